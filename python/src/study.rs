//! Studies: many runs of one problem, their table left in a folder.

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use ribopt::run::folder::default_folder;
use ribopt::study::{Ended, Request, Seen, Share, Store, Study, StudyError, TABLE, Table, merge, retry, work};
use serde::Serialize;

use super::failure::{exception, refused};
use super::watch::watched;

/// What is asked of a study.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Swept {
    study: PathBuf,
    out: Option<PathBuf>,
    jobs: usize,
    fresh: bool,
    retry: Vec<String>,
    watch: Option<Py<PyAny>>,
}

/// What came of it, beside the table.
#[derive(Serialize)]
struct Summary<'a> {
    title: &'a str,
    names: Vec<&'a str>,
    missing: usize,
    status: Vec<(&'a str, usize)>,
}

/// The table's path, the summary as JSON, and what a signal or the watching function raised.
type Outcome = (PathBuf, String, Option<PyErr>);

#[pyfunction]
pub fn sweep(py: Python<'_>, asked: Swept) -> PyResult<Outcome> {
    let (interrupt, raised) = (AtomicBool::new(false), Mutex::new(None));
    let watch = |seen: Seen| {
        let Some(function) = &asked.watch else { return };
        let mut raised = raised.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if raised.is_none() {
            *raised = Python::attach(|py| function.call1(py, (seen.done, seen.of)).err());
            interrupt.fetch_or(raised.is_some(), Ordering::SeqCst);
        }
    };
    let all = || -> Result<_, StudyError> {
        let study = Study::read(&asked.study)?;
        let folder = asked.out.clone().unwrap_or_else(|| default_folder(&asked.study));
        let store = Store::open(&study, &folder, asked.fresh)?;
        retry(&study, &store, &asked.retry)?;
        let request = Request { jobs: asked.jobs, share: Share::default(), interrupt: Some(&interrupt), watch: &watch };
        let table = match work(&study, &store, &request)? {
            Ended::Done => merge(&study, &store)?,
            Ended::Interrupted => Table::of(&study, &store),
        };
        Ok((folder.join(TABLE), study, table))
    };
    let (found, signalled) = watched(py, &interrupt, all)?;
    let (place, study, table) = found.map_err(|error| match error {
        StudyError::Run(error) => refused(py, &error),
        other => exception(py, "StudyError", &other.to_string(), &()),
    })?;
    let summary = Summary { title: &study.title, names: study.names(), missing: table.missing, status: table.counts() };
    let text = serde_json::to_string(&summary).map_err(|error| PyValueError::new_err(error.to_string()))?;
    let raised = raised.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    Ok((place, text, signalled.or(raised)))
}
