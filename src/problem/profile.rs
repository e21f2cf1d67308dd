//! Profiles: values along a line of ribs that follow a B-spline of few control values, note (1.5.1).
//!
//! At a fixed s the value is Σ w_i(s)·c_i: linear in the control values c_i, with at most degree + 1 weights that are not zero.
//! The weights are not negative and sum to one, so that **bounds on the control values bound the profile everywhere**: where
//! lower ≤ c_i ≤ upper for all i, lower ≤ profile(s) ≤ upper for every s in \[0, 1\].

use super::formula::Formula;
use crate::expression::operators::{Binary, Fold};
use crate::splines::KnotVector;

/// One entry of `[profiles]`.
///
/// ```
/// use ribopt::problem::profile::Profile;
/// use ribopt::splines::KnotVector;
/// let depth = Profile { name: "depth".into(), first: 4, knots: KnotVector::clamped_uniform(1, 3, 0.0, 1.0)? };
/// assert_eq!(depth.weights(0.75), Some(vec![(5, 0.5), (6, 0.5)]));
/// assert_eq!(depth.weights(1.5), None);
/// # Ok::<(), ribopt::splines::SplineError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Its name, which is that of its control variables `NAME[1]`, `NAME[2]`, … too.
    pub name: String,
    /// The first control variable; the others follow it.
    pub first: u32,
    /// Degree and knots, with the domain \[0, 1\].
    pub knots: KnotVector,
}

impl Profile {
    /// The control variables that count at s and their weights; `None` outside \[0, 1\].
    pub fn weights(&self, s: f64) -> Option<Vec<(u32, f64)>> {
        let basis = self.knots.basis(s).ok()?;
        let row = basis.values.into_iter().next()?;
        let variables = self.first + basis.first as u32..;
        Some(variables.zip(row).filter(|(_, weight)| *weight > 0.0).collect())
    }

    /// The profile's value at s as a sum over control variables; `None` outside \[0, 1\].
    pub fn at(&self, s: f64) -> Option<Formula> {
        let mut terms: Vec<Formula> = self.weights(s)?.into_iter().map(term).collect();
        match terms.len() {
            1 => terms.pop(),
            _ => Some(Formula::Fold(Fold::Sum, terms)),
        }
    }

    /// The profile's value at s where the variables are x; `None` outside \[0, 1\].
    pub fn value(&self, s: f64, x: &[f64]) -> Option<f64> {
        self.weights(s)?.into_iter().map(|(j, weight)| Some(weight * x.get(j as usize)?)).sum()
    }
}

fn term((variable, weight): (u32, f64)) -> Formula {
    let variable = Formula::Variable(variable);
    if weight == 1.0 {
        variable
    } else {
        Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(weight)), Box::new(variable))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cubic() -> Profile {
        Profile { name: "depth".into(), first: 2, knots: KnotVector::clamped_uniform(3, 6, 0.0, 1.0).unwrap() }
    }

    #[test]
    fn the_ends_are_the_end_controls() {
        assert_eq!(cubic().at(0.0), Some(Formula::Variable(2)));
        assert_eq!(cubic().at(1.0), Some(Formula::Variable(7)));
        assert_eq!(cubic().at(-0.1), None);
    }

    proptest! {
        #[test]
        fn bounds_on_controls_bound_the_profile(s in 0.0..=1.0f64, x in prop::collection::vec(0.2..1.2f64, 8)) {
            let profile = cubic();
            let weights = profile.weights(s).unwrap();
            prop_assert!(weights.len() <= 4);
            prop_assert!((weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-14);
            let value = profile.value(s, &x).unwrap();
            prop_assert!((0.2 - 1e-14..=1.2 + 1e-14).contains(&value));
        }
    }
}
