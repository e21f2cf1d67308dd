//! From one run of the engine to the next: anew in better scales where those of the start no longer fit the solution,
//! and from elsewhere where the first run failed.

use super::begin::InitialPoint;
use super::ending::Ending;
use super::engine::Engine;
use super::parameters::PARAMETERS;
use super::scaling;
use super::slack_form::Source;
use super::start;
use super::state::State;
use crate::model::{EvaluationError, Model};
use crate::solvers::{Conclusion, RankedPoint};

/// What became of earlier runs.
#[derive(Default)]
pub(super) struct Attempts {
    rescaled: usize,
    elsewhere: usize,
    /// The best conclusion so far with its point.
    earlier: Option<(Ending, Conclusion, RankedPoint)>,
}

impl Attempts {
    /// The next run, if one is called for after this ending. Notes what was reached.
    pub fn next<'a>(
        &mut self,
        model: &'a dyn Model,
        start: &[f64],
        engine: &mut Engine<'a>,
        (ending, conclusion, point): (Ending, Conclusion, RankedPoint),
        passes: &dyn Fn(&[f64]) -> bool,
    ) -> Result<Option<Engine<'a>>, EvaluationError> {
        let solved = ending.is_solved();
        if self.earlier.as_ref().is_none_or(|earlier| supersedes(&ending, &point, earlier)) {
            self.earlier = Some((ending.clone(), conclusion, point));
        }
        if solved {
            return self.in_new_scales(model, start, engine, passes);
        }
        let after_solved = self.earlier.as_ref().is_some_and(|(ending, ..)| ending.is_solved());
        let hopeless =
            matches!(ending, Ending::Diverging(_)) || start.len() > PARAMETERS.attempts.largest_repeated || after_solved;
        let Some(&(share, mu)) = PARAMETERS.attempts.elsewhere.get(self.elsewhere).filter(|_| !hopeless) else { return Ok(None) };
        self.elsewhere += 1;
        let x = start::towards_middle(model.meta(), start, share);
        begin(model, InitialPoint { mu: Some(mu), ease: PARAMETERS.attempts.ease, ..InitialPoint::at(&x) })
    }

    fn in_new_scales<'a>(
        &mut self,
        model: &'a dyn Model,
        start: &[f64],
        engine: &mut Engine<'a>,
        passes: &dyn Fn(&[f64]) -> bool,
    ) -> Result<Option<Engine<'a>>, EvaluationError> {
        if self.rescaled >= PARAMETERS.attempts.most_rescaled {
            return Ok(None);
        }
        let Some(magnitudes) = outgrown(&engine.state, start) else { return Ok(None) };
        self.rescaled += 1;
        let State { form, iterate, .. } = &mut engine.state;
        let x = form.x(&iterate.w).to_vec();
        let multipliers = form.multipliers(&iterate.y);
        let cold = InitialPoint { magnitudes: &magnitudes, ..InitialPoint::at(&x) };
        let warm = InitialPoint { multipliers: Some(&multipliers), ..cold };
        // Where the answer is as good in the new scales there is nothing to mend.
        let enough = PARAMETERS.attempts.good_enough.max(engine.state.errors.largest());
        match warm.error_as_answer(model)? {
            error if error <= enough || self.earlier.as_ref().is_some_and(|(.., point)| passes(&point.x)) => Ok(None),
            error if error <= PARAMETERS.epsilon_acceptable => {
                // What is nearly solved in scales that fit is solved by one more run; variables that are nothing but rounding never fit.
                self.rescaled = PARAMETERS.attempts.most_rescaled;
                begin(model, warm)
            }
            _ => begin(model, cold),
        }
    }

    /// What the runs came to.
    pub fn conclude(self) -> Option<(Conclusion, Option<RankedPoint>)> {
        self.earlier.map(|(ending, conclusion, point)| {
            // A run that got stuck has nothing to say for its last point; the best one by rank is handed back.
            let stuck = matches!(ending, Ending::Stuck(_) | Ending::Invalid(_));
            (conclusion, (!stuck).then_some(point))
        })
    }
}

fn begin<'a>(model: &'a dyn Model, beginning: InitialPoint<'_>) -> Result<Option<Engine<'a>>, EvaluationError> {
    match Engine::new(Source::Given(model), beginning) {
        Ok(engine) => Ok(Some(engine)),
        Err(EvaluationError::Invalid { .. }) => Ok(None),
        Err(stopped) => Err(stopped),
    }
}

/// Whether a run's ending is worth more than an earlier one's.
fn supersedes(ending: &Ending, point: &RankedPoint, (earlier, _, earlier_point): &(Ending, Conclusion, RankedPoint)) -> bool {
    let rank = |ending: &Ending| match ending {
        Ending::Optimal | Ending::Acceptable => 0,
        Ending::Diverging(_) => 1,
        Ending::Infeasible => 2,
        Ending::Stuck(_) => 3,
        Ending::Invalid(_) => 4,
    };
    match rank(ending).cmp(&rank(earlier)) {
        std::cmp::Ordering::Less => true,
        std::cmp::Ordering::Greater => false,
        // Solved again: in scales that fit better.
        std::cmp::Ordering::Equal => rank(ending) == 0 || point.relative_violation < earlier_point.relative_violation,
    }
}

/// The magnitudes of the variables at the iterate, if scales by them differ much from those in use.
fn outgrown(state: &State<'_>, start: &[f64]) -> Option<Vec<f64>> {
    let State { form, iterate, .. } = state;
    let mut magnitudes = start.to_vec();
    let mut growth = vec![1.0; form.variables()];
    for (at, &j) in form.free.iter().enumerate() {
        let scale = form.variable_scale[at];
        let x = iterate.w[at] * scale;
        // A variable that ends on its bound, or next to it, tells nothing of its magnitude by being small.
        let on_bound = iterate.w[at] == form.lower[at] || iterate.w[at] == form.upper[at];
        let least = if on_bound { scale } else { scale * PARAMETERS.attempts.smallest_share };
        magnitudes[j] = x.abs().max(start[j].abs()).max(least);
        growth[at] = scaling::variable_scale(magnitudes[j], f64::NEG_INFINITY, f64::INFINITY) / scale;
    }
    let much = |factor: f64| factor > PARAMETERS.attempts.outgrown || factor * PARAMETERS.attempts.outgrown < 1.0;
    let moved = growth.iter().any(|&factor| much(factor)) || rows_outgrown(state, &growth).any(much);
    moved.then_some(magnitudes)
}

/// By which factors objective and rows would be scaled differently.
fn rows_outgrown<'e>(State { form, iterate, .. }: &'e State<'_>, growth: &'e [f64]) -> impl Iterator<Item = f64> + 'e {
    let rows = (0..form.rows.len()).map(move |i| {
        let size = form.jacobian.range(i).map(|at| (iterate.jacobian[at] * growth[form.jacobian.columns[at] as usize]).abs());
        size.fold(0.0, f64::max)
    });
    let objective = iterate.gradient.iter().zip(growth).map(|(g, d)| (g * d).abs()).fold(0.0, f64::max);
    // The objective's gradient may vanish at a solution: only scales that were cut down too far count.
    let objective = if form.objective_scale < 1.0 || objective > 1.0 { objective } else { 1.0 };
    rows.chain([objective]).map(|size| scaling::gradient_scale(size, 0.0))
}
