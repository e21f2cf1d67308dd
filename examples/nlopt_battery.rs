//! Every algorithm of the NLopt backend on every kind of shape, for a memory checker to watch:
//!
//! `cargo build --profile quick --example nlopt_battery && valgrind --error-exitcode=9
//! target/quick/examples/nlopt_battery` prints the table of docs/nlopt.md and exits 0 where no algorithm read or wrote outside
//! its memory or decided by memory it never set. An argument limits it to lines of the table whose name holds it.

use std::time::{Duration, Instant};

use ribopt::backends::nlopt::Nlopt;
use ribopt::backends::{Backend, Job, Solution};
use ribopt::linear_algebra::Pattern;
use ribopt::model::{Budget, EvaluationError, Meta, Model};

/// Evaluations of one run: ISRES needs 20(n + 1) for one generation.
const EVALUATIONS: u64 = 400;

/// What the model answers with.
#[derive(Clone, Copy, PartialEq)]
enum Values {
    /// Rows with random coefficients, consistent, with a quadratic term that vanishes at the solution.
    Plain,
    /// Every row a multiple of one.
    Dependent,
    /// Rows without a common solution.
    Inconsistent,
    /// Gradients that are zero everywhere.
    ZeroGradients,
    /// Numbers around this one.
    Magnitude(f64),
    /// No number, away from the start.
    NotANumber,
}

struct Shape {
    /// The line of the table it counts for.
    class: String,
    free: usize,
    fixed: usize,
    inequalities: usize,
    equalities: usize,
    values: Values,
    bounds: [f64; 2],
}

impl Shape {
    fn new(class: &str, free: usize, inequalities: usize, equalities: usize) -> Self {
        let (values, bounds) = (Values::Plain, BOUNDS);
        Shape { class: class.into(), free, fixed: 0, inequalities, equalities, values, bounds }
    }

    /// n, fixed variables, inequalities, equalities.
    fn size(&self) -> String {
        format!("n = {} + {} fixed, {} inequalities, {} equalities", self.free, self.fixed, self.inequalities, self.equalities)
    }
}

const BOUNDS: [f64; 2] = [-2.0, 3.0];
const OPEN: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// The shapes, for n = 1, 2, 3, 7 and one of 60: sizes first, then what can be wrong with bounds and numbers.
fn shapes() -> Vec<Shape> {
    let mut all: Vec<Shape> = [1, 2, 3, 7].into_iter().flat_map(|n| sizes(n).into_iter().chain(oddities(n))).collect();
    all.push(Shape::new("m_eq = n + 10", 60, 30, 70));
    all
}

fn sizes(n: usize) -> Vec<Shape> {
    let mut all = vec![Shape::new("no rows", n, 0, 0)];
    for (class, m) in [
        ("inequalities, m < n", n / 2),
        ("inequalities, m = n", n),
        ("inequalities, m > n", 3 * n + 5),
        ("inequalities, m >> n", 60),
    ] {
        all.extend((m > 0).then(|| Shape::new(class, n, m, 0)));
    }
    for equalities in 1..=n + 8 {
        let class = match equalities.checked_sub(n) {
            None => "m_eq < n".into(),
            Some(0) => "m_eq = n".into(),
            Some(surplus) => format!("m_eq = n + {surplus}"),
        };
        all.push(Shape::new(&class, n, 0, equalities));
        all.push(Shape::new(&class, n, n + 1, equalities));
        all.push(Shape { bounds: OPEN, ..Shape::new("m_eq <= n + 8, no bounds", n, 0, equalities) });
    }
    all
}

