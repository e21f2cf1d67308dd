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

    /// Adds the weighted gradients of many elements to `target`, which holds the derivatives by the variables `first ..
    /// first + target.len()`; the others are left to whoever holds those. Returns the weighted values of the elements whose
    /// first input is among them.
    fn add_gradients(
        &self,
        elements: &Elements<'_>,
        x: &[f64],
        first: usize,
        target: &mut [f64],
        workspace: &mut Workspace,
    ) -> f64 {
        gradients_one_by_one(self, elements, x, first, target, workspace)
    }

    /// Adds the weighted Hessians of many elements to `target`, which holds the values `first .. first + target.len()`; `slots`
    /// says where each second derivative belongs, along the pattern. An element of weight 0 is left out.
    fn add_hessians(
        &self,
        elements: &Elements<'_>,
        x: &[f64],
        slots: &[u32],
        first: usize,
        target: &mut [f64],
        workspace: &mut Workspace,
    ) {
        hessians_one_by_one(self, elements, x, slots, first, target, workspace);
    }

    /// Why there is no finite value (or derivative) here; `None` where there is.
    fn explain(&self, x: &[f64], data: &[f64]) -> Option<String>;
}

/// Elements that share a kernel, laid out one after another.
#[derive(Debug, Clone, Copy)]
pub struct Elements<'a> {
    /// Variables, `inputs()` apiece.
    pub inputs: &'a [u32],
    /// Constants, `data()` apiece.
    pub data: &'a [f64],
    /// What each element is multiplied by.
    pub weights: &'a [f64],
}

/// [`Kernel::add_gradients`], element by element.
pub fn gradients_one_by_one<K: Kernel + ?Sized>(
    kernel: &K,
    elements: &Elements<'_>,
    x: &[f64],
    first: usize,
    target: &mut [f64],
    workspace: &mut Workspace,
) -> f64 {
    let (k, d) = (kernel.inputs(), kernel.data());
    let (mut local, mut gradient, mut sum) = (vec![0.0; k], vec![0.0; k], 0.0);
    for (at, &weight) in elements.weights.iter().enumerate() {
        let inputs = &elements.inputs[at * k..(at + 1) * k];
        for (slot, &input) in local.iter_mut().zip(inputs) {
            *slot = x[input as usize];
        }
        let value = kernel.gradient(&local, &elements.data[at * d..(at + 1) * d], workspace, &mut gradient);
        sum += weight * scatter(inputs, &gradient, weight, first, target, value);
    }
    sum
}

/// [`Kernel::add_hessians`], element by element.
pub fn hessians_one_by_one<K: Kernel + ?Sized>(
    kernel: &K,
    elements: &Elements<'_>,
    x: &[f64],
    slots: &[u32],
    first: usize,
    target: &mut [f64],
    workspace: &mut Workspace,
) {
    let (k, d, p) = (kernel.inputs(), kernel.data(), kernel.hessian_pattern().len());
    let (mut local, mut hessian) = (vec![0.0; k], vec![0.0; p]);
    for (at, &weight) in elements.weights.iter().enumerate().filter(|&(_, &weight)| weight != 0.0) {
        for (slot, &input) in local.iter_mut().zip(&elements.inputs[at * k..]) {
            *slot = x[input as usize];
        }
        kernel.hessian(&local, &elements.data[at * d..(at + 1) * d], workspace, &mut hessian);
        for (&slot, second) in slots[at * p..].iter().zip(&hessian) {
            if let Some(sum) = target.get_mut((slot as usize).wrapping_sub(first)) {
                *sum += weight * second;
            }
        }
    }
}

/// Adds one element's weighted gradient where it belongs to `target`; see [`Kernel::add_gradients`]. Returns `value` where the
/// first input is there, 0 otherwise.
#[inline]
pub fn scatter(inputs: &[u32], gradient: &[f64], weight: f64, first: usize, target: &mut [f64], value: f64) -> f64 {
    let mut own = 0.0;
    for (at, (&input, slope)) in inputs.iter().zip(gradient).enumerate() {
        // Variables before the first wrap round to places far beyond the end.
        if let Some(sum) = target.get_mut((input as usize).wrapping_sub(first)) {
            *sum += weight * slope;
            if at == 0 {
                own = value;
            }
        }
    }
    own
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
