//! What states and their equations are called.

use super::super::{NameTable, Names};
use super::{States, prepared};
use crate::problem::Problem;
use crate::problem::structure::DIRECTIONS;
use std::sync::Arc;

/// The user's names, then those of the states and their equations.
pub(super) struct LiftedNames {
    pub(super) own: NameTable,
    pub(super) problem: Arc<Problem>,
    pub(super) states: States,
    pub(super) directions: Vec<(u32, u8)>,
}

impl LiftedNames {
    pub(super) fn state(&self, at: usize) -> String {
        let structure = prepared(&self.problem).0;
        let (node, direction) = self.directions[at % self.states.block];
        let case = &structure.cases[at / self.states.block];
        format!("{case}, {}, {}", &structure.nodes.names[node as usize], DIRECTIONS[usize::from(direction)])
    }
}

impl Names for LiftedNames {
    fn variable(&self, j: usize) -> String {
        match j.checked_sub(self.states.first_variable) {
            None => self.problem.variable_name(j),
            Some(at) => format!("displacement[{}]", self.state(at)),
        }
    }

    fn row(&self, i: usize) -> String {
        match i.checked_sub(self.states.first_row) {
            None => self.own.row(i),
            Some(at) => format!("equilibrium[{}]", self.state(at)),
        }
    }

    fn objective(&self) -> String {
        self.own.objective()
    }

    fn rib_volume(&self, rib: usize) -> String {
        self.own.rib_volume(rib)
    }

    fn row_place(&self, i: usize) -> Option<String> {
        if i < self.states.first_row { self.own.row_place(i) } else { None }
    }
}
