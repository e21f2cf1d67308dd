//! One component of a model of elements at a time, evaluated densely from the parent's elements.

use super::Local;
use super::members::{self, ComponentView};
use crate::expression::kernel::Kernel;
use crate::expression::tape::Workspace;

/// One element with its inputs translated: `inputs[first..first + kernel.inputs()]` are places in the component.
struct Element<'a> {
    kernel: &'a dyn Kernel,
    data: &'a [f64],
    weight: f64,
    /// Row of the component; `None` in the objective.
    row: Option<u32>,
    first: usize,
}

#[derive(Default)]
struct Scratch {
    x: Vec<f64>,
    out: Vec<f64>,
    inner: Workspace,
}

pub(super) struct DenseComponent<'a> {
    view: ComponentView<'a>,
    elements: Vec<Element<'a>>,
    inputs: Vec<u32>,
    /// The objective's affine part.
    linear: Vec<(u32, f64)>,
    /// The rows' affine parts: row, variable, coefficient.
    affine: Vec<(u32, u32, f64)>,
    constants: Vec<f64>,
    scratch: Scratch,
}

/// Gathers an element's inputs; returns (x, room for derivatives, working memory).
fn gather<'s>(
    element: &Element<'_>,
    inputs: &[u32],
    x: &[f64],
    scratch: &'s mut Scratch,
    out: usize,
) -> (&'s [f64], &'s mut [f64], &'s mut Workspace) {
    let Scratch { x: local, out: room, inner } = scratch;
    local.clear();
    local.extend(inputs[element.first..element.first + element.kernel.inputs()].iter().map(|&j| x[j as usize]));
    if room.len() < out {
        room.resize(out, 0.0);
    }
    (local, &mut room[..out], inner)
}

impl<'a> DenseComponent<'a> {
    /// At no component yet.
    pub fn new(view: ComponentView<'a>) -> Self {
        DenseComponent {
            view,
            elements: Vec::new(),
            inputs: Vec::new(),
            linear: Vec::new(),
            affine: Vec::new(),
            constants: Vec::new(),
            scratch: Scratch::default(),
        }
    }

    /// The affine parts: f; overwrites the rows.
    fn affine_values(&self, x: &[f64], rows: &mut [f64]) -> f64 {
        rows.copy_from_slice(&self.constants);
        for &(row, j, coefficient) in &self.affine {
            rows[row as usize] += coefficient * x[j as usize];
        }
        self.linear.iter().map(|&(j, coefficient)| coefficient * x[j as usize]).sum()
    }
}

impl Local for DenseComponent<'_> {
    fn select(&mut self, component: usize) {
        let ComponentView { model, members } = self.view;
        let (partition, pattern) = (&members.partition, &model.meta.jacobian);
        self.elements.clear();
        self.inputs.clear();
        for member in members.of_component(component) {
            let element = members::group(model, member.group).view(member.index as usize);
            let first = self.inputs.len();
            self.inputs.extend(element.inputs.iter().map(|&j| partition.place(j)));
            let row = element.row.map(|i| partition.row_place(i));
            self.elements.push(Element { kernel: element.kernel, data: element.data, weight: element.weight, row, first });
        }
        let rows = partition.rows(component);
        self.constants.clear();
        self.constants.extend(rows.iter().map(|&i| model.row_constants[i as usize]));
        self.affine.clear();
        for (row, &i) in rows.iter().enumerate() {
            let entries =
                pattern.range(i as usize).map(|at| (row as u32, partition.place(pattern.columns[at]), model.linear_jacobian[at]));
            self.affine.extend(entries.filter(|entry| entry.2 != 0.0));
        }
        self.linear.clear();
        let coefficients = &model.objective.coefficients;
        if !coefficients.is_empty() {
            let coefficient = |&j: &u32| {
                coefficients.binary_search_by_key(&j, |entry| entry.0).ok().map(|at| (partition.place(j), coefficients[at].1))
            };
            self.linear.extend(partition.variables(component).iter().filter_map(coefficient));
        }
    }

    fn values(&mut self, x: &[f64], rows: &mut [f64]) -> f64 {
        let mut objective = self.affine_values(x, rows);
        let DenseComponent { elements, inputs, scratch, .. } = self;
        for element in elements.iter() {
            let (x, _, inner) = gather(element, inputs, x, scratch, 0);
            let value = element.weight * element.kernel.value(x, element.data, inner);
            match element.row {
                Some(row) => rows[row as usize] += value,
                None => objective += value,
            }
        }
        objective
    }

    fn first_order(&mut self, x: &[f64], rows: &mut [f64], gradient: &mut [f64], jacobian: &mut [f64]) -> f64 {
        let n = x.len();
        let mut objective = self.affine_values(x, rows);
        gradient.fill(0.0);
        jacobian.fill(0.0);
        self.linear.iter().for_each(|&(j, coefficient)| gradient[j as usize] = coefficient);
        self.affine.iter().for_each(|&(row, j, coefficient)| jacobian[row as usize * n + j as usize] = coefficient);
        let DenseComponent { elements, inputs, scratch, .. } = self;
        for element in elements.iter() {
            let own = element.kernel.inputs();
            let (x, out, inner) = gather(element, inputs, x, scratch, own);
            let value = element.weight * element.kernel.gradient(x, element.data, inner, out);
            let target = match element.row {
                Some(row) => {
                    rows[row as usize] += value;
                    &mut jacobian[row as usize * n..(row as usize + 1) * n]
                }
                None => {
                    objective += value;
                    &mut *gradient
                }
            };
            for (&j, slope) in inputs[element.first..].iter().zip(out) {
                target[j as usize] += element.weight * *slope;
            }
        }
        objective
    }

    fn hessian(&mut self, x: &[f64], weight: f64, y: &[f64], hessian: &mut [f64]) {
        let n = x.len();
        hessian.fill(0.0);
        let DenseComponent { elements, inputs, scratch, .. } = self;
        for element in elements.iter() {
            let factor = element.weight * element.row.map_or(weight, |row| y[row as usize]);
            if factor == 0.0 {
                continue;
            }
            let pattern = element.kernel.hessian_pattern();
            let (x, out, inner) = gather(element, inputs, x, scratch, pattern.len());
            element.kernel.hessian(x, element.data, inner, out);
            for (&(i, j), second) in pattern.iter().zip(out) {
                let (a, b) = (inputs[element.first + i as usize] as usize, inputs[element.first + j as usize] as usize);
                hessian[a.max(b) * n + a.min(b)] += factor * *second;
            }
        }
    }
}
