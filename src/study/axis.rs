//! The values one varied name takes on.

use std::ops::Range;

use super::declaration::{self, Method, Number, Scale};
use super::mistakes::Mistakes;

/// A varied name and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// As in `--set`.
    pub name: String,
    /// Its values, in the order in which they were given; empty where they are drawn between its ends.
    pub values: Vec<f64>,
    /// The ends between which values are drawn.
    ends: Option<[f64; 2]>,
    /// Whether they are spaced by their logarithms.
    logarithmic: bool,
}

impl Axis {
    /// A name with its values.
    pub(super) fn of(name: &str, values: Vec<f64>) -> Axis {
        Axis { name: name.to_owned(), values, ends: None, logarithmic: false }
    }

    /// The value at a share in [0, 1) of the way, or of the list.
    pub(super) fn at(&self, share: f64) -> f64 {
        match self.ends {
            Some(ends) => between(ends, self.logarithmic, share),
            None => self.values[((share * self.values.len() as f64) as usize).min(self.values.len() - 1)],
        }
    }

    /// The largest magnitude on it: what a step of it is measured by where it is at 0.
    pub(super) fn size(&self) -> f64 {
        self.values.iter().chain(self.ends.iter().flatten()).fold(0.0, |most, value| most.max(value.abs()))
    }
}

/// The value a share of the way between two ends; exact at both.
fn between([from, to]: [f64; 2], logarithmic: bool, share: f64) -> f64 {
    match (share, logarithmic) {
        (1.0, _) => to,
        (_, true) => from * (to / from).powf(share),
        (_, false) => from + share * (to - from),
    }
}

/// The texts of an axis' numbers that have to be computed, in the order in which [`read`] takes them.
pub(super) fn texts(axis: &declaration::Axis) -> Vec<(String, Range<usize>)> {
    let all = axis.from.iter().chain(&axis.to).chain(axis.values.iter().flatten());
    all.filter_map(|number| match number.get_ref() {
        Number::Text(text) => Some((text.clone(), number.span())),
        Number::Given(_) => None,
    })
    .collect()
}

/// An axis with its numbers; `computed` gives those of its texts, one by one.
pub(super) fn read(
    (name, span): (&str, Range<usize>),
    axis: &declaration::Axis,
    method: Method,
    computed: &mut dyn Iterator<Item = f64>,
    mistakes: &mut Mistakes<'_>,
) -> Option<Axis> {
    let mut number = |number: &toml::Spanned<Number>, mistakes: &mut Mistakes<'_>| {
        let value = match number.get_ref() {
            Number::Given(value) => *value,
            Number::Text(_) => computed.next().unwrap_or(f64::NAN),
        };
        if !value.is_finite() {
            mistakes.tell(number.span(), "this is no finite number", None);
        }
        value
    };
    let from = axis.from.as_ref().map(|given| number(given, mistakes));
    let to = axis.to.as_ref().map(|given| number(given, mistakes));
    let values: Option<Vec<f64>> = axis.values.as_ref().map(|list| list.iter().map(|given| number(given, mistakes)).collect());
    match (from, to, values) {
        (None, None, Some(values)) => {
            if values.is_empty() {
                mistakes.tell(span, format!("`{name}` has no values"), Some("give one at least"));
                return None;
            }
            Some(Axis::of(name, values))
        }
        (Some(from), Some(to), None) => spaced((name, span), axis, method, [from, to], mistakes),
        _ => {
            let help = "as in { from = 1, to = 2, count = 5 } or { values = [1, 2] }";
            mistakes.tell(span, format!("`{name}` needs either `from` and `to`, or `values`"), Some(help));
            None
        }
    }
}

/// Values between two ends.
fn spaced(
    (name, span): (&str, Range<usize>),
    axis: &declaration::Axis,
    method: Method,
    ends: [f64; 2],
    mistakes: &mut Mistakes<'_>,
) -> Option<Axis> {
    let logarithmic = axis.scale == Scale::Log;
    if logarithmic && (ends.contains(&0.0) || ends[0].signum() != ends[1].signum()) {
        let help = "leave `scale` out, or begin above 0";
        mistakes.tell(span, format!("`{name}` cannot be spaced by logarithms: an end is 0, or they differ in sign"), Some(help));
        return None;
    }
    if method.draws() {
        return Some(Axis { name: name.to_owned(), values: Vec::new(), ends: Some(ends), logarithmic });
    }
    let Some(count) = &axis.count else {
        mistakes.tell(span, format!("`{name}` needs a `count`"), Some("how many values, both ends among them"));
        return None;
    };
    let steps = *count.get_ref();
    if steps == 0 || (steps == 1 && ends[0] != ends[1]) {
        mistakes.tell(count.span(), "`count` must be 2 or more: both ends are among the values", None);
        return None;
    }
    if steps > super::MOST_POINTS {
        mistakes.tell(count.span(), format!("a study has at most {} points", super::MOST_POINTS), None);
        return None;
    }
    let share = |step: u32| if steps == 1 { 0.0 } else { f64::from(step) / f64::from(steps - 1) };
    let values = (0..steps).map(|step| between(ends, logarithmic, share(step))).collect();
    Some(Axis { name: name.to_owned(), values, ends: Some(ends), logarithmic })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_met_exactly() {
        assert_eq!(between([0.1, 0.7], false, 1.0), 0.7);
        assert_eq!(between([1e-3, 1e3], true, 1.0), 1e3);
        assert!((between([1e-3, 1e3], true, 0.5) - 1.0).abs() < 1e-15);
        assert_eq!(between([-1e-3, -1e3], true, 0.0), -1e-3);
    }

    #[test]
    fn a_list_is_chosen_from_evenly() {
        let axis = Axis::of("b", vec![0.2, 0.3, 0.4]);
        assert_eq!([0.0, 0.34, 0.999].map(|share| axis.at(share)), [0.2, 0.3, 0.4]);
        assert_eq!(axis.size(), 0.4);
    }
}
