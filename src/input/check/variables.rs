//! `[variables]`: sizes, bounds, starts; and the rules for starts of all variables.

use super::Assembly;
use crate::files::memory;
use crate::input::declaration::{Numbers, Range, VariableEntry};
use crate::input::fields::Scalar;
use crate::input::source::Place;
use crate::math::within;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::resolve::Value;
use crate::problem::words::brief;
use crate::problem::{Formula, Origin, Variables};

/// Elements of all arrays together.
const LARGEST: f64 = 1e8;

/// Memory a variable takes from reading to solving, at the least: 3.0 GB were measured for `check` of sum(x) over 1e7.
const BYTES: f64 = 300.0;

/// What sums of a thousand terms may leave of 0, beside the largest of them.
const ROUNDED: f64 = 1e3 * f64::EPSILON;

/// Moved starts named one by one; further ones are counted.
const NAMED: usize = 10;

impl Assembly<'_> {
    /// The entries of `[variables]`, element by element.
    pub(super) fn variables(&mut self, entries: &[VariableEntry]) {
        for (at, entry) in entries.iter().enumerate() {
            let first = self.problem.variables.lower.len() as u32;
            let size = entry.size.as_ref().map(|size| self.size(size, first));
            self.variables.push((first, size));
            self.problem.variables.declared.push(entry.name.text.as_str().into());
            for index in 0..size.unwrap_or(1) {
                let origin = match size {
                    Some(_) => Origin::Element(at as u32, index + 1),
                    None => Origin::Scalar(at as u32),
                };
                self.push_variable(origin, Range { lower: None, upper: None, start: None });
            }
            if let Some(list) = entry.list.as_ref().and_then(|list| self.listing(list)) {
                self.listings.extend((0..size.unwrap_or(1)).map(|index| (first + index, list.clone())));
            }
            self.fill(entry, first as usize, size);
        }
    }

    /// Adds a variable; left-out parts are open or NaN until [`Assembly::check_variables`].
    pub(super) fn push_variable(&mut self, origin: Origin, range: Range<f64>) -> u32 {
        let variables = &mut self.problem.variables;
        variables.origin.push(origin);
        variables.lower.push(range.lower.unwrap_or(f64::NEG_INFINITY));
        variables.upper.push(range.upper.unwrap_or(f64::INFINITY));
        variables.start.push(range.start.unwrap_or(f64::NAN));
        (variables.lower.len() - 1) as u32
    }

    fn size(&mut self, size: &Scalar, before: u32) -> u32 {
        let allowed = |value: &f64| value.fract() == 0.0 && *value >= 1.0 && *value + f64::from(before) <= LARGEST;
        let Some(value) = self.constant(size) else { return 1 };
        if !allowed(&value) {
            let message = format!("an array cannot have {} elements", brief(value));
            self.findings.mistake(
                MistakeCode::OutOfRange,
                size.place(),
                message,
                format!("`size` is a whole number from 1; all variables together are at most {LARGEST}"),
            );
            return 1;
        }
        if let Err(cause) = memory::fits(BYTES * (value + f64::from(before))) {
            let message = format!("{} variables are too many here: {cause}", brief(value + f64::from(before)));
            self.findings.mistake(MistakeCode::OutOfRange, size.place(), message, "give the array fewer elements");
            return 1;
        }
        value as u32
    }

    fn fill(&mut self, entry: &VariableEntry, first: usize, size: Option<u32>) {
        let Range { lower, upper, start } = &entry.range;
        let lower = lower.as_ref().map(|numbers| self.column(numbers, size));
        let upper = upper.as_ref().map(|numbers| self.column(numbers, size));
        let start = start.as_ref().map(|numbers| self.column(numbers, size));
        let last = first + size.unwrap_or(1) as usize;
        let variables = &mut self.problem.variables;
        let columns = [(&mut variables.lower, lower), (&mut variables.upper, upper), (&mut variables.start, start)];
        for (target, values) in columns {
            if let Some(Some(values)) = values {
                target[first..last].copy_from_slice(&values);
            }
        }
        for j in (first..last).filter(|_| entry.positive) {
            if variables.lower[j] <= 0.0 {
                variables.lower[j] = 0.0;
                variables.positive.push(j as u32);
            }
        }
    }

    /// One number per element; a single one is repeated.
    fn column(&mut self, numbers: &Numbers, size: Option<u32>) -> Option<Vec<f64>> {
        let number = |formula: Formula| if let Formula::Constant(value) = formula { value } else { f64::NAN };
        let count = size.unwrap_or(1) as usize;
        match self.constants(numbers)? {
            Value::Scalar(formula) => Some(vec![number(formula); count]),
            Value::Array(list) if size.is_some() && list.len() == count => Some(list.into_iter().map(number).collect()),
            Value::Array(list) => {
                let place = match numbers {
                    Numbers::One(scalar) => scalar.place(),
                    Numbers::Many(_, place) => *place,
                };
                let expected = match size {
                    Some(size) => format!("expected {size}, or one number for all"),
                    None => "expected one number; an array variable needs `size`".to_owned(),
                };
                self.findings.mistake(MistakeCode::ArraySize, place, format!("an array of {} numbers", list.len()), expected);
                None
            }
        }
    }

    /// Where a scalar variable is declared.
    pub(super) fn variable_place(&self, j: usize) -> Place {
        match self.problem.variables.origin[j] {
            Origin::Scalar(entry) | Origin::Element(entry, _) => {
                let name = &self.problem.variables.declared[entry as usize];
                self.declared_at.get(&**name).copied().unwrap_or(Place::Whole)
            }
            Origin::Dimension(section, position) => self.dimension_place(section, position),
            Origin::Input(_) => Place::Whole,
        }
    }

    /// Bounds in order; starts filled in, and moved inside their bounds.
    pub(super) fn check_variables(&mut self) {
        let mut moved = 0;
        for j in 0..self.problem.variables.lower.len() {
            let variables = &self.problem.variables;
            let (lower, upper, start) = (variables.lower[j], variables.upper[j], variables.start[j]);
            if let Some((message, help)) = wrong(lower, upper, start) {
                let name = self.problem.variable_name(j);
                self.findings.mistake(MistakeCode::Bounds, self.variable_place(j), format!("`{name}`: {message}"), help);
                self.problem.variables.typical.push(0.0);
                continue;
            }
            let inside = if start.is_nan() { middle(lower, upper) } else { within(start, lower, upper) };
            self.problem.variables.start[j] = inside;
            self.problem.variables.typical.push(if start.is_nan() { 0.0 } else { start.abs() });
            if !start.is_nan() && inside != start {
                moved += 1;
                if moved <= NAMED {
                    let name = self.problem.variable_name(j);
                    let message = format!("the start of `{name}` lies outside its bounds: moved from {start} to {inside}");
                    self.findings.warning(MistakeCode::StartMoved, self.variable_place(j), message, None);
                }
            }
        }
        self.forget_rounding();
        if moved > NAMED {
            let message = format!("{} more starts outside their bounds were moved to the nearest point inside", moved - NAMED);
            self.findings.warning(MistakeCode::StartMoved, Place::Whole, message, None);
        }
    }

    /// Of an array's starts, those that are nothing beside the largest tell no size: displacements or forces that were computed, and would be 0 but for
    /// rounding. Where 0 is a bound, or beyond one, they are meant.
    fn forget_rounding(&mut self) {
        let Variables { origin, declared, lower, upper, typical, .. } = &mut self.problem.variables;
        let arrays: Vec<(usize, usize)> = origin
            .iter()
            .enumerate()
            .filter_map(|(j, origin)| if let Origin::Element(entry, _) = *origin { Some((j, entry as usize)) } else { None })
            .collect();
        let mut largest = vec![0.0f64; declared.len()];
        arrays.iter().for_each(|&(j, entry)| largest[entry] = largest[entry].max(typical[j]));
        for (j, entry) in arrays {
            if typical[j] <= ROUNDED * largest[entry] && lower[j] < 0.0 && upper[j] > 0.0 {
                typical[j] = 0.0;
            }
        }
    }
}