fn oddities(n: usize) -> Vec<Shape> {
    let fixed = |fixed: usize, free: usize, class: &str| Shape { fixed, ..Shape::new(class, free, 2, fixed) };
    let mut all = vec![fixed(n + 6, n, "fixed variables, m_eq = n + 6"), fixed(n, 0, "all variables fixed")];
    let mut odd = |class: &str, values: Values, bounds: [f64; 2]| {
        for (rows, m, m_eq) in [("equalities", n + 1, n.min(2)), ("inequalities", n + 1, 0), ("no rows", 0, 0)] {
            all.push(Shape { values, bounds, ..Shape::new(&format!("{class}, {rows}"), n, m, m_eq) });
        }
    };
    odd("dependent rows", Values::Dependent, BOUNDS);
    odd("inconsistent rows", Values::Inconsistent, BOUNDS);
    odd("zero gradients", Values::ZeroGradients, BOUNDS);
    odd("no numbers beside the start", Values::NotANumber, BOUNDS);
    for size in [1e-320, 1e-150, 1e99, 1e101, 1e200, 1e307] {
        odd(&format!("numbers of {size:.0e}"), Values::Magnitude(size), BOUNDS);
    }
    let half_open = [-2.0, f64::INFINITY];
    for (class, bounds) in
        [("open", OPEN), ("half open", half_open), ("of 1e300", [-1e300, 1e300]), ("1e-310 apart", [0.0, 1e-310])]
    {
        odd(&format!("bounds {class}"), Values::Plain, bounds);
    }
    all
}

struct Battery {
    meta: Meta,
    values: Values,
    /// Row by row.
    coefficients: Vec<f64>,
}

impl Battery {
    fn new(shape: &Shape) -> Self {
        let (n, m) = (shape.free + shape.fixed, shape.inequalities + shape.equalities);
        let mut positions: Vec<(u32, u32)> = (0..m as u32).flat_map(|i| (0..n as u32).map(move |j| (i, j))).collect();
        let bound = |side: usize| (0..n).map(|j| if j < shape.free { shape.bounds[side] } else { 1.0 }).collect::<Vec<_>>();
        let lower_limit = |i: usize| if i < shape.equalities { 0.0 } else { f64::NEG_INFINITY };
        let meta = Meta {
            lower: bound(0),
            upper: bound(1),
            start: (0..n).map(|j| if j < shape.free { 0.5f64.clamp(shape.bounds[0], shape.bounds[1]) } else { 1.0 }).collect(),
            typical: Vec::new(),
            row_lower: (0..m).map(lower_limit).collect(),
            row_upper: vec![0.0; m],
            row_is_linear: vec![matches!(shape.values, Values::Dependent | Values::Inconsistent); m],
            objective_is_linear: false,
            jacobian: Pattern::from_positions(m, &mut positions),
            hessian: Pattern::from_positions(n, &mut Vec::new()),
            ..Meta::default()
        };
        let coefficient = |at: usize| match shape.values {
            Values::Dependent => (1 + at / n) as f64,
            Values::Inconsistent => (1 + at / n) as f64 * if (at / n).is_multiple_of(2) { 1.0 } else { -1.0 },
            _ => ((at * 7919 + 13) % 101) as f64 / 50.0 - 1.0,
        };
        let coefficients = (0..m * n).map(coefficient).collect();
        Battery { meta, values: shape.values, coefficients }
    }

    fn unit(&self) -> f64 {
        if let Values::Magnitude(size) = self.values { size } else { 1.0 }
    }

    fn check(&self, x: &[f64]) -> Result<(), EvaluationError> {
        let invalid = self.values == Values::NotANumber && x.iter().zip(&self.meta.start).any(|(x, start)| x < start);
        let error = EvaluationError::Invalid { term: "model".into(), cause: "no value here".into() };
        if invalid { Err(error) } else { Ok(()) }
    }

    /// 0 where everything is flat.
    fn slope(&self) -> f64 {
        if self.values == Values::ZeroGradients { 0.0 } else { 1.0 }
    }
}

