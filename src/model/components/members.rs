//! Which elements belong to which component, counted once for the whole model.

use super::Partition;
use crate::model::element_model::ElementModel;
use crate::model::elements::KernelGroup;

/// Where an element is: its group (objective groups first, then row groups) and its place there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Member {
    pub group: u32,
    pub index: u32,
}

/// The components of a rib model with their elements.
#[derive(Debug)]
pub struct Members {
    pub(super) partition: Partition,
    offsets: Vec<u32>,
    members: Vec<Member>,
    /// Whether the objective is a sum of volumes.
    pub(super) positive: bool,
}

impl Members {
    /// The components; `None` where there is only one, or a row or an element has no variables.
    pub(in crate::model) fn of(model: &ElementModel) -> Option<Members> {
        let meta = &model.meta;
        let rows = (0..meta.rows()).map(|i| meta.jacobian.row(i));
        let couplings = model.objective_groups.iter().flat_map(|group| (0..group.len()).map(|index| group.inputs(index)));
        let partition = Partition::new(meta.variables(), rows, couplings)?;
        if partition.len() < 2 || groups(model).any(|group| group.len() > 0 && group.inputs(0).is_empty()) {
            return None;
        }
        let mut offsets = vec![0; partition.len() + 1];
        let component = |group: &KernelGroup, index| partition.component(group.inputs(index)[0]) as usize;
        for group in groups(model) {
            (0..group.len()).for_each(|index| offsets[component(group, index) + 1] += 1);
        }
        for k in 0..partition.len() {
            offsets[k + 1] += offsets[k];
        }
        let mut next = offsets.clone();
        let mut members = vec![Member { group: 0, index: 0 }; offsets[partition.len()] as usize];
        for (number, group) in groups(model).enumerate() {
            for index in 0..group.len() {
                let at = &mut next[component(group, index)];
                members[*at as usize] = Member { group: number as u32, index: index as u32 };
                *at += 1;
            }
        }
        let positive = model.objective.coefficients.is_empty() && model.objective_groups.iter().all(KernelGroup::is_volume);
        Some(Members { partition, offsets, members, positive })
    }

    /// The elements of component k, those of the objective first.
    pub(super) fn of_component(&self, k: usize) -> &[Member] {
        &self.members[self.offsets[k] as usize..self.offsets[k + 1] as usize]
    }
}

/// A model of elements with its components.
#[derive(Clone, Copy)]
pub(in crate::model) struct ComponentView<'a> {
    pub model: &'a ElementModel,
    pub members: &'a Members,
}

/// All groups in the order members count them.
pub(super) fn groups(model: &ElementModel) -> impl Iterator<Item = &KernelGroup> {
    model.objective_groups.iter().chain(&model.row_groups)
}

/// The group of this number.
pub(super) fn group(model: &ElementModel, number: u32) -> &KernelGroup {
    let (number, objective) = (number as usize, model.objective_groups.len());
    if number < objective { &model.objective_groups[number] } else { &model.row_groups[number - objective] }
}
