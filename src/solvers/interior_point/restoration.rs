//! The feasibility restoration: Wächter & Biegler (2006), §3.3. The same engine minimises the violation until the
//! filter accepts a point again, or a local minimum of the violation shows that there is none nearby.

use super::begin::InitialPoint;
use super::elastic::Elastic;
use super::engine::{Ending, Engine};
use super::form::Source;
use super::parameters::PARAMETERS;
use super::start;
use super::vectors::norm_max;
use crate::model::{EvaluationError, Model};

/// Violations (scaled) below this cannot be told from rounding: no verdict of infeasibility.
const SMALLEST_VIOLATION: f64 = 1e-9;
/// ζ = this·√μ, and the ζ of the last word on infeasibility.
const PROXIMITY: f64 = 1e-3;
const LAST_PROXIMITY: f64 = 1e-9;

/// A restoration under way.
pub(super) struct Restoration<'a> {
    engine: Engine<'a>,
    /// θ when it began.
    violation: f64,
    /// Whether the proximity term is gone but for a trace.
    last_word: bool,
}

impl<'a> Engine<'a> {
    /// Begins a restoration, unless this is one itself or there is nothing to restore.
    pub(super) fn restore(&mut self, why: &str) -> Result<Option<Ending>, EvaluationError> {
        let violation = self.iterate.violation();
        let nothing_to_restore = norm_max(&self.iterate.residual) <= SMALLEST_VIOLATION;
        let Source::Given(_) = self.form.model else { return Ok(Some(self.end_of_progress(why))) };
        self.restorations += 1;
        if nothing_to_restore || self.restorations > PARAMETERS.most_restorations {
            return Ok(Some(self.end_of_progress(why)));
        }
        self.watchdog = None;
        self.shortened_steps = 0;
        let here = self.current_measure();
        self.filter.add(here.violation, here.objective);
        let zeta = PROXIMITY * self.mu.sqrt();
        self.begin_restoration(zeta, violation)
    }

    fn begin_restoration(&mut self, zeta: f64, violation: f64) -> Result<Option<Ending>, EvaluationError> {
        let Source::Given(model) = self.form.model else { return Ok(Some(self.end_of_progress("restoration failed"))) };
        let x = self.form.x(&self.iterate.w).to_vec();
        let rows: Vec<(usize, f64)> = self.form.rows.iter().copied().zip(self.form.row_scale.iter().copied()).collect();
        let mu = self.mu.max(norm_max(&self.iterate.residual).min(1e3));
        let elastic = Elastic::new(model, &x, rows, zeta, mu)?;
        let start = elastic.meta().start.clone();
        let beginning = InitialPoint { mu: Some(mu), push: Some(PARAMETERS.kappa_1_warm), ..InitialPoint::at(&start) };
        match Engine::new(Source::Own(Box::new(elastic)), beginning) {
            Ok(engine) => {
                let last_word = zeta <= LAST_PROXIMITY;
                self.restoration = Some(Box::new(Restoration { engine, violation, last_word }));
                Ok(None)
            }
            Err(EvaluationError::Invalid { term, cause }) => Ok(Some(Ending::Invalid(format!("{term}: {cause}")))),
            Err(stopped) => Err(stopped),
        }
    }

    /// One iteration of the restoration, and a look whether its point will do.
    pub(super) fn restoration_step(&mut self) -> Result<Option<Ending>, EvaluationError> {
        let Some(mut restoration) = self.restoration.take() else { return Ok(None) };
        let ending = restoration.engine.step()?;
        self.step_norm = restoration.engine.step_norm;
        let inside = self.adopt(&mut restoration)?;
        let violation = self.trial.violation();
        let accepted = inside && violation <= PARAMETERS.kappa_resto * restoration.violation && {
            let measure = self.measure(&self.trial.w, self.trial.objective, &self.trial.residual);
            self.filter.accepts(measure.violation, measure.objective)
        };
        match ending {
            _ if accepted => self.resume(),
            None => {
                self.restoration = Some(restoration);
                Ok(None)
            }
            Some(Ending::Optimal | Ending::Acceptable) if inside => self.end_restoration(&restoration),
            Some(_) if inside && violation < PARAMETERS.kappa_resto * restoration.violation => {
                self.filter.reset(self.largest_violation);
                self.resume()
            }
            Some(_) => Ok(Some(Ending::Stuck("the restoration of feasibility failed".into()))),
        }
    }

    /// Puts the trial point at the restoration's x, slacks at the rows' values. `false`: outside the domain.
    fn adopt(&mut self, restoration: &mut Restoration<'a>) -> Result<bool, EvaluationError> {
        let inner = &mut restoration.engine;
        let x = inner.form.x(&inner.iterate.w);
        for (at, &j) in self.form.free.iter().enumerate() {
            self.trial.w[at] = x[j] / self.form.variable_scale[at];
        }
        let push = self.mu.clamp(PARAMETERS.kappa_1_warm * 1e-4, PARAMETERS.kappa_1);
        self.form.keep_inside(&mut self.trial.w);
        match self.trial.evaluate(&mut self.form) {
            Ok(()) => start::place_slacks(&self.form, &mut self.trial, push),
            Err(EvaluationError::Invalid { .. }) => return Ok(false),
            Err(stopped) => return Err(stopped),
        }
        Ok(true)
    }

    /// The restoration converged at the trial point without the filter's consent.
    fn end_restoration(&mut self, restoration: &Restoration<'a>) -> Result<Option<Ending>, EvaluationError> {
        if self.form.scaled_violation(&self.trial.rows) <= SMALLEST_VIOLATION {
            self.filter.reset(self.largest_violation);
            return self.resume();
        }
        std::mem::swap(&mut self.iterate, &mut self.trial);
        if restoration.last_word {
            return Ok(Some(Ending::Infeasible));
        }
        let violation = self.iterate.violation();
        self.begin_restoration(LAST_PROXIMITY, violation)
    }

    /// Goes on from the trial point with fresh multipliers.
    fn resume(&mut self) -> Result<Option<Ending>, EvaluationError> {
        std::mem::swap(&mut self.iterate, &mut self.trial);
        start::central_bound_multipliers(&self.form, &mut self.iterate, self.mu, PARAMETERS.largest_restored_multiplier);
        start::least_squares_multipliers(&self.form, &mut self.kkt, &mut self.iterate);
        self.assess();
        Ok(None)
    }
}
