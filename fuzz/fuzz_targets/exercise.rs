//! What both targets do with files: read them, assemble, classify, evaluate.

use std::fs;
use std::path::PathBuf;

use ribopt::model::{EvaluationError, Model};
use ribopt::run::Subject;

/// A folder of this process in memory, where there is such a thing.
pub fn folder() -> PathBuf {
    let memory = PathBuf::from("/dev/shm");
    let base = if memory.is_dir() { memory } else { std::env::temp_dir() };
    let folder = base.join(format!("ribopt-fuzz-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a writable folder");
    folder
}

/// Reads the problem file in the folder; where it has no mistakes, evaluates everything at the start and off it.
pub fn exercise(path: &std::path::Path) {
    let Ok(subject) = Subject::read(path, &[]) else { return };
    let model = subject.model();
    let meta = model.meta();
    let start = meta.start.clone();
    assert!((0..start.len()).all(|j| meta.lower[j] <= start[j] && start[j] <= meta.upper[j]), "a start outside its bounds");
    let moved = start.iter().map(|x| x * 1.25 + 0.125).collect();
    let zero = vec![0.0; start.len()];
    for x in [start, moved, zero] {
        evaluate(model, &x);
        subject.volumes(&x);
    }
}

/// Values and derivatives: finite numbers, or an error that names a term and a cause.
fn evaluate(model: &dyn Model, x: &[f64]) {
    let meta = model.meta();
    let mut gradient = vec![0.0; meta.variables()];
    let mut rows = vec![0.0; meta.rows()];
    let mut jacobian = vec![0.0; meta.jacobian.len()];
    let mut hessian = vec![0.0; meta.hessian.len()];
    sound(model.objective(x).map(|_| ()), &[]);
    let outcome = model.gradient(x, &mut gradient).map(|_| ());
    sound(outcome, &gradient);
    let outcome = model.constraints(x, &mut rows);
    sound(outcome, &rows);
    let outcome = model.jacobian(x, &mut jacobian);
    sound(outcome, &jacobian);
    let multipliers = vec![1.0; meta.rows()];
    let outcome = model.hessian(x, 1.0, &multipliers, &mut hessian);
    sound(outcome, &hessian);
}

fn sound(outcome: Result<(), EvaluationError>, values: &[f64]) {
    match outcome {
        Ok(()) => assert!(values.iter().all(|value| value.is_finite()), "a value that is no number passes for one"),
        Err(EvaluationError::Invalid { term, cause }) => assert!(!term.is_empty() && !cause.is_empty()),
        Err(EvaluationError::Stopped(_)) => unreachable!("nothing stops an evaluation here"),
    }
}