impl Model for Battery {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.check(x)?;
        Ok(self.unit() * self.slope() * x.iter().enumerate().map(|(j, x)| (x - 0.1 * j as f64).powi(2)).sum::<f64>())
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        for (j, (slope, x)) in gradient.iter_mut().zip(x).enumerate() {
            *slope = 2.0 * self.unit() * self.slope() * (x - 0.1 * j as f64);
        }
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.check(x)?;
        for (i, (value, line)) in values.iter_mut().zip(self.coefficients.chunks(x.len())).enumerate() {
            let linear: f64 = line.iter().zip(x).map(|(a, x)| a * (x - 1.0)).sum();
            let bend = if self.meta.row_is_linear[i] { 0.0 } else { 0.1 * (x[0] - 1.0).powi(2) };
            let shift = if self.values == Values::Inconsistent { i as f64 } else { 0.0 };
            *value = self.unit() * (self.slope() * (linear + bend) + shift);
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.check(x)?;
        let n = x.len();
        for (at, value) in values.iter_mut().enumerate() {
            let bend = if at % n == 0 && !self.meta.row_is_linear[at / n] { 0.2 * (x[0] - 1.0) } else { 0.0 };
            *value = self.unit() * self.slope() * (self.coefficients[at] + bend);
        }
        Ok(())
    }

    fn hessian(&self, _: &[f64], _: f64, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }
}

fn solve(model: &Battery, algorithm: &str) -> Solution {
    let deadline = Some(Instant::now() + Duration::from_secs(60));
    let mut job = Job {
        algorithm,
        start: &model.meta.start,
        start_multipliers: None,
        optimality_tolerance: 1e-6,
        step_tolerance: 1e-6,
        constraint_tolerance: 1e-8,
        max_iterations: 100_000,
        budget: Budget { max_evaluations: EVALUATIONS, deadline, interrupt: None },
        stop_test: None,
        part_test: None,
        observer: &mut |_| {},
    };
    Nlopt.solve(model, &mut job)
}

fn main() {
    let wanted = std::env::args().nth(1).unwrap_or_default();
    let algorithms: Vec<&str> = ["auto"].into_iter().chain(Nlopt.algorithms().iter().copied()).collect();
    let mut table: Vec<(String, Vec<Vec<Cell>>)> = Vec::new();
    for shape in shapes().iter().filter(|shape| shape.class.contains(&wanted)) {
        // For the log of a memory checker, which goes to standard error as well.
        eprintln!("{}: {}", shape.class, shape.size());
        let model = Battery::new(shape);
        let at = table.iter().position(|(class, _)| *class == shape.class).unwrap_or(table.len());
        if at == table.len() {
            table.push((shape.class.clone(), vec![Vec::new(); algorithms.len()]));
        }
        for (cells, algorithm) in table[at].1.iter_mut().zip(&algorithms) {
            cells.push(Cell { n: shape.free, is_safe: came_back(&model, algorithm) });
        }
    }
    println!("| shape | {} |\n|---{}|", algorithms.join(" | "), "|---".repeat(algorithms.len()));
    for (class, cells) in &table {
        println!("| {class} | {} |", cells.iter().map(|cells| summary(cells)).collect::<Vec<_>>().join(" | "));
    }
}

#[derive(Clone, Copy)]
struct Cell {
    n: usize,
    /// It ran, and came back; otherwise it was refused.
    is_safe: bool,
}

fn came_back(model: &Battery, algorithm: &str) -> bool {
    Nlopt.refusal(algorithm, model).is_none() && {
        let message = solve(model, algorithm).message;
        // `ffi` looks once more before it calls NLopt; nothing should come as far.
        assert!(!message.contains("could not be set up"), "{algorithm}: {message}");
        true
    }
}

fn summary(cells: &[Cell]) -> String {
    let refused: Vec<String> = cells.iter().filter(|cell| !cell.is_safe).map(|cell| cell.n.to_string()).collect();
    match refused.len() {
        0 => "safe".into(),
        all if all == cells.len() => "refused".into(),
        _ => format!("safe, n = {} refused", refused.join(", ")),
    }
}
