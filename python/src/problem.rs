//! A problem read, solved, verified, analysed.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use ribopt::files::Inputs;
use ribopt::report::Findings;
use ribopt::report::answer::EarlierAnswer;
use ribopt::report::result;
use ribopt::run::analyse::analyse;
use ribopt::run::choice::choose;
use ribopt::run::solve::{Request, solve, solve_in_memory};
use ribopt::run::verify::verify_answer;
use ribopt::run::{RunError, Subject};

use super::failure::{not_analysed, refused};
use super::model::Model;
use super::watch::{Calling, watched};

/// A problem, checked and assembled.
#[pyclass(frozen, module = "ribopt._native")]
pub struct Problem {
    subject: Arc<Subject>,
}

/// An answer: the path of a file, or the text of one.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Answer {
    path: Option<PathBuf>,
    text: Option<String>,
}

impl Answer {
    fn read(&self) -> Result<EarlierAnswer, RunError> {
        match (&self.path, &self.text) {
            (Some(path), _) => Ok(EarlierAnswer::read(path)?),
            (None, text) => Ok(EarlierAnswer::of_text(text.as_deref().unwrap_or_default())?),
        }
    }
}

/// What is accepted and when to give up; what is left out stays as the file says.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Limits {
    optimality_tolerance: Option<f64>,
    step_tolerance: Option<f64>,
    constraint_tolerance: Option<f64>,
    max_iterations: Option<u64>,
    max_evaluations: Option<u64>,
    max_seconds: Option<f64>,
}

impl Limits {
    /// The same ranges as the problem file's and the command line's.
    fn check(&self) -> Result<(), RunError> {
        let wrong = |name: &str, range: &str| Err(RunError::Choice(format!("{name}: {range} is expected")));
        let tolerances = [
            ("optimality_tolerance", self.optimality_tolerance),
            ("step_tolerance", self.step_tolerance),
            ("constraint_tolerance", self.constraint_tolerance),
        ];
        for (name, tolerance) in tolerances {
            if tolerance.is_some_and(|tolerance| !(tolerance > 0.0 && tolerance < 1.0)) {
                return wrong(name, "a number between 0 and 1, such as 1e-6,");
            }
        }
        for (name, count) in [("max_iterations", self.max_iterations), ("max_evaluations", self.max_evaluations)] {
            if count == Some(0) {
                return wrong(name, "a whole number, 1 or more,");
            }
        }
        if self.max_seconds.is_some_and(|seconds| !(seconds >= 0.0 && seconds.is_finite())) {
            return wrong("max_seconds", "a number of seconds, 0 or more,");
        }
        Ok(())
    }
}

/// What is asked of a run.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    backends: Vec<String>,
    algorithm: Option<String>,
    start: Option<Answer>,
    starts: Option<usize>,
    out: Option<PathBuf>,
    plot: bool,
    limits: Limits,
    watch: Option<Py<PyAny>>,
}

/// The result as JSON, the folder it was left in, what kept it from being left, and what a signal or the watching function raised.
type Solution = (String, Option<PathBuf>, Option<String>, Option<PyErr>);

impl Problem {
    fn of(py: Python<'_>, read: impl FnOnce() -> Result<Subject, RunError> + Send) -> PyResult<Problem> {
        let subject = py.detach(read).map_err(|error| refused(py, &error))?;
        Ok(Problem { subject: Arc::new(subject) })
    }

    /// The problem within other limits.
    fn within(&self, limits: &Limits) -> Result<Subject, RunError> {
        limits.check()?;
        let mut subject = (*self.subject).clone();
        let settings = &mut subject.settings;
        settings.optimality_tolerance = limits.optimality_tolerance.unwrap_or(settings.optimality_tolerance);
        settings.step_tolerance = limits.step_tolerance.unwrap_or(settings.step_tolerance);
        settings.constraint_tolerance = limits.constraint_tolerance.unwrap_or(settings.constraint_tolerance);
        settings.max_iterations = limits.max_iterations.unwrap_or(settings.max_iterations);
        settings.max_evaluations = limits.max_evaluations.unwrap_or(settings.max_evaluations);
        settings.max_seconds = limits.max_seconds.unwrap_or(settings.max_seconds);
        Ok(subject)
    }
}

