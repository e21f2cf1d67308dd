//! Sections that cannot exist inside their bounds, or may cease to: a dimension, such as an H beam's flange thickness, that is
//! never positive, or may reach zero.

use std::collections::HashMap;

use super::affine::{Affine, Reading};
use super::evaluate::{Evaluation, Item};
use super::{Constraint, Dimension, Formula, Limit, Problem, Scope, sections_form};
use crate::sections;

/// A dimension in doubt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Doubt {
    /// The section.
    pub section: u32,
    /// The dimension.
    pub name: &'static str,
    /// True where it can never be positive, false where it may reach zero.
    pub never: bool,
}

/// Every dimension in doubt, section by section. Linear rows that keep a dimension positive are taken into account.
pub fn doubts(problem: &Problem) -> Vec<Doubt> {
    let (rows, mut reading) = (Rows::of(problem), Reading::of(problem));
    let mut found = Vec::new();
    for section in (0..problem.sections.names.len() as u32).filter(|&section| !is_plainly_positive(problem, section)) {
        for name in needed(problem, section, &mut reading) {
            let Some(value) = reading.property(section, name) else { continue };
            let (least, most) = value.range(&problem.variables);
            let never = most <= 0.0;
            if never || (least <= 0.0 && !rows.keep_positive(problem, section, &value, &mut reading)) {
                found.push(Doubt { section, name, never });
            }
        }
    }
    found
}

/// Whether all that must be positive is given, and is a positive number or a variable with a positive lower bound: nothing needs
/// to be looked into.
fn is_plainly_positive(problem: &Problem, section: u32) -> bool {
    let given = sections_form(problem, section as usize).map_or(&[][..], |form| form.dimensions);
    let kind = sections::kind_of(problem.sections.form[section as usize]);
    let is_positive = |dimension: &Dimension| match *dimension {
        Dimension::Constant(value) => value > 0.0,
        Dimension::Variable(j) => problem.variables.lower.get(j as usize).is_some_and(|lower| *lower > 0.0),
        Dimension::Formula(_) => false,
    };
    kind.positive().iter().all(|name| given.contains(name)) && problem.dimensions(section as usize).iter().all(is_positive)
}

/// The dimensions that must be positive: the given ones, and those of the kind that are no mere multiple of a given one.
fn needed(problem: &Problem, section: u32, reading: &mut Reading) -> Vec<&'static str> {
    let given = sections_form(problem, section as usize).map_or(&[][..], |form| form.dimensions);
    let kind = sections::kind_of(problem.sections.form[section as usize]);
    let derived = kind.positive().iter().copied().filter(|name| {
        !given.contains(name)
            && reading.property(section, name).is_some_and(|value| value.terms.len() != 1 || value.constant != 0.0)
    });
    let derived: Vec<&str> = derived.collect();
    given.iter().copied().chain(derived).collect()
}

/// Rows that may keep a dimension positive, findable by section and by variable.
struct Rows<'a> {
    /// Constraints repeated over sections, with the sections.
    repeated: Vec<(&'a Constraint, &'a [u32])>,
    /// Single affine rows with their limits, by variable.
    single: HashMap<u32, Vec<(Affine, f64, f64)>>,
}

impl<'a> Rows<'a> {
    fn of(problem: &'a Problem) -> Rows<'a> {
        let mut rows = Rows { repeated: Vec::new(), single: HashMap::new() };
        for constraint in &problem.constraints {
            match &constraint.scope {
                Scope::Sections(members) => rows.repeated.push((constraint, members)),
                Scope::Once => {
                    let Some(row) = Affine::of(problem, &constraint.left, Item::None) else { continue };
                    let (lower, upper) = limits(problem, &constraint.right, Item::None);
                    for &(j, _) in &row.terms {
                        rows.single.entry(j).or_default().push((row.clone(), lower, upper));
                    }
                }
                _ => {}
            }
        }
        rows
    }

    fn keep_positive(&self, problem: &Problem, section: u32, value: &Affine, reading: &mut Reading<'_>) -> bool {
        let singles = value.terms.iter().filter_map(|(j, _)| self.single.get(j)).flatten();
        let mut own = self.repeated.iter().filter(|(_, members)| members.binary_search(&section).is_ok());
        singles.into_iter().any(|(row, lower, upper)| keeps_positive(problem, value, row, *lower, *upper))
            || own.any(|(constraint, _)| {
                let item = Item::Section(section);
                let (lower, upper) = limits(problem, &constraint.right, item);
                reading.formula(&constraint.left, item).is_some_and(|row| keeps_positive(problem, value, &row, lower, upper))
            })
    }
}

/// Whether `lower ≤ row ≤ upper` and the bounds make the value positive: with value = λ·row + rest, for the λ that removes one
/// variable, the least value is λ times a limit plus the least rest.
fn keeps_positive(problem: &Problem, value: &Affine, row: &Affine, lower: f64, upper: f64) -> bool {
    row.terms.iter().filter(|(_, coefficient)| *coefficient != 0.0).any(|&(j, coefficient)| {
        let factor = value.coefficient(j) / coefficient;
        let limit = if factor > 0.0 { lower } else { upper };
        let mut rest = value.clone().plus(row, -factor);
        rest.terms.retain(|term| term.0 != j);
        factor != 0.0 && factor * limit + rest.range(&problem.variables).0 > 0.0
    })
}

fn limits(problem: &Problem, limit: &Limit, item: Item) -> (f64, f64) {
    let value = |formula: &Formula| Evaluation::constants(problem).value(formula, item);
    let (lower, upper) = match limit {
        Limit::AtMost(upper) => (None, value(upper)),
        Limit::AtLeast(lower) => (value(lower), None),
        Limit::Equal(both) => (value(both), value(both)),
        Limit::Between(lower, upper) => (value(lower), value(upper)),
    };
    (lower.unwrap_or(f64::NEG_INFINITY), upper.unwrap_or(f64::INFINITY))
}
