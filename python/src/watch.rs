//! Ctrl-C and iterations: a run goes on without the interpreter's lock, on a thread of its own, while the thread that asked for it
//! looks for signals.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{Builder, scope};
use std::time::Duration;

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use ribopt::backends::Iteration;
use ribopt::run::Watcher;

/// How often signals are looked for.
const EVERY: Duration = Duration::from_millis(50);

/// As much as the first thread of a program usually has: the command line runs there.
const STACK: usize = 8 << 20;

/// Does some work without the interpreter's lock. A signal handler that raises sets `interrupt`; its exception is brought back with
/// what the work came to.
pub fn watched<T: Send>(py: Python<'_>, interrupt: &AtomicBool, work: impl FnOnce() -> T + Send) -> PyResult<(T, Option<PyErr>)> {
    py.detach(|| {
        scope(|scope| {
            let (done, waiting) = channel::<()>();
            let work = move || {
                // Dropped when the work has ended, however it ends.
                let _done = done;
                work()
            };
            let worker = Builder::new().name("ribopt".into()).stack_size(STACK).spawn_scoped(scope, work)?;
            let mut raised = None;
            while waiting.recv_timeout(EVERY) == Err(RecvTimeoutError::Timeout) {
                if raised.is_none() {
                    raised = Python::attach(|py| py.check_signals()).err();
                    interrupt.fetch_or(raised.is_some(), Ordering::SeqCst);
                }
            }
            Ok((worker.join().unwrap_or_else(|panic| resume_unwind(panic)), raised))
        })
    })
}

/// Calls a Python function at every iteration; an exception of it stops the run.
pub struct Calling<'a> {
    function: Option<Py<PyAny>>,
    interrupt: &'a AtomicBool,
    backend: String,
    algorithm: String,
    /// What the function raised.
    pub raised: Option<PyErr>,
}

impl<'a> Calling<'a> {
    /// Of this function, if any.
    pub fn new(function: Option<Py<PyAny>>, interrupt: &'a AtomicBool) -> Calling<'a> {
        Calling { function, interrupt, backend: String::new(), algorithm: String::new(), raised: None }
    }

    fn call(&self, function: &Py<PyAny>, iteration: &Iteration<'_>) -> PyResult<()> {
        let numbers = [iteration.objective, iteration.feasibility, iteration.optimality, iteration.step_norm];
        let counts = (iteration.iteration, iteration.evaluations);
        Python::attach(|py| {
            let x: Bound<'_, PyBytes> = super::numbers::floats(py, iteration.x);
            function.call1(py, (self.backend.as_str(), self.algorithm.as_str(), counts, numbers, x)).map(drop)
        })
    }
}

impl Watcher for Calling<'_> {
    fn begin(&mut self, backend: &str, algorithm: &str) {
        (self.backend, self.algorithm) = (backend.to_owned(), algorithm.to_owned());
    }

    fn iteration(&mut self, iteration: &Iteration<'_>) {
        let Some(function) = self.function.as_ref().filter(|_| self.raised.is_none()) else { return };
        if let Err(error) = self.call(function, iteration) {
            self.raised = Some(error);
            self.interrupt.store(true, Ordering::SeqCst);
        }
    }

    fn end(&mut self) {}
}
