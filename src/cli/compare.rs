//! `ribopt compare`

use std::fs;
use std::io;
use std::path::Path;

use super::arguments::Compare;
use super::failure::Failure;
use super::{interrupt, output};
use ribopt::files::whole;
use ribopt::report::comparison::{self, Trial};
use ribopt::report::pictures::performance_profile;
use ribopt::report::result::write_value;
use ribopt::run::{RunError, Subject, compare::compare};

/// Compares all solvers on all files. All files are read first: a mistake in one is told before anything is run.
pub fn run(arguments: &Compare) -> Result<u8, Failure> {
    let read = |file: &std::path::PathBuf| {
        let mut subject = Subject::read(file, &arguments.changes.set)?;
        arguments.limits.apply(&mut subject.settings);
        Ok::<_, Failure>(subject)
    };
    let subjects = arguments.files.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    if let Some(folder) = &arguments.profile {
        spare_inputs(&subjects, folder)?;
    }
    let interrupt = interrupt::flag();
    let mut trials = Vec::new();
    for subject in &subjects {
        output::tell(&subject.warnings);
        let of_file = compare(subject, Some(interrupt));
        if !arguments.json {
            let (about, class) = (&subject.about, subject.class());
            output::print(|out| write!(out, "{} ({}), {class}\n{}\n", about.title, about.file, comparison::table(&of_file)))?;
        }
        trials.extend(of_file);
    }
    interrupt::release();
    if arguments.json {
        output::print(|out| write_value(&trials, out))?;
    }
    if let Some(folder) = &arguments.profile {
        leave_profiles(&trials, folder).map_err(|error| {
            Failure::Request(format!("cannot write to {}: {error}; choose another folder with --profile", folder.display()))
        })?;
    }
    Ok(interrupt::code(0))
}

/// No file of a profile takes the place of a problem or its tables.
fn spare_inputs(subjects: &[Subject], folder: &Path) -> Result<(), RunError> {
    let names =
        ["compare.csv", "profile-evaluations.csv", "profile-evaluations.svg", "profile-seconds.csv", "profile-seconds.svg"];
    for subject in subjects {
        subject.inputs.spare(names.map(|name| folder.join(name)))?;
    }
    Ok(())
}

/// `compare.csv`, `profile-evaluations.csv`, `….svg`, `profile-seconds.csv`, `….svg`.
fn leave_profiles(trials: &[Trial], folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    whole::write(&folder.join("compare.csv"), |out| comparison::write_csv(trials, out))?;
    for profile in comparison::profiles(trials) {
        let stem = format!("profile-{}", profile.measure);
        whole::write(&folder.join(format!("{stem}.csv")), |out| profile.write_csv(out))?;
        whole::write(&folder.join(format!("{stem}.svg")), |out| out.write_all(performance_profile::draw(&profile).as_bytes()))?;
    }
    Ok(())
}
