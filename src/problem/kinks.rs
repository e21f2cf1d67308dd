//! Rows and objectives with min, max or abs, restated without their kinks where that is exact (convex use).
//!
//! `max(a, b) <= c` is `a <= c` and `b <= c`; `abs(a) <= c` is `a <= c` and `-a <= c`; `min(a, b) >= c` likewise.
//! An objective `minimize = "max(a, b)"` becomes the least bound above both: one more variable and a row for each.

use super::evaluate::{Evaluation, Item};
use super::formula::Formula;
use super::{Constraint, Limit, Origin, Problem, Scope, Sense};
use crate::expression::operators::{Binary, Fold, Unary};

/// Pieces a row may fall into; beyond this its kinks stay.
const MOST_PIECES: usize = 256;

/// Definitions looked into one inside another, in search of kinks.
const DEFINITIONS: usize = 16;

/// The variable that bounds an objective of pieces.
pub const OBJECTIVE_BOUND: &str = "objective_bound";

impl Problem {
    /// The same problem with as few kinks as can be.
    pub fn without_kinks(mut self) -> Problem {
        self.split_objective();
        self.constraints = std::mem::take(&mut self.constraints).into_iter().flat_map(split).collect();
        self
    }

    /// What keeps a min, max or abs: the objective, or constraints by name.
    pub fn kinks(&self) -> Vec<String> {
        let objective = self.bends(&self.objective, 0).then(|| "the objective".to_owned());
        let bent = |row: &&Constraint| self.bends(&row.left, 0) || row.right.formulas().any(|formula| self.bends(formula, 0));
        let rows = self.constraints.iter().filter(bent).map(|row| format!("`{}`", row.name));
        objective.into_iter().chain(rows).collect()
    }

    /// Whether there is a kink in a formula or the definitions it uses.
    fn bends(&self, formula: &Formula, depth: usize) -> bool {
        let go = |formula: &Formula| self.bends(formula, depth);
        match formula {
            Formula::Unary(Unary::Abs, _) | Formula::Binary(Binary::Min | Binary::Max, ..) => true,
            Formula::Fold(Fold::Min | Fold::Max, _) | Formula::Over { fold: Fold::Min | Fold::Max, .. } => true,
            Formula::Unary(_, inner) | Formula::Profile(_, inner) => go(inner),
            Formula::Binary(_, left, right) => go(left) || go(right),
            Formula::Fold(_, list) => list.iter().any(go),
            Formula::Over { body, .. } => go(body),
            Formula::Definition(d) if depth < DEFINITIONS => {
                self.definitions.get(*d as usize).is_some_and(|(_, inner)| self.bends(inner, depth + 1))
            }
            _ => false,
        }
    }

    fn split_objective(&mut self) {
        let upward = self.sense == Sense::Minimize;
        let Some(pieces) = pieces(&self.objective, upward).filter(|pieces| pieces.len() > 1) else { return };
        let Some(start) = self.objective_start() else { return };
        let bound = self.variables.lower.len() as u32;
        self.variables.origin.push(Origin::Scalar(self.variables.declared.len() as u32));
        self.variables.declared.push(OBJECTIVE_BOUND.into());
        self.variables.lower.push(f64::NEG_INFINITY);
        self.variables.upper.push(f64::INFINITY);
        self.variables.start.push(start);
        let zero = Formula::Constant(0.0);
        for (number, piece) in pieces.into_iter().enumerate() {
            let left = Formula::Binary(Binary::Subtract, Box::new(piece), Box::new(Formula::Variable(bound)));
            let right = if upward { Limit::AtMost(zero.clone()) } else { Limit::AtLeast(zero.clone()) };
            self.constraints.push(Constraint {
                name: format!("objective#{}", number + 1),
                place: "the objective".into(),
                text: self.objective_text.clone(),
                scope: Scope::Once,
                left,
                right,
            });
        }
        self.objective = Formula::Variable(bound);
    }

