//! One solve as `ribopt solve` does it, and a point taken back to the file it comes from.

use std::any::Any;
use std::fmt::Write;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

use ribopt::certificate::{Certificate, Extent};
use ribopt::crosscheck::Status;
use ribopt::files::Inputs;
use ribopt::model::Class;
use ribopt::run::choice::choose;
use ribopt::run::solve::{Request, solve};
use ribopt::run::verify::verify;
use ribopt::run::{RunError, Subject};

use super::draft::Draft;

/// What a run found; values are the file's, to be minimised, whatever the draft was.
#[derive(Debug, Clone)]
pub struct Run {
    pub status: Status,
    pub scope: Extent,
    pub class: Class,
    pub objective: Option<f64>,
    pub lower_bound: Option<f64>,
    pub message: String,
    pub seconds: f64,
    /// What the file itself says of a certified point taken back to it.
    pub in_file: Option<Certificate>,
}

/// Solves the problem at `path` for at most `seconds`; `folder` is the run's own. What it could not even begin is an error.
pub fn run(path: &Path, draft: &Draft, original: &Path, folder: &Path, seconds: f64) -> Result<Run, String> {
    let begin = Instant::now();
    let solved = catch_unwind(AssertUnwindSafe(|| solved(path, folder, seconds)));
    let (subject, outcome) = solved.unwrap_or_else(|panic| Err(format!("panic: {}", panic_text(&*panic))))?;
    let seconds = begin.elapsed().as_secs_f64();
    let in_file = match outcome.status {
        Status::Certified => judged_in_file(&subject, &outcome.x, draft, original, folder)?,
        _ => None,
    };
    let in_file_units = |value: f64| value / draft.factor;
    Ok(Run {
        status: outcome.status,
        scope: outcome.scope,
        class: subject.class(),
        objective: outcome.objective.map(in_file_units),
        lower_bound: outcome.lower_bound.map(in_file_units),
        message: outcome.message,
        seconds,
        in_file,
    })
}

fn solved(path: &Path, folder: &Path, seconds: f64) -> Result<(Subject, ribopt::crosscheck::Outcome), String> {
    let mut subject = Subject::read(path, &[]).map_err(|error| error.to_string())?;
    subject.settings.max_seconds = seconds;
    let choices = choose(&[], None, &subject.settings).map_err(|error| error.to_string())?;
    let inputs = Inputs::new([path.to_path_buf()]);
    let request = Request { choices, out: Some(folder), start: None, inputs: &inputs, starts: 1, plot: false, interrupt: None };
    let outcome = solve(&subject, &request, &mut ()).map_err(|error: RunError| error.to_string())?.outcome;
    Ok((subject, outcome))
}

fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("no words").to_string()
}

/// `ribopt verify` of the original file at the point; nothing where the file's model has auxiliary variables besides the user's.
fn judged_in_file(
    subject: &Subject,
    x: &[f64],
    draft: &Draft,
    original: &Path,
    folder: &Path,
) -> Result<Option<Certificate>, String> {
    let mut answer = String::from("name,value\n");
    for origin in &draft.origins {
        let at = (0..x.len()).find(|&j| subject.model().variable_name(j) == origin.now);
        let value = at.map(|j| origin.steps.iter().fold(x[j], |value, step| step.apply(value)));
        let value = value.ok_or_else(|| format!("the tool lost variable {}", origin.in_file))?;
        let _ = writeln!(answer, "{},{value}", origin.in_file);
    }
    let file = folder.join("in-file.csv");
    fs::write(&file, answer).map_err(|cause| cause.to_string())?;
    let subject = Subject::read(original, &[]).map_err(|error| error.to_string())?;
    match verify(&subject, &file) {
        Err(RunError::Answer(_)) => Ok(None),
        Err(other) => Err(other.to_string()),
        Ok(outcome) if outcome.certificate.is_none() => {
            Err(format!("certified where the file has no value: {}", outcome.message))
        }
        Ok(outcome) => Ok(outcome.certificate),
    }
}
