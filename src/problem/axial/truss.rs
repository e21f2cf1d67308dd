//! Trusses whose forces equilibrium bounds: their bars and equations.

use crate::expression::operators::Fold;
use crate::problem::rewritten::scaled;
use crate::problem::statics::Statics;
use crate::problem::structure::{Action, Structure};
use crate::problem::{Constraint, Dimension, Formula, Limit, Problem, Scope};

/// Bars up to which a truss is written out in its forces: rows are stated one by one, and the equilibrium matrix is dense.
const MOST_BARS: usize = 600;

/// A truss whose forces do not depend on where its nodes have moved to.
pub(super) struct Truss<'a> {
    pub problem: &'a Problem,
    pub structure: &'a Structure,
    pub statics: &'a Statics,
    /// Members that are there.
    pub bars: Vec<u32>,
    /// Node and direction of every equation of equilibrium.
    pub free: Vec<(u32, usize)>,
}

impl<'a> Truss<'a> {
    /// `None` for structures with members that bend, with nodes or moduli that move with the design, with springs, or with loads on members that their nodes
    /// have to carry.
    pub fn of(problem: &'a Problem) -> Option<Self> {
        let (structure, statics) = (problem.structure.as_deref()?, problem.statics.as_deref()?);
        let bars: Vec<u32> = (0..structure.members.len() as u32).filter(|&at| !structure.members[at as usize].absent).collect();
        let is_bar = |&at: &u32| {
            let (member, prepared) = (&structure.members[at as usize], &statics.members[at as usize]);
            let young = structure.materials[member.material as usize].young;
            member.pinned && prepared.fixed && prepared.components[0] && matches!(young, Dimension::Constant(_))
        };
        let pulls = |action: &Action| {
            matches!(
                action,
                Action::Distributed { .. } | Action::Point { .. } | Action::SelfWeight { .. } | Action::Gradient { .. }
            )
        };
        if bars.is_empty()
            || bars.len() * structure.cases.len() > MOST_BARS
            || structure.has_springs()
            || !bars.iter().all(is_bar)
            || structure.loads.iter().any(|load| pulls(&load.action))
        {
            return None;
        }
        let free = statics.free_directions().collect();
        Some(Truss { problem, structure, statics, bars, free })
    }

    /// How much a bar of unit force pulls at a node in a direction, with the sign of the equations of equilibrium.
    fn pull(&self, bar: u32, node: u32, direction: usize) -> f64 {
        self.structure.members[bar as usize].at_node(&self.statics.members[bar as usize].rows[0], node, direction)
    }

    /// Equilibrium as rows over the forces.
    pub fn equations(&self, first: u32) -> Vec<Constraint> {
        let mut rows = Vec::new();
        for case in 0..self.structure.cases.len() {
            for &(node, direction) in &self.free {
                let force = |at: usize| Formula::Variable(first + (case * self.bars.len() + at) as u32);
                let pulls = self.bars.iter().enumerate().map(|(at, &bar)| (at, self.pull(bar, node, direction)));
                let terms = pulls.filter(|(_, pull)| *pull != 0.0).map(|(at, pull)| scaled(pull, force(at))).collect();
                rows.push(Constraint {
                    name: format!("equilibrium[{}, {}]", &self.structure.nodes.names[node as usize], direction),
                    detail: self.structure.cases[case].to_string().into(),
                    place: String::new(),
                    text: String::new(),
                    scope: Scope::Once,
                    left: Formula::Fold(Fold::Sum, terms),
                    right: Limit::Equal(Formula::Constant(self.statics.nodal_load(self.structure, case as u32, node, direction))),
                    asked: Vec::new(),
                });
            }
        }
        rows
    }
}
