//! The watchdog of Wächter & Biegler (2006), §3.2: where many steps in a row were cut short, a few full ones are
//! taken on trial against the filter's will. Kept if they lead to a point the filter likes; undone otherwise.

use super::barrier;
use super::engine::Engine;
use super::iterate::Iterate;
use super::line_search::{Here, Search};
use super::parameters::PARAMETERS;
use crate::model::EvaluationError;

/// What to return to.
pub(super) struct Watchdog {
    iterate: Iterate,
    here: Here,
    trials: usize,
}

impl Engine<'_> {
    /// Counts steps cut short, and notes where to return to when there were too many.
    pub(super) fn watch(&mut self, here: Here) {
        if self.watchdog.is_none() && self.shortened_steps >= PARAMETERS.watchdog_after {
            self.shortened_steps = 0;
            self.watchdog = Some(Box::new(Watchdog { iterate: self.iterate.clone(), here, trials: 0 }));
        }
    }

    /// A full step on trial. `None`: the trials led nowhere and the iterate is back where they began.
    pub(super) fn full_step_on_trial(&mut self, mut watchdog: Box<Watchdog>) -> Result<Option<Search>, EvaluationError> {
        let longest = barrier::longest_step(&self.form, &self.iterate.w, &self.direction.w, self.tau());
        self.move_trial(longest);
        let measure = self.trial_measure()?;
        if let Some(measure) = measure {
            let verdict = self.judge(&watchdog.here, longest, measure);
            if self.accept(&watchdog.here, verdict) {
                return Ok(Some(Search::Step(longest)));
            }
        }
        watchdog.trials += 1;
        if measure.is_none() || watchdog.trials > PARAMETERS.watchdog_trials {
            self.iterate = watchdog.iterate;
            return Ok(None);
        }
        self.watchdog = Some(watchdog);
        Ok(Some(Search::Step(longest)))
    }
}
