//! Values, derivatives and scales at the point to be judged.

mod curvature;

use crate::certificate::parameters::feasibility::ROUNDED;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::Instant;

use super::known_sizes;
use super::scales::{self, RowTerms};
use crate::certificate::Side;
use crate::linear_algebra::FactorizationError;
use crate::model::{Budget, EvaluationError, Evaluator, Meta, Model};

/// A model ready to have points judged.
pub(super) struct Origin<'a> {
    pub(super) model: Evaluator<'a>,
    /// When searches take what they have.
    pub(super) until: Option<Instant>,
}

impl<'a> Origin<'a> {
    pub(super) fn new(model: &'a dyn Model) -> Self {
        Origin { model: Evaluator::new(model, Budget::default()), until: None }
    }

    pub(super) fn meta(&self) -> &Meta {
        self.model.meta()
    }
}

/// First-order information at x, in the user's units, with what it is measured by (docs/certificate.md).
pub(super) struct Point<'a> {
    pub(super) origin: &'a Origin<'a>,
    pub(super) x: &'a [f64],
    pub(super) objective: f64,
    pub(super) gradient: Vec<f64>,
    pub(super) rows: Vec<f64>,
    pub(super) jacobian: Vec<f64>,
    /// d_j
    pub(super) sizes: Vec<f64>,
    /// d_j as it was before curvature had a say.
    plain_sizes: Vec<f64>,
    /// σ: ‖D∇f(x)‖∞ over the variables that can move, or more, see [`Point::add_curvature`].
    pub(super) sigma: f64,
    /// ‖D∇f(x)‖∞, and Σ_k |∂²f/∂x_j∂x_k|·d_j·d_k variable by variable where that has been looked at.
    steepest: f64,
    bends: Vec<f64>,
    /// Only curvature makes the slope here a small one: in a tail that is deceptive.
    pub(super) relies_on_curvature: bool,
    /// ‖D∇c_i(x)‖∞ over the variables that can move
    pub(super) slopes: Vec<f64>,
    /// max_j |∂c_i/∂x_j·x_j|
    pub(super) terms: RowTerms,
    /// A search was ended by the deadline.
    cut_short: AtomicBool,
    /// Mean slopes of the rows about x, computed where they are needed; see [`scales::mean_slopes`].
    mean_slopes: OnceLock<Option<Vec<f64>>>,
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
        let sizes = known_sizes::variable_sizes(origin, x, &jacobian);
        let sigma = steepest(meta, &gradient, &sizes);
        let slopes = slopes(meta, &jacobian, &sizes);
        let terms = scales::row_terms(meta, x, &jacobian);
        Ok(Point {
            origin,
            x,
            objective,
            gradient,
            rows,
            jacobian,
            sizes,
            plain_sizes: Vec::new(),
            sigma,
            steepest: sigma,
            bends: Vec::new(),
            relies_on_curvature: false,
            slopes,
            terms,
            cut_short: AtomicBool::new(false),
            mean_slopes: OnceLock::new(),
        })
    }

    /// The same point with its variables measured by other sizes.
    pub(super) fn in_sizes(&self, sizes: Vec<f64>) -> Result<Point<'a>, EvaluationError> {
        let mut point = Point::new(self.origin, self.x)?;
        point.sigma = steepest(point.meta(), &point.gradient, &sizes);
        point.steepest = point.sigma;
        point.slopes = slopes(point.meta(), &point.jacobian, &sizes);
        point.sizes = sizes;
        Ok(point)
    }

    /// Whether the deadline has passed.
    pub(super) fn is_late(&self) -> bool {
        self.origin.until.is_some_and(|until| Instant::now() >= until)
    }

    /// Whether searches have to end, and so are cut short.
    pub(super) fn is_over(&self) -> bool {
        let is_over = self.is_late();
        if is_over {
            self.cut_short.store(true, Relaxed);
        }
        is_over
    }

    /// Before a factorisation: nothing is begun after the deadline.
    pub(super) fn in_time(&self) -> Result<(), FactorizationError> {
        if self.is_over() { Err(FactorizationError::Late) } else { Ok(()) }
    }

    /// Whether a search was cut short.
    pub(super) fn is_cut_short(&self) -> bool {
        self.cut_short.load(Relaxed)
    }

    pub(super) fn meta(&self) -> &'a Meta {
        self.origin.meta()
    }

    /// Row i's gradient in these sizes, divided by its slope in them: (variable, entry).
    pub(super) fn row_in_sizes(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (pattern, slope) = (&self.meta().jacobian, self.slopes[i]);
        pattern.range(i).map(move |at| {
            let j = pattern.columns[at] as usize;
            (j, self.jacobian[at] * self.sizes[j] / slope)
        })
    }

    /// σ, or 1 where every point is stationary.
    pub(super) fn scale(&self) -> f64 {
        if self.sigma > 0.0 { self.sigma } else { 1.0 }
    }

    /// Relative violation of row i: what rounding does not explain, over max(|limit|, the row's largest term).
    pub(super) fn row_violation(&self, i: usize) -> f64 {
        let (violation, limit) = self.row_excess(i);
        if violation <= 0.0 {
            return 0.0;
        }
        let terms = self.row_term(i);
        let summed = terms.max(self.fixed_term(i)) * self.meta().jacobian.row(i).len() as f64;
        let rounding = ROUNDED * (limit.abs() + summed);
        if violation <= rounding {
            return 0.0;
        }
        (violation / limit.abs().max(terms).max(f64::MIN_POSITIVE)).min(f64::MAX)
    }

    /// The limit row i is nearest to.
    pub(super) fn nearest_limit(&self, i: usize) -> f64 {
        let (lower, upper, value) = (self.meta().row_lower[i], self.meta().row_upper[i], self.rows[i]);
        if (value - lower).abs() <= (value - upper).abs() { lower } else { upper }
    }

    /// By how much row i lies beyond the limit it violates, and that limit.
    pub(super) fn row_excess(&self, i: usize) -> (f64, f64) {
        let (value, lower, upper) = (self.rows[i], self.meta().row_lower[i], self.meta().row_upper[i]);
        if value < lower { (lower - value, lower) } else { (value - upper, upper) }
    }

    /// The largest term of row i that a fixed variable has, where that is more than all others; else 0.
    fn fixed_term(&self, i: usize) -> f64 {
        let (moving, all) = (self.terms.moving[i], self.terms.all[i]);
        if all > moving { all } else { 0.0 }
    }

    /// The largest term of row i. Of a row that is not linear, derivatives without end say nothing: its term is no larger than
    /// the mean slope over a finite step.
    pub(super) fn row_term(&self, i: usize) -> f64 {
        let term = self.terms.moving[i];
        if term == 0.0 || self.meta().is_row_linear(i) {
            return term;
        }
        let mean = self.mean_slopes.get_or_init(|| scales::mean_slopes(self.origin, self.x, &self.rows));
        mean.as_ref().map_or(term, |mean| term.min(mean[i]))
    }

    /// Relative violation of the bounds of variable j: violation/d_j.
    pub(super) fn bound_violation(&self, j: usize) -> f64 {
        (self.meta().lower[j] - self.x[j]).max(self.x[j] - self.meta().upper[j]).max(0.0) / self.sizes[j]
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

/// ‖D∇f‖∞ over the variables that can move. Where it overflows, the largest number there is: no slope passes beside that.
fn steepest(meta: &Meta, gradient: &[f64], d: &[f64]) -> f64 {
    let free = (0..d.len()).filter(|&j| !meta.is_fixed(j));
    free.fold(0.0, |most: f64, j| most.max((gradient[j] * d[j]).abs())).min(f64::MAX)
}

/// ‖D∇c_i‖∞ over the variables that can move, row by row.
fn slopes(meta: &Meta, jacobian: &[f64], d: &[f64]) -> Vec<f64> {
    let entry = |at: usize| {
        let j = meta.jacobian.columns[at] as usize;
        if meta.is_fixed(j) { 0.0 } else { (jacobian[at] * d[j]).abs() }
    };
    (0..meta.rows()).map(|i| meta.jacobian.range(i).map(entry).fold(0.0, f64::max)).collect()
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
