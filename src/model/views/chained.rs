//! One substitution after another: logarithms of flange thicknesses, flange thicknesses of a lifted model.

use super::substitution::Substitution;
use crate::model::Model;

/// The problem in the variables of `second`, which substitutes those of `first`: z = second(first(x)).
pub struct Chained<F, S> {
    first: F,
    second: S,
}

impl<F: Substitution, S: Substitution> Chained<F, S> {
    /// `second` substitutes variables of `first`'s model.
    pub fn new(first: F, second: S) -> Self {
        Chained { first, second }
    }
}

impl<F: Substitution, S: Substitution> Substitution for Chained<F, S> {
    fn model(&self) -> &dyn Model {
        self.second.model()
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        self.second.inward(&self.first.inward(x))
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        self.first.outward(&self.second.outward(z))
    }

    fn outward_objective(&self, value: f64) -> f64 {
        self.first.outward_objective(self.second.outward_objective(value))
    }

    fn outward_multipliers(&self, user: &dyn Model, z: &[f64], y: &[f64]) -> Option<Vec<f64>> {
        let between = self.second.outward_multipliers(self.first.model(), z, y)?;
        self.first.outward_multipliers(user, &self.second.outward(z), &between)
    }

    fn vanishing(&self, x: &[f64]) -> Vec<(usize, usize)> {
        self.first.vanishing(x)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use num_dual::DualNum;

    use super::*;
    use crate::model::derivative_check::derivative_check;
    use crate::model::sample::Sample;
    use crate::model::views::flange_substitution::FlangeSubstitution;
    use crate::model::views::logarithmic::Logarithmic;

    /// x = (h, hw, b): the area of flanges is no posynomial in heights, and one in the thickness h − hw.
    fn chain() -> Chained<Arc<FlangeSubstitution>, Logarithmic> {
        let model = Sample::new(&[0.6, 0.4, 0.2], |x| x[2] * (x[0] - x[1])).bounds(&[0.1, 0.1, 0.01], &[1.0, 0.9, 1.0]).row(
            1e-3,
            f64::INFINITY,
            |x| (x[0] - x[1]) * x[1].powi(2),
        );
        let flanges = Arc::new(FlangeSubstitution::new(Arc::new(model), &[(0, 1)]));
        let logarithms = Logarithmic::new(Arc::clone(&flanges) as _, vec![true, false]).unwrap();
        Chained::new(flanges, logarithms)
    }

    #[test]
    fn points_go_through_both_and_back() {
        let (chain, x) = (chain(), [0.7, 0.5, 0.3]);
        let z = chain.inward(&x);
        assert!(z.iter().zip([0.2_f64, 0.5, 0.3]).all(|(z, thick)| (z - thick.ln()).abs() < 1e-14), "{z:?}");
        assert!(chain.outward(&z).iter().zip(x).all(|(there, x)| (there - x).abs() < 1e-14));
        assert!((chain.model().objective(&z).unwrap() - 0.3 * 0.2).abs() < 1e-15);
    }

    #[test]
    fn derivatives_stay_exact() {
        let chain = chain();
        let check = derivative_check(chain.model(), &[-1.4, -0.7, -1.2]).unwrap();
        assert_eq!(check.disagreements, 0, "{:?}", check.worst);
    }
}
