//! The restoration's problem as a model: least violation of the rows, near a reference point.
//!
//! ```text
//! min Σ(p + n) + ζ/2·Σ (D_j (x_j − r_j))²   subject to   l ≤ s·c(x) − p + n ≤ u,  p, n ≥ 0,  x in its bounds
//! ```
//! Wächter & Biegler (2006), equation (29), with a violation per side of each row.

use crate::model::{EvaluationError, Meta, Model, NameTable, Names, Pattern};

/// A violation of one row on one side.
struct Violation {
    /// Among the elastic rows.
    row: usize,
    /// −1: lets the row exceed its upper side; +1: fall below its lower side.
    sign: f64,
}

/// Least violation near a reference point. Variables: x, then the violations.
pub(super) struct LeastViolation<'a> {
    base: &'a dyn Model,
    meta: Meta,
    /// The base's number and scale of each row.
    rows: Vec<(usize, f64)>,
    violations: Vec<Violation>,
    reference: Vec<f64>,
    /// ζ·D², per variable of the base.
    proximity: Vec<f64>,
    /// Where the base's Hessian values, and the diagonal, stand in this Hessian.
    hessian_places: Vec<usize>,
    diagonal_places: Vec<usize>,
}

impl<'a> LeastViolation<'a> {
    /// The restoration of `base` from `x`: `rows` with their scales, ζ, and the barrier parameter that balances the
    /// first violations.
    pub fn new(base: &'a dyn Model, x: &[f64], rows: Vec<(usize, f64)>, zeta: f64, mu: f64) -> Result<Self, EvaluationError> {
        let of = base.meta();
        let n = of.variables();
        let mut values = vec![0.0; of.rows()];
        base.constraints(x, &mut values)?;
        let mut meta = Meta { start: x.to_vec(), lower: of.lower.clone(), upper: of.upper.clone(), ..Meta::default() };
        let mut violations = Vec::new();
        for (at, &(row, scale)) in rows.iter().enumerate() {
            let (lower, upper) = (of.row_lower[row] * scale, of.row_upper[row] * scale);
            meta.row_lower.push(lower);
            meta.row_upper.push(upper);
            meta.row_is_linear.push(of.row_is_linear[row]);
            meta.jacobian.columns.extend(of.jacobian.row(row));
            let value = values[row] * scale;
            for (limit, sign) in [(upper, -1.0), (lower, 1.0)] {
                if limit.is_finite() {
                    meta.jacobian.columns.push((n + violations.len()) as u32);
                    violations.push(Violation { row: at, sign });
                    meta.start.push(balanced(sign * (limit - value), mu));
                }
            }
            meta.jacobian.offsets.push(meta.jacobian.columns.len());
        }
        meta.lower.resize(n + violations.len(), 0.0);
        meta.upper.resize(n + violations.len(), f64::INFINITY);
        let (hessian, hessian_places, diagonal_places) = with_diagonal(&of.hessian);
        meta.hessian = hessian;
        meta.hessian.offsets.resize(n + violations.len() + 1, meta.hessian.columns.len());
        let violated = violations.iter().map(|violation| rows[violation.row].0).collect();
        let chosen = rows.iter().map(|&(row, _)| row).collect();
        meta.names = NameTable::new(ViolationNames { of: of.names.clone(), variables: n, violated, rows: chosen });
        let proximity = x.iter().map(|x| zeta / x.abs().max(1.0).powi(2)).collect();
        Ok(LeastViolation { base, meta, rows, violations, reference: x.to_vec(), proximity, hessian_places, diagonal_places })
    }

    fn split<'x>(&self, x: &'x [f64]) -> (&'x [f64], &'x [f64]) {
        x.split_at(self.reference.len())
    }
}

/// `violation of c` for what follows the variables.
struct ViolationNames {
    of: NameTable,
    variables: usize,
    /// The base's row of each violation.
    violated: Vec<usize>,
    /// The base's number of each row.
    rows: Vec<usize>,
}

