//! From the one form to NLopt's: minimise f(w) subject to g(w) ≤ 0, h(w) = 0 and bounds with room between them.

use super::independent;
use crate::math::within;
use crate::model::stated::stated;
use crate::model::views::scaled::{Scaled, Scales};
use crate::model::{EvaluationError, Meta, Model};

/// One side of a row: sign·(c_row − limit), scaled.
struct RowSide {
    row: usize,
    sign: f64,
    limit: f64,
}

/// Which rows of NLopt's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RowKind {
    Inequalities,
    Equalities,
}

/// The largest magnitude NLopt is given: sums of squares of such numbers, and products of three, are finite. Bounds beyond it
/// count as open, values beyond it as none.
pub(super) const LARGEST: f64 = 1e100;

/// A scaled model without its fixed variables, rows split into sides.
pub(super) struct InequalityForm<'a> {
    scaled: Scaled<'a>,
    free: Vec<usize>,
    /// Position among the free variables; `usize::MAX` for fixed ones.
    position: Vec<usize>,
    template: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    inequalities: Vec<RowSide>,
    equalities: Vec<RowSide>,
}

impl<'a> InequalityForm<'a> {
    /// The model in units of `scales`, to be started at `x`.
    pub fn new(model: &'a dyn Model, scales: Scales, x: &[f64]) -> Self {
        let scaled = Scaled::new(model, scales);
        let meta = scaled.meta();
        // NLopt fixes a variable whose room is below the smallest normal number by itself, and hands its dimensions on wrongly.
        let has_room = |&j: &usize| meta.upper[j] - meta.lower[j] >= f64::MIN_POSITIVE;
        let free: Vec<usize> = (0..meta.variables()).filter(has_room).collect();
        let mut position = vec![usize::MAX; meta.variables()];
        for (at, &j) in free.iter().enumerate() {
            position[j] = at;
        }
        let template = clamped(scaled.scaled_point(x), meta);
        let open = |bound: f64| if bound.abs() > LARGEST { bound * f64::INFINITY } else { bound };
        let lower = free.iter().map(|&j| open(meta.lower[j])).collect();
        let upper = free.iter().map(|&j| open(meta.upper[j])).collect();
        let (inequalities, equalities) = sides(meta, &position);
        InequalityForm { free, position, template, lower, upper, inequalities, equalities, scaled }
    }

    /// Leaves out equalities whose gradients at the start depend on others'.
    ///
    /// # Errors
    /// Those of the model at the start.
    pub fn keep_independent(&mut self) -> Result<(), EvaluationError> {
        let count = self.equalities.len();
        let mut dense = vec![0.0; count * self.free.len()];
        if !dense.is_empty() {
            self.spread_jacobian(RowKind::Equalities, &self.jacobian(&self.template)?, &mut dense);
        }
        let lines: Vec<&[f64]> = dense.chunks_exact(self.free.len().max(1)).collect();
        let is_linear: Vec<bool> = self.equalities.iter().map(|side| self.scaled.meta().row_is_linear[side.row]).collect();
        let kept = independent::choice(&lines, &is_linear);
        let mut at = 0..;
        self.equalities.retain(|_| at.next().is_some_and(|at| kept.binary_search(&at).is_ok()));
        Ok(())
    }

    /// Takes the bounds off variables whose value an equation states within them: SLSQP's subproblems lose their way where gradients of
    /// an equation and of a bound depend on one another.
    pub fn open_what_is_stated(&mut self) {
        for at in stated(&self.scaled, &self.free, &self.template).iter().enumerate().filter_map(|(at, is)| is.then_some(at)) {
            (self.lower[at], self.upper[at]) = (f64::NEG_INFINITY, f64::INFINITY);
        }
    }

    /// Lower bounds of the free variables.
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// Upper bounds of the free variables.
    pub fn upper(&self) -> &[f64] {
        &self.upper
    }

    /// Where the run starts: the point the form was made about.
    pub fn start(&self) -> Vec<f64> {
        self.free.iter().map(|&j| self.template[j]).collect()
    }

    /// Number of g or h.
    pub fn count(&self, kind: RowKind) -> usize {
        self.sides(kind).len()
    }

    fn sides(&self, kind: RowKind) -> &[RowSide] {
        match kind {
            RowKind::Inequalities => &self.inequalities,
            RowKind::Equalities => &self.equalities,
        }
    }

