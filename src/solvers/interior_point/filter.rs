//! The filter of Fletcher & Leyffer as in Wächter & Biegler (2006), §2.3: pairs of violation and barrier objective that
//! a trial point must not be dominated by.

use super::parameters::PARAMETERS;

/// Pairs (θ, φ) that bound the region of rejected points, margins included.
#[derive(Debug, Default)]
pub(super) struct Filter {
    entries: Vec<(f64, f64)>,
    /// θ_max: no point beyond is accepted.
    largest_violation: f64,
}

impl Filter {
    /// Forgets all entries; points beyond `largest_violation` stay rejected.
    pub fn reset(&mut self, largest_violation: f64) {
        self.entries.clear();
        self.largest_violation = largest_violation;
    }

    /// Whether a point with these measures may be accepted.
    pub fn accepts(&self, violation: f64, objective: f64) -> bool {
        violation <= self.largest_violation && self.entries.iter().all(|&(v, o)| violation < v || at_most(objective, o))
    }

    /// Rejects from now on what does not improve on this point by the margins.
    pub fn add(&mut self, violation: f64, objective: f64) {
        let entry = ((1.0 - PARAMETERS.filter.gamma_theta) * violation, objective - PARAMETERS.filter.gamma_phi * violation);
        self.entries.retain(|&(v, o)| v < entry.0 || o < entry.1);
        self.entries.push(entry);
    }
}

/// a ≤ b but for the rounding of b.
pub(super) fn at_most(a: f64, b: f64) -> bool {
    a - b <= 10.0 * f64::EPSILON * b.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dominated_points_are_rejected_and_others_are_not() {
        let mut filter = Filter::default();
        filter.reset(10.0);
        filter.add(1.0, 5.0);
        assert!(!filter.accepts(1.0, 5.0) && !filter.accepts(2.0, 6.0));
        assert!(filter.accepts(0.5, 9.0) && filter.accepts(3.0, 4.0));
        assert!(!filter.accepts(11.0, -1.0));
    }

    #[test]
    fn a_better_entry_replaces_the_ones_it_dominates() {
        let mut filter = Filter::default();
        filter.reset(10.0);
        filter.add(2.0, 5.0);
        filter.add(1.0, 4.0);
        assert_eq!(filter.entries.len(), 1);
    }
}
