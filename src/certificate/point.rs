//! Values, derivatives and scales at the point to be judged.

use crate::certificate::Side;
use crate::model::{Budget, EvaluationError, Evaluator, Meta, Model};

/// Less than this share of the largest variable is rounding where the start is zero.
const NEGLIGIBLE: f64 = 1e-8;

/// A model with what does not depend on the point: its start's gradient.
pub(super) struct Origin<'a> {
    pub(super) model: Evaluator<'a>,
    /// ∇f(start); `None` where the start has no gradient.
    gradient: Option<Vec<f64>>,
    /// ‖D∇c_i(start)‖∞; `None` where the start has no Jacobian.
    pub(super) slopes: Option<Vec<f64>>,
}

impl<'a> Origin<'a> {
    pub(super) fn new(model: &'a dyn Model) -> Self {
        let model = Evaluator::new(model, Budget::default());
        let start = &model.meta().start;
        let mut gradient = vec![0.0; start.len()];
        let known = model.gradient(start, &mut gradient).is_ok();
        let mut jacobian = vec![0.0; model.meta().jacobian.len()];
        let has_jacobian = model.jacobian(start, &mut jacobian).is_ok();
        let sizes: Vec<f64> = start.iter().map(|start| if *start == 0.0 { 1.0 } else { start.abs() }).collect();
        let slopes = has_jacobian.then(|| slopes(model.meta(), &jacobian, &sizes));
        Origin { gradient: known.then_some(gradient), slopes, model }
    }

    pub(super) fn meta(&self) -> &Meta {
        self.model.meta()
    }

    /// d_j = max(|x_j|, |start_j|), or 1 where both are 0 (SPEC §4).
    pub(super) fn variable_scales(&self, x: &[f64]) -> Vec<f64> {
        let scale = |(x, start): (&f64, &f64)| x.abs().max(start.abs());
        x.iter().zip(&self.meta().start).map(scale).map(|d| if d > 0.0 { d } else { 1.0 }).collect()
    }
}

/// First-order information at x, in the user's units, with the scales of SPEC §4.
pub(super) struct Point<'a> {
    pub(super) origin: &'a Origin<'a>,
    pub(super) x: &'a [f64],
    pub(super) objective: f64,
    pub(super) gradient: Vec<f64>,
    pub(super) rows: Vec<f64>,
    pub(super) jacobian: Vec<f64>,
    /// d_j
    pub(super) d: Vec<f64>,
    /// d_j, but 1 for a variable that starts at zero and still is, but for rounding: what is left has no size of its own.
    pub(super) sizes: Vec<f64>,
    /// max(‖D∇f(x)‖∞, ‖D∇f(start)‖∞)
    pub(super) sigma: f64,
    /// ‖D∇c_i(x)‖∞
    pub(super) slopes: Vec<f64>,
}

impl<'a> Point<'a> {
    pub(super) fn new(origin: &'a Origin<'a>, x: &'a [f64]) -> Result<Self, EvaluationError> {
        check_point(origin, x)?;
        let meta = origin.meta();
        let mut gradient = vec![0.0; meta.variables()];
        let objective = origin.model.gradient(x, &mut gradient)?;
        let mut rows = vec![0.0; meta.rows()];
        origin.model.constraints(x, &mut rows)?;
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        origin.model.jacobian(x, &mut jacobian)?;
        let d = origin.variable_scales(x);
        let sizes = sizes(&d, &meta.start);
        let sigma = largest(&gradient, &d).max(origin.gradient.as_ref().map_or(0.0, |start| largest(start, &d)));
        let slopes = slopes(meta, &jacobian, &d);
        Ok(Point { origin, x, objective, gradient, rows, jacobian, d, sizes, sigma, slopes })
    }

