//! Sums of small elements: one kernel, many tuples of variables, scattered to where they belong.

use std::ops::Range;
use std::sync::Arc;

use super::Pattern;
use crate::expression::kernel::{Elements, Kernel};
use crate::expression::tape::Workspace;

/// Elements whose Hessians are added in one call.
const BATCH: usize = 64;

/// What an element is called when it has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Label {
    /// A term of the objective.
    Objective,
    /// The volume of a rib.
    RibVolume(u32),
    /// A term of a row.
    Row(u32),
}

/// Elements that share a kernel.
pub struct KernelGroup {
    kernel: Arc<dyn Kernel>,
    /// Variables of each element, `kernel.inputs()` apiece, distinct within an element.
    inputs: Vec<u32>,
    /// Constants of each element, `kernel.data()` apiece.
    data: Vec<f64>,
    /// What each element is multiplied by.
    weights: Vec<f64>,
    /// Names for errors.
    labels: Vec<Label>,
    /// Where each element's value goes: its row (objective groups leave this empty).
    rows: Vec<u32>,
    /// Where each first derivative goes: a position of the Jacobian (rows only).
    jacobian_slots: Vec<u32>,
    /// Where each second derivative goes: a position of the Hessian.
    hessian_slots: Vec<u32>,
}

/// One element with everything that belongs to it, for those who evaluate elements one by one.
pub(super) struct View<'a> {
    pub kernel: &'a dyn Kernel,
    pub inputs: &'a [u32],
    pub data: &'a [f64],
    pub weight: f64,
    pub label: Label,
    /// `None` in the objective.
    pub row: Option<u32>,
}

/// Working memory of one pass over a group.
struct Scratch {
    x: Vec<f64>,
    inner: Workspace,
    out: Vec<f64>,
}

/// One element while it is visited.
struct Element<'a> {
    index: usize,
    weight: f64,
    inputs: &'a [u32],
    data: &'a [f64],
}

impl KernelGroup {
    /// An empty group.
    pub fn new(kernel: Arc<dyn Kernel>) -> KernelGroup {
        KernelGroup {
            kernel,
            inputs: Vec::new(),
            data: Vec::new(),
            weights: Vec::new(),
            labels: Vec::new(),
            rows: Vec::new(),
            jacobian_slots: Vec::new(),
            hessian_slots: Vec::new(),
        }
    }

    /// Adds an element; `row` is `None` in the objective.
    pub fn push(&mut self, inputs: &[u32], data: &[f64], weight: f64, label: Label, row: Option<u32>) {
        debug_assert_eq!((inputs.len(), data.len()), (self.kernel.inputs(), self.kernel.data()));
        self.inputs.extend_from_slice(inputs);
        self.data.extend_from_slice(data);
        self.weights.push(weight);
        self.labels.push(label);
        self.rows.extend(row);
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.weights.len()
    }

    /// Whether every element is a share of a rib's volume, counted positively.
    pub fn is_volume(&self) -> bool {
        let volume = |label: &Label| matches!(label, Label::RibVolume(_));
        self.labels.iter().all(volume) && self.weights.iter().all(|&weight| weight > 0.0)
    }

    /// A group of the same kernel, without elements.
    pub fn empty_like(&self) -> KernelGroup {
        KernelGroup::new(Arc::clone(&self.kernel))
    }

    /// The variables of one element.
    pub fn inputs(&self, index: usize) -> &[u32] {
        let k = self.kernel.inputs();
        &self.inputs[index * k..(index + 1) * k]
    }

