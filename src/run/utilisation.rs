//! How far each rib's limits are used at a point.
//!
//! A row's use is value/limit where it is held from above and limit/value where it is held from below; both sides may vary
//! (`h <= 8*b`: h over 8b). It counts for the rib it is stated for, for the ribs at both sides of the section it is stated
//! for, for every member of its group, and for what its text names. Equalities are always met, so they count nowhere, nor do
//! limits of 0, which have no shares.

use std::sync::Arc;

use super::Subject;
use crate::expression::ast::Collection;
use crate::model::{EvaluationError, Model, assemble};
use crate::problem::{Constraint, Formula, Limit, Problem};

/// A use this large or larger is shown as this: limits whose value has the wrong sign have no share.
const MOST: f64 = 1e6;

/// The largest use of each rib's limits; `None` for ribs no limit speaks of.
///
/// # Errors
/// A side of a row that has no value at this point.
pub fn utilisation(subject: &Subject, x: &[f64]) -> Result<Vec<Option<f64>>, EvaluationError> {
    let problem = subject.problem();
    let mut found = Found::new(problem);
    let uses = uses(problem, x)?;
    for (constraint, uses) in problem.constraints.iter().zip(&uses) {
        let named = constraint.named(problem);
        let largest = uses.iter().flatten().copied().reduce(f64::max);
        named.sections.iter().for_each(|&s| found.note(Collection::Sections, s, largest));
        named.ribs.iter().for_each(|&r| found.note(Collection::Ribs, r, largest));
        for (row, &used) in uses.iter().enumerate() {
            let (collection, items) = constraint.own(row);
            items.iter().for_each(|&item| found.note(collection, item, used));
        }
    }
    Ok(found.of_ribs(problem))
}

struct Found {
    sections: Vec<Option<f64>>,
    ribs: Vec<Option<f64>>,
}

impl Found {
    fn new(problem: &Problem) -> Self {
        Found { sections: vec![None; problem.sections.names.len()], ribs: vec![None; problem.ribs.names.len()] }
    }

    fn note(&mut self, collection: Collection, item: u32, used: Option<f64>) {
        let all = if collection == Collection::Sections { &mut self.sections } else { &mut self.ribs };
        if let Some(known) = all.get_mut(item as usize) {
            *known = larger(*known, used);
        }
    }

    /// A rib's own, and those of its ends.
    fn of_ribs(self, problem: &Problem) -> Vec<Option<f64>> {
        let section = |s: u32| self.sections.get(s as usize).copied().flatten();
        let ends = problem.ribs.from.iter().zip(&problem.ribs.to);
        let both = |(own, (&from, &to)): (&Option<f64>, (&u32, &u32))| larger(*own, larger(section(from), section(to)));
        self.ribs.iter().zip(ends).map(both).collect()
    }
}

fn larger(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.max(b)),
        (one, other) => one.or(other),
    }
}

/// The use of every row, constraint by constraint. Each constraint becomes three: its left side and both its limits, free.
fn uses(problem: &Problem, x: &[f64]) -> Result<Vec<Vec<Option<f64>>>, EvaluationError> {
    let zero = Formula::Constant(0.0);
    let sides = problem.constraints.iter().flat_map(|constraint| {
        let [lower, upper] = constraint.right.sides().map(|side| side.unwrap_or(&zero));
        [&constraint.left, lower, upper].map(|side| free(constraint, side))
    });
    let constraints = sides.collect();
    let restated = Problem { constraints, objective: Formula::default(), ..problem.clone() };
    let too_dense =
        |error: crate::model::AssemblyError| EvaluationError::Invalid { term: "utilisation".into(), cause: error.to_string() };
    let model = assemble(&Arc::new(restated)).map_err(too_dense)?;
    let mut values = vec![0.0; model.meta().rows()];
    model.constraints(x, &mut values)?;
    let mut rest = values.as_slice();
    let of_constraint = |constraint: &Constraint| {
        let rows = constraint.scope.rows().min(rest.len() / 3);
        let (own, others) = rest.split_at(3 * rows);
        rest = others;
        let [has_lower, has_upper] = constraint.right.sides().map(|side| side.is_some());
        let equality = matches!(constraint.right, Limit::Equal(_));
        let used = |row: usize| {
            let [value, lower, upper] = [own[row], own[rows + row], own[2 * rows + row]];
            let below = if has_lower { share(-value, -lower) } else { None };
            let above = if has_upper { share(value, upper) } else { None };
            larger(below, above).filter(|_| !equality)
        };
        (0..rows).map(used).collect()
    };
    Ok(problem.constraints.iter().map(of_constraint).collect())
}

/// The same rows with one side alone and no limit.
fn free(constraint: &Constraint, side: &Formula) -> Constraint {
    let right = Limit::AtMost(Formula::Constant(f64::INFINITY));
    Constraint { left: side.clone(), right, ..constraint.clone() }
}

/// How much of `value <= limit` is used: 1 where they are equal, 0 where value is on the other side of 0 than a positive limit.
fn share(value: f64, limit: f64) -> Option<f64> {
    if limit > 0.0 {
        Some((value / limit).clamp(0.0, MOST))
    } else if limit < 0.0 {
        Some(if value < 0.0 { (limit / value).min(MOST) } else { MOST })
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_limits_from_either_side_and_of_either_sign() {
        assert_eq!(share(3.0, 4.0), Some(0.75));
        assert_eq!(share(-3.0, 4.0), Some(0.0));
        // value >= 4 at 5: four fifths are used; turned round as a limit from above.
        assert_eq!(share(-5.0, -4.0), Some(0.8));
        assert_eq!(share(1.0, -4.0), Some(MOST));
        assert_eq!(share(1.0, 0.0), None);
    }
}
