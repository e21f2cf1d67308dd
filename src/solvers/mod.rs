//! Our own solvers. They know models, and neither the library whose executor runs them nor what becomes of their answers.
//!
//! | room | method |
//! |---|---|
//! | [`interior_point`] | primal-dual interior point with a filter line search, sparse: every model |
//! | [`block_interior_point`] | many small independent components side by side, each by a small dense interior point |
//! | [`augmented_lagrangian`] | bounds-only subproblems by a trust region, multipliers moved in between |
//! | `barrier` | what both interior points do alike |
//! | [`progress`] | what an iteration leaves behind, and how a run ends |

pub mod augmented_lagrangian;
mod barrier;
pub mod block_interior_point;
pub mod interior_point;
pub mod progress;

pub use progress::{Conclusion, Progress, RankedPoint, Reached, Why};

/// Says whether a point passes as an answer: iterations may end there.
pub type StopTest<'a> = &'a (dyn Fn(&[f64]) -> bool + Sync);

/// A solver that is asked for one iteration after another. It counts nothing and shows nothing: who drives it does.
pub trait Solver {
    /// What it is called.
    fn name(&self) -> &'static str;

    /// Evaluates the first iterate.
    fn begin(&mut self) -> Progress;

    /// One iteration; `is_last`: the limit on iterations allows no further one.
    fn step(&mut self, is_last: bool) -> Progress;
}
