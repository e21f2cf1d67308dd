//! What a structure does, as files: tables of displacements, reactions and forces, pictures and VTU.

use std::io;
use std::path::{Path, PathBuf};

use super::courses::courses;
use super::folder::FolderError;
use super::results::{Writer, is_foreign};
use super::{RunError, Subject, utilisation};
use crate::files::{Inputs, whole};
use crate::report::About;
use crate::report::pictures;
use crate::report::structure::{Courses, write_vtu};
use crate::report::utilisation::Table;

/// What a file is written by.
type Content<'a> = &'a dyn Fn(&mut dyn io::Write) -> io::Result<()>;

/// Takes one file by name and what writes it.
pub(super) type Put<'a> = &'a mut dyn FnMut(&str, Content<'_>) -> io::Result<()>;

/// `displacements.csv`, `reactions.csv`, `forces.csv`.
///
/// # Errors
/// Where a file cannot be written.
pub(super) fn tables(courses: &Courses, put: Put<'_>) -> io::Result<()> {
    put("displacements.csv", &|out| courses.write_displacements(out))?;
    put("reactions.csv", &|out| courses.write_reactions(out))?;
    put("forces.csv", &|out| courses.write_forces(out))
}

/// `displaced.svg`, `forces.svg` where there are any, `structure.vtu`.
///
/// # Errors
/// Where a file cannot be written.
pub(super) fn pictures(courses: &Courses, used: Option<&Table>, about: &About, put: Put<'_>) -> io::Result<()> {
    let displaced = pictures::displaced(courses, about);
    put("displaced.svg", &|out| out.write_all(displaced.as_bytes()))?;
    if let Some(forces) = pictures::forces(courses, about) {
        put("forces.svg", &|out| out.write_all(forces.as_bytes()))?;
    }
    let share = |(_, most): &(String, Option<(usize, f64)>)| most.map(|(_, share)| share);
    let utilisation: Vec<Option<f64>> = used.map_or_else(Vec::new, |table| table.ribs.iter().map(share).collect());
    put("structure.vtu", &|out| write_vtu(courses, &utilisation, out))
}

/// Into the folder of a run.
pub(super) fn into(files: &mut Writer) -> impl FnMut(&str, Content<'_>) -> io::Result<()> + '_ {
    |name, write| files.file(name, |out| write(out))
}

/// Everything a folder of an analysis may hold.
const FILES: [&str; 8] = [
    "displacements.csv",
    "reactions.csv",
    "forces.csv",
    "limits.csv",
    "utilisation.csv",
    "displaced.svg",
    "forces.svg",
    "structure.vtu",
];

/// `analyse --out`: tables and pictures of the structure at x, all or none. Brings back where they are.
///
/// # Errors
/// An input, or a file of somebody else, where one of them would stand; a folder that cannot be written to; more places than are listed.
pub fn leave(subject: &Subject, x: &[f64], inputs: &Inputs, folder: &Path) -> Result<Vec<PathBuf>, RunError> {
    let outputs = || FILES.iter().map(|name| folder.join(name));
    inputs.spare(outputs())?;
    if let Some(foreign) = outputs().find(|output| is_foreign(output)) {
        return Err(FolderError::Foreign(foreign).into());
    }
    let courses = courses(subject, x).map_err(|error| RunError::Choice(error.to_string()))?;
    let Some(courses) = courses else {
        let message = "there is nothing to write: the structure has no load case, or too many ribs, cases and stations to list";
        return Err(RunError::Choice(message.into()));
    };
    let used = utilisation::table(subject, x).ok();
    let unwritable = |path: &Path, cause| FolderError::Unwritable { path: path.into(), cause };
    std::fs::create_dir_all(folder).map_err(|cause| unwritable(folder, cause))?;
    let (mut set, mut written) = (whole::Set::default(), Vec::new());
    let mut put = |name: &str, write: Content<'_>| {
        written.push(folder.join(name));
        set.write(&folder.join(name), |out| write(out))
    };
    let mut all = || {
        tables(&courses, &mut put)?;
        if let Some(table) = &used {
            put("limits.csv", &|out| table.write_limits(out))?;
            put("utilisation.csv", &|out| table.write_ribs(out))?;
        }
        pictures(&courses, used.as_ref(), &subject.about, &mut put)
    };
    all().map_err(|cause| unwritable(folder, cause))?;
    set.swap().map_err(|(path, cause)| unwritable(&path, cause))?;
    Ok(written)
}