    /// The same with d_j = |x_j| wherever that is not 0: for what happens in proportion.
    pub(super) fn in_own_sizes(&self) -> Point<'a> {
        let d: Vec<f64> = self.x.iter().zip(&self.d).map(|(x, &d)| if *x == 0.0 { d } else { x.abs() }).collect();
        let slopes = slopes(self.meta(), &self.jacobian, &d);
        let (gradient, rows, jacobian) = (self.gradient.clone(), self.rows.clone(), self.jacobian.clone());
        Point { sizes: d.clone(), d, slopes, gradient, rows, jacobian, ..*self }
    }

    pub(super) fn meta(&self) -> &'a Meta {
        self.origin.meta()
    }

    /// ‖diag(sizes)·∇c_i‖∞: what the curvature test divides row i by.
    pub(super) fn slope_in_sizes(&self, i: usize) -> f64 {
        let pattern = &self.meta().jacobian;
        let entry = |at: usize| (self.jacobian[at] * self.sizes[pattern.columns[at] as usize]).abs();
        pattern.range(i).map(entry).fold(0.0, f64::max)
    }

    /// Row i's gradient in these sizes, divided by its slope in them: (variable, entry).
    pub(super) fn row_in_sizes(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (pattern, slope) = (&self.meta().jacobian, self.slope_in_sizes(i));
        pattern.range(i).map(move |at| {
            let j = pattern.columns[at] as usize;
            (j, self.jacobian[at] * self.sizes[j] / slope)
        })
    }

    /// σ, or 1 where every point is stationary.
    pub(super) fn scale(&self) -> f64 {
        if self.sigma > 0.0 { self.sigma } else { 1.0 }
    }

    /// Relative violation of row i: violation/s_i with s_i = max(|limit|, ‖D∇c_i‖∞).
    pub(super) fn row_violation(&self, i: usize) -> f64 {
        relative_violation(self.rows[i], self.meta().row_lower[i], self.meta().row_upper[i], self.slopes[i])
    }

    /// Relative violation of the bounds of variable j: violation/d_j.
    pub(super) fn bound_violation(&self, j: usize) -> f64 {
        (self.meta().lower[j] - self.x[j]).max(self.x[j] - self.meta().upper[j]).max(0.0) / self.d[j]
    }

    /// ∇f + Jᵀy
    pub(super) fn row_gradient(&self, y: &[f64]) -> Vec<f64> {
        let mut total = self.gradient.clone();
        self.meta().jacobian.add_transposed(&self.jacobian, y, &mut total);
        total
    }

    /// The limit of row i a multiplier of this sign belongs to.
    pub(super) fn row_limit(&self, i: usize, y: f64) -> f64 {
        if y > 0.0 { self.meta().row_upper[i] } else { self.meta().row_lower[i] }
    }

    /// The bound of variable j a multiplier of this sign belongs to.
    pub(super) fn bound(&self, j: usize, z: f64) -> f64 {
        if z > 0.0 { self.meta().upper[j] } else { self.meta().lower[j] }
    }

    /// The name of variable j.
    pub(super) fn variable(&self, j: usize) -> String {
        self.origin.model.variable_name(j)
    }

    /// The name of row i.
    pub(super) fn row(&self, i: usize) -> String {
        self.origin.model.row_name(i)
    }
}

/// The side a value rests on, given its multiplier and the distance below which it counts as resting. A multiplier that
/// outweighs the relative distance shows the limit as well (strict complementarity, free of scale).
pub(super) fn side(value: f64, lower: f64, upper: f64, multiplier: f64, touch: f64, slope: f64) -> Side {
    if lower == upper {
        return Side::Equal;
    }
    let rests = |distance: f64, weight: f64| {
        distance <= touch || (weight > 0.0 && distance <= weight * slope && distance <= 1e-3 * slope)
    };
    let (below, above) = (rests((value - lower).abs(), -multiplier), rests((value - upper).abs(), multiplier));
    match (below || value < lower, above || value > upper) {
        (true, true) if multiplier > 0.0 => Side::Upper,
        (true, _) => Side::Lower,
        (false, true) => Side::Upper,
        (false, false) => Side::None,
    }
}

fn relative_violation(value: f64, lower: f64, upper: f64, slope: f64) -> f64 {
    let (violation, limit) = if value < lower { (lower - value, lower) } else { (value - upper, upper) };
    if violation > 0.0 { (violation / limit.abs().max(slope).max(f64::MIN_POSITIVE)).min(f64::MAX) } else { 0.0 }
}

fn sizes(d: &[f64], start: &[f64]) -> Vec<f64> {
    let negligible = NEGLIGIBLE * d.iter().fold(0.0, |most: f64, d| most.max(*d));
    d.iter().zip(start).map(|(&d, &start)| if start == 0.0 && d < negligible { 1.0 } else { d }).collect()
}

fn largest(gradient: &[f64], d: &[f64]) -> f64 {
    gradient.iter().zip(d).fold(0.0, |most, (g, d)| most.max((g * d).abs()))
}

/// ‖D∇c_i‖∞, row by row.
fn slopes(meta: &Meta, jacobian: &[f64], d: &[f64]) -> Vec<f64> {
    let pattern = &meta.jacobian;
    let slope = |i| pattern.range(i).fold(0.0, |most: f64, at| most.max((jacobian[at] * d[pattern.columns[at] as usize]).abs()));
    (0..meta.rows()).map(slope).collect()
}

fn check_point(origin: &Origin<'_>, x: &[f64]) -> Result<(), EvaluationError> {
    let invalid = |term: String, cause: String| Err(EvaluationError::Invalid { term, cause });
    let n = origin.meta().variables();
    if x.len() != n {
        return invalid("the point".into(), format!("it has {} values for {n} variables", x.len()));
    }
    match x.iter().position(|value| !value.is_finite()) {
        Some(j) => invalid(format!("variable {}", origin.model.variable_name(j)), format!("its value is {}", x[j])),
        None => Ok(()),
    }
}