    /// One element.
    pub(super) fn view(&self, index: usize) -> View<'_> {
        let Element { weight, inputs, data, .. } = self.element(index);
        View { kernel: self.kernel.as_ref(), inputs, data, weight, label: self.labels[index], row: self.rows.get(index).copied() }
    }

    fn element(&self, index: usize) -> Element<'_> {
        let (k, d) = (self.kernel.inputs(), self.kernel.data());
        Element {
            index,
            weight: self.weights[index],
            inputs: &self.inputs[index * k..(index + 1) * k],
            data: &self.data[index * d..(index + 1) * d],
        }
    }

    fn scratch(&self) -> Scratch {
        let (k, p) = (self.kernel.inputs(), self.kernel.hessian_pattern().len());
        Scratch { x: vec![0.0; k], inner: Workspace::default(), out: vec![0.0; k.max(p)] }
    }

    /// Calls `visit` for every element of the range with its inputs gathered into `scratch.x`.
    fn each(&self, range: Range<usize>, x: &[f64], mut visit: impl FnMut(&Element, &mut Scratch)) {
        let mut scratch = self.scratch();
        for index in range {
            let element = self.element(index);
            for (slot, &input) in scratch.x.iter_mut().zip(element.inputs) {
                *slot = x[input as usize];
            }
            visit(&element, &mut scratch);
        }
    }

    /// All elements.
    pub fn range(&self) -> Range<usize> {
        0..self.len()
    }

    /// The row of an element: none, or one.
    pub fn row(&self, index: usize) -> &[u32] {
        self.rows.get(index..=index).unwrap_or_default()
    }

    /// The weighted sum of all elements (objective groups).
    pub fn value(&self, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.each(self.range(), x, |e, s| sum += e.weight * self.kernel.value(&s.x, e.data, &mut s.inner));
        sum
    }

    /// Adds the weighted gradients of a range of elements (objective groups) to the derivatives by the variables from `first`
    /// on; returns the values of the elements whose first variable is among them.
    pub fn add_gradients(
        &self,
        range: Range<usize>,
        x: &[f64],
        first: usize,
        target: &mut [f64],
        workspace: &mut Workspace,
    ) -> f64 {
        let weights = &self.weights[range.clone()];
        self.kernel.add_gradients(&self.elements(range, weights), x, first, target, workspace)
    }

    /// Adds the weighted gradients to a dense vector; returns the value (objective groups).
    pub fn add_gradient(&self, x: &[f64], gradient: &mut [f64]) -> f64 {
        let (mut sum, k) = (0.0, self.kernel.inputs());
        self.each(self.range(), x, |e, s| {
            sum += e.weight * self.kernel.gradient(&s.x, e.data, &mut s.inner, &mut s.out[..k]);
            for (&input, derivative) in e.inputs.iter().zip(&s.out) {
                gradient[input as usize] += e.weight * derivative;
            }
        });
        sum
    }

    /// Adds each element of the range to its row; `target` holds the rows from `first` on.
    pub fn add_rows(&self, range: Range<usize>, x: &[f64], first: usize, target: &mut [f64]) {
        self.each(range, x, |e, s| {
            if let Some(value) = target.get_mut((self.rows[e.index] as usize).wrapping_sub(first)) {
                *value += e.weight * self.kernel.value(&s.x, e.data, &mut s.inner);
            }
        });
    }

    /// Adds the gradient of each element of the range to the Jacobian; `target` holds its values from `first` on.
    pub fn add_jacobian(&self, range: Range<usize>, x: &[f64], first: usize, target: &mut [f64]) {
        let k = self.kernel.inputs();
        self.each(range, x, |e, s| {
            self.kernel.gradient(&s.x, e.data, &mut s.inner, &mut s.out[..k]);
            for (&slot, derivative) in self.jacobian_slots[e.index * k..].iter().zip(&s.out[..k]) {
                if let Some(value) = target.get_mut((slot as usize).wrapping_sub(first)) {
                    *value += e.weight * derivative;
                }
            }
        });
    }

    /// Adds the second derivatives of the range, each element times its row's multiplier (or the objective's weight), to the
    /// Hessian; `target` holds its values from `first` on.
    pub fn add_hessian(&self, range: Range<usize>, x: &[f64], weight: f64, y: &[f64], first: usize, target: &mut [f64]) {
        let p = self.kernel.hessian_pattern().len();
        let (mut factors, mut workspace) = ([0.0; BATCH], Workspace::default());
        for begin in range.clone().step_by(BATCH) {
            let batch = begin..range.end.min(begin + BATCH);
            let factors = &mut factors[..batch.len()];
            for (factor, index) in factors.iter_mut().zip(batch.clone()) {
                *factor = self.weights[index] * self.rows.get(index).map_or(weight, |&row| y[row as usize]);
            }
            // Rows without a multiplier are not looked at: they may have no value where others do.
            if factors.iter().any(|&factor| factor != 0.0) {
                let slots = &self.hessian_slots[batch.start * p..batch.end * p];
                self.kernel.add_hessians(&self.elements(batch, factors), x, slots, first, target, &mut workspace);
            }
        }
    }

    /// The elements of a range under factors of their own.
    fn elements<'a>(&'a self, range: Range<usize>, weights: &'a [f64]) -> Elements<'a> {
        let (k, d) = (self.kernel.inputs(), self.kernel.data());
        Elements {
            inputs: &self.inputs[range.start * k..range.end * k],
            data: &self.data[range.start * d..range.end * d],
            weights,
        }
    }

    /// The first element without a finite value, gradient or Hessian, and why.
    pub fn explain(&self, x: &[f64]) -> Option<(Label, String)> {
        (0..self.len()).find_map(|index| {
            let element = self.element(index);
            let local: Vec<f64> = element.inputs.iter().map(|&input| x[input as usize]).collect();
            self.kernel.explain(&local, element.data).map(|cause| (self.labels[index], cause))
        })
    }

    /// Positions (row, variable) its elements reach in the Jacobian.
    pub fn jacobian_positions(&self, positions: &mut Vec<(u32, u32)>) {
        for (index, &row) in self.rows.iter().enumerate() {
            positions.extend(self.element(index).inputs.iter().map(|&input| (row, input)));
        }
    }

    /// Positions (variable, variable), lower triangle, its elements reach in the Hessian.
    pub fn hessian_positions(&self, positions: &mut Vec<(u32, u32)>) {
        for index in 0..self.len() {
            positions.extend(self.hessian_pairs(index));
        }
    }

    fn hessian_pairs(&self, index: usize) -> impl Iterator<Item = (u32, u32)> {
        let inputs = self.element(index).inputs;
        self.kernel.hessian_pattern().iter().map(move |&(i, j)| {
            let (a, b) = (inputs[i as usize], inputs[j as usize]);
            (a.max(b), a.min(b))
        })
    }

    /// Looks up where every derivative goes. Both patterns must hold all positions announced above.
    pub fn connect(&mut self, jacobian: &Pattern, hessian: &Pattern) {
        let k = self.kernel.inputs();
        let slot = |pattern: &Pattern, row: u32, column: u32| {
            pattern.position(row as usize, column).expect("the pattern was built from these positions") as u32
        };
        self.jacobian_slots = self
            .rows
            .iter()
            .zip(self.inputs.chunks(k.max(1)))
            .flat_map(|(&row, inputs)| inputs.iter().map(move |&input| (row, input)))
            .map(|(row, input)| slot(jacobian, row, input))
            .collect();
        self.hessian_slots =
            (0..self.len()).flat_map(|index| self.hessian_pairs(index)).map(|(row, column)| slot(hessian, row, column)).collect();
    }
}
