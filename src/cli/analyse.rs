//! `ribopt analyse`

mod show;

use super::arguments::Analyse;
use super::failure::Failure;
use super::{output, reading};
use ribopt::files::Inputs;
use ribopt::report::answer::EarlierAnswer;
use ribopt::run::RunError;
use ribopt::run::Subject;
use ribopt::run::analyse::{AnalysisError, analyse};
use ribopt::run::structure_files;

/// The exit code where the structure cannot be analysed.
const NOT_ANALYSED: u8 = 6;

/// Analyses the structure and shows what it does; exit code 6 where it cannot be analysed.
pub fn run(arguments: &Analyse) -> Result<u8, Failure> {
    let subject = reading::read(&arguments.file, &arguments.changes.set, false)?;
    output::tell(&subject.warnings);
    let answer = arguments.answer.as_deref().map(EarlierAnswer::read).transpose().map_err(RunError::from)?;
    let analysis = match analyse(&subject, answer.as_ref(), arguments.gradient) {
        Ok(analysis) => analysis,
        Err(AnalysisError::Run(error)) => return Err(error.into()),
        Err(error) => {
            output::tell(&[error.to_string()]);
            return Ok(NOT_ANALYSED);
        }
    };
    output::tell(&analysis.remarks);
    let written = match &arguments.out {
        Some(folder) => structure_files::leave(&subject, &analysis.x, &inputs(arguments, &subject), folder)?,
        None => Vec::new(),
    };
    let problem = subject.problem();
    output::print(|out| if arguments.json { analysis.write_json(problem, out) } else { show::text(&analysis, problem, out) })?;
    if !arguments.json {
        output::print(|out| written.iter().try_for_each(|path| writeln!(out, "written: {}", path.display())))?;
    }
    Ok(0)
}

/// Everything that is read, none of which an output may take the place of.
fn inputs(arguments: &Analyse, subject: &Subject) -> Inputs {
    let mut inputs = subject.inputs.clone();
    arguments.answer.iter().for_each(|answer| inputs.add(answer));
    inputs
}
