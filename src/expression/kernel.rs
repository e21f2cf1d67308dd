//! One small function of a few inputs, evaluated over many tuples of variables: what a model is a sum of.

use super::tape::{Tape, Workspace};

/// Value, gradient and Hessian of a function of `inputs()` numbers, with `data()` constants that differ from element to element.
///
/// Outside its domain a kernel gives NaN or an infinity; [`Kernel::explain`] says why. Slices have the lengths stated here.
pub trait Kernel: Send + Sync {
    /// Number of inputs.
    fn inputs(&self) -> usize;

    /// Number of constants per element.
    fn data(&self) -> usize {
        0
    }

    /// Local positions (row ≥ column) at which the Hessian can be non-zero, in the order [`Kernel::hessian`] fills them.
    fn hessian_pattern(&self) -> &[(u32, u32)];

    /// f(x)
    fn value(&self, x: &[f64], data: &[f64], workspace: &mut Workspace) -> f64;

    /// ∇f(x), overwritten; returns f(x).
    fn gradient(&self, x: &[f64], data: &[f64], workspace: &mut Workspace, gradient: &mut [f64]) -> f64;

    /// ∇²f(x) along the pattern, overwritten.
    fn hessian(&self, x: &[f64], data: &[f64], workspace: &mut Workspace, hessian: &mut [f64]);

    /// Why there is no finite value (or derivative) here; `None` where there is.
    fn explain(&self, x: &[f64], data: &[f64]) -> Option<String>;
}

impl Kernel for Tape {
    fn inputs(&self) -> usize {
        Tape::inputs(self)
    }

    fn data(&self) -> usize {
        Tape::data(self)
    }

    fn hessian_pattern(&self) -> &[(u32, u32)] {
        Tape::hessian_pattern(self)
    }

    fn value(&self, x: &[f64], data: &[f64], workspace: &mut Workspace) -> f64 {
        Tape::value(self, x, data, workspace)
    }

    fn gradient(&self, x: &[f64], data: &[f64], workspace: &mut Workspace, gradient: &mut [f64]) -> f64 {
        Tape::gradient(self, x, data, workspace, gradient)
    }

    fn hessian(&self, x: &[f64], data: &[f64], workspace: &mut Workspace, hessian: &mut [f64]) {
        Tape::hessian(self, x, data, workspace, hessian);
    }

    fn explain(&self, x: &[f64], data: &[f64]) -> Option<String> {
        Tape::explain(self, x, data).map(|invalid| invalid.cause)
    }
}
