//! Pieces that members are cut into for buckling and vibration.

use super::{Prepared, Statics};
use crate::problem::structure::Structure;
use crate::structure::Components;

impl Statics {
    /// The input of a displacement of a piece's end in a mode, 0 to 11; they follow those of every case and combination.
    pub fn modal(&self, structure: &Structure, piece: u32, at: usize) -> u32 {
        structure.load_sets() as u32 * self.inputs + 12 * piece + at as u32
    }
}

impl Prepared {
    /// What piece number `at` carries: hinges are at the ends of the member only. Torsion that a hinge releases anywhere is nowhere.
    pub fn of_piece(&self, at: u32) -> Components {
        let mut components = self.unhinged;
        components[5] = self.components[5];
        if at == 0 {
            (components[1], components[3]) = (self.components[1], self.components[3]);
        }
        if at + 1 == self.pieces {
            (components[2], components[4]) = (self.components[2], self.components[4]);
        }
        components
    }

    /// Which of u, v, w, rx, ry, rz (member axes) the ends of inner pieces have.
    pub fn inner_directions(&self) -> [bool; 6] {
        let [axial, lateral, _, vertical, _, _] = self.unhinged;
        [axial, lateral, vertical, self.components[5], vertical, lateral]
    }
}
