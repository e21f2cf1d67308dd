//! `ribopt section`

use std::path::Path;

use super::arguments::Section;
use super::failure::Failure;
use super::output;
use ribopt::report::cross_section::CrossSection;
use ribopt::report::{pictures, result::write_value, whole_file};
use ribopt::run::{Subject, section};

/// Shows sections in numbers and as a picture; exit code 1 where one is not valid.
pub fn run(arguments: &Section) -> Result<u8, Failure> {
    let sections = described(arguments)?;
    if let Some(path) = &arguments.svg {
        draw(&sections, path)?;
    }
    if arguments.json {
        output::print(|out| write_value(&sections, out))?;
    } else {
        output::print(|out| {
            sections.iter().try_for_each(|section| writeln!(out, "{}", section.table()))?;
            writeln!(out, "Ix is about the horizontal axis, the strong one of an upright rib; Eurocode calls it Iy.")
        })?;
    }
    Ok(u8::from(sections.iter().any(|section| section.defect.is_some())))
}

fn described(arguments: &Section) -> Result<Vec<CrossSection>, Failure> {
    match (&arguments.kind, &arguments.file) {
        (Some(kind), _) => {
            let dimensions = arguments.dims.as_deref().unwrap_or_default();
            Ok(vec![section::by_kind(kind, dimensions, arguments.points.as_deref())?])
        }
        (None, Some(file)) => {
            let subject = Subject::read(file, &arguments.changes.set)?;
            output::tell(&subject.warnings);
            Ok(section::of_file(&subject, &arguments.sections, arguments.answer.as_deref())?)
        }
        // Held off by the definition of the arguments.
        (None, None) => Err(Failure::Request("give a problem file, or --kind and --dims".into())),
    }
}

fn draw(sections: &[CrossSection], path: &Path) -> Result<(), Failure> {
    let picture = pictures::cross_section(sections);
    whole_file::write(path, |out| out.write_all(picture.as_bytes()))
        .map_err(|error| Failure::Request(format!("cannot write {}: {error}; choose another file with --svg", path.display())))
}
