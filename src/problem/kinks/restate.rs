//! Takes kinks out of formulas: pieces where one kink decides, auxiliaries elsewhere.

mod auxiliaries;
mod pieces;
mod slopes;

use std::collections::HashMap;

use super::super::evaluate::Item;
use super::super::range::Ranges;
use super::{Auxiliary, is_kink};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::expression::structure::{Interval, Slope};
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};

/// Auxiliaries of one problem; beyond this kinks stay.
const MOST_AUXILIARIES: usize = 100_000;

/// Pieces of one kink; beyond this it stays.
const MOST_PIECES: usize = 100_000;

/// A problem while its kinks are taken out.
pub(super) struct Restating {
    pub problem: Problem,
    /// Constraints done.
    pub rows: Vec<Constraint>,
    ranges: Ranges,
    definition_has_kinks: Vec<bool>,
    /// As [`Restating::level`].
    definition_level: Vec<usize>,
    /// Definitions restated: the definition, its direction, and whether it is guarded.
    definitions: HashMap<(u32, bool, bool), Formula>,
    /// Pieces of definitions, by the same.
    definition_pieces: HashMap<(u32, bool, bool), Vec<Formula>>,
    /// Auxiliaries, each with the constraints that bound it.
    auxiliaries: Vec<(Auxiliary, Vec<Constraint>)>,
    /// The first auxiliary.
    first: usize,
    /// Items whose own names the formula at hand uses; ranges are taken over all of them.
    items: Vec<Item>,
    /// Whether auxiliaries may be added where the formula at hand stands.
    may_add: bool,
    /// Where it stands.
    place: Constraint,
}

impl Restating {
    pub fn new(problem: Problem) -> Self {
        Restating {
            first: problem.variables.lower.len(),
            rows: Vec::new(),
            ranges: Ranges::default(),
            definition_has_kinks: super::definitions_with_kinks(&problem),
            definition_level: vec![0; problem.definitions.len()],
            definitions: HashMap::new(),
            definition_pieces: HashMap::new(),
            auxiliaries: Vec::new(),
            items: vec![Item::None],
            may_add: true,
            place: Constraint {
                detail: Box::default(),
                name: String::new(),
                place: String::new(),
                text: String::new(),
                scope: Scope::Once,
                left: Formula::default(),
                right: Limit::AtMost(Formula::default()),
                asked: Vec::new(),
            },
            problem,
        }
    }

    /// Whether a kink stands anywhere in a formula.
    pub fn has_kinks(&self, formula: &Formula) -> bool {
        super::has_kinks(formula, &self.definition_has_kinks)
    }

    /// A formula that stands `place`, where a larger value is worse (`upward`) or a smaller one.
    pub fn restated(&mut self, formula: &Formula, upward: bool, place: &Constraint) -> Formula {
        self.place = place.clone();
        self.restate(formula, upward, false)
    }

    /// The formulas whose greatest (`upward`; else smallest) is the left side of a constraint.
    pub fn pieces_in(&mut self, formula: &Formula, upward: bool, place: &Constraint) -> Vec<Formula> {
        self.place = place.clone();
        self.pieces(formula, upward, false)
    }

    /// Pieces of a constraint that is repeated, where no auxiliary is needed for any of its items.
    pub fn pieces_of_items(&mut self, constraint: &Constraint, upward: bool) -> Option<Vec<Formula>> {
        self.items = (0..constraint.scope.rows()).map(|at| constraint.scope.item(at).0).collect();
        self.may_add = false;
        let pieces = self.pieces(&constraint.left, upward, false);
        (self.items, self.may_add) = (vec![Item::None], true);
        (!pieces.iter().any(|piece| self.has_kinks(piece))).then_some(pieces)
    }

    /// The problem with the auxiliaries and their constraints at the end.
    pub fn finish(mut self) -> Problem {
        for (mut auxiliary, constraints) in self.auxiliaries {
            auxiliary.constraints = self.rows.len()..self.rows.len() + constraints.len();
            self.rows.extend(constraints);
            self.problem.auxiliaries.push(auxiliary);
        }
        self.problem.constraints = self.rows;
        self.problem
    }

