//! Sizes of all sections and volumes of all ribs at a point, as tables.

use std::sync::Arc;

use super::MOST_LISTED;
use super::Subject;
use crate::expression::ast::Collection;
use crate::files::whole::Content;
use crate::model::{EvaluationError, assemble_any};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::{Constraint, Dimension, Formula, Problem, Scope};
use crate::report::cross_section::CrossSection;
use crate::report::sizes::{self, RibVolume, Size};
use crate::sections;

/// The datum of ribs or sections, or else the parameter, that gives mass to volume.
pub const DENSITY: &str = "density";

/// Sections whose properties are written besides their dimensions, at the most: each takes some microseconds.
const MOST_PROPERTIES: usize = 5_000;

/// `sizes.csv` where there are sections, `volumes.csv` where there are ribs.
pub(super) fn tables<'a>(subject: &'a Subject, x: &'a [f64]) -> Vec<(&'static str, Content<'a>)> {
    let (problem, mut files) = (subject.problem(), Vec::<(&'static str, Content<'a>)>::new());
    if (1..=MOST_LISTED).contains(&problem.sections.names.len()) {
        files.push(("sizes.csv", Box::new(move |out| sizes::write(all_sizes(problem, x), out))));
    }
    if (1..=MOST_LISTED).contains(&problem.ribs.names.len())
        && let Ok(volumes) = rib_volumes(problem, x, None)
    {
        files.push(("volumes.csv", Box::new(move |out| sizes::write_volumes(lines(problem, &volumes), out))));
    }
    files
}

/// The mass of all ribs, where each has a density.
pub fn mass(problem: &Problem, x: &[f64]) -> Option<f64> {
    if problem.ribs.names.is_empty() || density(problem, 0).is_none() {
        return None;
    }
    let volumes = rib_volumes(problem, x, None).ok()?;
    lines(problem, &volumes).map(|line| line.mass()).sum()
}

/// Dimensions of every section, and its properties where there are not too many.
pub(super) fn all_sizes<'a>(problem: &'a Problem, x: &'a [f64]) -> impl Iterator<Item = Size<'a>> {
    let evaluation = Evaluation::at(problem, x);
    let with_properties = problem.sections.names.len() <= MOST_PROPERTIES;
    (0..problem.sections.names.len()).flat_map(move |s| {
        let form = sections::form(problem.sections.form[s]);
        let section = &problem.sections.names[s];
        let kind = sections::kind_of(problem.sections.form[s]).name();
        let given = form.dimensions.iter().zip(problem.dimensions(s)).map(|(name, &dimension)| {
            let value = evaluation.dimension(s as u32, dimension).unwrap_or(f64::NAN);
            Size { section, kind, name, value, given: given(problem, s, dimension) }
        });
        let shape = if with_properties { CrossSection::of(problem, s as u32, x) } else { None };
        let derived = shape.into_iter().flat_map(|shape| shape.properties).map(move |(name, value)| Size {
            section,
            kind,
            name,
            value: value.unwrap_or(f64::NAN),
            given: "derived",
        });
        given.collect::<Vec<_>>().into_iter().chain(derived)
    })
}

fn given(problem: &Problem, s: usize, dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::Constant(_) => "fixed",
        Dimension::Formula(_) => "linked",
        Dimension::Variable(j) => match problem.variables.origin.get(j as usize) {
            Some(crate::problem::Origin::Dimension(own, _)) if *own as usize == s => "variable",
            _ => "linked",
        },
    }
}

/// Every rib's volume: by its own law, or all by this one.
///
/// # Errors
/// A volume without a value at this point.
pub(super) fn rib_volumes(
    problem: &Problem,
    x: &[f64],
    law: Option<crate::problem::VolumeLaw>,
) -> Result<Vec<f64>, EvaluationError> {
    if problem.ribs.names.is_empty() {
        return Ok(Vec::new());
    }
    let mut restated = Problem { objective: Formula::default(), ..problem.clone() };
    if let Some(law) = law {
        restated.ribs.law.fill(law);
    }
    let all = Scope::Ribs((0..problem.ribs.names.len() as u32).collect());
    restated.constraints = vec![Constraint::unlimited("volume", all, Formula::OwnVolume)];
    let too_dense =
        |error: crate::model::AssemblyError| EvaluationError::Invalid { term: "volume".into(), cause: error.to_string() };
    let assembled = assemble_any(&Arc::new(restated)).map_err(too_dense)?;
    let model = assembled.model();
    let mut volumes = vec![0.0; model.meta().rows()];
    model.constraints(x, &mut volumes)?;
    Ok(volumes)
}

/// Every rib with its volume.
pub(super) fn lines<'a>(problem: &'a Problem, volumes: &'a [f64]) -> impl Iterator<Item = RibVolume<'a>> {
    let ribs = &problem.ribs;
    volumes.iter().enumerate().map(move |(r, &volume)| RibVolume {
        rib: &ribs.names[r],
        ends: [ribs.from[r], ribs.to[r]].map(|s| problem.item_name(Collection::Sections, s)),
        length: ribs.length[r],
        law: ribs.law[r].name(),
        volume,
        density: density(problem, r),
    })
}

/// The rib's own datum, else the mean of its sections' data, else the parameter.
fn density(problem: &Problem, r: usize) -> Option<f64> {
    let column = |collection| problem.columns(collection).iter().position(|column| column.name == DENSITY);
    let constants = Evaluation::constants(problem);
    let of = |collection, item: u32| {
        let formula = Formula::OwnData(column(collection)? as u32);
        constants.value(&formula, Item::of(collection, item)).filter(|value| value.is_finite())
    };
    let ends = || {
        let [from, to] = [*problem.ribs.from.get(r)?, *problem.ribs.to.get(r)?].map(|s| of(Collection::Sections, s));
        Some(0.5 * (from? + to?))
    };
    of(Collection::Ribs, r as u32).or_else(ends).or(problem.density)
}
