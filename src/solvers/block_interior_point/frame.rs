//! One component in the small solver's form: scaled, with slacks; one frame per thread.
//!
//! min f(x) subject to c(x) − s = 0 and bounds on w = (x, s). Variables with a positive lower bound are taken by their
//! logarithms, and so are nonlinear rows with positive limits, and an objective that is positive by nature: products, powers and
//! quotients, of which structural formulas are made, become linear or nearly so, sums of them convex. The other variables are scaled by powers of two.

mod answer;
mod evaluation;

use super::arena::ComponentIterate;
use super::parameters::PARAMETERS;
use crate::model::Meta;
use crate::model::components::{Components, Local, Partition};

/// The component a thread is at.
pub(super) struct Frame<'m> {
    meta: &'m Meta,
    start: &'m [f64],
    is_positive: bool,
    partition: &'m Partition,
    local: Box<dyn Local + 'm>,
    pub n: usize,
    pub m: usize,
    /// x = d·w; 0 where x = exp(w).
    d: Vec<f64>,
    /// ∂x/∂w at the point evaluated last.
    slopes: Vec<f64>,
    logarithmic_rows: Vec<bool>,
    /// c(x), unscaled.
    natural_rows: Vec<f64>,
    /// Bounds of w, scaled.
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    x: Vec<f64>,
    weights: Vec<f64>,
    /// Scaled values at the point evaluated last.
    pub objective: f64,
    pub rows: Vec<f64>,
    pub gradient: Vec<f64>,
    /// m×n, row by row.
    pub jacobian: Vec<f64>,
    /// Lower triangle of n×n, row by row.
    pub hessian: Vec<f64>,
}

/// The power of two next below a magnitude.
fn power_of_two(magnitude: f64) -> f64 {
    let power = f64::from_bits(magnitude.to_bits() & 0x7FF0_0000_0000_0000);
    if power > 0.0 && power.is_finite() { power } else { 1.0 }
}

/// The scale of a variable.
fn scale(start: f64, lower: f64, upper: f64) -> f64 {
    let range = upper - lower;
    match start.abs() {
        size if size > 0.0 => power_of_two(size),
        _ if range > 0.0 && range.is_finite() => power_of_two(range),
        _ => 1.0,
    }
}

/// w from x.
fn inward(d: f64, x: f64) -> f64 {
    if d == 0.0 { x.ln() } else { x / d }
}

/// x from w.
fn outward(d: f64, w: f64) -> f64 {
    if d == 0.0 { w.exp() } else { d * w }
}

impl<'m> Frame<'m> {
    pub fn new(components: &'m dyn Components, meta: &'m Meta, start: &'m [f64]) -> Self {
        Frame {
            meta,
            start,
            is_positive: components.has_positive_objective(),
            partition: components.partition(),
            local: components.local(),
            n: 0,
            m: 0,
            d: Vec::new(),
            slopes: Vec::new(),
            logarithmic_rows: Vec::new(),
            natural_rows: Vec::new(),
            lower: Vec::new(),
            upper: Vec::new(),
            x: Vec::new(),
            weights: Vec::new(),
            objective: 0.0,
            rows: Vec::new(),
            gradient: Vec::new(),
            jacobian: Vec::new(),
            hessian: Vec::new(),
        }
    }

    /// Turns to the component of this iterate.
    pub fn select(&mut self, iterate: &ComponentIterate<'_>) {
        self.scales_of(iterate);
        let (n, m) = (self.n, self.m);
        for room in [&mut self.x, &mut self.slopes, &mut self.gradient] {
            room.resize(n, 0.0);
        }
        for room in [&mut self.weights, &mut self.rows, &mut self.natural_rows] {
            room.resize(m, 0.0);
        }
        self.jacobian.resize(m * n, 0.0);
        self.hessian.resize(n * n, 0.0);
        self.local.select(iterate.component);
    }

    /// Scales and bounds of the component of this iterate, nothing more.
    pub fn scales_of(&mut self, iterate: &ComponentIterate<'_>) {
        let (variables, rows) = (self.partition.variables(iterate.component), self.partition.rows(iterate.component));
        (self.n, self.m) = (variables.len(), rows.len());
        let (meta, start) = (self.meta, self.start);
        self.d.clear();
        self.lower.clear();
        self.upper.clear();
        for &j in variables {
            let (lower, upper) = (meta.lower[j as usize], meta.upper[j as usize]);
            let d = if lower > 0.0 { 0.0 } else { scale(start[j as usize], lower, upper) };
            self.d.push(d);
            self.lower.push(inward(d, lower));
            self.upper.push(inward(d, upper));
        }
        self.logarithmic_rows.clear();
        for (&i, scale) in rows.iter().zip(&*iterate.row_scale) {
            let (lower, upper) = (meta.row_lower[i as usize], meta.row_upper[i as usize]);
            let positive = upper > 0.0 && (lower > 0.0 || (lower == f64::NEG_INFINITY && upper < f64::INFINITY));
            let logarithmic = positive && !meta.row_is_linear[i as usize];
            let limit = |limit: f64| if logarithmic && limit.is_finite() { limit.ln() * scale } else { limit * scale };
            self.logarithmic_rows.push(logarithmic);
            self.lower.push(limit(lower));
            self.upper.push(limit(upper));
        }
    }

    /// The start, scaled.
    pub fn start(&self, component: usize) -> impl Iterator<Item = f64> + '_ {
        self.partition.variables(component).iter().zip(&self.d).map(|(&j, &d)| inward(d, self.start[j as usize]))
    }

    /// Whether the objective evaluated last may be taken by its logarithm.
    pub fn has_logarithm(&self) -> bool {
        self.is_positive && self.objective > 0.0
    }

    /// Scales of objective and rows by the gradients evaluated last (with all scales 1, and no logarithm of the objective).
    pub fn choose_scales(&mut self, iterate: &mut ComponentIterate<'_>) {
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let size = largest(&self.gradient) / if iterate.header.logarithmic { self.objective } else { 1.0 };
        iterate.header.objective_scale = if size > 0.0 { 1.0 / size } else { 1.0 };
        for (i, scale) in iterate.row_scale.iter_mut().enumerate() {
            let slope = largest(&self.jacobian[i * self.n..(i + 1) * self.n]);
            let (lower, upper) = (self.lower[self.n + i], self.upper[self.n + i]);
            let limit = [lower, upper].into_iter().filter(|limit| limit.is_finite()).fold(0.0, |most: f64, l| most.max(l.abs()));
            let size = if slope > PARAMETERS.level * limit { slope } else { limit };
            *scale = if size > 0.0 { 1.0 / size } else { 1.0 };
            self.lower[self.n + i] = lower * *scale;
            self.upper[self.n + i] = upper * *scale;
        }
    }

    /// The longest step of variable j worth its Newton matrix: its whole range, or a factor e⁴, or tenfold.
    pub fn reach(&self, j: usize, w: f64) -> f64 {
        let far = if self.d[j] == 0.0 { 4.0 } else { 10.0 * w.abs().max(1.0) };
        far.min(self.upper[j] - self.lower[j])
    }
}
