//! One component as a model of its own, with elements copied from the parent.

use std::sync::{Arc, OnceLock};

use super::local::ComponentView;
use super::members;
use crate::model::assembled::Affine;
use crate::model::elements::Group;
use crate::model::{EvaluationError, Meta, Model, Pattern, RibModel};

/// A component; names are the parent's.
pub(super) struct Submodel {
    inner: RibModel,
    /// The parent's number of each variable.
    variables: Vec<u32>,
}

impl Submodel {
    /// Component k.
    pub fn of(view: ComponentView<'_>, k: usize) -> Submodel {
        let partition = &view.members.partition;
        let (parent, variables, rows) = (view.model, partition.variables(k), partition.rows(k));
        let meta = &parent.meta;
        let variable = |values: &[f64]| variables.iter().map(|&j| values[j as usize]).collect();
        let row = |values: &[f64]| rows.iter().map(|&i| values[i as usize]).collect();
        let place = |j: u32| partition.place(j);
        let (jacobian, linear_jacobian) = restricted(&meta.jacobian, rows, place, &parent.linear_jacobian);
        let (hessian, _) = restricted(&meta.hessian, variables, place, &[]);
        let (objective_groups, row_groups) = copied(view, k, &jacobian, &hessian);
        let coefficients = &parent.objective.coefficients;
        let own = |j: &u32| coefficients.binary_search_by_key(j, |entry| entry.0).ok().map(|at| (place(*j), coefficients[at].1));
        let inner = RibModel {
            problem: Arc::clone(&parent.problem),
            objective: Affine { constant: 0.0, coefficients: variables.iter().filter_map(own).collect() },
            row_constants: row(&parent.row_constants),
            linear_jacobian,
            row_origin: rows.iter().map(|&i| parent.row_origin[i as usize]).collect(),
            meta: Meta {
                lower: variable(&meta.lower),
                upper: variable(&meta.upper),
                start: variable(&meta.start),
                typical: variable(&meta.typical),
                row_lower: row(&meta.row_lower),
                row_upper: row(&meta.row_upper),
                row_is_linear: rows.iter().map(|&i| meta.row_is_linear[i as usize]).collect(),
                objective_is_linear: objective_groups.is_empty(),
                jacobian,
                hessian,
            },
            objective_groups,
            row_groups,
            members: OnceLock::new(),
            chunks: OnceLock::new(),
        };
        Submodel { inner, variables: variables.to_vec() }
    }
}

/// Some rows of a pattern with their columns renumbered (order is kept), and the values along them if there are any.
fn restricted(pattern: &Pattern, rows: &[u32], place: impl Fn(u32) -> u32, values: &[f64]) -> (Pattern, Vec<f64>) {
    let (mut own, mut kept) = (Pattern::default(), Vec::new());
    for &row in rows {
        let range = pattern.range(row as usize);
        own.columns.extend(pattern.columns[range.clone()].iter().map(|&column| place(column)));
        own.offsets.push(own.columns.len());
        kept.extend_from_slice(values.get(range).unwrap_or_default());
    }
    (own, kept)
}

/// The component's elements, connected to its patterns: of the objective, of the rows.
fn copied(view: ComponentView<'_>, k: usize, jacobian: &Pattern, hessian: &Pattern) -> (Vec<Group>, Vec<Group>) {
    let partition = &view.members.partition;
    let (mut objective, mut rows): (Vec<Group>, Vec<Group>) = (Vec::new(), Vec::new());
    let mut last = u32::MAX;
    for member in view.members.of_component(k) {
        let group = members::group(view.model, member.group);
        let element = group.view(member.index as usize);
        let list = if element.row.is_some() { &mut rows } else { &mut objective };
        if member.group != last {
            list.push(group.empty_like());
            last = member.group;
        }
        let inputs: Vec<u32> = element.inputs.iter().map(|&j| partition.place(j)).collect();
        if let Some(own) = list.last_mut() {
            own.push(&inputs, element.data, element.weight, element.label, element.row.map(|i| partition.row_place(i)));
        }
    }
    objective.iter_mut().chain(&mut rows).for_each(|group| group.connect(jacobian, hessian));
    (objective, rows)
}

impl Model for Submodel {
    fn meta(&self) -> &Meta {
        &self.inner.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.inner.objective(x)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.inner.gradient(x, gradient)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.constraints(x, values)
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.jacobian(x, values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.hessian(x, weight, y, values)
    }

    fn variable_name(&self, j: usize) -> String {
        self.inner.variable_name(self.variables[j] as usize)
    }

    fn row_name(&self, i: usize) -> String {
        self.inner.row_name(i)
    }
}
