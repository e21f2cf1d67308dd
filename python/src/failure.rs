//! What goes wrong, as the exceptions of `ribopt._errors`: a message, and the details as JSON.

use pyo3::prelude::*;
use pyo3::types::PyString;
use ribopt::model::EvaluationError;
use ribopt::run::RunError;
use ribopt::run::analyse::AnalysisError;
use serde::Serialize;

/// The exception of this name with a message and details.
pub fn exception(py: Python<'_>, name: &str, message: &str, details: &impl Serialize) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let details =
            serde_json::to_string(details).map_err(|error| pyo3::exceptions::PyValueError::new_err(error.to_string()))?;
        let arguments = (PyString::new(py, name), PyString::new(py, message), PyString::new(py, &details));
        Ok(PyErr::from_value(py.import("ribopt._errors")?.call_method1("made", arguments)?))
    };
    made().unwrap_or_else(|error| error)
}

/// A run that could not begin, with its mistakes.
pub fn refused(py: Python<'_>, error: &RunError) -> PyErr {
    exception(py, "InputError", error.to_string().trim_end(), &error.mistakes())
}

/// A structure that could not be analysed.
pub fn not_analysed(py: Python<'_>, error: &AnalysisError) -> PyErr {
    match error {
        AnalysisError::Run(error) => refused(py, error),
        AnalysisError::Value(error) => no_value(py, error),
        other => exception(py, "AnalysisError", &other.to_string(), &()),
    }
}

/// A point without a value.
pub fn no_value(py: Python<'_>, error: &EvaluationError) -> PyErr {
    match error {
        EvaluationError::Invalid { term, cause } => exception(py, "EvaluationError", &error.to_string(), &(term, cause)),
        EvaluationError::Stopped(_) => exception(py, "EvaluationError", &error.to_string(), &("", error.to_string())),
    }
}