impl Names for ViolationNames {
    fn variable(&self, j: usize) -> String {
        match j.checked_sub(self.variables) {
            None => self.of.variable(j),
            Some(at) => format!("violation of {}", self.of.row(self.violated[at])),
        }
    }

    fn row(&self, i: usize) -> String {
        self.of.row(self.rows[i])
    }
}

/// The violation that solves the barrier problem of one row for x held fast: equation (33), ρ = 1.
fn balanced(short: f64, mu: f64) -> f64 {
    let half = 0.5 * (mu + short);
    let root = half + (half * half - 0.5 * mu * short).max(0.0).sqrt();
    root.max(short.max(0.0) + 0.1 * mu).max(1e-12)
}

/// The pattern with all diagonal positions; where the old positions and the diagonal stand in it.
fn with_diagonal(pattern: &Pattern) -> (Pattern, Vec<usize>, Vec<usize>) {
    let (mut full, mut places, mut diagonal) = (Pattern::default(), Vec::new(), Vec::new());
    for row in 0..pattern.rows() {
        let own = pattern.row(row);
        places.extend((0..own.len()).map(|at| full.columns.len() + at));
        full.columns.extend(own);
        if own.last() != Some(&(row as u32)) {
            full.columns.push(row as u32);
        }
        diagonal.push(full.columns.len() - 1);
        full.offsets.push(full.columns.len());
    }
    (full, places, diagonal)
}

impl Model for LeastViolation<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn may_go_on(&self) -> Result<(), EvaluationError> {
        self.base.may_go_on()
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        let (x, violations) = self.split(x);
        let distance = x.iter().zip(&self.reference).zip(&self.proximity).map(|((x, r), weight)| weight * (x - r).powi(2));
        Ok(violations.iter().sum::<f64>() + 0.5 * distance.sum::<f64>())
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let value = self.objective(x)?;
        gradient.fill(1.0);
        for (j, gradient) in gradient.iter_mut().enumerate().take(self.reference.len()) {
            *gradient = self.proximity[j] * (x[j] - self.reference[j]);
        }
        Ok(value)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (x, violations) = self.split(x);
        let mut base = vec![0.0; self.base.meta().rows()];
        self.base.constraints(x, &mut base)?;
        for (value, &(row, scale)) in values.iter_mut().zip(&self.rows) {
            *value = base[row] * scale;
        }
        for (violation, size) in self.violations.iter().zip(violations) {
            values[violation.row] += violation.sign * size;
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (x, _) = self.split(x);
        let pattern = &self.base.meta().jacobian;
        let mut base = vec![0.0; pattern.len()];
        self.base.jacobian(x, &mut base)?;
        for (at, &(row, scale)) in self.rows.iter().enumerate() {
            let places = self.meta.jacobian.range(at);
            for (value, base) in values[places].iter_mut().zip(&base[pattern.range(row)]) {
                *value = base * scale;
            }
        }
        let mut next: Vec<usize> =
            self.rows.iter().enumerate().map(|(at, &(row, _))| self.meta.jacobian.offsets[at] + pattern.row(row).len()).collect();
        for violation in &self.violations {
            values[next[violation.row]] = violation.sign;
            next[violation.row] += 1;
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (x, _) = self.split(x);
        let mut multipliers = vec![0.0; self.base.meta().rows()];
        for (&(row, scale), y) in self.rows.iter().zip(y) {
            multipliers[row] = y * scale;
        }
        let mut base = vec![0.0; self.base.meta().hessian.len()];
        self.base.hessian(x, 0.0, &multipliers, &mut base)?;
        values.fill(0.0);
        for (&place, base) in self.hessian_places.iter().zip(&base) {
            values[place] = *base;
        }
        for (&place, proximity) in self.diagonal_places.iter().zip(&self.proximity) {
            values[place] += weight * proximity;
        }
        Ok(())
    }
}
