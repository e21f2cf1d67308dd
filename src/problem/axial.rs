//! Trusses as problems in the axial forces of their bars.
//!
//! Equilibrium of the free directions is Bᵀ·N = p, whatever the areas are. Where B is square and regular (a statically *determinate* truss) the forces are numbers, and
//! every response is an explicit formula of the areas: σ = N/A, u = Σ n·N·L/(E·A) by the unit load theorem. Otherwise the forces of the elastic
//! truss are one solution among many: with them as free variables, and without the rows that ask for more than forces, the minimum is a
//! *lower bound* of that of the elastic truss (the lower-bound theorem of limit analysis; Dorn, Gomory and Greenberg, *Automatic design of optimal structures*,
//! Journal de Mécanique 3, 1964).

use std::sync::Arc;

use nalgebra::DMatrix;

use super::formula::{Response, Subject, What};
use super::statics::Statics;
use super::structure::{Action, Structure};
use super::{Constraint, Dimension, Formula, Limit, Origin, Problem, Property, Scope};
use crate::expression::operators::{Binary, Fold};
use crate::structure::beam::Force;

/// Bars up to which a truss is written out in its forces: rows are stated one by one, and the equilibrium matrix is dense.
const MOST_BARS: usize = 600;

/// Forces and displacements by unit loads below this share of the largest are rounding.
const ROUNDING: f64 = 1e-12;

/// A truss whose forces do not depend on where its nodes have moved to.
struct Truss<'a> {
    problem: &'a Problem,
    structure: &'a Structure,
    statics: &'a Statics,
    /// Members that are there.
    bars: Vec<u32>,
    /// Node and direction of every equation of equilibrium.
    free: Vec<(u32, usize)>,
}

/// What the forces are: by case and bar.
enum Forces {
    /// Those of equilibrium, and by equation those that a unit load there calls forth.
    Known { of_cases: DMatrix<f64>, of_units: DMatrix<f64> },
    /// Variables from this one on, case by case.
    Open(u32),
}

impl Problem {
    /// The problem of a statically determinate truss as formulas of its areas; `None` where it is none, or where something is asked that is
    /// no such formula.
    pub fn determinate(&self) -> Option<Problem> {
        let truss = Truss::of(self)?;
        if !self.analyses() || truss.free.len() != truss.bars.len() {
            return None;
        }
        let equilibrium = truss.equilibrium();
        let inverse = equilibrium.clone().try_inverse()?;
        let loads = DMatrix::from_fn(truss.free.len(), truss.structure.cases.len(), |row, case| truss.load(case, row));
        let cleaned = |matrix: DMatrix<f64>| {
            let largest = matrix.amax();
            matrix.map(|value| if value.abs() <= ROUNDING * largest { 0.0 } else { value })
        };
        let forces = Forces::Known { of_cases: cleaned(&inverse * loads), of_units: cleaned(inverse) };
        let writer = Writer { truss: &truss, forces };
        let objective = writer.formula(&self.objective)?;
        let definitions = self.definitions.iter().map(|(name, formula)| Some((name.clone(), writer.formula(formula)?)));
        let definitions = definitions.collect::<Option<_>>()?;
        let constraints = self.constraints.iter().map(|constraint| writer.rows(constraint)).collect::<Option<Vec<_>>>()?.concat();
        Some(Problem { objective, definitions, constraints, ..self.clone() })
    }

    /// The problem with the forces of a truss's bars as variables that equilibrium alone holds: no design that meets the limits is below its
    /// minimum. `None` for other structures.
    pub fn with_free_forces(&self) -> Option<Problem> {
        if !self.analyses() || Truss::of(self).is_none() {
            return None;
        }
        self.clone().with_force_limits_of_all_bars().in_free_forces()
    }

    fn in_free_forces(&self) -> Option<Problem> {
        let truss = Truss::of(self)?;
        let first = self.variables.lower.len() as u32;
        let writer = Writer { truss: &truss, forces: Forces::Open(first) };
        let objective = writer.formula(&self.objective)?;
        // What cannot be said in forces is left out, with every row that uses it.
        let definitions = self
            .definitions
            .iter()
            .map(|(name, formula)| (name.clone(), writer.formula(formula).unwrap_or(Formula::Constant(f64::NAN))));
        let said = |constraint: &&Constraint| !self.uses_unsaid(constraint, &writer);
        let rows = self.constraints.iter().filter(said).filter_map(|constraint| writer.rows(constraint)).flatten();
        let mut relaxed = Problem {
            objective,
            definitions: definitions.collect(),
            constraints: rows.chain(truss.equations(first)).collect(),
            ..self.clone()
        };
        let count = truss.bars.len() * truss.structure.cases.len();
        let variables = &mut relaxed.variables;
        variables.typical.resize(first as usize, 0.0);
        for at in 0..count as u32 {
            variables.origin.push(Origin::Input(at));
            variables.lower.push(f64::NEG_INFINITY);
            variables.upper.push(f64::INFINITY);
            variables.start.push(0.0);
            variables.typical.push(0.0);
        }
        Some(relaxed)
    }

    fn uses_unsaid(&self, constraint: &Constraint, writer: &Writer<'_>) -> bool {
        let unsaid = |&d: &u32| self.definitions.get(d as usize).is_some_and(|(_, formula)| writer.formula(formula).is_none());
        let mut used = Vec::new();
        [&constraint.left].into_iter().chain(constraint.right.formulas()).for_each(|formula| definitions_in(formula, &mut used));
        used.iter().any(unsaid)
    }
}