    /// The objective at the start, if it has a value there.
    fn objective_start(&self) -> Option<f64> {
        let value = Evaluation::at_start(self).value(&self.objective, Item::None);
        value.or(Some(0.0)).filter(|value| value.is_finite())
    }
}

/// A constraint as one without kinks, or as several.
fn split(constraint: Constraint) -> Vec<Constraint> {
    let upward = match constraint.right {
        Limit::AtMost(_) => true,
        Limit::AtLeast(_) => false,
        // −c ≤ |a| ≤ c and the like are rare; both sides of a kink cannot be convex at once.
        Limit::Equal(_) | Limit::Between(..) => return vec![constraint],
    };
    match pieces(&constraint.left, upward) {
        Some(pieces) if pieces.len() > 1 => pieces
            .into_iter()
            .enumerate()
            .map(|(number, left)| Constraint { name: format!("{}#{}", constraint.name, number + 1), left, ..constraint.clone() })
            .collect(),
        _ => vec![constraint],
    }
}

/// The formulas whose maximum (`upward`; else minimum) the formula is; one where it has no kink to split.
/// `None` where there would be too many.
fn pieces(formula: &Formula, upward: bool) -> Option<Vec<Formula>> {
    let unsplit = || Some(vec![formula.clone()]);
    match formula {
        Formula::Unary(Unary::Abs, inner) if upward => {
            let mut all = pieces(inner, true)?;
            all.extend(pieces(inner, false)?.into_iter().map(negated));
            limited(all)
        }
        Formula::Fold(Fold::Max, list) if upward => limited(all_pieces(list, true)?),
        Formula::Fold(Fold::Min, list) if !upward => limited(all_pieces(list, false)?),
        Formula::Binary(Binary::Max, left, right) if upward => limited(both_pieces(left, right, true)?),
        Formula::Binary(Binary::Min, left, right) if !upward => limited(both_pieces(left, right, false)?),
        // These have a value everywhere and grow throughout: the greatest argument gives the greatest value.
        Formula::Unary(op @ (Unary::Exp | Unary::Atan | Unary::Sinh | Unary::Tanh), inner) => {
            let grown = |piece| Formula::Unary(*op, Box::new(piece));
            Some(pieces(inner, upward)?.into_iter().map(grown).collect())
        }
        Formula::Unary(Unary::Negate, inner) => Some(pieces(inner, !upward)?.into_iter().map(negated).collect()),
        Formula::Binary(Binary::Add, left, right) => combined(Binary::Add, pieces(left, upward)?, pieces(right, upward)?),
        Formula::Binary(Binary::Subtract, left, right) => {
            combined(Binary::Subtract, pieces(left, upward)?, pieces(right, !upward)?)
        }
        Formula::Binary(Binary::Multiply, factor, other) | Formula::Binary(Binary::Multiply, other, factor)
            if matches!(**factor, Formula::Constant(_)) =>
        {
            scaled(Binary::Multiply, other, factor, upward)
        }
        Formula::Binary(Binary::Divide, other, factor) if matches!(**factor, Formula::Constant(_)) => {
            scaled(Binary::Divide, other, factor, upward)
        }
        Formula::Fold(Fold::Sum, list) if list.len() <= MOST_PIECES => sum_of_pieces(list, upward),
        _ => unsplit(),
    }
}

fn all_pieces(list: &[Formula], upward: bool) -> Option<Vec<Formula>> {
    let nested: Option<Vec<Vec<Formula>>> = list.iter().map(|one| pieces(one, upward)).collect();
    Some(nested?.into_iter().flatten().collect())
}

fn both_pieces(left: &Formula, right: &Formula, upward: bool) -> Option<Vec<Formula>> {
    let mut all = pieces(left, upward)?;
    all.extend(pieces(right, upward)?);
    Some(all)
}