/// What cannot be right about a variable, and the remedy.
fn wrong(lower: f64, upper: f64, start: f64) -> Option<(String, &'static str)> {
    if lower > upper {
        return Some((format!("the lower bound {lower} is above the upper bound {upper}"), "exchange them, or widen one"));
    }
    if lower == f64::INFINITY || upper == f64::NEG_INFINITY {
        return Some((format!("no number lies between {lower} and {upper}"), "leave an open bound out, or write lower = -inf"));
    }
    start.is_infinite().then(|| (format!("it cannot start at {start}"), "expected a finite number"))
}

/// The start of a variable without one: the middle of its bounds, or inside the only one, or 0.
fn middle(lower: f64, upper: f64) -> f64 {
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => within(0.5 * lower + 0.5 * upper, lower, upper),
        (true, false) => lower + lower.abs().max(1.0),
        (false, true) => upper - upper.abs().max(1.0),
        (false, false) => 0.0,
    }
    .clamp(f64::MIN, f64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_left_out() {
        assert_eq!(middle(1.0, 3.0), 2.0);
        assert_eq!(middle(-10.0, f64::INFINITY), 0.0);
        assert_eq!(middle(f64::NEG_INFINITY, 0.5), -0.5);
        assert_eq!(middle(f64::NEG_INFINITY, f64::INFINITY), 0.0);
        assert_eq!(middle(-f64::MAX, f64::MAX), 0.0);
    }

    #[test]
    fn impossible_bounds() {
        assert!(wrong(2.0, 1.0, 1.5).is_some());
        assert!(wrong(f64::INFINITY, f64::INFINITY, f64::NAN).is_some());
        assert!(wrong(0.0, 1.0, f64::INFINITY).is_some());
        assert!(wrong(1.0, 1.0, f64::NAN).is_none());
    }
}
