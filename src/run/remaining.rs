//! What is left of the seconds a command may take: its further parts keep within them.

use std::time::Instant;

use crate::problem::Settings;

/// The time since a command began.
pub(super) struct Remaining {
    begun: Instant,
}

impl Remaining {
    /// Begins now.
    pub fn new() -> Self {
        Remaining { begun: Instant::now() }
    }

    /// The settings of a further part; `None` where no time is left for one.
    pub fn settings(&self, settings: &Settings) -> Option<Settings> {
        let max_seconds = settings.max_seconds - self.begun.elapsed().as_secs_f64();
        (max_seconds > 0.0).then(|| Settings { max_seconds, ..settings.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_further_part_has_what_is_left_and_none_begins_without() {
        let remaining = Remaining::new();
        let with = |max_seconds| Settings { max_seconds, ..Settings::default() };
        assert_eq!(remaining.settings(&with(f64::INFINITY)).unwrap().max_seconds, f64::INFINITY);
        assert!(remaining.settings(&with(1e6)).unwrap().max_seconds < 1e6);
        assert!(remaining.settings(&with(0.0)).is_none());
    }
}