    /// All variables of the scaled model, bounds kept to the last bit.
    pub fn complete(&self, w: &[f64]) -> Vec<f64> {
        let mut full = self.template.clone();
        for (at, &j) in self.free.iter().enumerate() {
            full[j] = w[at].max(self.scaled.meta().lower[j]).min(self.scaled.meta().upper[j]);
        }
        full
    }

    /// The point in the model's own units.
    pub fn unscaled(&self, full: &[f64]) -> Vec<f64> {
        self.scaled.unscaled_point(full)
    }

    /// f in the model's own units.
    pub fn unscaled_objective(&self, value: f64) -> f64 {
        value * self.scaled.scales().objective
    }

    /// f(w), with ∇f(w) over the free variables where asked for.
    pub fn objective(&self, full: &[f64], gradient: Option<&mut [f64]>) -> Result<f64, EvaluationError> {
        let Some(gradient) = gradient else { return self.scaled.objective(full) };
        let mut all = vec![0.0; full.len()];
        let value = self.scaled.gradient(full, &mut all)?;
        for (entry, &j) in gradient.iter_mut().zip(&self.free) {
            *entry = all[j];
        }
        Ok(value)
    }

    /// c(w), scaled.
    pub fn rows(&self, full: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let mut values = vec![0.0; self.scaled.meta().rows()];
        if !values.is_empty() {
            self.scaled.constraints(full, &mut values)?;
        }
        Ok(values)
    }

    /// The scaled Jacobian's values.
    pub fn jacobian(&self, full: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let mut values = vec![0.0; self.scaled.meta().jacobian.len()];
        self.scaled.jacobian(full, &mut values)?;
        Ok(values)
    }

    /// g or h from c.
    pub fn spread(&self, kind: RowKind, rows: &[f64], values: &mut [f64]) {
        for (value, side) in values.iter_mut().zip(self.sides(kind)) {
            *value = side.sign * (rows[side.row] - side.limit);
        }
    }

    /// The dense Jacobian of g or h, by rows, from the sparse one; `dense` comes zeroed.
    pub fn spread_jacobian(&self, kind: RowKind, sparse: &[f64], dense: &mut [f64]) {
        let pattern = &self.scaled.meta().jacobian;
        for (line, side) in dense.chunks_exact_mut(self.free.len()).zip(self.sides(kind)) {
            for at in pattern.range(side.row) {
                if let Some(entry) = line.get_mut(self.position[pattern.columns[at] as usize]) {
                    *entry = side.sign * sparse[at];
                }
            }
        }
    }

    /// The largest scaled violation at a point in the model's own units; `None` where it has no value.
    pub fn violation_at(&self, x: &[f64]) -> Option<f64> {
        let rows = self.rows(&self.scaled.scaled_point(x)).ok()?;
        Some(self.violation(&rows).0)
    }

    /// The largest violation of a row: scaled, and in the model's own units.
    pub fn violation(&self, rows: &[f64]) -> (f64, f64) {
        let meta = self.scaled.meta();
        let mut largest = (0.0_f64, 0.0_f64);
        for (row, &value) in rows.iter().enumerate() {
            let violation = (meta.row_lower[row] - value).max(value - meta.row_upper[row]).max(0.0);
            largest = (largest.0.max(violation), largest.1.max(violation * self.scaled.scales().rows[row]));
        }
        largest
    }
}

fn clamped(mut point: Vec<f64>, meta: &Meta) -> Vec<f64> {
    for (j, value) in point.iter_mut().enumerate() {
        *value = within(*value, meta.lower[j], meta.upper[j]);
    }
    point
}

/// A row without a free variable is a constant, and nothing NLopt could change.
fn sides(meta: &Meta, position: &[usize]) -> (Vec<RowSide>, Vec<RowSide>) {
    let (mut inequalities, mut equalities) = (Vec::new(), Vec::new());
    let varies = |&row: &usize| meta.jacobian.range(row).any(|at| position[meta.jacobian.columns[at] as usize] != usize::MAX);
    for row in (0..meta.rows()).filter(varies) {
        let (lower, upper) = (meta.row_lower[row], meta.row_upper[row]);
        if lower == upper {
            equalities.push(RowSide { row, sign: 1.0, limit: lower });
            continue;
        }
        if lower.is_finite() {
            inequalities.push(RowSide { row, sign: -1.0, limit: lower });
        }
        if upper.is_finite() {
            inequalities.push(RowSide { row, sign: 1.0, limit: upper });
        }
    }
    (inequalities, equalities)
}
