//! One iteration of the primal-dual interior point: Wächter & Biegler, "On the implementation of an interior-point filter
//! line-search algorithm for large-scale nonlinear programming", Math. Program. 106 (2006), Algorithm A. The strategies
//! propose; what is done is decided here.

use super::begin::InitialPoint;
use super::ending::Ending;
use super::globalization::{Globalization, Proposal};
use super::parameters::PARAMETERS;
use super::polish::TrialPolish;
use super::predictor::{Predicted, Predictor};
use super::restoration::{self, Next, Origin, Restored};
use super::saddle::Escapes;
use super::slack_form::Source;
use super::state::State;
use crate::model::{EvaluationError, Model};
use crate::solvers::{Conclusion, RankedPoint, Why};

/// The state of a run, and the strategies that work on it. Each keeps its own counters.
pub(super) struct Engine<'a> {
    pub state: State<'a>,
    globalization: Globalization,
    predictor: Predictor,
    trial_polish: TrialPolish,
    escapes: Escapes,
    restoration: Option<Box<Restoration<'a>>>,
    /// Restorations so far.
    restorations: usize,
}

/// A restoration under way: the same iterations on the elastic problem.
struct Restoration<'a> {
    engine: Engine<'a>,
    origin: Origin,
}

impl<'a> Engine<'a> {
    /// At the start, ready to iterate.
    pub fn new(model: Source<'a>, beginning: InitialPoint<'_>) -> Result<Self, EvaluationError> {
        let state = State::at_start(model, beginning)?;
        let is_large = state.form.is_large();
        // Equilibrium couples design and displacements by their products: such a problem is not convex anywhere near its start.
        let has_states = state.form.model.meta().states.is_some();
        Ok(Engine {
            globalization: Globalization::new(state.iterate.violation()),
            predictor: Predictor::new(is_large && !has_states),
            trial_polish: TrialPolish::new(is_large),
            escapes: Escapes::default(),
            restoration: None,
            restorations: 0,
            state,
        })
    }

    /// One iteration. `Some`: it was the last.
    pub fn step(&mut self) -> Result<Option<Ending>, EvaluationError> {
        self.state.iterations += 1;
        if let Some(restoration) = self.restoration.take() {
            return self.restoration_step(restoration);
        }
        match Ending::called_for(&self.state) {
            Some(ending) if ending.is_solved() && self.leave_saddle()? => {}
            Some(ending) => return Ok(Some(ending)),
            None if self.trial_polish.succeeds(&mut self.state)? || self.predicted()? => return Ok(None),
            None => {}
        }
        if !self.globalization.is_on_trial() {
            self.decrease_barrier();
        }
        match self.state.newton_direction() {
            Ok(true) => {}
            Ok(false) => return self.restore("the KKT matrix has no usable factors"),
            Err(EvaluationError::Invalid { term, cause }) => return Ok(Some(Ending::Invalid(format!("{term}: {cause}")))),
            Err(stopped) => return Err(stopped),
        }
        self.move_along()
    }

    /// Whether a step was taken without the filter.
    fn predicted(&mut self) -> Result<bool, EvaluationError> {
        let predicted = self.predictor.step(&mut self.state)?;
        if predicted == Predicted::HandedOver {
            self.forget();
        }
        Ok(predicted == Predicted::Step)
    }

    /// Whether the iterate was a saddle and has been left.
    fn leave_saddle(&mut self) -> Result<bool, EvaluationError> {
        // Where steps are still taken without the filter the inertia was right at the last of them.
        let left = !self.predictor.is_in_charge() && self.escapes.leave(&mut self.state)?;
        if left {
            self.forget();
        }
        Ok(left)
    }

    /// The iterate was put elsewhere: the filter and the search for the best iterate begin anew.
    fn forget(&mut self) {
        self.globalization.forget();
        self.state.forget_best();
    }

    /// Lowers μ while the barrier problem is solved well enough: equation (7). Steps below rounding count as well enough once.
    fn decrease_barrier(&mut self) {
        let rule = &PARAMETERS.barrier;
        let mut at_rest = self.globalization.is_at_rest();
        while self.state.mu > rule.mu_last {
            let error = self.state.barrier_error();
            if !rule.is_solved(error, self.state.mu) && !at_rest {
                break;
            }
            at_rest = false;
            self.state.mu = rule.next(self.state.mu);
            self.globalization.for_new_barrier();
        }
    }

    /// Goes where the globalization proposes; restores feasibility where it has nothing to propose.
    fn move_along(&mut self) -> Result<Option<Ending>, EvaluationError> {
        let mut cap: f64 = 1.0;
        loop {
            let length = match self.globalization.propose(&mut self.state, cap)? {
                Proposal::Step(length) => length,
                Proposal::Back => {
                    self.state.assess();
                    return Ok(None);
                }
                Proposal::Failed => return self.without_proposal(),
            };
            if self.globalization.stays_at_rest() && self.state.mu <= PARAMETERS.barrier.mu_last {
                return Ok(Some(Ending::of_progress(&self.state, "the steps are below rounding")));
            }
            match self.state.take(length) {
                Ok(()) => return Ok(None),
                // Values exist there, derivatives do not: stay closer.
                Err(EvaluationError::Invalid { .. }) if length > PARAMETERS.shortest_with_derivatives => cap = 0.5 * length,
                Err(EvaluationError::Invalid { .. }) => return self.without_proposal(),
                Err(stopped) => return Err(stopped),
            }
        }
    }

