//! Bars that may vanish: their stress limits as limits of their forces, and structures without the bars that have vanished.
//!
//! The stress a bar would have as its area goes to zero is that of its nodes' displacements, which are finite: σ ≤ σ̄ would forbid the area
//! zero though a bar of no area carries nothing. Wherever the area A is positive N ≤ σ̄·A says the same, and it lets the bar go (Cheng and Guo,
//! *ε-relaxed approach in structural topology optimization*, Structural Optimization 13, 1997; Achtziger and Kanzow, *Mathematical programs
//! with vanishing constraints*, Mathematical Programming 114, 2008).

use std::sync::Arc;

use super::evaluate::Evaluation;
use super::formula::{Response, Subject, What};
use super::{Constraint, Formula, Limit, Problem, Property, Scope};
use crate::expression::operators::{Binary, Unary};
use crate::structure::beam::Force;

/// A bar whose area may fall to this share of its start is one that may vanish.
const MAY_VANISH: f64 = 1e-4;

/// A bar of less than this share of the largest area has vanished: what it carries is lost in the tolerance of the limits.
const VANISHED: f64 = 1e-6;

impl Problem {
    /// The problem with the stress limits of bars that may vanish stated as limits of their forces.
    pub fn with_force_limits(self) -> Problem {
        let light = self.light_ribs();
        self.with_force_limits_of(light)
    }

    /// The same for every bar.
    pub fn with_force_limits_of_all_bars(self) -> Problem {
        let mut bars = vec![false; self.ribs.from.len()];
        let members = self.structure.iter().flat_map(|structure| &structure.members);
        members.filter(|member| member.pinned).for_each(|member| bars[member.rib as usize] = true);
        self.with_force_limits_of(bars)
    }

    fn with_force_limits_of(mut self, ribs: Vec<bool>) -> Problem {
        let light = Light { ribs, from: self.ribs.from.clone(), to: self.ribs.to.clone() };
        if light.ribs.contains(&true) {
            for constraint in std::mem::take(&mut self.constraints) {
                let rows = force_limits(&light, constraint);
                self.constraints.extend(rows);
            }
        }
        self
    }

    /// Members whose areas have vanished at a point, among those that may.
    pub fn vanished_members(&self, x: &[f64]) -> Vec<u32> {
        let Some(structure) = self.structure.as_deref() else { return Vec::new() };
        let (light, evaluation) = (self.light_ribs(), Evaluation::at(self, x));
        let areas: Vec<f64> = structure.members.iter().map(|member| area(&evaluation, member.rib).unwrap_or(f64::NAN)).collect();
        let largest = areas.iter().copied().fold(0.0, f64::max);
        let gone = |member: &usize| light[structure.members[*member].rib as usize] && areas[*member] < VANISHED * largest;
        (0..areas.len()).filter(gone).map(|member| member as u32).collect()
    }

    /// The structure without these members. Variables that nothing but their sections knows keep their lower bounds; every name and every row stays: the
    /// force of what is absent is zero.
    pub fn without_members(&self, members: &[u32]) -> Problem {
        let mut rest = self.clone();
        let Some(structure) = rest.structure.as_mut().map(Arc::make_mut) else { return rest };
        members.iter().for_each(|&member| structure.members[member as usize].absent = true);
        let absent: Vec<bool> = self.ribs_flagged(members);
        let mut stays = vec![false; self.sections.names.len()];
        for (rib, _) in absent.iter().enumerate().filter(|(_, absent)| !**absent) {
            stays[self.ribs.from[rib] as usize] = true;
            stays[self.ribs.to[rib] as usize] = true;
        }
        for (rib, _) in absent.iter().enumerate().filter(|(_, absent)| **absent) {
            for section in [self.ribs.from[rib], self.ribs.to[rib]].into_iter().filter(|&section| !stays[section as usize]) {
                for dimension in self.dimensions(section as usize) {
                    if let super::Dimension::Variable(j) = *dimension {
                        let lower = rest.variables.lower[j as usize];
                        (rest.variables.upper[j as usize], rest.variables.start[j as usize]) = (lower, lower);
                    }
                }
            }
        }
        rest.prepare();
        rest
    }

    fn ribs_flagged(&self, members: &[u32]) -> Vec<bool> {
        let mut flagged = vec![false; self.ribs.from.len()];
        if let Some(structure) = self.structure.as_deref() {
            members.iter().for_each(|&member| flagged[structure.members[member as usize].rib as usize] = true);
        }
        flagged
    }

