//! One component as a model of its own, with elements copied from the parent.

use super::members::{self, ComponentView};
use crate::model::element_model::ElementModel;
use crate::model::excerpt::{Excerpt, Selection};

/// Component k; names are the parent's.
pub(super) fn submodel(view: ComponentView<'_>, k: usize) -> ElementModel {
    let partition = &view.members.partition;
    let (variables, rows) = (partition.variables(k), partition.rows(k));
    let place = |j: u32| (partition.component(j) as usize == k).then(|| partition.place(j));
    let selection = Selection { variables, rows, place: &place, row_place: &|i| partition.row_place(i) };
    let mut excerpt = Excerpt::new(view.model, selection);
    for member in view.members.of_component(k) {
        excerpt.copy(members::group(view.model, member.group), member.group, member.index as usize);
    }
    excerpt.model()
}
