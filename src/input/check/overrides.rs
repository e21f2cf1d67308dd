//! `--set NAME.upper=VALUE` and `--set PARAMETER=VALUE`.

use super::Assembly;
use crate::input::source::Place;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::nearest::did_you_mean;
use crate::problem::{Dimension, sections_form};

/// Overrides that could be read.
#[derive(Default)]
pub(super) struct Overrides {
    list: Vec<Override>,
}

struct Override {
    name: String,
    part: Option<Part>,
    value: f64,
    place: Place,
}

#[derive(Clone, Copy, PartialEq)]
enum Part {
    Lower,
    Upper,
    Start,
}

impl Overrides {
    /// The last value set for a parameter.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        let set = self.list.iter().rev().find(|set| set.part.is_none() && set.name == name);
        set.map(|set| set.value)
    }
}

impl Assembly<'_> {
    /// Reads the arguments of `--set`.
    pub(super) fn overrides(&mut self, arguments: &[String]) -> Overrides {
        let mut overrides = Overrides::default();
        for (number, argument) in arguments.iter().enumerate() {
            let place =
                |start: usize, end: usize| Place::Argument { number: number as u16, start: start as u32, end: end as u32 };
            let Some((left, right)) = argument.split_once('=') else {
                let help = "as in --set depth.upper=0.8 or --set E=200e6";
                self.findings.mistake(MistakeCode::Set, place(0, argument.len()), "`--set` needs a name, `=` and a number", help);
                continue;
            };
            let quantity = self.units.quantity(right).map(|(value, _)| value);
            match quantity.map_or_else(|| right.trim().parse::<f64>(), Ok) {
                Ok(value) if value.is_finite() || (value.is_infinite() && is_open_bound(left, right)) => {
                    overrides.list.push(set(left.trim(), value, place(0, left.len())))
                }
                _ => {
                    let place = place(left.len() + 1, argument.len());
                    let message = match right.trim().parse::<f64>() {
                        Ok(value) if value.is_infinite() => {
                            format!("`{right}` is too large, or infinite where only bounds may be")
                        }
                        _ => format!("`{right}` is no number"),
                    };
                    self.findings.mistake(MistakeCode::Set, place, message, "expected a number, as in 0.8");
                }
            }
        }
        overrides
    }

    /// The mistake of a name that is neither parameter nor variable.
    fn unknown_override(&mut self, place: Place, name: &str) {
        let suggestion = did_you_mean(name, self.names.suggestions(&self.problem).into_iter().filter(|known| *known != name));
        let message = match self.names.find(&self.problem, name) {
            Some(entity) => format!("`{name}` is a {}, not a parameter or a variable", entity.word()),
            None => format!("there is no parameter or variable `{name}`"),
        };
        let help =
            "NAME=VALUE sets a parameter or fixes a variable such as depth, x[2] or support.b; NAME.lower=, .upper=, .start=";
        self.findings.mistake(MistakeCode::Set, place, message, suggestion.unwrap_or_else(|| help.into()));
    }

    /// `NAME=VALUE` for what is no parameter: a variable is fixed there, a fixed dimension takes another value.
    fn fix(&mut self, set: &Override) {
        if matches!(self.names.find(&self.problem, &set.name), Some(Entity::Parameter(_))) {
            return;
        }
        if let Some(variables) = self.variables_named(&set.name) {
            let table = &mut self.problem.variables;
            for column in [&mut table.lower, &mut table.upper, &mut table.start] {
                column[variables.clone()].fill(set.value);
            }
            if let Some((_, dimension)) = set.name.rsplit_once('.') {
                self.positive(dimension, set.value, set.place);
            }
            return;
        }
        match self.dimension_named(&set.name) {
            Some((s, at)) => {
                let first = self.problem.sections.first_dimension[s] as usize;
                if let Dimension::Constant(value) = &mut self.problem.sections.dimensions[first + at] {
                    *value = set.value;
                    let dimension = set.name.rsplit_once('.').map_or("", |(_, name)| name);
                    self.positive(dimension, set.value, set.place);
                } else {
                    let message = format!("`{}` follows from an expression", set.name);
                    self.findings.mistake(MistakeCode::Set, set.place, message, "set what the expression is made of");
                }
            }
            None => self.unknown_override(set.place, &set.name),
        }
    }

    /// Sets bounds and starts of variables.
    pub(super) fn apply(&mut self, overrides: &Overrides) {
        for set in &overrides.list {
            let Some(part) = set.part else {
                self.fix(set);
                continue;
            };
            let Some(variables) = self.variables_named(&set.name) else {
                let known = self.problem.variables.declared.iter().map(|name| &**name);
                let help =
                    did_you_mean(&set.name, known).unwrap_or_else(|| "a variable is named as in depth, x[2] or support.b".into());
                self.findings.mistake(MistakeCode::Set, set.place, format!("there is no variable `{}`", set.name), help);
                continue;
            };
            let table = &mut self.problem.variables;
            let column = match part {
                Part::Lower => &mut table.lower,
                Part::Upper => &mut table.upper,
                Part::Start => &mut table.start,
            };
            column[variables].fill(set.value);
        }
    }

    /// The scalar variables a name stands for: `depth`, `x`, `x[2]`, `support.b`.
    fn variables_named(&self, name: &str) -> Option<std::ops::Range<usize>> {
        let (base, element) = match name.strip_suffix(']').and_then(|name| name.split_once('[')) {
            Some((base, index)) => (base, Some(index.trim().parse::<u32>().ok()?)),
            None => (name, None),
        };
        if let Some(Entity::Variable(entry)) = self.names.find(&self.problem, base) {
            let (first, size) = *self.variables.get(entry as usize)?;
            return match (element, size) {
                (None, size) => Some(first as usize..(first + size.unwrap_or(1)) as usize),
                (Some(index), Some(size)) if (1..=size).contains(&index) => {
                    Some((first + index - 1) as usize..(first + index) as usize)
                }
                _ => None,
            };
        }
        let (s, at) = self.dimension_named(name)?;
        match self.problem.dimensions(s).get(at)? {
            Dimension::Variable(j) => Some(*j as usize..*j as usize + 1),
            _ => None,
        }
    }

    /// The section and the position of a dimension: `support.b`.
    fn dimension_named(&self, name: &str) -> Option<(usize, usize)> {
        let (section, dimension) = name.rsplit_once('.')?;
        let s = self.names.sections.find(&self.problem.sections.names, section)? as usize;
        let at = sections_form(&self.problem, s)?.dimensions.iter().position(|given| *given == dimension)?;
        Some((s, at))
    }
}

/// `depth.upper=inf`, and not `depth.upper=1e400`.
fn is_open_bound(left: &str, right: &str) -> bool {
    let says_so = ["inf", "infinity"].contains(&right.trim().trim_start_matches(['+', '-']).to_lowercase().as_str());
    says_so && [".lower", ".upper"].iter().any(|bound| left.trim().ends_with(bound))
}

fn set(left: &str, value: f64, place: Place) -> Override {
    let parts = [(".lower", Part::Lower), (".upper", Part::Upper), (".start", Part::Start)];
    let found = parts.into_iter().find_map(|(suffix, part)| Some((left.strip_suffix(suffix)?, part)));
    let (name, part) = found.map_or((left, None), |(name, part)| (name, Some(part)));
    Override { name: name.to_owned(), part, value, place }
}
