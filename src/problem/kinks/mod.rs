//! Rows and objectives with min, max or abs, restated without their kinks where that is exact.
//!
//! Two means, both exact (docs/expressions-and-classes.md):
//! - *Pieces.* `max(a, b) <= c` is `a <= c` and `b <= c`; `abs(a) <= c` is `a <= c` and `-a <= c`; `min(a, b) >= c` likewise.
//! - *Bounds.* Where a larger value of `max(a, b)` can only make things worse, a variable t with `a <= t`, `b <= t` takes its
//!   place: the monotone composition rule. `min(a, b)`, where a smaller value makes things worse, becomes a t below a and b.
//!
//! A bound is an auxiliary: it follows from the user's variables ([`crate::model::Model::complete`]) and no report shows it.

mod restate;

use std::ops::Range;

use super::formula::Formula;
use super::{Constraint, Limit, Problem, Scope, Sense};
use crate::expression::operators::{Binary, Fold, Unary};
use restate::Restating;

/// Items up to which a repeated constraint is written out where its kinks need variables of their own.
const MOST_ITEMS: usize = 10_000;

/// A variable in the place of a minimum, maximum or absolute value.
#[derive(Debug, Clone, PartialEq)]
pub struct Auxiliary {
    /// What it stands for.
    pub formula: Formula,
    /// The constraints that bound it by its pieces: piece − t ≤ 0, or ≥ 0 for a minimum.
    pub constraints: Range<usize>,
    /// Whether it lies above its pieces.
    pub above: bool,
    /// It may depend on auxiliaries of smaller levels only.
    pub level: usize,
}

impl Problem {
    /// The same problem with as few kinks as can be. Auxiliary variables and their constraints come last.
    pub fn without_kinks(self) -> Problem {
        let mut restating = Restating::new(self);
        let upward = restating.problem.sense == Sense::Minimize;
        let objective = std::mem::take(&mut restating.problem.objective);
        let place = Constraint {
            detail: Box::default(),
            name: "the objective".into(),
            place: "the objective".into(),
            text: restating.problem.objective_text.clone(),
            scope: Scope::Once,
            left: Formula::default(),
            right: Limit::AtMost(Formula::default()),
            asked: Vec::new(),
        };
        restating.problem.objective = restating.restated(&objective, upward, &place);
        for constraint in std::mem::take(&mut restating.problem.constraints) {
            let split = restating.constraint(constraint);
            restating.rows.extend(split);
        }
        restating.finish()
    }

    /// The problem as it was written, as far as values go: every auxiliary replaced by what it stands for. Rows keep their order.
    pub fn with_kinks(&self) -> Problem {
        let Some(first) = self.auxiliaries.first() else { return self.clone() };
        let mut written = self.clone();
        let count = self.variables.lower.len() - self.auxiliaries.len();
        written.variables.truncate(count);
        written.constraints.truncate(first.constraints.start);
        written.auxiliaries.clear();
        written.objective = self.written(&self.objective, count);
        for (_, formula) in &mut written.definitions {
            *formula = self.written(formula, count);
        }
        for constraint in &mut written.constraints {
            constraint.left = self.written(&constraint.left, count);
        }
        written
    }

    /// What has a min, max or abs: the objective, or constraints by name.
    pub fn kinks(&self) -> Vec<String> {
        let known = definitions_with_kinks(self);
        let bent = |formula: &Formula| has_kinks(formula, &known);
        let objective = bent(&self.objective).then(|| "the objective".to_owned());
        let bent = |row: &&Constraint| bent(&row.left) || row.right.formulas().any(bent);
        let rows = self.constraints.iter().filter(bent).map(|row| format!("`{}`", row.name));
        objective.into_iter().chain(rows).collect()
    }

    /// A formula with auxiliaries (variables from `first` on) replaced by what they stand for.
    fn written(&self, formula: &Formula, first: usize) -> Formula {
        let go = |inner: &Formula| self.written(inner, first);
        match formula {
            Formula::Variable(j) if *j as usize >= first => self.auxiliaries[*j as usize - first].formula.clone(),
            other => other.with_children(go),
        }
    }
}

impl Restating {
    /// A constraint with as few kinks as can be, or as several.
    fn constraint(&mut self, constraint: Constraint) -> Vec<Constraint> {
        let upward = match constraint.right {
            Limit::AtMost(_) => true,
            Limit::AtLeast(_) => false,
            // An equality holds a kink from both sides, and a range mostly does: at most one of them is convex use.
            Limit::Equal(_) | Limit::Between(..) => return vec![constraint],
        };
        if !self.has_kinks(&constraint.left) {
            return vec![constraint];
        }
        if matches!(constraint.scope, Scope::Once) {
            let pieces = self.pieces_in(&constraint.left, upward, &constraint);
            return named(&constraint, pieces);
        }
        if let Some(pieces) = self.pieces_of_items(&constraint, upward) {
            return named(&constraint, pieces);
        }
        if constraint.scope.rows() > MOST_ITEMS {
            return vec![constraint];
        }
        let single: Option<Vec<Constraint>> =
            (0..constraint.scope.rows()).map(|at| self.problem.one_row(&constraint, at)).collect();
        let Some(single) = single else { return vec![constraint] };
        single
            .into_iter()
            .flat_map(|one| {
                let pieces = self.pieces_in(&one.left, upward, &one);
                named(&one, pieces)
            })
            .collect()
    }
}

/// One constraint per piece, numbered where there are several.
fn named(constraint: &Constraint, pieces: Vec<Formula>) -> Vec<Constraint> {
    let several = pieces.len() > 1;
    let name = |number: usize| match several {
        true => format!("{}#{}", constraint.name, number + 1),
        false => constraint.name.clone(),
    };
    let one = |(number, left)| Constraint { name: name(number), left, ..constraint.clone() };
    pieces.into_iter().enumerate().map(one).collect()
}

/// Which definitions have a kink, of their own or by others they use.
fn definitions_with_kinks(problem: &Problem) -> Vec<bool> {
    let mut known = vec![false; problem.definitions.len()];
    // They stand in any order and are free of cycles: at most as many rounds as definitions settle them.
    loop {
        let next: Vec<bool> = problem.definitions.iter().map(|(_, formula)| has_kinks(formula, &known)).collect();
        if next == known {
            return known;
        }
        known = next;
    }
}

/// Whether a kink stands anywhere in a formula, given which definitions have one.
fn has_kinks(formula: &Formula, definitions: &[bool]) -> bool {
    match formula {
        _ if is_kink(formula) => true,
        Formula::Definition(d) => definitions.get(*d as usize).copied().unwrap_or(false),
        other => other.children().any(|inner| has_kinks(inner, definitions)),
    }
}

/// Whether an operation has a kink: of absolute values and of the greatest, or smallest, of several.
fn is_kink(formula: &Formula) -> bool {
    matches!(
        formula,
        Formula::Unary(Unary::Abs, _)
            | Formula::Binary(Binary::Min | Binary::Max, ..)
            | Formula::Fold(Fold::Min | Fold::Max, _)
            | Formula::Over { fold: Fold::Min | Fold::Max, .. }
    )
}

#[cfg(test)]
mod tests;
