//! How far limits are used at a point.
//!
//! A row's use is value/limit where it is held from above and limit/value where it is held from below; both sides may vary
//! (`h <= 8*b`: h over 8b). For a rib it counts what is stated for it, for its group, for the sections at its ends, and what
//! names it. Equalities are always met, so they count nowhere, nor do limits of 0, which have no shares.

use std::sync::Arc;

use super::{Subject, place};
use crate::expression::ast::Collection;
use crate::expression::operators::Binary;
use crate::model::{EvaluationError, assemble_any};
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};
use crate::report::pictures::Load;
pub use crate::report::utilisation::Table;
use crate::report::utilisation::{Declared, Loaded, Use};

/// A use this large or larger is shown as this: limits whose value has the wrong sign have no share.
const MOST: f64 = 1e6;

/// The largest use of each rib's limits.
///
/// # Errors
/// A side of a row that has no value at this point.
pub fn loads(subject: &Subject, x: &[f64]) -> Result<Vec<Load>, EvaluationError> {
    let problem = subject.problem();
    let uses = uses(subject, x)?;
    let found = Found::of(problem, &uses);
    let load =
        |most: Most| Load { share: Some(most.share), limit: problem.constraints[uses[most.at].used.constraint].name.clone() };
    Ok((0..problem.ribs.from.len()).map(|rib| found.of_rib(problem, rib).map(load).unwrap_or_default()).collect())
}

/// All limits with their values, and the sections and ribs by what uses them most.
///
/// # Errors
/// A side of a row that has no value at this point.
pub fn table(subject: &Subject, x: &[f64]) -> Result<Table, EvaluationError> {
    let problem = subject.problem();
    let uses = uses(subject, x)?;
    let found = Found::of(problem, &uses);
    let declared = |own: &Constraint| Declared {
        name: own.name.clone(),
        detail: own.detail.to_string(),
        of: of(&own.scope),
        place: place::of(problem, own),
    };
    let constraints: Vec<Declared> = problem.constraints.iter().map(declared).collect();
    let rows = problem.constraints.iter().enumerate();
    let rows = rows.flat_map(|(number, own)| std::iter::repeat_n(number as u32, own.scope.rows())).collect();
    let uses = uses.into_iter().map(|row| row.used).collect();
    let mut table = Table { constraints, uses, items: Vec::new(), ribs: of_ribs(problem, &found), rows };
    let all = [("section", Collection::Sections, &found.sections), ("rib", Collection::Ribs, &found.ribs)];
    for (of, collection, list) in all {
        for (index, most) in list.iter().enumerate() {
            let Some(Most { share, at }) = *most else { continue };
            table.items.push(Loaded { of, name: problem.item_name(collection, index as u32).into(), at, share });
        }
    }
    table.items.sort_by(|a, b| b.share.total_cmp(&a.share));
    Ok(table)
}

/// Every rib with the largest use of its own limits and those of its ends.
fn of_ribs(problem: &Problem, found: &Found) -> Vec<(String, Option<(usize, f64)>)> {
    let most = |rib: usize| found.of_rib(problem, rib).map(|most| (most.at, most.share));
    problem.ribs.names.iter().enumerate().map(|(rib, name)| (name.to_owned(), most(rib))).collect()
}

fn of(scope: &Scope) -> &'static str {
    match scope {
        Scope::Once => "",
        Scope::Sections(_) => "section",
        Scope::Ribs(_) => "rib",
        Scope::Nodes(_) => "node",
        Scope::RibGroups(_) | Scope::SectionGroups(_) | Scope::NodeGroups(_) => "group",
    }
}

/// A share, and the use it is of.
#[derive(Debug, Clone, Copy)]
struct Most {
    share: f64,
    at: usize,
}

/// Shares this near to one another are one: of limits that are met together the first one in the file is named, not the one that
/// rounding prefers.
const TIE: f64 = 1e-6;

fn larger(a: Option<Most>, b: Option<Most>) -> Option<Most> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.share > a.share * (1.0 + TIE) { b } else { a }),
        (one, other) => one.or(other),
    }
}

/// The largest use of every section and rib.
struct Found {
    sections: Vec<Option<Most>>,
    ribs: Vec<Option<Most>>,
}

impl Found {
    fn of(problem: &Problem, uses: &[Row]) -> Found {
        let (sections, ribs) = (problem.sections.names.len(), problem.ribs.names.len());
        let mut found = Found { sections: vec![None; sections], ribs: vec![None; ribs] };
        let mut first = 0;
        for (number, constraint) in problem.constraints.iter().enumerate() {
            let count = uses[first..].iter().take_while(|row| row.used.constraint == number).count();
            let rows = first..first + count;
            first += count;
            let shares = rows.filter_map(|at| Some((at, uses[at].row, Most { share: uses[at].used.share?, at })));
            let shares: Vec<(usize, usize, Most)> = shares.collect();
            let largest = shares.iter().map(|(.., most)| *most).map(Some).fold(None, larger);
            let named = constraint.named(problem);
            named.sections.iter().for_each(|&s| found.note(Collection::Sections, s, largest));
            named.ribs.iter().for_each(|&r| found.note(Collection::Ribs, r, largest));
            for (_, row, most) in shares {
                let (collection, items) = constraint.own(row);
                items.iter().for_each(|&item| found.note(collection, item, Some(most)));
            }
        }
        found
    }

