//! `[solver]`: what is accepted, and when to give up. fmincon's names and defaults where it has them.

use std::collections::BTreeMap;

/// What files and the command line may call a backend and its algorithms, whether it is built in or not.
#[derive(Debug)]
pub struct BackendNames {
    /// The backend.
    pub name: &'static str,
    /// Its algorithms, besides [`AUTO`].
    pub algorithms: &'static [&'static str],
}

/// The algorithm that lets the backend choose.
pub const AUTO: &str = "auto";

/// All backends. `run::choice` tests that those built in have these names.
pub const BACKENDS: &[BackendNames] = &[
    BackendNames {
        name: "nlopt",
        algorithms: &["slsqp", "mma", "ccsaq", "auglag", "lbfgs", "tnewton", "var2", "cobyla", "bobyqa", "isres", "mlsl"],
    },
    BackendNames { name: "argmin", algorithms: &["interior-point", "augmented-lagrangian"] },
];

/// The settings of one run.
///
/// ```
/// use ribopt::Settings;
///
/// let hurried = Settings { backends: vec!["argmin".into()], max_seconds: 5.0, ..Settings::default() };
/// assert_eq!((hurried.algorithm("argmin"), hurried.optimality_tolerance), ("auto", 1e-6));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Backends by name, in order; empty: all that are built in.
    pub backends: Vec<String>,
    /// Largest accepted dual infeasibility and complementarity (fmincon's TolFun). In (0, 1); 1e-6 by default.
    pub optimality_tolerance: f64,
    /// Relative step below which a run has stopped moving (TolX). In (0, 1); 1e-6 by default.
    pub step_tolerance: f64,
    /// Largest accepted primal infeasibility, relative (TolCon). In (0, 1); 1e-8 by default.
    pub constraint_tolerance: f64,
    /// Iterations per backend (MaxIter); 500 000 by default.
    pub max_iterations: u64,
    /// Evaluations per backend (MaxFunEvals); ten million by default.
    pub max_evaluations: u64,
    /// Seconds for the whole command, all backends together; 600 by default.
    pub max_seconds: f64,
    /// Algorithms by the name of their backend; [`AUTO`] for those left out.
    pub algorithms: BTreeMap<String, String>,
}

impl Settings {
    /// The algorithm asked of a backend.
    pub fn algorithm(&self, backend: &str) -> &str {
        self.algorithms.get(backend).map_or(AUTO, String::as_str)
    }
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            backends: Vec::new(),
            optimality_tolerance: 1e-6,
            step_tolerance: 1e-6,
            constraint_tolerance: 1e-8,
            max_iterations: 500_000,
            max_evaluations: 10_000_000,
            max_seconds: 600.0,
            algorithms: BTreeMap::new(),
        }
    }
}
