//! Models stated in other variables, with the way there and back.

use super::Model;

/// A model whose variables z stand for the user's x. Objectives are equal: f_z(z) = f(x(z)).
///
/// Solvers work on z; whatever they find is judged at x by the user's own model.
pub trait Reformulation: Model {
    /// x(z), inside the user's bounds up to rounding.
    fn to_user(&self, z: &[f64]) -> Vec<f64>;

    /// A z that stands for x, moved inside the bounds of z.
    fn from_user(&self, x: &[f64]) -> Vec<f64>;
}
