//! `--set NAME.upper=VALUE` and `--set PARAMETER=VALUE`.

use super::Assembly;
use crate::input::source::Place;
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

    /// Overrides of parameters there are none of.
    pub fn unknown_parameters(&self, known: impl Fn(&str) -> bool) -> Vec<(Place, String)> {
        let unknown = self.list.iter().filter(|set| set.part.is_none() && !known(&set.name));
        unknown.map(|set| (set.place, set.name.clone())).collect()
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
                self.findings.mistake(place(0, argument.len()), "`--set` needs a name, `=` and a number", help);
                continue;
            };
            match right.trim().parse::<f64>() {
                Ok(value) if !value.is_nan() => overrides.list.push(set(left.trim(), value, place(0, left.len()))),
                _ => {
                    let place = place(left.len() + 1, argument.len());
                    self.findings.mistake(place, format!("`{right}` is no number"), "expected a number, as in 0.8");
                }
            }
        }
        overrides
    }

    /// The mistake of a parameter that does not exist.
    pub(super) fn unknown_override(&mut self, place: Place, name: &str) {
        let suggestion = did_you_mean(name, self.names.suggestions(&self.problem).into_iter());
        let message = match self.names.find(&self.problem, name) {
            Some(entity) => format!("`{name}` is a {}, not a parameter", entity.word()),
            None => format!("there is no parameter `{name}`"),
        };
        let bounds = "bounds and starts of variables are set by depth.lower=…, depth.upper=…, depth.start=…";
        self.findings.mistake(place, message, suggestion.unwrap_or_else(|| bounds.into()));
    }

    /// Sets bounds and starts of variables.
    pub(super) fn apply(&mut self, overrides: &Overrides) {
        for set in &overrides.list {
            let Some(part) = set.part else { continue };
            let Some(variables) = self.variables_named(&set.name) else {
                let known = self.problem.variables.declared.iter().map(|name| &**name);
                let help =
                    did_you_mean(&set.name, known).unwrap_or_else(|| "a variable is named as in depth, x[2] or support.b".into());
                self.findings.mistake(set.place, format!("there is no variable `{}`", set.name), help);
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
        let (section, dimension) = name.rsplit_once('.')?;
        let s = self.names.sections.find(&self.problem.sections.names, section)? as usize;
        let at = sections_form(&self.problem, s)?.dimensions.iter().position(|given| *given == dimension)?;
        match self.problem.dimensions(s).get(at)? {
            Dimension::Variable(j) => Some(*j as usize..*j as usize + 1),
            _ => None,
        }
    }
}

fn set(left: &str, value: f64, place: Place) -> Override {
    let parts = [(".lower", Part::Lower), (".upper", Part::Upper), (".start", Part::Start)];
    let found = parts.into_iter().find_map(|(suffix, part)| Some((left.strip_suffix(suffix)?, part)));
    let (name, part) = found.map_or((left, None), |(name, part)| (name, Some(part)));
    Override { name: name.to_owned(), part, value, place }
}