    /// The same formula with kinks replaced by auxiliaries where that is exact. `guarded`: an operation around it only rises or
    /// falls over its range, so that an auxiliary must stay there.
    fn restate(&mut self, formula: &Formula, upward: bool, guarded: bool) -> Formula {
        if !self.may_add || !self.has_kinks(formula) {
            return formula.clone();
        }
        match formula {
            Formula::Unary(Unary::Abs, inner) if self.sign(inner).is_some() => match self.sign(inner) {
                Some(true) => self.restate(inner, upward, guarded),
                _ => negative(self.restate(inner, !upward, guarded)),
            },
            kink if is_kink(kink) => self.auxiliary(kink, upward, guarded),
            Formula::Definition(d) => self.definition(*d, upward, guarded),
            Formula::Unary(_, inner) => with_operand(formula, 0, self.operand(formula, 0, inner, upward, guarded)),
            Formula::Binary(_, left, right) => {
                let first = self.operand(formula, 0, left, upward, guarded);
                let second = match formula {
                    Formula::Binary(Binary::Add | Binary::Multiply, ..) if left == right => first.clone(),
                    _ => self.operand(formula, 1, right, upward, guarded),
                };
                with_operand(&with_operand(formula, 0, first), 1, second)
            }
            Formula::Fold(fold, list) => {
                Formula::Fold(*fold, list.iter().map(|one| self.restate(one, upward, guarded)).collect())
            }
            Formula::Over { fold, collection, members, body } => match self.problem.instances(*collection, members, body) {
                Some(list) if list.len() <= MOST_PIECES => self.restate(&Formula::Fold(*fold, list), upward, guarded),
                _ => formula.clone(),
            },
            other => other.clone(),
        }
    }

    /// An operand restated, if the operation rises or falls in it.
    fn operand(&mut self, formula: &Formula, at: usize, inner: &Formula, upward: bool, guarded: bool) -> Formula {
        if !self.has_kinks(inner) {
            return inner.clone();
        }
        let everywhere = self.slope(formula, at, Interval::WHOLE);
        let found = match everywhere {
            // Nothing about the range is needed, nor of other operands that are restated too.
            known @ (Slope::Rising | Slope::Falling) if self.is_alone(formula, at) => (known, guarded),
            _ => match self.domain_slope(formula, upward) {
                Some(slope) => (slope, true),
                None => {
                    let range = self.range(inner);
                    (self.slope(formula, at, range), true)
                }
            },
        };
        match found {
            (Slope::Rising, guarded) => self.restate(inner, upward, guarded),
            (Slope::Falling, guarded) => self.restate(inner, !upward, guarded),
            (Slope::Mixed, _) => inner.clone(),
        }
    }

    /// What a kink takes the greatest (`upward`; else smallest) of; `None` where it is the other way round.
    fn arguments(&self, kink: &Formula, upward: bool) -> Option<Vec<Formula>> {
        let (fold, binary) = if upward { (Fold::Max, Binary::Max) } else { (Fold::Min, Binary::Min) };
        match kink {
            Formula::Unary(Unary::Abs, inner) if upward => Some(vec![(**inner).clone(), negative((**inner).clone())]),
            Formula::Binary(op, left, right) if *op == binary => Some(vec![(**left).clone(), (**right).clone()]),
            Formula::Fold(own, list) if *own == fold => Some(list.clone()),
            Formula::Over { fold: own, collection, members, body } if *own == fold => {
                self.problem.instances(*collection, members, body).filter(|list| list.len() <= MOST_PIECES)
            }
            _ => None,
        }
    }
}

/// The same operation with another operand.
fn with_operand(formula: &Formula, at: usize, operand: Formula) -> Formula {
    match formula {
        Formula::Unary(op, _) => Formula::Unary(*op, Box::new(operand)),
        Formula::Binary(op, left, right) if at == 0 && left == right => {
            Formula::Binary(*op, Box::new(operand.clone()), Box::new(operand))
        }
        Formula::Binary(op, _, right) if at == 0 => Formula::Binary(*op, Box::new(operand), right.clone()),
        Formula::Binary(op, left, _) => Formula::Binary(*op, left.clone(), Box::new(operand)),
        other => other.clone(),
    }
}

fn negative(formula: Formula) -> Formula {
    Formula::Unary(Unary::Negate, Box::new(formula))
}
