//! `[solver]`: what is accepted, and when to give up. fmincon's names and defaults where it has them.

/// Backends by name, built in or not.
pub const BACKENDS: &[&str] = &["nlopt", "argmin"];

/// Names of NLopt's algorithms in files and on the command line.
pub const NLOPT_ALGORITHMS: &[&str] =
    &["auto", "slsqp", "mma", "ccsaq", "auglag", "lbfgs", "tnewton", "var2", "cobyla", "bobyqa", "isres", "mlsl"];

/// Names of the algorithms run by argmin.
pub const ARGMIN_ALGORITHMS: &[&str] = &["auto", "interior-point", "augmented-lagrangian"];

/// The settings of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Backends by name, in order; empty: all that are built in.
    pub backends: Vec<String>,
    /// Largest accepted dual infeasibility and complementarity (fmincon's TolFun). In (0, 1).
    pub optimality_tolerance: f64,
    /// Relative step below which a run has stopped moving (TolX). In (0, 1).
    pub step_tolerance: f64,
    /// Largest accepted primal infeasibility, relative (TolCon). In (0, 1).
    pub constraint_tolerance: f64,
    /// Iterations per backend (MaxIter).
    pub max_iterations: u64,
    /// Evaluations per backend (MaxFunEvals).
    pub max_evaluations: u64,
    /// Seconds for the whole command, all backends together.
    pub max_seconds: f64,
    /// NLopt's algorithm, or `auto`.
    pub nlopt_algorithm: String,
    /// argmin's algorithm, or `auto`.
    pub argmin_algorithm: String,
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
            nlopt_algorithm: "auto".into(),
            argmin_algorithm: "auto".into(),
        }
    }
}
