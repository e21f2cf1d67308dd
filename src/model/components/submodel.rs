//! One component as a model of its own, with elements copied from the parent.

use super::members::{self, ComponentView};
use crate::model::affine::Affine;
use crate::model::element_model::ElementModel;
use crate::model::elements::KernelGroup;
use crate::model::{Meta, Pattern};

/// Component k; names are the parent's.
pub(super) fn submodel(view: ComponentView<'_>, k: usize) -> ElementModel {
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
    ElementModel {
        objective: Affine { constant: 0.0, coefficients: variables.iter().filter_map(own).collect() },
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
            objective_is_linear: objective_groups.is_empty(),
            jacobian,
            hessian,
            names: meta.names.selected(variables.to_vec(), rows.to_vec()),
            ..Meta::default()
        },
        objective_groups,
        row_groups,
        ..ElementModel::default()
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
fn copied(view: ComponentView<'_>, k: usize, jacobian: &Pattern, hessian: &Pattern) -> (Vec<KernelGroup>, Vec<KernelGroup>) {
    let partition = &view.members.partition;
    let (mut objective, mut rows): (Vec<KernelGroup>, Vec<KernelGroup>) = (Vec::new(), Vec::new());
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
