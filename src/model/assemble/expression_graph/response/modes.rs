//! Energies of members' pieces in a mode, and the eigenvalues they lead to.

use super::super::{Item, Lowering, OwnNumber};
use crate::expression::graph::NodeId;
use crate::model::assemble::member::Framework;
use crate::problem::formula::{Energy, Response};
use crate::problem::modes::Eigenvalue;
use crate::structure::algebra::Algebra;
use crate::structure::beam::Piece;
use crate::structure::deformation::{along, turning};

impl Lowering<'_> {
    /// The input that stands for an eigenvalue: they follow those of cases and combinations.
    pub(super) fn eigenvalue(&mut self, framework: Framework, response: &Response) -> NodeId {
        let position = |wanted: Eigenvalue| self.problem.eigenvalues.iter().position(|known| *known == wanted);
        let Some(slot) = response.eigenvalue().and_then(position) else { return self.graph.constant(f64::NAN) };
        let before = framework.structure.load_sets() as u32 * framework.statics.inputs;
        self.variable(framework.first_input + before + slot as u32)
    }

    /// The energy of a member's piece.
    pub(super) fn modal(&mut self, framework: Framework, member: u32, set: u32, energy: Energy, piece: u32) -> NodeId {
        let (declared, prepared) = framework.member(member);
        let density = match energy {
            Energy::Inertia => self.own_number(Item::Rib(declared.rib), OwnNumber::Material("density".into())),
            _ => self.graph.constant(0.0),
        };
        let ends = self.piece_ends(framework, member, piece);
        let range = [piece, piece + 1].map(|at| f64::from(at) / f64::from(prepared.pieces));
        let components = prepared.of_piece(piece);
        self.with_beam(framework, member, set, |graph, whole| {
            let piece = Piece { whole, range, components, ends };
            match energy {
                Energy::Strain => piece.strain_energy(graph),
                Energy::Prestress => piece.prestress_energy(graph),
                Energy::Inertia => piece.inertia_energy(graph, density),
            }
        })
    }

    /// u, v, w, rx, ry, rz of a piece's start and end.
    fn piece_ends(&mut self, framework: Framework, member: u32, piece: u32) -> [NodeId; 12] {
        let (declared, prepared) = framework.member(member);
        let inputs = framework.modal(member, piece).map(|input| self.variable(input));
        if prepared.fixed {
            return inputs;
        }
        // The member's own ends move with its nodes, whose displacements are global.
        let axes = self.varying_frame(framework, member).axes;
        let outer = [piece == 0, piece + 1 == prepared.pieces];
        std::array::from_fn(|at| {
            let end = at / 6;
            if !outer[end] {
                return inputs[at];
            }
            let axis = axes[at % 3];
            let row = match at % 6 < 3 {
                true => along(&mut self.graph, end, axis, declared.offset[end]),
                false => turning(&mut self.graph, end, axis),
            };
            let parts: Vec<NodeId> =
                row.into_iter().zip(inputs).map(|(factor, input)| Algebra::multiply(&mut self.graph, factor, input)).collect();
            self.graph.sum(&parts)
        })
    }
}
