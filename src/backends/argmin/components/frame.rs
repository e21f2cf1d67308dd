//! One component in the small solver's form: scaled, with slacks; one frame per thread.
//!
//! min f(x) subject to c(x) − s = 0 and bounds on w = (x, s). x = d·(scaled x) with d a power of two, so that bounds
//! survive the way there and back bit for bit.

use super::arena::{Header, Piece};
use crate::model::Meta;
use crate::model::components::{Components, Local, Partition};

/// Row gradients smaller than this are no scale.
const FLAT: f64 = 1e-12;

/// The component a thread is at.
pub(super) struct Frame<'m> {
    meta: &'m Meta,
    start: &'m [f64],
    partition: &'m Partition,
    local: Box<dyn Local + 'm>,
    pub n: usize,
    pub m: usize,
    d: Vec<f64>,
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

impl<'m> Frame<'m> {
    pub fn new(components: &'m dyn Components, meta: &'m Meta, start: &'m [f64]) -> Self {
        Frame {
            meta,
            start,
            partition: components.partition(),
            local: components.local(),
            n: 0,
            m: 0,
            d: Vec::new(),
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
    pub fn turn_to(&mut self, piece: &Piece<'_>) {
        self.scales_of(piece);
        let (n, m) = (self.n, self.m);
        for (room, size) in [(&mut self.x, n), (&mut self.weights, m), (&mut self.rows, m), (&mut self.gradient, n)] {
            room.resize(size, 0.0);
        }
        self.jacobian.resize(m * n, 0.0);
        self.hessian.resize(n * n, 0.0);
        self.local.turn_to(piece.component);
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
            let d = scale(start[j as usize], lower, upper);
            self.d.push(d);
            self.lower.push(lower / d);
            self.upper.push(upper / d);
        }
        for (&i, scale) in rows.iter().zip(&*piece.row_scale) {
            self.lower.push(meta.row_lower[i as usize] * scale);
            self.upper.push(meta.row_upper[i as usize] * scale);
        }
    }

    /// The start, scaled.
    pub fn start(&self, component: usize) -> impl Iterator<Item = f64> + '_ {
        self.partition.variables(component).iter().zip(&self.d).map(|(&j, d)| self.start[j as usize] / d)
    }

    /// Scales of objective and rows by the gradients evaluated last (with all scales 1).
    pub fn choose_scales(&mut self, piece: &mut Piece<'_>) {
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let size = largest(&self.gradient);
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
        for ((x, w), d) in self.x.iter_mut().zip(w).zip(&self.d) {
            *x = w * d;
        }
    }

    /// Scaled f at w; `rows` holds the scaled c(x) afterwards. NaN or infinite where the model is.
    pub fn values(&mut self, w: &[f64], header: &mut Header, row_scale: &[f64]) -> f64 {
        self.place(w);
        header.evaluations += 1;
        self.objective = header.objective_scale * self.local.values(&self.x, &mut self.rows);
        self.rows.iter_mut().zip(row_scale).for_each(|(row, scale)| *row *= scale);
        if self.rows.iter().all(|row| row.is_finite()) { self.objective } else { f64::NAN }
    }

    /// Values and first derivatives at w, scaled. `false`: some are no numbers.
    pub fn first_order(&mut self, w: &[f64], header: &mut Header, row_scale: &[f64]) -> bool {
        self.place(w);
        header.evaluations += 1;
        self.objective = self.local.first_order(&self.x, &mut self.rows, &mut self.gradient, &mut self.jacobian);
        header.objective = self.objective;
        self.objective *= header.objective_scale;
        for (gradient, d) in self.gradient.iter_mut().zip(&self.d) {
            *gradient *= d * header.objective_scale;
        }
        for ((jacobian, row), scale) in self.jacobian.chunks_exact_mut(self.n.max(1)).zip(&mut self.rows).zip(row_scale) {
            *row *= scale;
            jacobian.iter_mut().zip(&self.d).for_each(|(slope, d)| *slope *= d * scale);
        }
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        self.objective.is_finite() && finite(&self.rows) && finite(&self.gradient) && finite(&self.jacobian)
    }

    /// The Lagrangian's Hessian at w, scaled. `false`: some entries are no numbers.
    pub fn second_order(&mut self, w: &[f64], y: &[f64], header: &Header, row_scale: &[f64]) -> bool {
        self.place(w);
        self.weights.iter_mut().zip(y).zip(row_scale).for_each(|((weight, y), scale)| *weight = y * scale);
        self.local.hessian(&self.x, header.objective_scale, &self.weights, &mut self.hessian);
        let mut finite = true;
        for i in 0..self.n {
            for j in 0..=i {
                let entry = &mut self.hessian[i * self.n + j];
                *entry *= self.d[i] * self.d[j];
                finite &= entry.is_finite();
            }
        }
        finite
    }

    /// The largest violation of the rows by the values evaluated last: absolute, and relative to large limits.
    pub fn violation(&self, row_scale: &[f64]) -> (f64, f64) {
        let beyond = |i: usize| {
            let (lower, upper) = (self.lower[self.n + i], self.upper[self.n + i]);
            let (below, above) = ((lower - self.rows[i]).max(0.0), (self.rows[i] - upper).max(0.0));
            let relative = (below / lower.abs().max(1.0)).max(above / upper.abs().max(1.0));
            (below.max(above) / row_scale[i], relative)
        };
        (0..self.m).map(beyond).fold((0.0, 0.0), |worst: (f64, f64), next| (worst.0.max(next.0), worst.1.max(next.1)))
    }

    /// The component's variables with their unscaled values, inside their bounds to the last digit.
    pub fn unscaled<'f>(&'f self, piece: &'f Piece<'_>) -> impl Iterator<Item = (u32, f64)> + 'f {
        let (meta, variables) = (self.meta, self.partition.variables(piece.component));
        let inside = move |(j, x): (u32, f64)| (j, x.min(meta.upper[j as usize]).max(meta.lower[j as usize]));
        variables.iter().zip(&*piece.w).zip(&self.d).map(|((&j, w), d)| (j, w * d)).map(inside)
    }

    /// The component's rows with their unscaled multipliers.
    pub fn multipliers<'f>(&'f self, piece: &'f Piece<'_>) -> impl Iterator<Item = (u32, f64)> + 'f {
        let rows = self.partition.rows(piece.component).iter().zip(&*piece.y).zip(&*piece.row_scale);
        rows.map(|((&i, y), scale)| (i, y * scale / piece.header.objective_scale))
    }

    /// Takes unscaled values and multipliers as the piece's iterate.
    pub fn take(&self, piece: &mut Piece<'_>, x: &[f64], multipliers: &[f64]) {
        for ((w, x), d) in piece.w.iter_mut().zip(x).zip(&self.d) {
            *w = x / d;
        }
        for ((y, given), scale) in piece.y.iter_mut().zip(multipliers).zip(&*piece.row_scale) {
            *y = if *scale > 0.0 { given * piece.header.objective_scale / scale } else { *given };
        }
    }
}
