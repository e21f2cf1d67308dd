//! Formulas of responses, written in the forces of bars.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::terms::{holds, one_sided, over, scaled};
use super::truss::Truss;
use crate::expression::operators::{Binary, Fold};
use crate::problem::formula::{Response, Subject, What};
use crate::problem::structure::{Action, Load};
use crate::problem::{Constraint, Dimension, Formula, Limit, Property};
use crate::structure::beam::Force;

/// What the forces are: by case and bar.
pub(super) enum Forces {
    /// Those of equilibrium, and by equation those that a unit load there calls forth.
    Known { of_cases: DMatrix<f64>, of_units: DMatrix<f64> },
    /// Variables from this one on, case by case.
    Open(u32),
}

/// Writes formulas in forces.
pub(super) struct Writer<'a> {
    pub truss: &'a Truss<'a>,
    pub forces: Forces,
}

impl Writer<'_> {
    /// The rows of a constraint, item by item where it asks for responses; `None` where it asks for one that is not said in forces.
    pub fn rows(&self, constraint: &Constraint) -> Option<Vec<Constraint>> {
        let problem = self.truss.problem;
        let mut known = vec![Some(false); problem.definitions.len()];
        let asks = [&constraint.left].into_iter().chain(constraint.right.formulas()).any(|one| one.analyses(problem, &mut known));
        if !asks {
            return Some(vec![constraint.clone()]);
        }
        let one = |at: usize| {
            let one = problem.one_row(constraint, at)?;
            let right = match &one.right {
                Limit::AtMost(limit) => Limit::AtMost(self.formula(limit)?),
                Limit::AtLeast(limit) => Limit::AtLeast(self.formula(limit)?),
                Limit::Equal(value) => Limit::Equal(self.formula(value)?),
                Limit::Between(lower, upper) => Limit::Between(self.formula(lower)?, self.formula(upper)?),
            };
            let left = self.formula(&one.left)?;
            Some(Constraint { right: one_sided(&left, right), left, ..one })
        };
        let rows: Vec<Constraint> = (0..constraint.scope.rows()).map(one).collect::<Option<_>>()?;
        // A row that speaks of no variable holds, and says nothing then, or never does, and the analysis tells.
        let idle = rows.iter().filter(|row| row.left.as_constant().is_some());
        let holds = idle.map(holds).collect::<Option<Vec<bool>>>()?.iter().all(|&holds| holds);
        holds.then(|| rows.into_iter().filter(|row| row.left.as_constant().is_none()).collect())
    }

    pub fn formula(&self, formula: &Formula) -> Option<Formula> {
        let problem = self.truss.problem;
        let boxed = |inner: &Formula| self.formula(inner).map(Box::new);
        Some(match formula {
            Formula::Response(response) => self.response(response)?,
            Formula::Unary(op, inner) => Formula::Unary(*op, boxed(inner)?),
            Formula::Binary(op, left, right) => Formula::Binary(*op, boxed(left)?, boxed(right)?),
            Formula::Fold(fold, list) => Formula::Fold(*fold, list.iter().map(|one| self.formula(one)).collect::<Option<_>>()?),
            Formula::Over { fold, collection, members, body } => {
                let mut known = vec![Some(false); problem.definitions.len()];
                if !body.analyses(problem, &mut known) {
                    return Some(formula.clone());
                }
                let parts = problem.instances(*collection, members, body)?;
                Formula::Fold(*fold, parts.iter().map(|one| self.formula(one)).collect::<Option<_>>()?)
            }
            other => other.clone(),
        })
    }

    fn response(&self, response: &Response) -> Option<Formula> {
        let structure = self.truss.structure;
        let member = match response.subject {
            Subject::Rib(rib) => structure.member(rib),
            _ => None,
        };
        match (&response.what, response.subject) {
            (What::Mass | What::Length, _) => Some(Formula::Response(Arc::new(response.clone()))),
            (What::Force(Force::N, _), Subject::Rib(_)) => self.force(response.set, member?),
            (What::Force(..), Subject::Rib(_)) => Some(Formula::Constant(0.0)),
            (What::Stress(..), Subject::Rib(_)) => Some(over(self.force(response.set, member?)?, self.area(member?)?)),
            (What::Compliance, _) => self.compliance(response.set),
            (What::Displacement(direction), Subject::Node(node)) => {
                self.displacement(response.set, node, usize::from(*direction))
            }
            _ => None,
        }
    }

    /// A bar's force in a case or combination.
    fn force(&self, set: u32, member: u32) -> Option<Formula> {
        let Ok(at) = self.truss.bars.binary_search(&member) else { return Some(Formula::Constant(0.0)) };
        let factors = self.truss.structure.factors(set);
        Some(match &self.forces {
            Forces::Known { of_cases, .. } => {
                Formula::Constant(factors.iter().map(|&(case, factor)| factor * of_cases[(at, case as usize)]).sum())
            }
            Forces::Open(first) => {
                let variable = |case: u32| Formula::Variable(first + case * self.truss.bars.len() as u32 + at as u32);
                match factors.as_slice() {
                    [(case, 1.0)] => variable(*case),
                    several => {
                        Formula::Fold(Fold::Sum, several.iter().map(|&(case, factor)| scaled(factor, variable(case))).collect())
                    }
                }
            }
        })
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
        if self.is_strained(set) {
            return None;
        }
        let term = |&member: &u32| {
            let force = self.force(set, member)?;
            let square = match force.as_constant() {
                Some(value) => Formula::Constant(value * value),
                None => Formula::Binary(Binary::Power, Box::new(force), Box::new(Formula::Constant(2.0))),
            };
            // A square over a positive term is convex as it stands.
            Some(scaled(self.length_by_modulus(member)?, over(square, self.area(member)?)))
        };
        Some(Formula::Fold(Fold::Sum, self.truss.bars.iter().map(term).collect::<Option<_>>()?))
    }

    /// Σ n·N·L/(E·A) by the forces n of a unit load.
    fn displacement(&self, set: u32, node: u32, direction: usize) -> Option<Formula> {
        let Forces::Known { of_units, .. } = &self.forces else { return None };
        if self.is_strained(set) {
            return None;
        }
        let Some(row) = self.truss.free.iter().position(|&at| at == (node, direction)) else {
            return Some(Formula::Constant(0.0));
        };
        let mut terms = Vec::new();
        for (at, &member) in self.truss.bars.iter().enumerate() {
            let force = self.force(set, member)?.as_constant()?;
            let coefficient = of_units[(at, row)] * force * self.length_by_modulus(member)?;
            if coefficient != 0.0 {
                terms.push(over(Formula::Constant(coefficient), self.area(member)?));
            }
        }
        Some(if terms.is_empty() { Formula::Constant(0.0) } else { Formula::Fold(Fold::Sum, terms) })
    }

    /// Whether anything but forces on nodes strains the truss in a case or combination.
    fn is_strained(&self, set: u32) -> bool {
        let factors = self.truss.structure.factors(set);
        let acts = |load: &&Load| factors.iter().any(|(case, _)| *case == load.case);
        self.truss.structure.loads.iter().filter(acts).any(|load| !matches!(load.action, Action::Nodal { .. }))
    }
}
