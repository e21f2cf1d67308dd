//! Graphs of what sections and ribs offer: properties, areas of parts, volumes.

use super::{Item, Lowering, OwnNumber};
use crate::expression::graph::NodeId;
use crate::geometry::polygon::Ring;
use crate::problem::Property;
use crate::ribs::law::{self, VolumeLaw};
use crate::sections::{self, Given};

impl Lowering<'_> {
    fn given<'b>(&self, section: u32, dimensions: &'b [NodeId], outline: &'b [Ring]) -> Given<'b> {
        Given { form: sections::form(self.problem.sections.form[section as usize]), dimensions, outline }
    }

    pub(super) fn property(&mut self, section: u32, dimensions: &[NodeId], Property(name): &Property) -> NodeId {
        let outline = self.problem.outline(section);
        let given = self.given(section, dimensions, outline);
        let kind = sections::kind_of(self.problem.sections.form[section as usize]);
        // The reader only lets through names the kind offers.
        kind.property(&mut self.graph, &given, name).unwrap_or_else(|| self.graph.constant(f64::NAN))
    }

    /// Areas of a section's parts.
    fn parts(&mut self, section: u32, dimensions: &[NodeId]) -> Vec<NodeId> {
        let outline = self.problem.outline(section);
        let given = self.given(section, dimensions, outline);
        sections::kind_of(self.problem.sections.form[section as usize]).parts(&mut self.graph, &given)
    }

    /// The volume of the rib that is the item.
    pub fn own_volume(&mut self, rib: u32, law: VolumeLaw) -> NodeId {
        let left = self.own_section(self.problem.ribs.from[rib as usize]);
        let right = self.own_section(self.problem.ribs.to[rib as usize]);
        let length = self.own_number(Item::Rib(rib), OwnNumber::Length);
        self.volume_between(rib, law, &left, &right, length)
    }

    /// The volume of a rib named globally.
    pub(super) fn rib_volume(&mut self, rib: u32, law: VolumeLaw) -> NodeId {
        let left = self.named_section(self.problem.ribs.from[rib as usize]);
        let right = self.named_section(self.problem.ribs.to[rib as usize]);
        let length = self.graph.constant(self.problem.ribs.length[rib as usize]);
        self.volume_between(rib, law, &left, &right, length)
    }

    fn volume_between(&mut self, rib: u32, law: VolumeLaw, left: &[NodeId], right: &[NodeId], length: NodeId) -> NodeId {
        let (from, to) = (self.problem.ribs.from[rib as usize], self.problem.ribs.to[rib as usize]);
        let left_parts = self.parts(from, left);
        let per_length = if from == to {
            self.graph.sum(&left_parts)
        } else {
            let right_parts = self.parts(to, right);
            match law {
                VolumeLaw::Frustum => self.frusta(&left_parts, &right_parts),
                VolumeLaw::Prismatoid => {
                    let mean = self.mean_dimensions(from, to, left, right);
                    let middle = self.parts(from, &mean);
                    let [left, middle, right] = [&left_parts, &middle, &right_parts].map(|parts| self.graph.sum(parts));
                    law::prismatoid(&mut self.graph, left, middle, right)
                }
            }
        };
        self.graph.multiply(length, per_length)
    }

    fn frusta(&mut self, left: &[NodeId], right: &[NodeId]) -> NodeId {
        let frusta: Vec<NodeId> =
            left.iter().zip(right).map(|(&left, &right)| law::frustum(&mut self.graph, left, right)).collect();
        self.graph.sum(&frusta)
    }

    /// Mean dimensions in the left section's form; the right one's are asked for by the same names.
    fn mean_dimensions(&mut self, from: u32, to: u32, left: &[NodeId], right: &[NodeId]) -> Vec<NodeId> {
        let names = sections::form(self.problem.sections.form[from as usize]).dimensions;
        let same_form = self.problem.sections.form[from as usize] == self.problem.sections.form[to as usize];
        (0..left.len())
            .map(|at| {
                let right = if same_form { right[at] } else { self.property(to, right, &Property(names[at].into())) };
                let sum = self.graph.add(left[at], right);
                self.graph.scale(0.5, sum)
            })
            .collect()
    }
}
