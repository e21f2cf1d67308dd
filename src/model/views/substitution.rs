//! The same problem in other variables: what backends solve where that is easier (logarithms, flange thicknesses).

use crate::model::Model;

/// A model in substituted variables z with the way there and back. Rows keep their order and meaning; some of its own may follow.
pub trait Substitution: Sync {
    /// The model in z.
    fn model(&self) -> &dyn Model;

    /// z(x), moved into the substituted model's bounds.
    fn inward(&self, x: &[f64]) -> Vec<f64>;

    /// x(z)
    fn outward(&self, z: &[f64]) -> Vec<f64>;

    /// f(x(z)) from the substituted model's objective, where that is not f itself (but, say, its logarithm). Increasing.
    fn outward_objective(&self, value: f64) -> f64 {
        value
    }

    /// Row multipliers of the user's model at x(z) from those of the substituted one at z, where they say anything of each other:
    /// a witness, worth what the sums computed from it say.
    fn outward_multipliers(&self, _user: &dyn Model, _z: &[f64], _y: &[f64]) -> Option<Vec<f64>> {
        None
    }

    /// Pairs (a, b) of user variables whose difference a − b has all but vanished at x: only a bound of the substituted model's own
    /// keeps it positive.
    fn vanishing(&self, _x: &[f64]) -> Vec<(usize, usize)> {
        Vec::new()
    }
}

impl<S: Substitution + Send + ?Sized> Substitution for std::sync::Arc<S> {
    fn model(&self) -> &dyn Model {
        (**self).model()
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        (**self).inward(x)
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        (**self).outward(z)
    }

    fn outward_objective(&self, value: f64) -> f64 {
        (**self).outward_objective(value)
    }

    fn outward_multipliers(&self, user: &dyn Model, z: &[f64], y: &[f64]) -> Option<Vec<f64>> {
        (**self).outward_multipliers(user, z, y)
    }

    fn vanishing(&self, x: &[f64]) -> Vec<(usize, usize)> {
        (**self).vanishing(x)
    }
}
