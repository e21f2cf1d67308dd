//! What proposes the next point along a direction: the filter line search, or the watchdog where that has cut too many steps short.

use super::acceptance::{Acceptance, Here, Measure};
use super::line_search::{Search, line_search};
use super::parameters::PARAMETERS;
use super::state::State;
use super::watchdog::{Trial, Watchdog};
use crate::model::EvaluationError;

/// A point to go to: the state's trial point, at this length along the direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Proposal {
    /// Go there.
    Step(f64),
    /// Nothing: the iterate is back where the watchdog's trials began.
    Back,
    /// No length is acceptable.
    Failed,
}

/// The filter, the watchdog, and how the last steps went.
pub(super) struct Globalization {
    acceptance: Acceptance,
    watchdog: Option<Box<Watchdog>>,
    /// Steps in a row that were cut short.
    shortened_steps: usize,
    /// Steps in a row that were below rounding.
    tiny_steps: usize,
}

impl Globalization {
    /// For a run that begins with the violation θ₀.
    pub fn new(theta_0: f64) -> Self {
        Globalization { acceptance: Acceptance::new(theta_0), watchdog: None, shortened_steps: 0, tiny_steps: 0 }
    }

    /// The next point, at most the length `cap` away.
    pub fn propose(&mut self, state: &mut State<'_>, cap: f64) -> Result<Proposal, EvaluationError> {
        let length = match self.watchdog.take() {
            Some(mut watchdog) => match watchdog.full_step(state, &mut self.acceptance)? {
                Trial::Kept(length) => length,
                Trial::Another(length) => {
                    self.watchdog = Some(watchdog);
                    length
                }
                Trial::Undone => return Ok(Proposal::Back),
            },
            None => {
                let here = Here::of(state);
                match line_search(state, &mut self.acceptance, &here, cap)? {
                    Search::Full(length) => {
                        self.shortened_steps = 0;
                        length
                    }
                    Search::Shortened(length) => {
                        self.shortened_steps += 1;
                        self.watch(state, here);
                        length
                    }
                    Search::Corrected(length) => length,
                    Search::Tiny(length) => {
                        self.tiny_steps += 1;
                        return Ok(Proposal::Step(length));
                    }
                    Search::Failed => return Ok(Proposal::Failed),
                }
            }
        };
        self.tiny_steps = 0;
        Ok(Proposal::Step(length))
    }

    /// Notes where to return to when too many steps were cut short.
    fn watch(&mut self, state: &State<'_>, here: Here) {
        if self.shortened_steps >= PARAMETERS.watchdog_after {
            self.shortened_steps = 0;
            self.watchdog = Some(Box::new(Watchdog::at(state, here)));
        }
    }

    /// Whether steps are being taken on trial.
    pub fn is_on_trial(&self) -> bool {
        self.watchdog.is_some()
    }

    /// Whether the last two steps were below rounding: the barrier problem is as good as solved.
    pub fn is_at_rest(&self) -> bool {
        self.tiny_steps >= 2
    }

    /// Whether even a lower barrier parameter has not brought the steps above rounding.
    pub fn stays_at_rest(&self) -> bool {
        self.tiny_steps > 2
    }

    /// Whether the filter lets the trial point in.
    pub fn admits_trial(&self, state: &State<'_>) -> bool {
        self.acceptance.admits(Measure::of_trial(state))
    }

    /// The barrier parameter has changed, and with it every φ.
    pub fn for_new_barrier(&mut self) {
        self.acceptance.forget();
        self.tiny_steps = 0;
    }

    /// The iterate was put elsewhere: nothing of the way there counts.
    pub fn forget(&mut self) {
        self.for_new_barrier();
        self.watchdog = None;
    }

    /// Empties the filter.
    pub fn open(&mut self) {
        self.acceptance.forget();
    }

    /// The iterate is left for a restoration: the filter keeps others from coming back to it.
    pub fn leave(&mut self, state: &State<'_>) {
        self.watchdog = None;
        self.shortened_steps = 0;
        self.acceptance.enter(Measure::of_iterate(state));
    }
}
