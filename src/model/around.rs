//! What some variables of a large model reach.

use super::Model;
use super::element_model::ElementModel;
use super::elements::KernelGroup;
use super::excerpt::{Excerpt, Selection};

/// The terms of rows and of the objective that hold one of some variables, as a model of its own: it changes with them as the whole does. What
/// it says of the other variables in these terms is not all that the whole says.
pub struct Around<'a> {
    /// The model, named as the whole is.
    pub model: Box<dyn Model + 'a>,
    /// Its variables in the whole, ascending.
    pub variables: Vec<u32>,
    /// Its rows in the whole, ascending.
    pub rows: Vec<u32>,
    /// Its Jacobian's positions among those of the whole.
    pub jacobian: Vec<usize>,
    /// Its Hessian's positions among those of the whole.
    pub hessian: Vec<usize>,
}

/// Of an element model.
pub(super) fn around(whole: &ElementModel, selected: &[u32]) -> Around<'static> {
    let meta = &whole.meta;
    let mut is_selected = vec![false; meta.variables()];
    selected.iter().for_each(|&j| is_selected[j as usize] = true);
    let holds_one = |variables: &[u32]| variables.iter().any(|&j| is_selected[j as usize]);
    let rows = ascending(meta.rows(), |i| holds_one(meta.jacobian.row(i)));
    // A row may hold all variables there are (a sum); of its terms the others do not change.
    let groups = || whole.objective_groups.iter().chain(&whole.row_groups);
    let elements = |group: &KernelGroup| (0..group.len()).filter(|&index| holds_one(group.inputs(index))).collect::<Vec<_>>();
    let kept: Vec<(&KernelGroup, Vec<usize>)> = groups().map(|group| (group, elements(group))).collect();
    let mut is_reached = is_selected.clone();
    let inputs = kept.iter().flat_map(|(group, elements)| elements.iter().flat_map(|&index| group.inputs(index)));
    inputs.for_each(|&j| is_reached[j as usize] = true);
    let variables = ascending(meta.variables(), |j| is_reached[j]);
    let (variable_places, row_places) = (places(meta.variables(), &variables), places(meta.rows(), &rows));
    let (place, row_place) = (|j: u32| variable_places[j as usize], |i: u32| row_places[i as usize].unwrap_or(0));
    let selection = Selection { variables: &variables, rows: &rows, place: &place, row_place: &row_place };
    let mut excerpt = Excerpt::new(whole, selection);
    for ((group, elements), number) in kept.into_iter().zip(0..) {
        elements.into_iter().for_each(|index| excerpt.copy(group, number, index));
    }
    let (model, jacobian, hessian) = excerpt.with_places();
    Around { model: Box::new(model), variables, rows, jacobian, hessian }
}

/// The numbers below `count` that are asked for.
fn ascending(count: usize, is_one: impl Fn(usize) -> bool) -> Vec<u32> {
    (0..count).filter(|&at| is_one(at)).map(|at| at as u32).collect()
}

/// Where each of `count` numbers stands among some.
fn places(count: usize, some: &[u32]) -> Vec<Option<u32>> {
    let mut places = vec![None; count];
    some.iter().zip(0..).for_each(|(&one, place)| places[one as usize] = Some(place));
    places
}
