//! Sizes from lists: the values of variables.

use super::Assembly;
use super::listing::{Listing, Values};
use crate::input::declaration::{self, ListEntry};
use crate::problem::Listed;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::words::brief;

/// Values of one list: more than any catalogue has, and as many as memory holds many times over.
const MOST_VALUES: f64 = 1e6;

impl Assembly<'_> {
    /// The numbers of a list; `None` after a mistake.
    pub(super) fn listing(&mut self, entry: &ListEntry) -> Option<Listing> {
        let values = match &entry.values {
            declaration::Listing::Integer => Values::Integer,
            declaration::Listing::Values(list) => {
                let values: Vec<Option<f64>> = list.iter().map(|scalar| self.constant(scalar)).collect();
                Values::Given(values.into_iter().collect::<Option<_>>()?)
            }
            declaration::Listing::Step(scalar) => {
                let step = self.constant(scalar)?;
                if !(step > 0.0 && step.is_finite()) {
                    let message = format!("`step` cannot be {}", brief(step));
                    self.findings.mistake(MistakeCode::OutOfRange, scalar.place(), message, "expected a positive number");
                    return None;
                }
                Values::Step(step)
            }
        };
        Some(Listing { place: entry.place, values })
    }

    /// Lists of all variables, once their bounds are known: a variable reaches from its first value to its last.
    pub(super) fn lists(&mut self) {
        for (variable, listing) in std::mem::take(&mut self.listings) {
            let j = variable as usize;
            let (lower, upper) = (self.problem.variables.lower[j], self.problem.variables.upper[j]);
            if lower == upper {
                continue; // fixed: nothing is to be chosen
            }
            let Some(values) = self.values(&listing, lower, upper) else { continue };
            (self.problem.variables.lower[j], self.problem.variables.upper[j]) = (values[0], values[values.len() - 1]);
            let rows = values.into_iter().map(|value| vec![value]).collect();
            let name = self.problem.variable_name(j);
            self.problem.listed.push(Listed { name, variables: vec![variable], rows, names: Vec::new() });
        }
        for (section, catalogue) in std::mem::take(&mut self.from_catalogues) {
            self.list_of_section(section, &catalogue);
        }
    }

    /// The values within the bounds, ascending.
    fn values(&mut self, listing: &Listing, lower: f64, upper: f64) -> Option<Vec<f64>> {
        let (first, step) = match &listing.values {
            Values::Given(values) => {
                let mut values: Vec<f64> = values.iter().copied().filter(|value| (lower..=upper).contains(value)).collect();
                values.sort_by(f64::total_cmp);
                values.dedup();
                if values.is_empty() {
                    let message = format!("no value of this list lies between {} and {}", brief(lower), brief(upper));
                    self.findings.mistake(MistakeCode::List, listing.place, message, "widen the bounds, or add values");
                    return None;
                }
                return Some(values);
            }
            Values::Step(step) => (lower, *step),
            Values::Integer => (lower.ceil(), 1.0),
        };
        // The last step may miss the bound by rounding.
        let count = ((upper - first) / step + 1e-9).floor() + 1.0;
        if !(lower.is_finite() && upper.is_finite()) {
            self.findings.mistake(MistakeCode::List, listing.place, "a list between open bounds", "give `lower` and `upper`");
            return None;
        }
        if !(1.0..=MOST_VALUES).contains(&count) {
            let message = format!("a list of {} values", brief(count.max(0.0)));
            self.findings.mistake(
                MistakeCode::List,
                listing.place,
                message,
                format!("expected 1 to {MOST_VALUES}: choose another step or other bounds"),
            );
            return None;
        }
        // Steps of 0.1 are tenths: counted, not added up.
        let value = |k: usize| {
            let steps = first / step;
            if steps.fract() == 0.0 { (steps + k as f64) * step } else { first + k as f64 * step }
        };
        Some((0..count as usize).map(|k| value(k).min(upper)).collect())
    }
}