    /// A step that lowers the primal-dual error is taken even against the filter (the soft restoration of §3.10 in
    /// spirit: near a solution φ is lost in rounding, the error is not); otherwise feasibility is restored.
    fn without_proposal(&mut self) -> Result<Option<Ending>, EvaluationError> {
        let state = &mut self.state;
        let before = state.barrier_error();
        let mut length = state.longest_step();
        for _ in 0..PARAMETERS.restoration.soft_steps {
            state.move_trial(length);
            if state.evaluate_trial()? {
                state.step_multipliers(length);
                if state.trial_barrier_error() < PARAMETERS.restoration.kappa_soft * before {
                    state.take(length)?;
                    return Ok(None);
                }
            }
            length *= 0.5;
        }
        self.restore("the line search found no acceptable step")
    }

    /// Begins a restoration, unless this is one itself or there is nothing to restore.
    fn restore(&mut self, why: &str) -> Result<Option<Ending>, EvaluationError> {
        let is_restoration = matches!(self.state.form.model, Source::Own(_));
        self.restorations += usize::from(!is_restoration);
        if is_restoration
            || !restoration::is_called_for(&self.state)
            || self.restorations > PARAMETERS.restoration.most_restorations
        {
            return Ok(Some(Ending::of_progress(&self.state, why)));
        }
        self.globalization.leave(&self.state);
        self.begin_restoration(Origin::of(&self.state))
    }

    fn begin_restoration(&mut self, origin: Origin) -> Result<Option<Ending>, EvaluationError> {
        let Some((elastic, mu)) = restoration::elastic(&mut self.state, origin.zeta)? else {
            return Ok(Some(Ending::of_progress(&self.state, "restoration failed")));
        };
        let start = elastic.meta().start.clone();
        let beginning = InitialPoint { mu: Some(mu), push: Some(PARAMETERS.kappa_1_warm), ..InitialPoint::at(&start) };
        match Engine::new(Source::Own(Box::new(elastic)), beginning) {
            Ok(engine) => {
                self.restoration = Some(Box::new(Restoration { engine, origin }));
                Ok(None)
            }
            Err(EvaluationError::Invalid { term, cause }) => Ok(Some(Ending::Invalid(format!("{term}: {cause}")))),
            Err(stopped) => Err(stopped),
        }
    }

    /// One iteration of the restoration, and a look whether its point will do.
    fn restoration_step(&mut self, mut restoration: Box<Restoration<'a>>) -> Result<Option<Ending>, EvaluationError> {
        let ending = restoration.engine.step()?;
        let Self { state, globalization, .. } = self;
        state.step_norm = restoration.engine.state.step_norm;
        let inside = restoration::adopt(state, &mut restoration.engine.state)?;
        let restored = Restored {
            inside,
            violation: state.trial.violation(),
            largest: state.form.scaled_violation(&state.trial.rows),
            admitted: inside && globalization.admits_trial(state),
        };
        let next = restoration::next(restoration.origin, ending.as_ref(), restored);
        if !matches!(next, Next::Iterate | Next::Failed) {
            std::mem::swap(&mut state.iterate, &mut state.trial);
        }
        match next {
            Next::Resume { open } => {
                if open {
                    globalization.open();
                }
                restoration::refresh_multipliers(state);
                Ok(None)
            }
            Next::Iterate => {
                self.restoration = Some(restoration);
                Ok(None)
            }
            Next::LastWord => self.begin_restoration(Origin::last_word(&self.state)),
            Next::Infeasible => Ok(Some(Ending::Infeasible)),
            Next::Failed => Ok(Some(Ending::Stuck("the restoration of feasibility failed".into()))),
        }
    }

    /// The run's conclusion and its point.
    pub fn conclude(&mut self, ending: &Ending) -> (Conclusion, RankedPoint) {
        let state = &mut self.state;
        let (why, message, invalid) = match ending {
            Ending::Optimal | Ending::Acceptable => {
                std::mem::swap(&mut state.iterate, &mut state.best.iterate);
                state.form.tighten();
                // A run told to stop keeps the point as it is.
                let _ = state.polish();
                (Why::Converged, format!("converged: optimality error {:.1e}", state.errors.largest()), None)
            }
            Ending::Infeasible => {
                let violation = state.form.violation(&state.iterate.rows);
                (Why::Converged, format!("the violation {violation:.3e} is a local minimum: locally infeasible"), None)
            }
            Ending::Diverging(message) => (Why::Converged, message.clone(), None),
            Ending::Stuck(message) => (Why::Failed, message.clone(), None),
            Ending::Invalid(term) => (Why::Failed, term.clone(), Some(term.clone())),
        };
        (Conclusion { why, message, invalid }, state.point())
    }
}
