//! One component in the small solver's form: scaled, with slacks; one frame per thread.
//!
//! min f(x) subject to c(x) − s = 0 and bounds on w = (x, s). Variables with a positive lower bound are taken by their
//! logarithms, and so are nonlinear rows with positive limits, and an objective that is positive by nature: products, powers and
//! quotients, of which structural formulas are made, become linear or nearly so, sums of them convex. The other variables are scaled by powers of two.

use super::arena::{Header, Piece};
use super::parameters::PARAMETERS;
use crate::model::Meta;
use crate::model::components::{Components, Local, Partition};
use crate::solvers::barrier::pushed;

/// Scaled multipliers smaller than this hold nothing.
const IDLE: f64 = 1e-10;
/// Row gradients smaller than this are no scale.
const FLAT: f64 = 1e-12;

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

/// Subtracts weight·vvᵀ from a lower triangle.
fn subtract_square(matrix: &mut [f64], weight: f64, v: &[f64]) {
    let n = v.len();
    for (j, &own) in v.iter().enumerate().filter(|(_, own)| **own != 0.0) {
        let factor = weight * own;
        for (entry, other) in matrix[j * n..=j * n + j].iter_mut().zip(v) {
            *entry -= factor * other;
        }
    }
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

    /// Turns to the component of this piece.
    pub fn select(&mut self, piece: &Piece<'_>) {
        self.scales_of(piece);
        let (n, m) = (self.n, self.m);
        for room in [&mut self.x, &mut self.slopes, &mut self.gradient] {
            room.resize(n, 0.0);
        }
        for room in [&mut self.weights, &mut self.rows, &mut self.natural_rows] {
            room.resize(m, 0.0);
        }
        self.jacobian.resize(m * n, 0.0);
        self.hessian.resize(n * n, 0.0);
        self.local.select(piece.component);
    }

    /// Scales and bounds of the component of this piece, nothing more.
    pub fn scales_of(&mut self, piece: &Piece<'_>) {
        let (variables, rows) = (self.partition.variables(piece.component), self.partition.rows(piece.component));
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
        for (&i, scale) in rows.iter().zip(&*piece.row_scale) {
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
    pub fn choose_scales(&mut self, piece: &mut Piece<'_>) {
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let size = largest(&self.gradient) / if piece.header.logarithmic { self.objective } else { 1.0 };
        piece.header.objective_scale = if size > 0.0 { 1.0 / size } else { 1.0 };
        for (i, scale) in piece.row_scale.iter_mut().enumerate() {
            let slope = largest(&self.jacobian[i * self.n..(i + 1) * self.n]);
            let (lower, upper) = (self.lower[self.n + i], self.upper[self.n + i]);
            let limit = [lower, upper].into_iter().filter(|limit| limit.is_finite()).fold(0.0, |most: f64, l| most.max(l.abs()));
            let size = if slope > FLAT * limit { slope } else { limit };
            *scale = if size > 0.0 { 1.0 / size } else { 1.0 };
            self.lower[self.n + i] = lower * *scale;
            self.upper[self.n + i] = upper * *scale;
        }
    }

    fn place(&mut self, w: &[f64]) {
        for (((x, slope), w), &d) in self.x.iter_mut().zip(&mut self.slopes).zip(w).zip(&self.d) {
            *x = outward(d, *w);
            *slope = if d == 0.0 { *x } else { d };
        }
    }

    /// Scaled rows from `natural_rows`.
    fn scale_rows(&mut self, row_scale: &[f64]) {
        let natural = self.natural_rows.iter().zip(&self.logarithmic_rows);
        for ((row, scale), (value, &logarithmic)) in self.rows.iter_mut().zip(row_scale).zip(natural) {
            *row = scale * if logarithmic { value.ln() } else { *value };
        }
    }

    /// Scaled f and rows at w. `false`: some are no numbers.
    pub fn values(&mut self, w: &[f64], header: &mut Header, row_scale: &[f64]) -> bool {
        self.place(w);
        header.evaluations += 1;
        let natural = self.local.values(&self.x, &mut self.natural_rows);
        self.objective = header.scaled(natural).0;
        self.scale_rows(row_scale);
        self.objective.is_finite() && self.rows.iter().all(|row| row.is_finite())
    }

    /// The longest step of variable j worth its Newton matrix: its whole range, or a factor e⁴, or tenfold.
    pub fn reach(&self, j: usize, w: f64) -> f64 {
        let far = if self.d[j] == 0.0 { 4.0 } else { 10.0 * w.abs().max(1.0) };
        far.min(self.upper[j] - self.lower[j])
    }

    /// Values and first derivatives at w, scaled. `false`: some are no numbers.
    pub fn first_order(&mut self, w: &[f64], header: &mut Header, row_scale: &[f64]) -> bool {
        self.place(w);
        header.evaluations += 1;
        header.objective = self.local.first_order(&self.x, &mut self.natural_rows, &mut self.gradient, &mut self.jacobian);
        let (objective, weight) = header.scaled(header.objective);
        self.objective = objective;
        self.scale_rows(row_scale);
        for (gradient, slope) in self.gradient.iter_mut().zip(&self.slopes) {
            *gradient *= slope * weight;
        }
        for (i, jacobian) in self.jacobian.chunks_exact_mut(self.n.max(1)).enumerate() {
            let scale = if self.logarithmic_rows[i] { row_scale[i] / self.natural_rows[i] } else { row_scale[i] };
            jacobian.iter_mut().zip(&self.slopes).for_each(|(entry, slope)| *entry *= slope * scale);
        }
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        self.objective.is_finite() && finite(&self.rows) && finite(&self.gradient) && finite(&self.jacobian)
    }

    /// The Lagrangian's Hessian at w, scaled, first derivatives there being known. `false`: some entries are no numbers.
    pub fn second_order(&mut self, y: &[f64], header: &Header, row_scale: &[f64]) -> bool {
        let n = self.n;
        for (i, weight) in self.weights.iter_mut().enumerate() {
            let scale = y[i] * row_scale[i];
            *weight = if self.logarithmic_rows[i] { scale / self.natural_rows[i] } else { scale };
        }
        self.local.hessian(&self.x, header.scaled(header.objective).1, &self.weights, &mut self.hessian);
        for (i, row) in self.hessian.chunks_exact_mut(n.max(1)).enumerate() {
            row.iter_mut().zip(&self.slopes[..=i]).for_each(|(entry, slope)| *entry *= self.slopes[i] * slope);
        }
        self.add_bends(y, header, row_scale);
        (0..n).all(|i| self.hessian[i * n..=i * n + i].iter().all(|entry| entry.is_finite()))
    }

    /// What the logarithms bend by themselves: diag(∂L/∂w) where x = exp(w), −∇ĉ∇ĉᵀ of logarithmic rows and objective.
    fn add_bends(&mut self, y: &[f64], header: &Header, row_scale: &[f64]) {
        let n = self.n;
        for j in (0..n).filter(|&j| self.d[j] == 0.0) {
            let pull: f64 = y.iter().enumerate().map(|(i, y)| y * self.jacobian[i * n + j]).sum();
            self.hessian[j * n + j] += self.gradient[j] + pull;
        }
        let rows = self.jacobian.chunks_exact(n.max(1)).enumerate().filter(|&(i, _)| self.logarithmic_rows[i] && y[i] != 0.0);
        for (i, row) in rows {
            subtract_square(&mut self.hessian, y[i] / row_scale[i], row);
        }
        if header.logarithmic {
            subtract_square(&mut self.hessian, 1.0 / header.objective_scale, &self.gradient);
        }
    }

    /// The largest violation of the rows by the values evaluated last: absolute, and relative to large limits.
    pub fn violation(&self, component: usize) -> (f64, f64) {
        let beyond = |(&row, value): (&u32, &f64)| {
            let (lower, upper) = (self.meta.row_lower[row as usize], self.meta.row_upper[row as usize]);
            let (below, above) = ((lower - value).max(0.0), (value - upper).max(0.0));
            (below.max(above), (below / lower.abs().max(1.0)).max(above / upper.abs().max(1.0)))
        };
        let all = self.partition.rows(component).iter().zip(&self.natural_rows).map(beyond);
        all.fold((0.0, 0.0), |worst: (f64, f64), next| (worst.0.max(next.0), worst.1.max(next.1)))
    }

    /// The component's variables with their unscaled values: exactly on the bounds they rest on, never beyond.
    pub fn unscaled<'f>(&'f self, piece: &'f Piece<'_>) -> impl Iterator<Item = (u32, f64)> + 'f {
        let variables = self.partition.variables(piece.component);
        variables.iter().enumerate().map(|(at, &j)| {
            let (w, lower, upper) = (piece.w[at], self.meta.lower[j as usize], self.meta.upper[j as usize]);
            let x = match w {
                _ if w == self.lower[at] => lower,
                _ if w == self.upper[at] => upper,
                _ => outward(self.d[at], w).min(upper).max(lower),
            };
            (j, x)
        })
    }

    /// The component's rows with their unscaled multipliers.
    pub fn multipliers<'f>(&'f self, piece: &'f Piece<'_>) -> impl Iterator<Item = (u32, f64)> + 'f {
        let factors = self.row_factors(piece);
        self.partition.rows(piece.component).iter().zip(&*piece.y).zip(factors).map(|((&i, y), factor)| (i, y * factor))
    }

    /// What unscales each row's multiplier. A row that has one rests on its limit: that is its value.
    fn row_factors<'f>(&'f self, piece: &'f Piece<'_>) -> impl Iterator<Item = f64> + 'f {
        self.partition.rows(piece.component).iter().enumerate().map(|(at, &i)| {
            let (lower, upper) = (self.meta.row_lower[i as usize], self.meta.row_upper[i as usize]);
            let limit = if lower > 0.0 && (piece.y[at] < 0.0 || upper == f64::INFINITY) { lower } else { upper };
            let value = if self.logarithmic_rows[at] { limit } else { 1.0 };
            piece.row_scale[at] / piece.header.scaled(piece.header.objective).1 / value
        })
    }

    /// Takes the start for an answer, with the multipliers of all rows: on the limits whose multipliers say so.
    pub fn take_start(&self, piece: &mut Piece<'_>, multipliers: &[f64]) {
        let x: Vec<f64> = self.partition.variables(piece.component).iter().map(|&j| self.start[j as usize]).collect();
        let y: Vec<f64> = self.partition.rows(piece.component).iter().map(|&i| multipliers[i as usize]).collect();
        self.take(piece, &x, &y);
        for i in 0..self.m {
            let at = self.n + i;
            piece.w[at] = match piece.y[i] {
                y if y > IDLE => self.upper[at],
                y if y < -IDLE => self.lower[at],
                _ => pushed(self.rows[i], self.lower[at], self.upper[at], PARAMETERS.kappa_1),
            };
        }
        for (at, &w) in piece.w.iter().enumerate() {
            piece.z_lower[at] = f64::from(u8::from(w <= self.lower[at]));
            piece.z_upper[at] = f64::from(u8::from(w >= self.upper[at]));
        }
    }

    /// Takes unscaled values and multipliers as the piece's iterate.
    pub fn take(&self, piece: &mut Piece<'_>, x: &[f64], multipliers: &[f64]) {
        for (at, &x) in x.iter().enumerate() {
            piece.w[at] = inward(self.d[at], x);
        }
        piece.y.copy_from_slice(multipliers);
        let factors: Vec<f64> = self.row_factors(piece).collect();
        piece.y.iter_mut().zip(factors).for_each(|(y, factor)| *y /= factor);
    }
}
