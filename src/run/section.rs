//! `section`: cross-sections of a file, or one put together on the command line.

use std::path::Path;

use super::{RunError, Subject};
use crate::geometry::polygon::Ring;
use crate::input;
use crate::problem::nearest::did_you_mean;
use crate::problem::texts::Texts;
use crate::report::answer::EarlierAnswer;
use crate::report::cross_section::CrossSection;
use crate::sections::{self, Form, Kind};

/// Sections described at the most where none is named.
const MOST: usize = 1000;

/// The sections of these names (all where there is none), at the start or at an earlier answer.
///
/// # Errors
/// An unknown section, an answer that cannot be read, a dimension without value.
pub fn of_file(subject: &Subject, names: &[String], answer: Option<&Path>) -> Result<Vec<CrossSection>, RunError> {
    let problem = subject.problem();
    let x = match answer {
        Some(path) => EarlierAnswer::read(path)?.point(subject.shown())?,
        None => subject.shown().meta().start.clone(),
    };
    let all = &problem.sections.names;
    let chosen: Vec<usize> = match names {
        [] => (0..all.len().min(MOST)).collect(),
        names => names.iter().map(|name| number(all, name)).collect::<Result<_, _>>()?,
    };
    if chosen.is_empty() {
        return Err(RunError::Choice(format!("{} has no sections", subject.about.file)));
    }
    let described = |s: usize| {
        let section = CrossSection::of(problem, s as u32, &x);
        section.ok_or_else(|| RunError::Choice(format!("section {} has no value at this point; give --answer", &all[s])))
    };
    chosen.into_iter().map(described).collect()
}

fn number(all: &Texts, name: &str) -> Result<usize, RunError> {
    all.iter().position(|known| known == name).ok_or_else(|| {
        let near = did_you_mean(name, all.iter().take(10_000));
        let help = near.unwrap_or_else(|| "sections are named under [sections] or in the table".into());
        RunError::Choice(format!("there is no section `{name}`; {help}"))
    })
}

/// A section by kind, dimensions as `b=0.2,h=0.5`, and points as `x y; x y; …`, those of holes after a bar.
///
/// ```
/// use ribopt::run::section::by_kind;
/// let tube = by_kind("tube", "d=0.2, t=0.01", None)?;
/// assert!((tube.value("di").unwrap() - 0.18).abs() < 1e-15);
/// assert!(by_kind("tube", "d=0.2", None).unwrap_err().to_string().contains("give d, t"));
/// # Ok::<(), ribopt::run::RunError>(())
/// ```
///
/// # Errors
/// An unknown kind, dimensions that do not make one, points that do not.
pub fn by_kind(kind: &str, dimensions: &str, points: Option<&str>) -> Result<CrossSection, RunError> {
    let names = || sections::KINDS.iter().map(|kind| kind.name());
    let Some(kind) = sections::kind(kind) else {
        let help = did_you_mean(kind, names()).unwrap_or_else(|| format!("known: {}", names().collect::<Vec<_>>().join(", ")));
        return Err(RunError::Choice(format!("unknown kind of section `{kind}`; {help}")));
    };
    let given = pairs(dimensions)?;
    let outline = points.map(input::points).transpose().map_err(RunError::Choice)?.unwrap_or_default();
    let (form, values) = form_of(kind, &given)?;
    outline_fits(kind, form, &outline)?;
    let section = CrossSection::new(kind.name(), form, &values, &outline);
    section.ok_or_else(|| RunError::Choice("these dimensions make no section".into()))
}

/// `b=0.2,h=0.5`
fn pairs(text: &str) -> Result<Vec<(String, f64)>, RunError> {
    let one = |pair: &str| {
        let (name, value) = pair.split_once('=')?;
        Some((name.trim().to_owned(), value.trim().parse::<f64>().ok().filter(|value| value.is_finite())?))
    };
    let wrong =
        |pair: &str| RunError::Choice(format!("`{}` is no dimension; expected NAME=NUMBER, as in b=0.2,h=0.5", pair.trim()));
    text.split(',').map(|pair| one(pair).ok_or_else(|| wrong(pair))).collect()
}

fn form_of(kind: &'static dyn Kind, given: &[(String, f64)]) -> Result<(&'static Form, Vec<f64>), RunError> {
    let value = |name: &str| given.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
    let values = |form: &Form| form.dimensions.iter().map(|name| value(name)).collect::<Option<Vec<f64>>>();
    let mut fitting = kind.forms().iter().filter(|form| form.dimensions.len() == given.len());
    fitting.find_map(|form| Some((form, values(form)?))).ok_or_else(|| {
        let sets: Vec<String> = kind.forms().iter().take(6).map(|form| form.dimensions.join(", ")).collect();
        RunError::Choice(format!("these are not the dimensions of a {}; give {}", kind.name(), sets.join("; or ")))
    })
}

fn outline_fits(kind: &dyn Kind, form: &Form, outline: &[Ring]) -> Result<(), RunError> {
    match (kind.has_outline(), outline.is_empty()) {
        (true, true) => Err(RunError::Choice(format!("a {} is drawn by points: give --points \"x y; x y; …\"", kind.name()))),
        (false, false) => Err(RunError::Choice(format!("a {} has no points; leave --points out", kind.name()))),
        (false, true) => Ok(()),
        (true, false) if outline.len() > 1 && !kind.takes_holes() => {
            Err(RunError::Choice(format!("a {} takes no holes; give one ring of points", kind.name())))
        }
        (true, false) => kind.outline_defect(form, outline).map_or(Ok(()), |reason| Err(RunError::Choice(reason))),
    }
}
