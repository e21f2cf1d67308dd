//! The watchdog of Wächter & Biegler (2006), §3.2: where many steps in a row were cut short, a few full ones are
//! taken on trial against the filter's will. Kept if they lead to a point the filter likes; undone otherwise.

use super::acceptance::{Acceptance, Here, Measure};
use super::iterate::Iterate;
use super::parameters::PARAMETERS;
use super::state::State;
use crate::model::EvaluationError;

/// What to return to.
pub(super) struct Watchdog {
    iterate: Iterate,
    here: Here,
    trials: usize,
}

/// What a full step on trial came to.
#[derive(Debug, PartialEq)]
pub(super) enum Trial {
    /// The filter likes where it leads: the watchdog is done.
    Kept(f64),
    /// It is taken, and the watchdog goes on.
    Another(f64),
    /// The trials led nowhere: the iterate is back where they began.
    Undone,
}

impl Watchdog {
    /// Trials that begin at the current iterate.
    pub fn at(state: &State<'_>, here: Here) -> Self {
        Watchdog { iterate: state.iterate.clone(), here, trials: 0 }
    }

    /// Puts the trial point a full step on.
    pub fn full_step(&mut self, state: &mut State<'_>, acceptance: &mut Acceptance) -> Result<Trial, EvaluationError> {
        let longest = state.longest_step();
        state.move_trial(longest);
        let measure = Measure::evaluated(state)?;
        if measure.is_some_and(|measure| acceptance.takes(&self.here, longest, measure)) {
            return Ok(Trial::Kept(longest));
        }
        self.trials += 1;
        if measure.is_none() || self.trials > PARAMETERS.watchdog_trials {
            state.iterate.clone_from(&self.iterate);
            return Ok(Trial::Undone);
        }
        Ok(Trial::Another(longest))
    }
}
