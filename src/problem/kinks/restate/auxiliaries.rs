//! Kinks that become a variable with rows that bound it.

use super::super::Auxiliary;
use super::{MOST_AUXILIARIES, Restating};
use crate::expression::operators::Binary;
use crate::problem::{Constraint, Formula, Limit, Origin, Scope};

impl Restating {
    /// A variable in the place of a kink.
    pub(super) fn auxiliary(&mut self, kink: &Formula, upward: bool, guarded: bool) -> Formula {
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
    pub(super) fn bounding(&self, name: &str, piece: Formula, variable: &Formula, upward: bool) -> Constraint {
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
            asked: Vec::new(),
        }
    }

    pub(super) fn add_variable(&mut self, name: &str, lower: f64, upper: f64) -> Formula {
        let variables = &mut self.problem.variables;
        variables.origin.push(Origin::Scalar(variables.declared.len() as u32));
        variables.declared.push(name.into());
        variables.lower.push(lower);
        variables.upper.push(upper);
        variables.start.push(0.0_f64.max(lower).min(upper));
        Formula::Variable((variables.lower.len() - 1) as u32)
    }

    /// 0 where a formula depends on no auxiliary, else one more than the highest level of those.
    pub(super) fn level(&self, formula: &Formula) -> usize {
        match formula {
            Formula::Variable(j) => {
                (*j as usize).checked_sub(self.first).and_then(|at| self.auxiliaries.get(at)).map_or(0, |(own, _)| own.level + 1)
            }
            Formula::Definition(d) => self.definition_level.get(*d as usize).copied().unwrap_or(0),
            other => other.children().map(|one| self.level(one)).max().unwrap_or(0),
        }
    }

    pub(super) fn definition(&mut self, d: u32, upward: bool, guarded: bool) -> Formula {
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
}