fn limited(pieces: Vec<Formula>) -> Option<Vec<Formula>> {
    (pieces.len() <= MOST_PIECES).then_some(pieces)
}

fn negated(formula: Formula) -> Formula {
    Formula::Unary(Unary::Negate, Box::new(formula))
}

/// Every piece of the left joined with every piece of the right.
fn combined(op: Binary, left: Vec<Formula>, right: Vec<Formula>) -> Option<Vec<Formula>> {
    if left.len() * right.len() > MOST_PIECES {
        return None;
    }
    let join = |a: &Formula, b: &Formula| Formula::Binary(op, Box::new(a.clone()), Box::new(b.clone()));
    Some(left.iter().flat_map(|a| right.iter().map(move |b| join(a, b))).collect())
}

fn scaled(op: Binary, formula: &Formula, factor: &Formula, upward: bool) -> Option<Vec<Formula>> {
    let Formula::Constant(value) = factor else { return Some(vec![formula.clone()]) };
    let pieces = pieces(formula, upward == (*value >= 0.0))?;
    Some(pieces.into_iter().map(|piece| Formula::Binary(op, Box::new(piece), Box::new(factor.clone()))).collect())
}

fn sum_of_pieces(list: &[Formula], upward: bool) -> Option<Vec<Formula>> {
    let nested: Option<Vec<Vec<Formula>>> = list.iter().map(|one| pieces(one, upward)).collect();
    let nested = nested?;
    if nested.iter().all(|one| one.len() == 1) {
        return Some(vec![Formula::Fold(Fold::Sum, list.to_vec())]);
    }
    nested.into_iter().try_fold(vec![Formula::Constant(0.0)], |sums, one| combined(Binary::Add, sums, one))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(index: u32) -> Box<Formula> {
        Box::new(Formula::Variable(index))
    }

    fn once(left: Formula, right: Limit) -> Vec<Constraint> {
        split(Constraint { name: "c".into(), place: String::new(), text: String::new(), scope: Scope::Once, left, right })
    }

    #[test]
    fn convex_kinks_become_rows() {
        let abs = || Formula::Unary(Unary::Abs, variable(0));
        let limit = || Formula::Constant(1.0);
        let rows = once(abs(), Limit::AtMost(limit()));
        assert_eq!(rows.iter().map(|row| row.name.as_str()).collect::<Vec<_>>(), ["c#1", "c#2"]);
        assert_eq!(rows[1].left, Formula::Unary(Unary::Negate, variable(0)));
        assert_eq!(once(abs(), Limit::AtLeast(limit())).len(), 1, "not convex: the kink stays");
        let sum =
            Formula::Binary(Binary::Add, Box::new(abs()), Box::new(Formula::Fold(Fold::Max, vec![*variable(1), *variable(2)])));
        assert_eq!(once(sum.clone(), Limit::AtMost(limit())).len(), 4);
        assert_eq!(once(negated(sum), Limit::AtLeast(limit())).len(), 4);
        let growing = |inner| Formula::Unary(Unary::Exp, Box::new(inner));
        assert_eq!(once(growing(abs()), Limit::AtMost(limit()))[0].left, growing(*variable(0)));
    }

    #[test]
    fn a_minimised_maximum_becomes_a_bound_above_its_pieces() {
        let mut problem = Problem { objective: Formula::Fold(Fold::Max, vec![*variable(0), *variable(1)]), ..Problem::default() };
        problem.variables.origin = vec![Origin::Scalar(0), Origin::Scalar(1)];
        problem.variables.declared = vec!["a".into(), "b".into()];
        (problem.variables.lower, problem.variables.upper) = (vec![0.0; 2], vec![9.0; 2]);
        problem.variables.start = vec![2.0, 3.0];
        let problem = problem.without_kinks();
        assert_eq!((problem.constraints.len(), problem.variables.start[2]), (2, 3.0));
        assert_eq!(problem.variable_name(2), OBJECTIVE_BOUND);
    }
}
