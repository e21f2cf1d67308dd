//! Sums of numbers over the stiffnesses of members.

use std::collections::BTreeMap;

use super::numbers::{ROUNDING, Stiffness};
use crate::problem::Formula;
use crate::problem::rewritten::{over, total};

/// Σ number/(modulus·property), one term per member and stiffness.
#[derive(Default)]
pub(super) struct Sum {
    /// The number, and the size of the terms it is the sum of.
    terms: BTreeMap<(u32, Stiffness), (f64, f64)>,
}

impl Sum {
    pub fn add(&mut self, member: u32, stiffness: Stiffness, value: f64) {
        let term = self.terms.entry((member, stiffness)).or_default();
        *term = (term.0 + value, term.1 + value.abs());
    }

    /// As a formula, by modulus and property of each stiffness; `None` where one of these is not known.
    pub fn formula(&self, by: impl Fn(u32, Stiffness) -> Option<(f64, Formula)>) -> Option<Formula> {
        let kept = self.terms.iter().filter(|(_, (value, size))| value.abs() > ROUNDING * size);
        let term = |(&(member, stiffness), &(value, _)): (&(u32, Stiffness), &(f64, f64))| {
            let (modulus, property) = by(member, stiffness)?;
            Some(over(Formula::Constant(value / modulus), property))
        };
        Some(total(kept.map(term).collect::<Option<Vec<_>>>()?))
    }
}
