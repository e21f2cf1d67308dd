//! One solve as `ribopt solve` does it, and a point taken back to the file it comes from.

use std::any::Any;
use std::collections::HashMap;
use std::fmt::Write;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

use ribopt::certificate::{Certificate, Certifier, Extent, Tolerances};
use ribopt::crosscheck::{Outcome, Status};
use ribopt::files::Inputs;
use ribopt::model::Class;
use ribopt::run::choice::choose;
use ribopt::run::solve::{Request, solve};
use ribopt::run::verify::verify;
use ribopt::run::{RunError, Subject};

use super::draft::Draft;
use super::judge::FEASIBLE_IN_FILE;

/// What a run found; values are the file's, to be minimised, whatever the draft was.
#[derive(Debug, Clone)]
pub struct Run {
    pub status: Status,
    pub scope: Extent,
    pub class: Class,
    pub objective: Option<f64>,
    pub lower_bound: Option<f64>,
    pub message: String,
    /// How large its answer makes the variables, by their names: what the certificate measures them by, where there is one.
    pub sizes: HashMap<String, f64>,
    pub seconds: f64,
    /// What the file itself says of a certified point taken back to it.
    pub in_file: Option<InFile>,
}

/// A point taken back to the file.
#[derive(Debug, Clone)]
pub struct InFile {
    pub certificate: Certificate,
    /// By how much it misses the file's limits, relative to what their tolerance is relative to in the draft.
    pub misses: f64,
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
    let (in_file_units, sizes) = (|value: f64| value / draft.factor, sizes(&subject, &outcome));
    Ok(Run {
        status: outcome.status,
        scope: outcome.scope,
        class: subject.class(),
        objective: outcome.objective.map(in_file_units),
        lower_bound: outcome.lower_bound.map(in_file_units),
        message: outcome.message,
        sizes,
        seconds,
        in_file,
    })
}

fn sizes(subject: &Subject, outcome: &Outcome) -> HashMap<String, f64> {
    let measured = outcome.certificate.as_ref().map_or(&outcome.x, |certificate| &certificate.variable_scales);
    measured.iter().enumerate().map(|(j, &size)| (subject.model().variable_name(j), size.abs())).collect()
}

fn solved(path: &Path, folder: &Path, seconds: f64) -> Result<(Subject, Outcome), String> {
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
fn judged_in_file(subject: &Subject, x: &[f64], draft: &Draft, original: &Path, folder: &Path) -> Result<Option<InFile>, String> {
    let mut answer = String::from("name,value\n");
    let (mut place, mut offsets) = (HashMap::new(), HashMap::new());
    for origin in &draft.origins {
        let at = (0..x.len()).find(|&j| subject.model().variable_name(j) == origin.now);
        let value = at.map(|j| origin.steps.iter().fold(x[j], |value, step| step.apply(value)));
        let value = value.ok_or_else(|| format!("the tool lost variable {}", origin.in_file))?;
        let _ = writeln!(answer, "{},{value}", origin.in_file);
        place.insert(origin.in_file.as_str(), value);
        offsets.insert(origin.in_file.as_str(), origin.offset());
    }
    let file = folder.join("in-file.csv");
    fs::write(&file, answer).map_err(|cause| cause.to_string())?;
    let subject = Subject::read(original, &[]).map_err(|error| error.to_string())?;
    match verify(&subject, &file).map(|verified| verified.outcome) {
        Err(RunError::Answer(_)) => Ok(None),
        Err(other) => Err(other.to_string()),
        Ok(outcome) if outcome.certificate.is_none() => {
            Err(format!("certified where the file has no value: {}", outcome.message))
        }
        Ok(outcome) => {
            let in_order = |values: &HashMap<&str, f64>| {
                let model = subject.model();
                let value = |j: usize| values.get(model.variable_name(j).as_str()).copied();
                (0..model.meta().variables()).map(value).collect::<Option<Vec<f64>>>()
            };
            let (x, offsets) = (in_order(&place), in_order(&offsets));
            let misses = x.zip(offsets).map_or(0.0, |(x, offsets)| misses(&subject, &x, &offsets));
            Ok(outcome.certificate.map(|certificate| InFile { certificate, misses }))
        }
    }
}

/// By how much a point of the file misses its limits: not at all, where one that meets them lies within what a point taken back may
/// miss them by; else relative to the rows' terms, each variable counted from where the draft counts it.
fn misses(subject: &Subject, x: &[f64], offsets: &[f64]) -> f64 {
    let model = subject.model();
    let tolerances = Tolerances { constraint: FEASIBLE_IN_FILE, ..Tolerances::default() };
    let nearest = Certifier::new(model, subject.class(), tolerances).primal_infeasibility(x);
    if nearest.is_some_and(|miss| miss <= FEASIBLE_IN_FILE) {
        return 0.0;
    }
    let meta = model.meta();
    let (mut rows, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
    if model.constraints(x, &mut rows).is_err() || model.jacobian(x, &mut jacobian).is_err() {
        return f64::INFINITY;
    }
    let magnitude = |j: usize| x[j].abs() + offsets[j];
    let beyond = |value: f64, lower: f64, upper: f64| (lower - value).max(value - upper).max(0.0);
    let row = |i: usize| {
        let entries = meta.jacobian.range(i).map(|at| (jacobian[at] * magnitude(meta.jacobian.columns[at] as usize)).abs());
        let limits = [meta.row_lower[i], meta.row_upper[i]].map(f64::abs).into_iter().filter(|limit| limit.is_finite());
        let terms = entries.chain(limits).fold(f64::MIN_POSITIVE, f64::max);
        beyond(rows[i], meta.row_lower[i], meta.row_upper[i]) / terms
    };
    let bound = |j: usize| beyond(x[j], meta.lower[j], meta.upper[j]) / magnitude(j).max(f64::MIN_POSITIVE);
    (0..rows.len()).map(row).chain((0..x.len()).map(bound)).fold(0.0, f64::max)
}
