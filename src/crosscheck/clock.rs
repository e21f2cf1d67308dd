//! The time one command has, shared among everything it runs.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::{Duration, Instant};

use crate::model::Budget;

/// Longest time that is taken literally; beyond it there is no deadline.
const NO_DEADLINE: f64 = 3e9;

/// What judging may take beyond the deadline.
const GRACE: Duration = Duration::from_millis(300);

/// The deadline of the whole command and Ctrl-C.
#[derive(Clone, Copy)]
pub(super) struct Clock<'a> {
    deadline: Option<Instant>,
    interrupt: Option<&'a AtomicBool>,
    max_evaluations: u64,
}

impl<'a> Clock<'a> {
    pub(super) fn new(max_seconds: f64, max_evaluations: u64, interrupt: Option<&'a AtomicBool>) -> Self {
        let deadline = (max_seconds < NO_DEADLINE).then(|| Instant::now() + Duration::from_secs_f64(max_seconds.max(0.0)));
        Clock { deadline, interrupt, max_evaluations }
    }

    pub(super) fn is_interrupted(&self) -> bool {
        self.interrupt.is_some_and(|flag| flag.load(Relaxed))
    }

    pub(super) fn is_over(&self) -> bool {
        self.is_interrupted() || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// When judging ends with what it has: a little after the deadline, so that the point a run has ended with is still judged.
    pub(super) fn judging_ends(&self) -> Option<Instant> {
        self.deadline.map(|deadline| deadline + GRACE)
    }

    /// A budget with this share of the time that is left.
    pub(super) fn share(&self, share: f64) -> Budget<'a> {
        let now = Instant::now();
        let left = |deadline: Instant| deadline.saturating_duration_since(now);
        let deadline = self.deadline.map(|deadline| now + left(deadline).mul_f64(share));
        Budget { max_evaluations: self.max_evaluations, deadline, interrupt: self.interrupt }
    }
}
