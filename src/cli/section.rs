//! `ribopt section`

use std::path::Path;

use super::arguments::Section;
use super::failure::Failure;
use super::output;
use ribopt::files::{Inputs, whole};
use ribopt::report::cross_section::CrossSection;
use ribopt::report::{pictures, result::write_value};
use ribopt::run::{RunError, Subject, section};

/// Shows sections in numbers and as a picture; exit code 1 where one is not valid.
pub fn run(arguments: &Section) -> Result<u8, Failure> {
    arguments.svg.as_deref().map_or(Ok(()), check_ending)?;
    let (sections, inputs, at_start) = described(arguments)?;
    inputs.spare(&arguments.svg).map_err(RunError::from)?;
    if let Some(path) = &arguments.svg {
        draw(&sections, at_start, path)?;
    }
    if arguments.json {
        output::print(|out| write_value(&sections, out))?;
    } else {
        output::print(|out| {
            if at_start {
                writeln!(out, "At the start, not at an answer (--answer results/…/result.json shows one):\n")?;
            }
            sections.iter().try_for_each(|section| writeln!(out, "{}", section.table()))?;
            writeln!(out, "Ix is about the horizontal axis, the strong one of an upright rib; Eurocode calls it Iy.")
        })?;
    }
    Ok(u8::from(sections.iter().any(|section| section.defect.is_some())))
}

/// A picture is an SVG, and called so.
fn check_ending(path: &Path) -> Result<(), Failure> {
    match path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg")) {
        true => Ok(()),
        false => Err(Failure::Request(format!("--svg {}: the picture is an SVG; give a name that ends in .svg", path.display()))),
    }
}

/// The sections, what was read for them, and whether they stand at a file's starts.
fn described(arguments: &Section) -> Result<(Vec<CrossSection>, Inputs, bool), Failure> {
    match (&arguments.kind, &arguments.file) {
        (Some(kind), _) => {
            let dimensions = arguments.dims.as_deref().unwrap_or_default();
            let section = section::by_kind(kind, dimensions, arguments.points.as_deref())?;
            Ok((vec![section], Inputs::default(), false))
        }
        (None, Some(file)) => {
            let subject = Subject::read(file, &arguments.changes.set)?;
            output::tell(&subject.warnings);
            let sections = section::of_file(&subject, &arguments.sections, arguments.answer.as_deref())?;
            let inputs = subject.inputs.files().iter().cloned().chain(arguments.answer.clone());
            let at_start = arguments.answer.is_none()
                && subject
                    .problem()
                    .variables
                    .lower
                    .iter()
                    .zip(&subject.problem().variables.upper)
                    .any(|(lower, upper)| lower < upper);
            Ok((sections, Inputs::new(inputs), at_start))
        }
        // Held off by the definition of the arguments.
        (None, None) => Err(Failure::Request("give a problem file, or --kind and --dims".into())),
    }
}

fn draw(sections: &[CrossSection], at_start: bool, path: &Path) -> Result<(), Failure> {
    let picture = pictures::cross_section(sections, at_start);
    whole::write(path, |out| out.write_all(picture.as_bytes()))
        .map_err(|error| Failure::Request(format!("cannot write {}: {error}; choose another file with --svg", path.display())))
}
