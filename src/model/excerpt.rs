//! Some variables, rows and terms of a large model as a model of its own, with elements copied from it.

use super::Meta;
use super::affine::Affine;
use super::element_model::ElementModel;
use super::elements::KernelGroup;

/// Which variables and rows, ascending, and where they stand among those selected.
pub(super) struct Selection<'a> {
    pub variables: &'a [u32],
    pub rows: &'a [u32],
    /// `None` for variables that are not selected.
    pub place: &'a dyn Fn(u32) -> Option<u32>,
    /// Asked for selected rows only.
    pub row_place: &'a dyn Fn(u32) -> u32,
}

/// An excerpt while elements are copied into it.
pub(super) struct Excerpt<'a> {
    parent: &'a ElementModel,
    selection: Selection<'a>,
    objective: Vec<KernelGroup>,
    rows: Vec<KernelGroup>,
    /// The group the last element came from.
    last: Option<u32>,
}

impl<'a> Excerpt<'a> {
    /// Affine parts, bounds and starts; no elements yet.
    pub fn new(parent: &'a ElementModel, selection: Selection<'a>) -> Self {
        Excerpt { parent, selection, objective: Vec::new(), rows: Vec::new(), last: None }
    }

    /// Adds element `index` of a group, all of whose variables are selected. Groups come one after another.
    pub fn copy(&mut self, group: &KernelGroup, number: u32, index: usize) {
        let element = group.view(index);
        let list = if element.row.is_some() { &mut self.rows } else { &mut self.objective };
        if self.last != Some(number) {
            list.push(group.empty_like());
            self.last = Some(number);
        }
        let inputs: Vec<u32> = element.inputs.iter().filter_map(|&j| (self.selection.place)(j)).collect();
        let row = element.row.map(self.selection.row_place);
        if let Some(own) = list.last_mut() {
            own.push(&inputs, element.data, element.weight, element.label, row);
        }
    }

    /// The model; names are the parent's.
    pub fn model(self) -> ElementModel {
        self.with_places().0
    }

    /// The same, and which positions of the parent's Jacobian and Hessian its own are.
    pub fn with_places(mut self) -> (ElementModel, Vec<usize>, Vec<usize>) {
        let (parent, meta) = (self.parent, &self.parent.meta);
        let Selection { variables, rows, place, .. } = self.selection;
        let variable = |values: &[f64]| variables.iter().map(|&j| values[j as usize]).collect();
        let row = |values: &[f64]| rows.iter().map(|&i| values[i as usize]).collect();
        let (jacobian, of_jacobian) = meta.jacobian.selected(rows, place);
        let (hessian, of_hessian) = meta.hessian.selected(variables, place);
        self.objective.iter_mut().chain(&mut self.rows).for_each(|group| group.connect(&jacobian, &hessian));
        let linear_jacobian = of_jacobian.iter().filter_map(|&at| parent.linear_jacobian.get(at).copied()).collect();
        let model = ElementModel {
            objective: Affine { constant: 0.0, coefficients: self.coefficients() },
            linear_jacobian,
            row_constants: row(&parent.row_constants),
            meta: Meta {
                lower: variable(&meta.lower),
                upper: variable(&meta.upper),
                start: variable(&meta.start),
                typical: variable(&meta.typical),
                row_lower: row(&meta.row_lower),
                row_upper: row(&meta.row_upper),
                row_constants: row(&meta.row_constants),
                row_is_linear: rows.iter().map(|&i| meta.row_is_linear[i as usize]).collect(),
                objective_is_linear: self.objective.is_empty(),
                jacobian,
                hessian,
                names: meta.names.selected(variables.to_vec(), rows.to_vec()),
                ..Meta::default()
            },
            objective_groups: self.objective,
            row_groups: self.rows,
            ..ElementModel::default()
        };
        (model, of_jacobian, of_hessian)
    }

    /// The objective's own coefficients.
    fn coefficients(&self) -> Vec<(u32, f64)> {
        let coefficients = &self.parent.objective.coefficients;
        let own = |&j: &u32| {
            let at = coefficients.binary_search_by_key(&j, |entry| entry.0).ok()?;
            Some(((self.selection.place)(j)?, coefficients[at].1))
        };
        self.selection.variables.iter().filter_map(own).collect()
    }
}