/// Definitions that a formula names.
fn definitions_in(formula: &Formula, used: &mut Vec<u32>) {
    match formula {
        Formula::Definition(d) => used.push(*d),
        Formula::Unary(_, inner) | Formula::Profile(_, inner) => definitions_in(inner, used),
        Formula::Binary(_, left, right) => {
            definitions_in(left, used);
            definitions_in(right, used);
        }
        Formula::Fold(_, list) => list.iter().for_each(|part| definitions_in(part, used)),
        Formula::Over { body, .. } => definitions_in(body, used),
        _ => {}
    }
}

impl<'a> Truss<'a> {
    /// `None` for structures with members that bend, with nodes or moduli that move with the design, with springs, or with loads on members that their nodes
    /// have to carry.
    fn of(problem: &'a Problem) -> Option<Self> {
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
        let springy = structure.supports.iter().any(|support| support.springs.iter().any(|&spring| spring != 0.0));
        if bars.is_empty()
            || bars.len() * structure.cases.len() > MOST_BARS
            || springy
            || !bars.iter().all(is_bar)
            || structure.loads.iter().any(|load| pulls(&load.action))
        {
            return None;
        }
        let nodes = 0..structure.nodes.names.len() as u32;
        let free = nodes.flat_map(|node| (0..6).map(move |direction| (node, direction)));
        let free = free.filter(|&(node, direction)| statics.is_free(node, direction)).collect();
        Some(Truss { problem, structure, statics, bars, free })
    }

    /// How much a bar of unit force pulls at a node in a direction, with the sign of the equations of equilibrium.
    fn pull(&self, bar: u32, node: u32, direction: usize) -> f64 {
        let (member, prepared) = (&self.structure.members[bar as usize], &self.statics.members[bar as usize]);
        let at = |end: usize| prepared.rows[0][6 * end + direction];
        (if member.start == node { at(0) } else { 0.0 }) + (if member.end == node { at(1) } else { 0.0 })
    }

    fn equilibrium(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.free.len(), self.bars.len(), |row, at| {
            let (node, direction) = self.free[row];
            self.pull(self.bars[at], node, direction)
        })
    }

    fn load(&self, case: usize, row: usize) -> f64 {
        let (node, direction) = self.free[row];
        self.statics.nodal_load(self.structure, case as u32, node, direction)
    }

    /// Equilibrium as rows over the forces.
    fn equations(&self, first: u32) -> Vec<Constraint> {
        let mut rows = Vec::new();
        for case in 0..self.structure.cases.len() {
            for (row, &(node, direction)) in self.free.iter().enumerate() {
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
                    right: Limit::Equal(Formula::Constant(self.load(case, row))),
                });
            }
        }
        rows
    }
}

/// Writes formulas in forces.
struct Writer<'a> {
    truss: &'a Truss<'a>,
    forces: Forces,
}

impl Writer<'_> {
    /// The rows of a constraint, item by item where it asks for responses; `None` where it asks for one that is not said in forces.
    fn rows(&self, constraint: &Constraint) -> Option<Vec<Constraint>> {
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

    fn formula(&self, formula: &Formula) -> Option<Formula> {
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
        let acts = |load: &&super::structure::Load| factors.iter().any(|(case, _)| *case == load.case);
        self.truss.structure.loads.iter().filter(acts).any(|load| !matches!(load.action, Action::Nodal { .. }))
    }
}

/// Whether a row without variables is met; `None` where its limit is no number.
fn holds(row: &Constraint) -> Option<bool> {
    let value = row.left.as_constant()?;
    let [lower, upper] = row.right.sides().map(|side| side.map(|limit| limit.as_constant()));
    let above = lower.map_or(Some(true), |lower| lower.map(|lower| value >= lower));
    let below = upper.map_or(Some(true), |upper| upper.map(|upper| value <= upper));
    Some(above? && below?)
}

/// A range around zero, of a left side that is never on one side of it, is one limit.
fn one_sided(left: &Formula, limit: Limit) -> Limit {
    match limit {
        Limit::Between(lower, upper) => match (sign(left), lower.as_constant(), upper.as_constant()) {
            (Some(sign), Some(least), _) if sign > 0.0 && least <= 0.0 => Limit::AtMost(upper),
            (Some(sign), _, Some(most)) if sign < 0.0 && most >= 0.0 => Limit::AtLeast(lower),
            _ => Limit::Between(lower, upper),
        },
        other => other,
    }
}

/// ±1 where a formula of numbers and areas, as they are written here, has one sign whatever the areas are.
fn sign(formula: &Formula) -> Option<f64> {
    match formula {
        Formula::Constant(value) if *value != 0.0 => Some(value.signum()),
        Formula::SectionProperty(..) => Some(1.0),
        Formula::Binary(Binary::Multiply | Binary::Divide, left, right) => Some(sign(left)? * sign(right)?),
        Formula::Fold(Fold::Sum, list) => {
            let first = sign(list.first()?)?;
            list.iter().all(|part| sign(part) == Some(first)).then_some(first)
        }
        _ => None,
    }
}

fn over(numerator: Formula, denominator: Formula) -> Formula {
    if numerator.as_constant() == Some(0.0) {
        return numerator;
    }
    Formula::Binary(Binary::Divide, Box::new(numerator), Box::new(denominator))
}

fn scaled(factor: f64, formula: Formula) -> Formula {
    match formula {
        Formula::Constant(value) => Formula::Constant(factor * value),
        other => Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(factor)), Box::new(other)),
    }
}