    /// Which ribs are bars whose area may vanish between its bounds.
    fn light_ribs(&self) -> Vec<bool> {
        let mut light = vec![false; self.ribs.from.len()];
        let Some(structure) = self.structure.as_deref() else { return light };
        let (least, start) = (Evaluation::at(self, &self.variables.lower), Evaluation::at_start(self));
        for member in structure.members.iter().filter(|member| member.pinned && !member.absent) {
            let pair = area(&least, member.rib).zip(area(&start, member.rib));
            light[member.rib as usize] = pair.is_some_and(|(least, start)| least < MAY_VANISH * start);
        }
        light
    }
}

/// Ribs that may vanish, and the sections at the ends of all.
struct Light {
    ribs: Vec<bool>,
    from: Vec<u32>,
    to: Vec<u32>,
}

impl Light {
    fn is_prismatic(&self, rib: u32) -> bool {
        self.from[rib as usize] == self.to[rib as usize]
    }
}

/// The smaller of the areas at a rib's ends.
fn area(evaluation: &Evaluation<'_>, rib: u32) -> Option<f64> {
    let ribs = &evaluation.problem.ribs;
    let at = |section: u32| evaluation.property(section, "A");
    Some(at(ribs.from[rib as usize])?.min(at(ribs.to[rib as usize])?))
}

/// A constraint as it is, or that of the ribs that stay and those of the ribs that may vanish.
fn force_limits(light: &Light, constraint: Constraint) -> Vec<Constraint> {
    let Some((set, subject, station, folded)) = stress(&constraint.left) else { return vec![constraint] };
    let name = || Property(Arc::from("A"));
    let (area, going, staying) = match (&constraint.scope, subject) {
        (Scope::Ribs(ribs), Subject::Own) => {
            let (going, staying): (Vec<u32>, Vec<u32>) = ribs.iter().partition(|&&rib| light.ribs[rib as usize]);
            (Formula::AtProperty(station, name()), Scope::Ribs(going), staying)
        }
        (Scope::Once, Subject::Rib(rib)) if light.ribs[rib as usize] && light.is_prismatic(rib) => {
            (Formula::SectionProperty(light.from[rib as usize], name()), Scope::Once, Vec::new())
        }
        _ => return vec![constraint],
    };
    if matches!(&going, Scope::Ribs(ribs) if ribs.is_empty()) {
        return vec![constraint];
    }
    let force = Formula::Response(Arc::new(Response { set, subject, what: What::Force(Force::N, station) }));
    let left = if folded { Formula::Unary(Unary::Abs, Box::new(force)) } else { force };
    // N − σ̄·A against zero.
    let less = |limit: &Formula| {
        let allowed = Formula::Binary(Binary::Multiply, Box::new(limit.clone()), Box::new(area.clone()));
        Formula::Binary(Binary::Subtract, Box::new(left.clone()), Box::new(allowed))
    };
    let zero = || Formula::Constant(0.0);
    let limits = match &constraint.right {
        Limit::AtMost(limit) => vec![("", less(limit), Limit::AtMost(zero()))],
        Limit::AtLeast(limit) => vec![("", less(limit), Limit::AtLeast(zero()))],
        Limit::Equal(limit) => vec![("", less(limit), Limit::Equal(zero()))],
        Limit::Between(lower, upper) => {
            vec![("compression", less(lower), Limit::AtLeast(zero())), ("tension", less(upper), Limit::AtMost(zero()))]
        }
    };
    let row = |(word, left, right): (&str, Formula, Limit)| {
        let detail = [&*constraint.detail, word].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ");
        Constraint { detail: detail.into(), scope: going.clone(), left, right, ..constraint.clone() }
    };
    let rest = (!staying.is_empty()).then(|| Constraint { scope: Scope::Ribs(staying), ..constraint.clone() });
    rest.into_iter().chain(limits.into_iter().map(row)).collect()
}

/// Case, rib and station of a normal stress, or of one's size.
fn stress(formula: &Formula) -> Option<(u32, Subject, f64, bool)> {
    match formula {
        Formula::Response(response) => match response.what {
            What::Stress(station, _) => Some((response.set, response.subject, station, false)),
            _ => None,
        },
        Formula::Unary(Unary::Abs, inner) => stress(inner).map(|(set, subject, station, _)| (set, subject, station, true)),
        _ => None,
    }
}