fn json(findings: &Findings<'_>) -> PyResult<String> {
    let mut text = Vec::new();
    result::write(findings, &mut text)?;
    Ok(String::from_utf8(text)?)
}

#[pymethods]
impl Problem {
    #[staticmethod]
    fn read(py: Python<'_>, file: PathBuf, changes: Vec<String>) -> PyResult<Problem> {
        Problem::of(py, || Subject::read(&file, &changes))
    }

    #[staticmethod]
    fn of_text(py: Python<'_>, name: &str, text: &str, folder: PathBuf, changes: Vec<String>) -> PyResult<Problem> {
        Problem::of(py, || Subject::of_text_in(name, text, &folder, &changes))
    }

    #[getter]
    fn title(&self) -> &str {
        &self.subject.about.title
    }

    #[getter]
    fn file(&self) -> &str {
        &self.subject.about.file
    }

    #[getter]
    fn problem_class(&self) -> String {
        self.subject.class().to_string()
    }

    #[getter]
    fn sign(&self) -> f64 {
        self.subject.sign()
    }

    #[getter]
    fn objective(&self) -> &str {
        &self.subject.about.objective
    }

    #[getter]
    fn units(&self) -> Vec<(String, String)> {
        self.subject.about.units.clone()
    }

    #[getter]
    fn has_structure(&self) -> bool {
        self.subject.about.has_structure
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.subject.warnings.iter().map(|warning| warning.trim_end().to_owned()).collect()
    }

    fn model(&self, restated: bool) -> Model {
        Model::new(Arc::clone(&self.subject), restated)
    }

    fn solve(&self, py: Python<'_>, asked: Asked) -> PyResult<Solution> {
        let subject = self.within(&asked.limits).map_err(|error| refused(py, &error))?;
        let interrupt = AtomicBool::new(false);
        let (start, mut inputs): (_, Inputs) = (asked.start, subject.inputs.clone());
        start.iter().filter_map(|start| start.path.as_deref()).for_each(|path| inputs.add(path));
        let mut calling = Calling::new(asked.watch, &interrupt);
        let work = || -> Result<_, RunError> {
            if asked.starts == Some(0) {
                return Err(RunError::Choice("starts: a whole number, 1 or more, is expected".into()));
            }
            let start = start.as_ref().map(Answer::read).transpose()?;
            let request = Request {
                choices: choose(&asked.backends, asked.algorithm.as_deref(), &subject.settings)?,
                out: asked.out.as_deref(),
                start: start.as_ref(),
                inputs: &inputs,
                starts: asked.starts.unwrap_or_else(|| subject.usual_starts()),
                plot: asked.plot,
                interrupt: Some(&interrupt),
            };
            let run = if asked.out.is_some() { solve } else { solve_in_memory };
            run(&subject, &request, &mut calling)
        };
        let (solved, signalled) = watched(py, &interrupt, work)?;
        let solved = solved.map_err(|error| refused(py, &error))?;
        let folder = asked.out.is_some().then(|| solved.folder().to_path_buf());
        let unwritten = solved.unwritten.as_ref().map(ToString::to_string);
        Ok((json(&solved.findings(&subject))?, folder, unwritten, signalled.or(calling.raised)))
    }

    fn verify(&self, py: Python<'_>, answer: Answer, limits: Limits) -> PyResult<String> {
        let subject = self.within(&limits).map_err(|error| refused(py, &error))?;
        let verified = py.detach(|| verify_answer(&subject, &answer.read()?)).map_err(|error| refused(py, &error))?;
        json(&verified.findings(&subject))
    }

    fn analyse(&self, py: Python<'_>, answer: Option<Answer>, gradient: bool) -> PyResult<(String, Vec<String>)> {
        let work = || {
            let answer = answer.as_ref().map(Answer::read).transpose()?;
            analyse(&self.subject, answer.as_ref(), gradient)
        };
        let analysis = py.detach(work).map_err(|error| not_analysed(py, &error))?;
        let mut text = Vec::new();
        analysis.write_json(self.subject.problem(), &mut text).map_err(|error| PyOSError::new_err(error.to_string()))?;
        Ok((String::from_utf8(text)?, analysis.remarks.iter().map(|remark| remark.trim_end().to_owned()).collect()))
    }
}
