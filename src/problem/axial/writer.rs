//! Formulas of responses, written in the forces of bars.

use std::sync::Arc;

use super::truss::Truss;
use crate::expression::operators::{Binary, Fold};
use crate::problem::formula::{Response, Subject, What};
use crate::problem::rewritten::{Rewriting, over, scaled};
use crate::problem::{Dimension, Formula, Problem, Property};
use crate::structure::beam::Force;

/// Writes formulas in forces.
pub(super) struct Writer<'a> {
    pub truss: &'a Truss<'a>,
    /// The variable that is the first force; they follow case by case, bar by bar.
    pub first: u32,
}

impl Rewriting for Writer<'_> {
    fn problem(&self) -> &Problem {
        self.truss.problem
    }

    fn response(&self, response: &Response) -> Option<Formula> {
        let structure = self.truss.structure;
        let member = match response.subject {
            Subject::Rib(rib) => structure.member(rib),
            _ => None,
        };
        match (&response.what, response.subject) {
            (What::Mass | What::Length, _) => Some(Formula::Response(Arc::new(response.clone()))),
            (What::Force(Force::N, _), Subject::Rib(_)) => Some(self.force(response.set, member?)),
            (What::Force(..), Subject::Rib(_)) => Some(Formula::Constant(0.0)),
            (What::Stress(..), Subject::Rib(_)) => Some(over(self.force(response.set, member?), self.area(member?)?)),
            (What::Compliance, _) => self.compliance(response.set),
            _ => None,
        }
    }
}

impl Writer<'_> {
    /// A bar's force in a case or combination.
    fn force(&self, set: u32, member: u32) -> Formula {
        let Ok(at) = self.truss.bars.binary_search(&member) else { return Formula::Constant(0.0) };
        let variable = |case: u32| Formula::Variable(self.first + case * self.truss.bars.len() as u32 + at as u32);
        match self.truss.structure.factors(set).as_slice() {
            [(case, 1.0)] => variable(*case),
            several => Formula::Fold(Fold::Sum, several.iter().map(|&(case, factor)| scaled(factor, variable(case))).collect()),
        }
    }

    /// The area of a prismatic bar.
    fn area(&self, member: u32) -> Option<Formula> {
        let ribs = &self.truss.problem.ribs;
        let rib = self.truss.structure.members[member as usize].rib as usize;
        (ribs.from[rib] == ribs.to[rib]).then(|| Formula::SectionProperty(ribs.from[rib], Property(Arc::from("A"))))
    }

    /// L/E of a bar.
    fn length_by_modulus(&self, member: u32) -> Option<f64> {
        let material = &self.truss.structure.materials[self.truss.structure.members[member as usize].material as usize];
        let Dimension::Constant(young) = material.young else { return None };
        Some(self.truss.statics.members[member as usize].frame.length / young)
    }

    /// Σ N²·L/(E·A): the work of the loads, where they are all that strains the bars.
    fn compliance(&self, set: u32) -> Option<Formula> {
        if self.truss.structure.is_strained(set) {
            return None;
        }
        let term = |&member: &u32| {
            let force = self.force(set, member);
            let square = match force.as_constant() {
                Some(value) => Formula::Constant(value * value),
                None => Formula::Binary(Binary::Power, Box::new(force), Box::new(Formula::Constant(2.0))),
            };
            // A square over a positive term is convex as it stands.
            Some(scaled(self.length_by_modulus(member)?, over(square, self.area(member)?)))
        };
        Some(Formula::Fold(Fold::Sum, self.truss.bars.iter().map(term).collect::<Option<_>>()?))
    }
}
