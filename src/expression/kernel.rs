//! One small function of a few inputs, evaluated over many tuples of variables: what a model is a sum of.

/// Value, gradient and Hessian of a function of `inputs()` numbers, with `data()` constants that differ from element to element.
///
/// Outside its domain a kernel gives NaN or an infinity; [`Kernel::explain`] says why. `scratch` has at least `scratch()` entries.
pub trait Kernel: Send + Sync {
    /// Number of inputs.
    fn inputs(&self) -> usize;

    /// Number of constants per element.
    fn data(&self) -> usize {
        0
    }

    /// Numbers of working memory each call needs.
    fn scratch(&self) -> usize {
        0
    }

    /// Local positions (row ≥ column) at which the Hessian can be non-zero, in the order [`Kernel::hessian`] fills them.
    fn hessian_pattern(&self) -> &[(u32, u32)];

    /// f(x)
    fn value(&self, x: &[f64], data: &[f64], scratch: &mut [f64]) -> f64;

    /// ∇f(x), overwritten; returns f(x).
    fn gradient(&self, x: &[f64], data: &[f64], scratch: &mut [f64], gradient: &mut [f64]) -> f64;

    /// ∇²f(x) along the pattern, overwritten.
    fn hessian(&self, x: &[f64], data: &[f64], scratch: &mut [f64], hessian: &mut [f64]);

    /// Why there is no finite value (or derivative) here; `None` where there is.
    fn explain(&self, x: &[f64], data: &[f64]) -> Option<String>;
}
