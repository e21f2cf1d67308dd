//! Members as expressions of the design and the states.

use super::super::{Item, Lowering, OwnNumber, end_section};
use crate::expression::graph::NodeId;
use crate::model::assemble::member::{Framework, MemberNodes};
use crate::problem::formula::End;
use crate::problem::structure::Shear;
use crate::sections;
use crate::structure::algebra::Algebra;
use crate::structure::axes::{Frame, frame};
use crate::structure::beam::{Beam, Tapered};
use crate::structure::deformation::rows;
use crate::structure::quadrature::TAPERED;

impl Lowering<'_> {
    /// The nodes of a member in a case or combination, made once.
    pub(in super::super) fn member(&mut self, framework: Framework, member: u32, set: u32) -> MemberNodes {
        if let Some(known) = self.members.get(&(member, set)) {
            return known.clone();
        }
        let nodes = match framework.is_plain(member) {
            true => self.plain_member(framework, member, set),
            false => self.varying_member(framework, member, set),
        };
        self.members.insert((member, set), nodes.clone());
        nodes
    }

    /// Numbers first, then inputs, in the order in which items bring them to a shared template.
    pub(super) fn plain_member(&mut self, framework: Framework, member: u32, set: u32) -> MemberNodes {
        let (numbers, values) = framework.numbers(member, set);
        let [length, young, shear] = [0, 1, 2].map(|at| self.number(numbers[at]));
        let loads = values.map(|value| self.number(value));
        let inputs = framework.inputs(member, set);
        let deformations = inputs.map(|input| match input {
            Some(input) => self.variable(input),
            None => self.graph.constant(0.0),
        });
        let by_forces = self.problem.inputs_are_forces && framework.member(member).1.by_forces;
        let forces = by_forces.then_some(deformations);
        MemberNodes { length, young, shear: Some(shear), loads, deformations, forces, rows: None, frame: None }
    }

    /// A member whose nodes or modulus vary with the design: everything as formulas of them and of its ends' displacements.
    pub(super) fn varying_member(&mut self, framework: Framework, member: u32, set: u32) -> MemberNodes {
        let (declared, prepared) = framework.member(member);
        let frame = self.varying_frame(framework, member);
        let material = &framework.structure.materials[declared.material as usize];
        let young = self.dimension(u32::MAX, material.young);
        let shear = material.shear.map(|shear| match shear {
            Shear::Modulus(modulus) => self.dimension(u32::MAX, modulus),
            Shear::Poisson(ratio) => self.graph.scale(0.5 / (1.0 + ratio), young),
        });
        let loads = framework.statics.member_loads(&mut self.graph, framework.structure, (member, set), &frame);
        let rows = rows(&mut self.graph, &frame, declared.offset);
        let deformations = match prepared.fixed {
            true => framework.inputs(member, set).map(|input| match input {
                Some(input) => self.variable(input),
                None => self.graph.constant(0.0),
            }),
            false => std::array::from_fn(|component| match prepared.components[component] {
                true => self.deformation(framework, (declared.start, declared.end), set, &rows[component]),
                false => self.graph.constant(0.0),
            }),
        };
        MemberNodes {
            length: frame.length,
            young,
            shear,
            loads,
            deformations,
            forces: None,
            rows: Some(rows),
            frame: Some(frame),
        }
    }

    /// Length and axes of a member as formulas of its nodes' coordinates.
    pub(super) fn varying_frame(&mut self, framework: Framework, member: u32) -> Frame<NodeId> {
        let (declared, prepared) = framework.member(member);
        let ends = [declared.start, declared.end]
            .map(|node| framework.structure.nodes.position[node as usize].map(|coordinate| self.dimension(u32::MAX, coordinate)));
        let between: [NodeId; 3] = std::array::from_fn(|axis| {
            let chord = self.graph.subtract(ends[1][axis], ends[0][axis]);
            let arms = self.graph.constant(declared.offset[1][axis] - declared.offset[0][axis]);
            self.graph.add(chord, arms)
        });
        frame(&mut self.graph, between, prepared.rule, declared.roll)
    }

    /// A rib's length: a number of the item or a constant, or a formula where its nodes move with the design.
    pub(in super::super) fn rib_length(&mut self, rib: u32, own: bool) -> NodeId {
        let varying = Framework::of(self.problem)
            .and_then(|framework| Some((framework, framework.structure.member(rib)?)))
            .filter(|(framework, member)| !framework.member(*member).1.fixed);
        match varying {
            Some((framework, member)) => self.varying_frame(framework, member).length,
            None if own => self.own_number(Item::Rib(rib), OwnNumber::Length),
            None => self.graph.constant(self.problem.ribs.length[rib as usize]),
        }
    }

    /// Σ row·u over the twelve displacements of a member's ends.
    pub(super) fn deformation(&mut self, framework: Framework, (start, end): (u32, u32), set: u32, row: &[NodeId; 12]) -> NodeId {
        let mut parts = Vec::new();
        for (at, &coefficient) in row.iter().enumerate() {
            let node = if at < 6 { start } else { end };
            let vanishes = self.graph.as_constant(coefficient) == Some(0.0);
            if !vanishes && framework.statics.exists[node as usize][at % 6] {
                let displacement = self.variable(framework.displacement(set, node, at % 6));
                parts.push(Algebra::multiply(&mut self.graph, coefficient, displacement));
            }
        }
        self.graph.sum(&parts)
    }

    /// Calls `then` with the member as a beam.
    pub(super) fn with_beam<T>(
        &mut self,
        framework: Framework,
        member: u32,
        set: u32,
        then: impl FnOnce(&mut crate::expression::graph::Graph, &Beam) -> T,
    ) -> T {
        let (declared, prepared) = framework.member(member);
        let sections = [End::From, End::To].map(|end| end_section(self.problem, declared.rib, end));
        let nodes = self.member(framework, member, set);
        let [start, end] = sections.map(|section| self.item_section(section));
        let form = sections::form(self.problem.sections.form[sections[0] as usize]);
        let outline = self.problem.outline(sections[0]);
        let beam = Beam {
            section: Tapered { form, outline, start: &start, end: &end },
            length: nodes.length,
            young: nodes.young,
            shear: nodes.shear,
            components: prepared.components,
            deforms_in_shear: declared.shear,
            grading: &prepared.grading,
            points: TAPERED,
            loads: nodes.loads,
            deformations: nodes.deformations,
            forces: nodes.forces,
        };
        then(&mut self.graph, &beam)
    }
}