    /// A rib's own largest use, or that of its ends.
    fn of_rib(&self, problem: &Problem, rib: usize) -> Option<Most> {
        let section = |s: Option<&u32>| self.sections.get(*s? as usize).copied().flatten();
        let ends = larger(section(problem.ribs.from.get(rib)), section(problem.ribs.to.get(rib)));
        larger(self.ribs.get(rib).copied().flatten(), ends)
    }

    fn note(&mut self, collection: Collection, item: u32, used: Option<Most>) {
        let all = match collection {
            Collection::Sections => &mut self.sections,
            Collection::Ribs => &mut self.ribs,
            Collection::Nodes => return,
        };
        if let Some(known) = all.get_mut(item as usize) {
            *known = larger(*known, used);
        }
    }
}

/// A limit of row number `row` of its constraint.
struct Row {
    row: usize,
    used: Use,
}

/// Every limit, constraint by constraint.
fn uses(subject: &Subject, x: &[f64]) -> Result<Vec<Row>, EvaluationError> {
    let (problem, model) = (subject.problem(), subject.shown());
    let meta = model.meta();
    let mut values = vec![0.0; meta.rows()];
    model.constraints(x, &mut values)?;
    let sides = both_sides(problem, x)?;
    let (mut first, mut varying, mut all) = (0, 0, Vec::with_capacity(values.len()));
    for (number, constraint) in problem.constraints.iter().enumerate() {
        let rows = constraint.scope.rows().min(values.len() - first);
        let both = varies(constraint).is_some();
        for row in 0..rows {
            let i = first + row;
            let equality = matches!(constraint.right, Limit::Equal(_));
            let mut push = |value: f64, from_above: bool, limit: f64| {
                let share = if from_above { share(value, limit) } else { share(-value, -limit) }.filter(|_| !equality);
                let item = item(problem, constraint, row);
                all.push(Row { row, used: Use { constraint: number, item, value, from_above, limit, share } });
            };
            let (lower, upper) = (meta.row_lower[i], meta.row_upper[i]);
            match both.then(|| (sides[varying + row], sides[varying + rows + row])) {
                Some((left, right)) => push(left, upper.is_finite(), right),
                None => {
                    if upper.is_finite() {
                        push(values[i], true, upper);
                    }
                    if lower.is_finite() && !equality {
                        push(values[i], false, lower);
                    }
                }
            }
        }
        first += rows;
        varying += if both { 2 * rows } else { 0 };
    }
    Ok(all)
}

/// The item in the row's name.
fn item(problem: &Problem, constraint: &Constraint, row: usize) -> String {
    match &constraint.scope {
        Scope::Once => String::new(),
        Scope::RibGroups(groups) | Scope::SectionGroups(groups) | Scope::NodeGroups(groups) => {
            groups.get(row).map_or("", |group| &group.0).into()
        }
        Scope::Sections(list) | Scope::Ribs(list) | Scope::Nodes(list) => {
            let (collection, _) = constraint.own(row);
            list.get(row).map_or("", |&index| problem.item_name(collection, index)).into()
        }
    }
}

/// The two sides of a row that is held as their difference against 0.
fn varies(constraint: &Constraint) -> Option<[&Formula; 2]> {
    let against_zero = constraint.right.formulas().all(|limit| limit.as_constant() == Some(0.0));
    match &constraint.left {
        Formula::Binary(Binary::Subtract, left, right) if against_zero => Some([left, right]),
        _ => None,
    }
}

/// Values of both sides of such rows, left sides of a constraint before its right sides.
fn both_sides(problem: &Problem, x: &[f64]) -> Result<Vec<f64>, EvaluationError> {
    let free = |constraint: &Constraint, side: &Formula| {
        let right = Limit::AtMost(Formula::Constant(f64::INFINITY));
        Constraint { left: side.clone(), right, ..constraint.clone() }
    };
    let sides = problem.constraints.iter().filter_map(|constraint| Some(varies(constraint)?.map(|side| free(constraint, side))));
    let constraints: Vec<Constraint> = sides.flatten().collect();
    if constraints.is_empty() {
        return Ok(Vec::new());
    }
    let restated = Problem { constraints, objective: Formula::default(), ..problem.clone() };
    let too_dense =
        |error: crate::model::AssemblyError| EvaluationError::Invalid { term: "utilisation".into(), cause: error.to_string() };
    let assembled = assemble_any(&Arc::new(restated)).map_err(too_dense)?;
    let model = assembled.model();
    let mut values = vec![0.0; model.meta().rows()];
    model.constraints(x, &mut values)?;
    Ok(values)
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
