//! What a solve runs: data made from sizes and kinds of rows, nothing else.
//!
//! | `auto` for | runs | and then |
//! |---|---|---|
//! | bounds only | LBFGS | SLSQP from there, which is more exact, or a truncated Newton method where SLSQP's n³ is too much |
//! | rows, and SLSQP's n²(n + m) is affordable | SLSQP | SLSQP from there, in units of the new point and with its independent equalities |
//! | rows, and it is not | MMA for inequalities, otherwise AUGLAG | |
//!
//! Where SLSQP has not passed by then, it runs once more from beside its end: it stays at points where everything is flat to
//! second order (y ≥ x³ at 0), and at a saddle. An algorithm that was named runs, and once more from its own end where it uses
//! gradients. Every further start is the caller's.

use super::algorithms::{Algorithm, find};
use crate::model::Meta;

/// Where an attempt starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StartPoint {
    /// The job's start.
    Start,
    /// The best point so far.
    Best,
    /// The best point so far, each variable moved by up to 1 % of its size, always in the same way.
    Beside,
}

/// One attempt.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// The algorithm.
    pub algorithm: &'static Algorithm,
    /// Where it starts.
    pub from: StartPoint,
    /// Evaluations at the most.
    pub evaluations: u64,
}

/// The plan of one named algorithm.
pub(super) fn named(algorithm: &'static Algorithm, meta: &Meta) -> Vec<Step> {
    let n = meta.variables() as u64;
    let evaluations = algorithm.evaluations_per_variable.map_or(100_000 + 100 * n, |each| each * (n + 1));
    let is_local = algorithm.gradients && algorithm.evaluations_per_variable.is_none();
    let starts: &[StartPoint] = if is_local { &[StartPoint::Start, StartPoint::Best] } else { &[StartPoint::Start] };
    starts.iter().map(|&from| Step { algorithm, from, evaluations }).collect()
}

/// Variables beyond which `auto` does not even try: with 60 000 (ribs with bounds only) NLopt's limited-memory methods stop at
/// wrong points after minutes.
const MOST_VARIABLES: usize = 20_000;

/// Why `auto` leaves the problem to others, if it does.
pub(super) fn too_much(meta: &Meta) -> Option<String> {
    let (count, rows) = (meta.variables(), meta.rows());
    if count > MOST_VARIABLES {
        let why = "beyond that NLopt's methods stop far from the answer, use the argmin backend";
        return Some(format!("auto is for up to {MOST_VARIABLES} variables, and there are {count}; {why}"));
    }
    let why = "its dense algorithms would take too long on them, use the argmin backend";
    automatic(meta)
        .is_empty()
        .then(|| format!("auto is for small problems, and there are {count} variables and {rows} rows; {why}"))
}

/// The plan of `auto`; empty where nothing is affordable.
pub(super) fn automatic(meta: &Meta) -> Vec<Step> {
    let ways: &[(&str, &[&str])] = match meta.rows() {
        0 => &[("lbfgs", &["slsqp", "tnewton"])],
        _ => &[("slsqp", &["slsqp"]), ("mma", &[]), ("auglag", &[])],
    };
    let found = ways.iter().find_map(|&(first, then)| Some((step(first, StartPoint::Start, meta)?, then)));
    let Some((first, then)) = found else { return Vec::new() };
    let polish = then.iter().find_map(|&name| step(name, StartPoint::Best, meta));
    let beside =
        polish.filter(|polish| polish.algorithm.name == "slsqp").map(|polish| Step { from: StartPoint::Beside, ..polish });
    [first].into_iter().chain(polish).chain(beside).collect()
}

fn step(name: &str, from: StartPoint, meta: &Meta) -> Option<Step> {
    let algorithm = find(name)?;
    let wanted = if name == "auglag" { 20_000 } else { 2_000 + 20 * meta.variables() as u64 };
    let evaluations = algorithm.affordable(meta, wanted);
    (evaluations > 0).then_some(Step { algorithm, from, evaluations })
}
