//! Models that decompose: variables that meet in no row and no term of the objective can be solved for by themselves.
//!
//! | file | subject |
//! |---|---|
//! | `members` | which elements belong to which component |
//! | `local` | one component, evaluated densely |
//! | `submodel` | one component as a model of its own |

mod local;
mod members;
mod submodel;

pub use crate::linear_algebra::Partition;
pub(super) use members::ComponentView;
pub use members::Members;

use super::Model;
use local::DenseComponent;
use submodel::submodel;

/// A model that decomposes is formulated, solved and judged component by component where it has at least so many variables: with fewer,
/// sharing the work among threads costs what it saves.
pub const FEWEST_VARIABLES: usize = 200;
/// Components of at most so many variables (where they are solved or judged, rows as well) are small: dense matrices do for them.
pub const SMALL: usize = 64;
/// Small components a thread takes at a time.
pub const BATCH: usize = 128;

/// A model seen as a sum of small ones over disjoint variables: f(x) = constant + Σ f_k(x_k), each row within one component.
pub trait Components: Sync {
    /// Who belongs where.
    fn partition(&self) -> &Partition;

    /// What the objective holds besides the components.
    fn constant(&self) -> f64;

    /// Whether every f_k is a sum of volumes: positive wherever it makes sense.
    fn has_positive_objective(&self) -> bool {
        false
    }

    /// An evaluator for one component at a time, with working memory of its own: one per thread.
    fn local(&self) -> Box<dyn Local + '_>;

    /// Component k as a model of its own, for solvers that want one. Variables and rows in the order of [`Partition`].
    fn model(&self, component: usize) -> Box<dyn Model + '_>;
}

impl Components for ComponentView<'_> {
    fn partition(&self) -> &Partition {
        &self.members.partition
    }

    fn constant(&self) -> f64 {
        self.model.objective.constant
    }

    fn has_positive_objective(&self) -> bool {
        self.members.positive
    }

    fn local(&self) -> Box<dyn Local + '_> {
        Box::new(DenseComponent::new(*self))
    }

    fn model(&self, component: usize) -> Box<dyn Model + '_> {
        Box::new(submodel(*self, component))
    }
}

/// Dense values and derivatives of one component: n variables and m rows in the order of [`Partition`].
///
/// Nothing is guarded here: outside the domain there come NaN or infinities, and callers must look.
pub trait Local {
    /// Turns to another component. Evaluations before the first call see an empty one.
    fn select(&mut self, component: usize);

    /// f(x); rows are overwritten by c(x).
    fn values(&mut self, x: &[f64], rows: &mut [f64]) -> f64;

    /// f(x); overwrites c(x), ∇f(x) and the Jacobian (m×n, row by row).
    fn first_order(&mut self, x: &[f64], rows: &mut [f64], gradient: &mut [f64], jacobian: &mut [f64]) -> f64;

    /// Overwrites the lower triangle (n×n, row by row) by weight·∇²f + Σ y_i ∇²c_i.
    fn hessian(&mut self, x: &[f64], weight: f64, y: &[f64], hessian: &mut [f64]);
}
