//! The schema of `[solver]`.

use serde_json::{Value, json};

use super::object;
use crate::problem::settings::{AUTO, BACKENDS, BackendNames, Settings};

pub(super) fn solver() -> Value {
    let defaults = Settings::default();
    let tolerance = |value: f64, what: &str| json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1, "default": value, "description": what });
    let count = |value: u64, what: &str| json!({ "type": "integer", "minimum": 1, "default": value, "description": what });
    let names: Vec<&str> = BACKENDS.iter().map(|backend| backend.name).collect();
    let mut keys = json!({
            "backends": { "type": "array", "items": { "enum": names }, "description": "Default: all that are built in." },
            "optimality_tolerance": tolerance(defaults.optimality_tolerance, "Largest accepted dual infeasibility (TolFun)."),
            "step_tolerance": tolerance(defaults.step_tolerance, "Relative step below which a run has stopped (TolX)."),
            "constraint_tolerance": tolerance(defaults.constraint_tolerance, "Largest accepted violation, relative (TolCon)."),
            "max_iterations": count(defaults.max_iterations, "Iterations per backend."),
            "max_evaluations": count(defaults.max_evaluations, "Evaluations per backend."),
            "max_seconds": { "type": "number", "minimum": 0, "default": defaults.max_seconds,
                "description": "Seconds for the whole command." },
    });
    for backend in BACKENDS {
        keys[backend.name] = algorithm(backend);
    }
    object(keys, &[])
}

fn algorithm(backend: &BackendNames) -> Value {
    let names: Vec<&str> = [AUTO].iter().chain(backend.algorithms).copied().collect();
    object(json!({ "algorithm": { "enum": names, "default": AUTO } }), &[])
}
