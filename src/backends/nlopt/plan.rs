//! What `auto` tries, in order: data made from sizes and kinds of rows, nothing else.

use super::algorithms::{Algorithm, find};
use crate::model::Meta;

/// Where an attempt starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum From {
    /// The job's start.
    Start,
    /// The best point so far.
    Best,
    /// The job's start, moved by up to this share of each variable's size.
    NearStart(f64),
    /// The best point so far, moved likewise: leaves saddles and maxima.
    NearBest(f64),
}

/// The unit of each variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unit {
    /// max(|x_j|, |start_j|), or 1 where both are 0.
    Magnitude,
    /// 1
    One,
}

/// One attempt of `auto`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// The algorithm.
    pub algorithm: &'static Algorithm,
    /// Where it starts.
    pub from: From,
    /// Units of the variables.
    pub unit: Unit,
    /// How often it is started again from the best point, rescaled there, while that helps.
    pub restarts: u32,
    /// Evaluations at the most.
    pub evaluations: u64,
}

/// What is tried.
pub(super) struct Plan {
    /// One after the other, until the certificate passes.
    pub steps: Vec<Step>,
    /// Once it has passed: cheap looks for a better minimum, each once.
    pub opinions: Vec<Step>,
}

/// The plan of one named algorithm.
pub(super) fn named(algorithm: &'static Algorithm, meta: &Meta) -> Plan {
    let n = meta.variables() as u64;
    let evaluations = algorithm.evaluations_per_variable.map_or(100_000 + 100 * n, |each| each * (n + 1));
    let restarts = if algorithm.gradients && algorithm.evaluations_per_variable.is_none() { 3 } else { 0 };
    let steps = vec![Step { algorithm, from: From::Start, unit: Unit::Magnitude, restarts, evaluations }];
    Plan { steps, opinions: Vec::new() }
}

/// Variables beyond which `auto` does not even try: with 60 000 (ribs with bounds only) NLopt's limited-memory methods stop at
/// wrong points after minutes.
const MOST_VARIABLES: usize = 20_000;

/// Why `auto` leaves the problem to others, if it does.
pub(super) fn too_many(meta: &Meta) -> Option<String> {
    let count = meta.variables();
    let why = "beyond that NLopt's methods stop far from the answer, use the argmin backend";
    (count > MOST_VARIABLES).then(|| format!("auto is for up to {MOST_VARIABLES} variables, and there are {count}; {why}"))
}

/// The plan of `auto`. An algorithm that cannot take the problem, or would be slow on it, is left out.
pub(super) fn automatic(meta: &Meta) -> Plan {
    let wanted = if meta.rows() == 0 { BOUNDS } else { ROWS };
    let quick = |name: &str| find(name).is_some_and(|algorithm| algorithm.is_quick(meta));
    let mut steps: Vec<Step> = wanted.iter().filter(|line| quick(line.0)).filter_map(|line| step(line, meta)).collect();
    if steps.is_empty() {
        steps = LAST.iter().filter_map(|line| step(line, meta)).collect();
    }
    let is_linear = meta.objective_is_linear && meta.row_is_linear.iter().all(|&linear| linear);
    let is_small = meta.variables() <= SMALL && meta.rows() <= SMALL && !is_linear;
    let capped = |step: Step| Step { evaluations: step.evaluations.min(OPINION), ..step };
    let opinions = OPINIONS.iter().filter(|_| is_small).filter_map(|line| step(line, meta)).map(capped).collect();
    Plan { steps, opinions }
}

type Line = (&'static str, From, Unit, u32);

/// Variables and rows up to which second opinions cost next to nothing.
const SMALL: usize = 50;

/// Other ways from the same start, which may lead to another minimum.
const OPINIONS: &[Line] = &[
    ("slsqp", From::Start, Unit::One, 0),
    ("slsqp", From::NearStart(0.5), Unit::Magnitude, 0),
    ("mma", From::Start, Unit::Magnitude, 0),
    ("auglag", From::Start, Unit::Magnitude, 0),
];

/// Evaluations of one second opinion at the most.
const OPINION: u64 = 300;

/// For bounds only.
const BOUNDS: &[Line] = &[
    ("lbfgs", From::Start, Unit::Magnitude, 3),
    ("tnewton", From::Best, Unit::Magnitude, 2),
    ("slsqp", From::Best, Unit::Magnitude, 3),
    ("slsqp", From::Start, Unit::One, 2),
    ("lbfgs", From::NearBest(0.01), Unit::Magnitude, 2),
    ("slsqp", From::NearBest(0.1), Unit::Magnitude, 2),
    ("var2", From::Start, Unit::One, 2),
    ("tnewton", From::NearStart(0.1), Unit::Magnitude, 2),
    ("bobyqa", From::Best, Unit::Magnitude, 0),
    ("slsqp", From::Best, Unit::Magnitude, 2),
];

/// With rows; SLSQP is the most exact and polishes the others' answers.
const ROWS: &[Line] = &[
    ("slsqp", From::Start, Unit::Magnitude, 3),
    ("slsqp", From::Start, Unit::One, 2),
    ("slsqp", From::NearBest(0.01), Unit::Magnitude, 2),
    ("mma", From::Start, Unit::Magnitude, 0),
    ("slsqp", From::Best, Unit::Magnitude, 2),
    ("auglag", From::Start, Unit::Magnitude, 0),
    ("slsqp", From::Best, Unit::Magnitude, 2),
    ("slsqp", From::NearStart(0.05), Unit::Magnitude, 2),
    ("ccsaq", From::Best, Unit::Magnitude, 1),
    ("slsqp", From::NearBest(0.1), Unit::Magnitude, 2),
    ("slsqp", From::NearStart(0.5), Unit::One, 2),
    ("cobyla", From::Start, Unit::Magnitude, 0),
    ("slsqp", From::Best, Unit::Magnitude, 2),
];

/// Where nothing is quick: whatever can hold the problem.
const LAST: &[Line] = &[
    ("ccsaq", From::Start, Unit::Magnitude, 2),
    ("auglag", From::Best, Unit::Magnitude, 2),
    ("slsqp", From::Best, Unit::Magnitude, 2),
];

fn step(&(name, from, unit, restarts): &Line, meta: &Meta) -> Option<Step> {
    let algorithm = find(name).filter(|algorithm| algorithm.obstacle(meta).is_none())?;
    let n = meta.variables() as u64;
    let evaluations = match algorithm.gradients {
        true if name == "auglag" => 20_000,
        true => 2_000 + 20 * n,
        false => 500 * (n + 1).min(40),
    };
    Some(Step { algorithm, from, unit, restarts, evaluations })
}
