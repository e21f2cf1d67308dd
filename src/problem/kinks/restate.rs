//! Takes kinks out of formulas: pieces where one kink decides, auxiliaries elsewhere.

use std::collections::HashMap;

use super::super::evaluate::Item;
use super::super::range::Ranges;
use super::{Auxiliary, is_kink};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::expression::structure::{Interval, Slope};
use crate::problem::{Constraint, Formula, Limit, Origin, Problem, Scope};

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

    fn range(&mut self, formula: &Formula) -> Interval {
        let items = std::mem::take(&mut self.items);
        let range = items.iter().map(|&item| self.ranges.of(&self.problem, formula, item)).reduce(Interval::union);
        self.items = items;
        range.unwrap_or(Interval::WHOLE)
    }

    /// The formulas whose greatest (`upward`; else smallest) is `formula`; one where no kink decides that. `guarded` as for
    /// [`Restating::restate`].
    fn pieces(&mut self, formula: &Formula, upward: bool, guarded: bool) -> Vec<Formula> {
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
    fn pieces_of_all(&mut self, kink: &Formula, list: &[Formula], upward: bool, guarded: bool) -> Vec<Formula> {
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
    fn pieces_of_definition(&mut self, d: u32, upward: bool, guarded: bool) -> Vec<Formula> {
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
    fn carried(&mut self, formula: &Formula, at: usize, inner: &Formula, upward: bool, guarded: bool) -> Vec<Formula> {
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

    fn carried_by_sum(&mut self, list: &[Formula], upward: bool, guarded: bool) -> Vec<Formula> {
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
    fn spread(&mut self, formula: &Formula, upward: bool) -> Interval {
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
    fn decides(&self, formula: &Formula) -> bool {
        is_kink(formula) || matches!(formula, Formula::Unary(_, inner) if is_kink(inner))
    }

    /// How an operation changes in the operand at a place, its range given.
    fn slope(&mut self, formula: &Formula, at: usize, range: Interval) -> Slope {
        match formula {
            Formula::Unary(op, _) => Slope::of_unary(*op, range),
            Formula::Binary(op, left, right) if at == 0 => {
                let other = self.range(right);
                Slope::in_left(*op, range, if left == right { range } else { other })
            }
            Formula::Binary(op, left, _) => Slope::in_right(*op, self.range(left), range),
            _ => Slope::Mixed,
        }
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

    /// Whether the slope in an operand depends on nothing else that is restated.
    fn is_alone(&self, formula: &Formula, at: usize) -> bool {
        match formula {
            Formula::Unary(..) | Formula::Binary(Binary::Add | Binary::Subtract, ..) => true,
            Formula::Binary(_, left, right) => !self.has_kinks(if at == 0 { right } else { left }),
            _ => false,
        }
    }

    /// Functions that rise or fall throughout a domain bounded from below: a bound below the argument that lies in the domain
    /// keeps the argument there too, whatever its range.
    fn domain_slope(&mut self, formula: &Formula, upward: bool) -> Option<Slope> {
        match formula {
            Formula::Unary(Unary::Sqrt | Unary::Log | Unary::Log10, _) if !upward => Some(Slope::Rising),
            Formula::Binary(Binary::Power, _, exponent) => match exponent.as_constant() {
                Some(p) if p.fract() != 0.0 && p > 0.0 && !upward => Some(Slope::Rising),
                Some(p) if p.fract() != 0.0 && p < 0.0 && upward => Some(Slope::Falling),
                _ => None,
            },
            _ => None,
        }
    }

    fn definition(&mut self, d: u32, upward: bool, guarded: bool) -> Formula {
        let key = (d, upward, guarded);
        if let Some(known) = self.definitions.get(&key) {
            return known.clone();
        }
        let (name, opened) = self.problem.definitions[d as usize].clone();
        let restated = self.restate(&opened, upward, guarded);
        let known = if restated == opened {
            Formula::Definition(d)
        } else {
            self.definition_has_kinks.push(self.has_kinks(&restated));
            self.definition_level.push(self.level(&restated));
            self.problem.definitions.push((name, restated));
            Formula::Definition((self.problem.definitions.len() - 1) as u32)
        };
        self.definitions.insert(key, known.clone());
        known
    }

    /// A variable in the place of a kink.
    fn auxiliary(&mut self, kink: &Formula, upward: bool, guarded: bool) -> Formula {
        if self.arguments(kink, upward).is_none() || self.auxiliaries.len() >= MOST_AUXILIARIES {
            return kink.clone();
        }
        let mut pieces = self.pieces(kink, upward, false);
        match pieces.len() {
            0 => return kink.clone(),
            1 => return pieces.swap_remove(0),
            _ => {}
        }
        let range = self.range(kink);
        let positive = pieces.iter().all(|piece| self.range(piece).is_non_negative());
        let all_positive = self.problem.variables.lower.iter().all(|&lower| lower >= 0.0);
        let (lower, upper) = match (guarded, positive && all_positive) {
            (true, _) => (range.lower, range.upper),
            // So that geometric programs stay so.
            (false, true) => (range.lower, f64::INFINITY),
            (false, false) => (f64::NEG_INFINITY, f64::INFINITY),
        };
        let level = pieces.iter().map(|piece| self.level(piece)).max().unwrap_or(0);
        let number = self.auxiliaries.len() + 1;
        let word = if matches!(kink, Formula::Unary(..)) {
            "abs"
        } else if upward {
            "max"
        } else {
            "min"
        };
        let name = format!("{word} {number} in {}", self.place.name);
        let variable = self.add_variable(&name, lower, upper);
        let constraints = pieces.into_iter().map(|piece| self.bounding(&name, piece, &variable, upward)).collect();
        let auxiliary = Auxiliary { formula: kink.clone(), constraints: 0..0, above: upward, level };
        self.auxiliaries.push((auxiliary, constraints));
        variable
    }

    /// piece − t against zero.
    fn bounding(&self, name: &str, piece: Formula, variable: &Formula, upward: bool) -> Constraint {
        let left = Formula::Binary(Binary::Subtract, Box::new(piece), Box::new(variable.clone()));
        let zero = Formula::Constant(0.0);
        let right = if upward { Limit::AtMost(zero) } else { Limit::AtLeast(zero) };
        let Constraint { place, text, .. } = &self.place;
        Constraint {
            name: name.into(),
            detail: Box::default(),
            place: place.clone(),
            text: text.clone(),
            scope: Scope::Once,
            left,
            right,
        }
    }

    fn add_variable(&mut self, name: &str, lower: f64, upper: f64) -> Formula {
        let variables = &mut self.problem.variables;
        variables.origin.push(Origin::Scalar(variables.declared.len() as u32));
        variables.declared.push(name.into());
        variables.lower.push(lower);
        variables.upper.push(upper);
        variables.start.push(0.0_f64.max(lower).min(upper));
        Formula::Variable((variables.lower.len() - 1) as u32)
    }

    /// 0 where a formula depends on no auxiliary, else one more than the highest level of those.
    fn level(&self, formula: &Formula) -> usize {
        match formula {
            Formula::Variable(j) => {
                (*j as usize).checked_sub(self.first).and_then(|at| self.auxiliaries.get(at)).map_or(0, |(own, _)| own.level + 1)
            }
            Formula::Definition(d) => self.definition_level.get(*d as usize).copied().unwrap_or(0),
            Formula::Unary(_, inner) => self.level(inner),
            Formula::Binary(_, left, right) => self.level(left).max(self.level(right)),
            Formula::Fold(_, list) => list.iter().map(|one| self.level(one)).max().unwrap_or(0),
            _ => 0,
        }
    }

    /// Whether a formula is proved never negative (`true`), or never positive.
    fn sign(&mut self, formula: &Formula) -> Option<bool> {
        match self.range(formula) {
            range if range.is_non_negative() => Some(true),
            range if range.is_non_positive() => Some(false),
            _ => None,
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

fn negated(list: Vec<Formula>) -> Vec<Formula> {
    list.into_iter().map(negative).collect()
}
