//! A formula as the greatest or smallest of several without the kink.

use super::super::is_kink;
use super::{MOST_PIECES, Restating, negative, with_operand};
use crate::expression::operators::{Fold, Unary};
use crate::expression::structure::{Interval, Slope};
use crate::problem::Formula;

impl Restating {
    /// The formulas whose greatest (`upward`; else smallest) is `formula`; one where no kink decides that. `guarded` as for
    /// [`Restating::restate`].
    pub(super) fn pieces(&mut self, formula: &Formula, upward: bool, guarded: bool) -> Vec<Formula> {
        if !self.has_kinks(formula) {
            return vec![formula.clone()];
        }
        match formula {
            Formula::Unary(Unary::Abs, inner) => match self.sign(inner) {
                Some(true) => self.pieces(inner, upward, guarded),
                Some(false) => negated(self.pieces(inner, !upward, guarded)),
                None if upward => {
                    let mut both = self.pieces(inner, true, guarded);
                    both.extend(negated(self.pieces(inner, false, guarded)));
                    both
                }
                None => vec![formula.clone()],
            },
            kink if is_kink(kink) => match self.arguments(kink, upward) {
                Some(list) => self.pieces_of_all(kink, &list, upward, guarded),
                None => vec![formula.clone()],
            },
            Formula::Definition(d) if self.decides(&self.problem.definitions[*d as usize].1) => {
                self.pieces_of_definition(*d, upward, guarded)
            }
            Formula::Unary(_, inner) => self.carried(formula, 0, inner, upward, guarded),
            Formula::Binary(_, left, right) => match (self.has_kinks(left), self.has_kinks(right)) {
                (true, false) => self.carried(formula, 0, left, upward, guarded),
                (false, true) => self.carried(formula, 1, right, upward, guarded),
                _ => vec![self.restate(formula, upward, guarded)],
            },
            Formula::Fold(Fold::Sum, list) if list.iter().filter(|one| self.has_kinks(one)).count() == 1 => {
                self.carried_by_sum(list, upward, guarded)
            }
            other => vec![self.restate(other, upward, guarded)],
        }
    }

    /// The pieces of all arguments of a kink; the kink itself where they are too many. An argument that stands there twice decides
    /// nothing the second time.
    pub(super) fn pieces_of_all(&mut self, kink: &Formula, list: &[Formula], upward: bool, guarded: bool) -> Vec<Formula> {
        let mut all = Vec::new();
        for (at, one) in list.iter().enumerate() {
            if at > 0 && list[at - 1] == *one {
                continue;
            }
            all.extend(self.pieces(one, upward, guarded));
            if all.len() > MOST_PIECES {
                return vec![kink.clone()];
            }
        }
        all
    }

    /// Definitions may double sixty times: each is opened once.
    pub(super) fn pieces_of_definition(&mut self, d: u32, upward: bool, guarded: bool) -> Vec<Formula> {
        // Ranges, and so pieces, depend on the items a formula stands for.
        let key = (d, upward, guarded);
        if self.items.len() == 1
            && let Some(known) = self.definition_pieces.get(&key)
        {
            return known.clone();
        }
        let opened = self.problem.definitions[d as usize].1.clone();
        let mut pieces = self.pieces(&opened, upward, guarded);
        if pieces == [opened] {
            pieces = vec![Formula::Definition(d)];
        }
        if self.items.len() == 1 {
            self.definition_pieces.insert(key, pieces.clone());
        }
        pieces
    }

    /// Pieces of an operation's only operand with kinks, carried through the operation where it rises or falls over all of them.
    pub(super) fn carried(&mut self, formula: &Formula, at: usize, inner: &Formula, upward: bool, guarded: bool) -> Vec<Formula> {
        let (slope, guarded) = match self.slope(formula, at, Interval::WHOLE) {
            Slope::Mixed => {
                let spread = self.spread(inner, upward);
                (self.slope(formula, at, spread), true)
            }
            known => (known, guarded),
        };
        let inner_upward = match slope {
            Slope::Rising => upward,
            Slope::Falling => !upward,
            Slope::Mixed => return vec![self.restate(formula, upward, guarded)],
        };
        let pieces = self.pieces(inner, inner_upward, guarded);
        pieces.into_iter().map(|piece| with_operand(formula, at, piece)).collect()
    }

    pub(super) fn carried_by_sum(&mut self, list: &[Formula], upward: bool, guarded: bool) -> Vec<Formula> {
        let Some(at) = list.iter().position(|one| self.has_kinks(one)) else {
            return vec![Formula::Fold(Fold::Sum, list.to_vec())];
        };
        let with = |piece: Formula| {
            let mut list = list.to_vec();
            list[at] = piece;
            Formula::Fold(Fold::Sum, list)
        };
        self.pieces(&list[at], upward, guarded).into_iter().map(with).collect()
    }

    /// Everything the pieces of a formula range over, whichever of them decides.
    pub(super) fn spread(&mut self, formula: &Formula, upward: bool) -> Interval {
        let opened = match formula {
            Formula::Definition(d) => self.problem.definitions[*d as usize].1.clone(),
            other => other.clone(),
        };
        match self.arguments(&opened, upward).or_else(|| self.arguments(&opened, !upward)) {
            Some(list) => list.iter().map(|one| self.spread(one, upward)).reduce(Interval::union).unwrap_or(Interval::WHOLE),
            None => self.range(formula),
        }
    }

    /// Whether a kink stands outermost, or inside one operation only, so that a definition is worth opening.
    pub(super) fn decides(&self, formula: &Formula) -> bool {
        is_kink(formula) || matches!(formula, Formula::Unary(_, inner) if is_kink(inner))
    }
}

pub(super) fn negated(list: Vec<Formula>) -> Vec<Formula> {
    list.into_iter().map(negative).collect()
}
