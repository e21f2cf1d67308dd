//! What one member of a structure brings to a formula: its numbers, its loads in one case or combination, its inputs.

use crate::expression::graph::NodeId;
use crate::problem::Problem;
use crate::problem::statics::{Prepared, Statics};
use crate::problem::structure::{Member, Structure};
use crate::structure::algebra::Numbers;
use crate::structure::axes::Frame;
use crate::structure::deformation::BASIC;
use crate::structure::loads::MemberLoads;

/// The structure of a problem with what was prepared of it.
#[derive(Clone, Copy)]
pub(super) struct Framework<'a> {
    pub structure: &'a Structure,
    pub statics: &'a Statics,
    /// The input that the first of them is in the assembled model.
    pub first_input: u32,
}

impl<'a> Framework<'a> {
    pub fn of(problem: &'a Problem) -> Option<Self> {
        let (structure, statics) = (problem.structure.as_deref()?, problem.statics.as_deref()?);
        Some(Framework { structure, statics, first_input: problem.first_input })
    }

    pub fn member(self, member: u32) -> (&'a Member, &'a Prepared) {
        (&self.structure.members[member as usize], &self.statics.members[member as usize])
    }

    /// Whether items alike in shape may share what is compiled: no coordinate and no modulus of it varies.
    pub fn is_plain(self, member: u32) -> bool {
        let (declared, prepared) = self.member(member);
        prepared.fixed && self.structure.has_constant_moduli(declared.material)
    }

    /// Length, E, G (NaN without) and the loads' values of a plain member, in the order a lowering asks for them.
    pub fn numbers(self, member: u32, set: u32) -> (Vec<f64>, MemberLoads<f64>) {
        let (declared, prepared) = self.member(member);
        let modulus = |name: &str| self.structure.material_number(declared.material, name).unwrap_or(f64::NAN);
        let (young, shear) = (modulus("E"), modulus("G"));
        let loads = self.statics.member_loads(&mut Numbers, self.structure, (member, set), &prepared.frame);
        let mut numbers = vec![prepared.frame.length, young, shear];
        let _ = loads.map(|value| numbers.push(value));
        (numbers, loads)
    }

    /// What decides, besides the sections, whether two members may share a template.
    pub fn shape(self, member: u32, loads: &MemberLoads<f64>, shape: &mut Vec<u32>) {
        let (declared, prepared) = self.member(member);
        let bits = prepared.components.iter().fold(0, |bits, &kept| 2 * bits + u32::from(kept));
        let has = |some: bool, bit: u32| if some { 1 << bit } else { 0 };
        let flags = [loads.weight.is_some(), loads.strain.is_some(), loads.gradient.is_some(), loads.pretension.is_some()];
        let flags = flags.into_iter().zip(6..).fold(bits, |bits, (some, bit)| bits | has(some, bit));
        shape.push(flags | has(declared.shear, 10));
        let mut wide = |value: u64| shape.extend([value as u32, (value >> 32) as u32]);
        prepared.grading.iter().for_each(|at| wide(at.to_bits()));
        wide(loads.terms.len() as u64);
        for term in &loads.terms {
            wide(term.way as u64);
            term.spread.key().into_iter().for_each(&mut wide);
        }
    }

    /// The inputs a plain member deforms by, in the order of its basic forces; `None` where one is released.
    pub fn inputs(self, member: u32, set: u32) -> [Option<u32>; BASIC] {
        std::array::from_fn(|component| self.statics.deformation(set, member, component).map(|input| self.first_input + input))
    }

    /// The inputs of a piece in a mode: displacements of its ends along and about the member's axes; global ones at the ends of a
    /// member whose nodes move with the design.
    pub fn modal(self, member: u32, piece: u32) -> [u32; 12] {
        let number = self.statics.members[member as usize].first_piece + piece;
        std::array::from_fn(|at| self.first_input + self.statics.modal(self.structure, number, at))
    }

    /// The input of a node's displacement.
    pub fn displacement(self, set: u32, node: u32, direction: usize) -> u32 {
        self.first_input + self.statics.displacement(set, node, direction)
    }
}

/// The nodes a member's formulas start from.
#[derive(Clone)]
pub(super) struct MemberNodes {
    pub length: NodeId,
    pub young: NodeId,
    pub shear: Option<NodeId>,
    pub loads: MemberLoads<NodeId>,
    pub deformations: [NodeId; BASIC],
    /// The basic forces, where these are the inputs.
    pub forces: Option<[NodeId; BASIC]>,
    /// The deformations by its ends' displacements, where its nodes move with the design.
    pub rows: Option<crate::structure::deformation::Rows<NodeId>>,
    /// Member axes likewise.
    pub frame: Option<Frame<NodeId>>,
}
