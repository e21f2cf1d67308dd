//! Basic forces by equilibrium alone.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use nalgebra::DMatrix;

use super::numbers::{Loaded, Numbered, ROUNDING, Shares};
use crate::problem::Problem;
use crate::problem::statics::Statics;
use crate::problem::structure::{Action, Structure};
use crate::structure::algebra::Numbers;
use crate::structure::deformation::{BASIC, support_rows};

/// Basic forces times cases up to which they are looked for: rows are stated one by one, and the matrix of equilibrium is dense.
const MOST_FORCES: usize = 1200;

/// A structure whose forces do not depend on its sections.
pub(super) struct Equilibrium<'a> {
    pub structure: &'a Structure,
    pub statics: &'a Statics,
    /// Member and component of every basic force.
    pub unknowns: Vec<(u32, usize)>,
    /// Node and direction of every equation.
    pub free: Vec<(u32, usize)>,
    /// By basic force and case.
    of_cases: DMatrix<f64>,
    /// By basic force and equation: those that a unit load there calls forth.
    of_units: DMatrix<f64>,
    /// Deformations of members by case or combination, once asked: every displacement is a sum of them.
    deformed: RefCell<HashMap<(u32, u32), Rc<Deformed>>>,
}

/// A member's deformations, each over what it has to be divided by.
type Deformed = [Shares; BASIC];

impl<'a> Equilibrium<'a> {
    /// `None` for structures with nodes or moduli that move with the design, with springs, with loads that depend on sections, and for
    /// indeterminate ones.
    pub fn of(problem: &'a Problem) -> Option<Self> {
        let (structure, statics) = (problem.structure.as_deref()?, problem.statics.as_deref()?);
        let weighs = structure.loads.iter().any(|load| matches!(load.action, Action::SelfWeight { .. }));
        let free: Vec<(u32, usize)> = statics.free_directions().collect();
        let members = statics.members.iter().zip(0..);
        let kept =
            members.flat_map(|(prepared, member)| (0..BASIC).filter(|&at| prepared.components[at]).map(move |at| (member, at)));
        let unknowns: Vec<(u32, usize)> = kept.collect();
        let cases = structure.cases.len();
        if structure.has_springs()
            || weighs
            || free.is_empty()
            || free.len() != unknowns.len()
            || unknowns.len() * cases > MOST_FORCES
            || !(0..structure.members.len()).all(|member| is_constant(structure, statics, member))
        {
            return None;
        }
        let factor = |row: usize, (member, component): (u32, usize)| {
            let (node, direction) = free[row];
            structure.members[member as usize].at_node(&statics.members[member as usize].rows[component], node, direction)
        };
        let inverse = DMatrix::from_fn(free.len(), unknowns.len(), |row, at| factor(row, unknowns[at])).try_inverse()?;
        let load = |row: usize, case: usize| {
            let (node, direction) = free[row];
            statics.nodal_load(structure, case as u32, node, direction) - by_members(structure, statics, case as u32, free[row])
        };
        let loads = DMatrix::from_fn(free.len(), cases, load);
        let (found, terms) = (&inverse * &loads, inverse.abs() * loads.abs());
        let of_cases = found.zip_map(&terms, |force, terms| if force.abs() <= ROUNDING * terms { 0.0 } else { force });
        let largest = inverse.amax();
        let of_units = inverse.map(|force| if force.abs() <= ROUNDING * largest { 0.0 } else { force });
        Some(Equilibrium { structure, statics, unknowns, free, of_cases, of_units, deformed: RefCell::default() })
    }

    /// The basic forces of a member in a case or combination.
    pub fn forces(&self, set: u32, member: u32) -> [f64; BASIC] {
        let factors = self.structure.factors(set);
        self.of_member(member, |at| factors.iter().map(|&(case, factor)| factor * self.of_cases[(at, case as usize)]).sum())
    }

    /// The equation of a free direction; `None` where it is held.
    pub fn equation(&self, node: u32, direction: usize) -> Option<usize> {
        self.free.iter().position(|&at| at == (node, direction))
    }

    /// The forces that a unit load in the direction of an equation calls forth.
    pub fn unit_forces(&self, equation: usize, member: u32) -> [f64; BASIC] {
        self.of_member(member, |at| self.of_units[(at, equation)])
    }

    /// The deformations of a member in a case or combination.
    pub fn deformations(&self, set: u32, member: u32) -> Rc<Deformed> {
        let found = || Rc::new(self.member(set, member).deformations());
        Rc::clone(self.deformed.borrow_mut().entry((set, member)).or_insert_with(found))
    }

    fn of_member(&self, member: u32, force: impl Fn(usize) -> f64) -> [f64; BASIC] {
        let first = self.unknowns.partition_point(|&(other, _)| other < member);
        let mut forces = [0.0; BASIC];
        let own = self.unknowns[first..].iter().zip(first..).take_while(|((other, _), _)| *other == member);
        own.for_each(|(&(_, component), at)| forces[component] = force(at));
        forces
    }

    /// A member in a case or combination.
    pub fn member(&self, set: u32, member: u32) -> Numbered<'a> {
        Numbered::new(self.structure, self.statics, Loaded { set, member, forces: self.forces(set, member) })
    }

    /// What the ground exerts on a node in a held direction.
    pub fn reaction(&self, set: u32, node: u32, direction: usize) -> f64 {
        let mut sum = -self.statics.nodal_load(self.structure, set, node, direction);
        let mut terms = sum.abs();
        for &member in &self.statics.members_at[node as usize] {
            let (declared, prepared) = (&self.structure.members[member as usize], &self.statics.members[member as usize]);
            let forces = self.forces(set, member);
            let shares = prepared.rows.iter().zip(forces).map(|(row, force)| declared.at_node(row, node, direction) * force);
            let (total, largest) = shares.fold((0.0, 0.0), |(total, largest), share: f64| (total + share, largest + share.abs()));
            let loads = by_member(self.structure, self.statics, (set, member), (node, direction));
            sum += total + loads;
            terms += largest + loads.abs();
        }
        if sum.abs() <= ROUNDING * terms { 0.0 } else { sum }
    }
}

/// What the supports of all members, simply supported, exert in a direction of a node.
fn by_members(structure: &Structure, statics: &Statics, set: u32, at: (u32, usize)) -> f64 {
    let members = statics.members_at[at.0 as usize].iter();
    members.map(|&member| by_member(structure, statics, (set, member), at)).sum()
}

fn by_member(structure: &Structure, statics: &Statics, (set, member): (u32, u32), at: (u32, usize)) -> f64 {
    let (declared, prepared) = (&structure.members[member as usize], &statics.members[member as usize]);
    if prepared.loads.is_empty() {
        return 0.0;
    }
    let numbered = Numbered::new(structure, statics, Loaded { set, member, forces: [0.0; BASIC] });
    let rows = support_rows(&mut Numbers, &prepared.frame, declared.offset);
    rows.iter().zip(numbered.support_forces()).map(|(row, force)| declared.at_node(row, at.0, at.1) * force).sum()
}

/// Whether coordinates and moduli of a member are numbers, or it is not there.
fn is_constant(structure: &Structure, statics: &Statics, member: usize) -> bool {
    let declared = &structure.members[member];
    declared.absent || (statics.members[member].fixed && structure.has_constant_moduli(declared.material))
}
