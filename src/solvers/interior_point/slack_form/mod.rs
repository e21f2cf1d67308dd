//! The form the interior point works on: min f(w) subject to g(w) = 0, l ≤ w ≤ u, scaled.
//!
//! w holds the variables that are not fixed, then one slack per inequality row; g is `c(x) − limit` for an equality and
//! `c(x) − s` for an inequality. Rows without any limit and fixed variables are gone, and bounds of what an equation states. Variables are scaled by powers of
//! two, so that bounds survive the way there and back bit for bit.

mod evaluation;
mod selection;

use super::parameters::PARAMETERS;
use super::scaling;
use crate::math::within;
use crate::model::stated::stated;
use crate::model::{Model, Pattern};
use evaluation::Kept;
use selection::{Entry, select_hessian, select_jacobian};
use std::ops::Deref;
use std::sync::Arc;

/// A model given, or made for the purpose (the restoration's).
pub(super) enum Source<'a> {
    Given(&'a dyn Model),
    Own(Box<dyn Model + 'a>),
}

impl<'a> Deref for Source<'a> {
    type Target = dyn Model + 'a;

    fn deref(&self) -> &Self::Target {
        match self {
            Source::Given(model) => *model,
            Source::Own(model) => model.as_ref(),
        }
    }
}

/// The problem in the interior point's form, with room for one evaluation.
pub(super) struct SlackForm<'a> {
    pub model: Source<'a>,
    /// The model's number of each variable of w.
    pub free: Vec<usize>,
    /// The model's number of each row of g.
    pub rows: Vec<usize>,
    /// The slack (an index into w) of each row, none for an equality.
    pub slack: Vec<Option<usize>>,
    /// Which variables of w an equation states: they have no bounds here.
    stated: Vec<bool>,
    /// Bounds of w, scaled.
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    /// x = variable_scale·w, c scaled = row_scale·c, f scaled = objective_scale·f.
    pub variable_scale: Vec<f64>,
    pub row_scale: Vec<f64>,
    pub objective_scale: f64,
    /// By how much the limits of inequality rows are eased, relative: gives an interior to rows that have none.
    pub ease: f64,
    /// Columns below the number of free variables; slacks are not in it.
    pub jacobian: Arc<Pattern>,
    pub hessian: Arc<Pattern>,
    jacobian_entries: Vec<Entry>,
    hessian_entries: Vec<Entry>,
    x: Vec<f64>,
    gradient_values: Vec<f64>,
    row_values: Vec<f64>,
    jacobian_values: Vec<f64>,
    hessian_values: Vec<f64>,
    multipliers: Vec<f64>,
    kept: Option<Kept<'a>>,
}

impl<'a> SlackForm<'a> {
    /// The form of `model`, fixed variables at `start`, the others scaled by `magnitudes`, rows and objective not yet.
    pub fn new(model: Source<'a>, start: &[f64], magnitudes: &[f64]) -> Self {
        let meta = model.meta();
        let free: Vec<usize> = (0..meta.variables()).filter(|&j| meta.lower[j] < meta.upper[j]).collect();
        let rows: Vec<usize> =
            (0..meta.rows()).filter(|&i| meta.row_lower[i].is_finite() || meta.row_upper[i].is_finite()).collect();
        let mut inequalities = free.len()..;
        let slack: Vec<Option<usize>> =
            rows.iter().map(|&i| (meta.row_lower[i] != meta.row_upper[i]).then(|| inequalities.next()).flatten()).collect();
        // A state's own start may be next to nothing by chance.
        let is_state = |j: usize| meta.states.is_some_and(|states| j >= states.first_variable);
        let typical = |j: usize| meta.typical.get(j).copied().filter(|size| is_state(j) && *size > 0.0);
        let magnitude = |j: usize| typical(j).unwrap_or(magnitudes[j]);
        let variable_scale: Vec<f64> =
            free.iter().map(|&j| scaling::variable_scale(magnitude(j), meta.lower[j], meta.upper[j])).collect();
        let (jacobian, jacobian_entries) = select_jacobian(&meta.jacobian, &rows, &free, meta.variables());
        let (hessian, hessian_entries) = select_hessian(&meta.hessian, &free, meta.variables());
        let mut x = start.to_vec();
        for (j, x) in x.iter_mut().enumerate() {
            *x = within(*x, meta.lower[j], meta.upper[j]);
        }
        let (n, m) = (meta.variables(), meta.rows());
        let (jacobian_size, hessian_size) = (meta.jacobian.len(), meta.hessian.len());
        let mut form = SlackForm {
            row_scale: vec![1.0; rows.len()],
            objective_scale: 1.0,
            ease: 0.0,
            lower: Vec::new(),
            upper: Vec::new(),
            stated: stated(&*model, &free, &x),
            free,
            rows,
            slack,
            variable_scale,
            jacobian: Arc::new(jacobian),
            hessian: Arc::new(hessian),
            jacobian_entries,
            hessian_entries,
            x,
            gradient_values: vec![0.0; n],
            row_values: vec![0.0; m],
            jacobian_values: vec![0.0; jacobian_size],
            hessian_values: vec![0.0; hessian_size],
            multipliers: vec![0.0; m],
            kept: None,
            model,
        };
        form.apply_scales();
        form
    }

    /// Takes these scales of objective and rows.
    pub fn rescale(&mut self, objective_scale: f64, row_scale: Vec<f64>) {
        self.objective_scale = objective_scale;
        self.row_scale = row_scale;
        self.apply_scales();
    }

    /// Takes the rows' limits as they are from now on.
    pub fn tighten(&mut self) {
        self.ease = 0.0;
        self.apply_scales();
    }

    /// Bounds and derivative factors that follow from the scales.
    fn apply_scales(&mut self) {
        let meta = self.model.meta();
        let scaled = |limits: &[f64]| self.free.iter().zip(&self.variable_scale).map(|(&j, d)| limits[j] / d).collect();
        let (mut lower, mut upper): (Vec<f64>, Vec<f64>) = (scaled(&meta.lower), scaled(&meta.upper));
        for at in (0..self.stated.len()).filter(|&at| self.stated[at]) {
            (lower[at], upper[at]) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        for (i, _) in self.slack.iter().enumerate().filter(|(_, slack)| slack.is_some()) {
            let limits = [&meta.row_lower, &meta.row_upper].map(|limits| limits[self.rows[i]] * self.row_scale[i]);
            lower.push(limits[0] - eased(limits[0], self.ease));
            upper.push(limits[1] + eased(limits[1], self.ease));
        }
        for i in 0..self.rows.len() {
            for at in self.jacobian.range(i) {
                let column = self.jacobian.columns[at] as usize;
                self.jacobian_entries[at].factor = self.row_scale[i] * self.variable_scale[column];
            }
        }
        for row in 0..self.free.len() {
            for at in self.hessian.range(row) {
                let column = self.hessian.columns[at] as usize;
                self.hessian_entries[at].factor = self.variable_scale[row] * self.variable_scale[column];
            }
        }
        (self.lower, self.upper) = (lower, upper);
    }

    /// Number of variables that are not fixed.
    pub fn variables(&self) -> usize {
        self.free.len()
    }

    /// Whether a run goes about it as a large problem: slacks well inside, steps without the filter, no more digits than are needed.
    pub fn is_large(&self) -> bool {
        self.variables() >= PARAMETERS.large
    }

    /// Variables and slacks: the length of w.
    pub fn size(&self) -> usize {
        self.lower.len()
    }

    /// The model's x at w.
    pub fn x(&mut self, w: &[f64]) -> &[f64] {
        let meta = self.model.meta();
        for ((&j, scale), w) in self.free.iter().zip(&self.variable_scale).zip(w) {
            // The upper bound first: a w that is no number becomes ∞ where the variable is open above, and its evaluation an error.
            self.x[j] = (w * scale).min(meta.upper[j]).max(meta.lower[j]);
        }
        &self.x
    }

    /// Takes w off bounds it was rounded onto: the barrier needs the strict interior.
    pub fn keep_inside(&self, w: &mut [f64]) {
        for ((w, &lower), &upper) in w.iter_mut().zip(&self.lower).zip(&self.upper) {
            if *w <= lower {
                *w = lower.next_up();
            }
            if *w >= upper {
                *w = upper.next_down();
            }
        }
    }

    /// Adds (∂g/∂w)ᵀy over variables and slacks to `target`.
    pub fn add_transposed(&self, jacobian: &[f64], y: &[f64], target: &mut [f64]) {
        self.jacobian.add_transposed(jacobian, y, &mut target[..self.free.len()]);
        for (slack, y) in self.slack.iter().zip(y) {
            if let Some(slack) = *slack {
                target[slack] -= y;
            }
        }
    }

    /// g from the rows' values: less the limit of an equality, less the slack of an inequality.
    pub fn residual(&self, w: &[f64], rows: &[f64], residual: &mut [f64]) {
        let meta = self.model.meta();
        for (i, residual) in residual.iter_mut().enumerate() {
            let target = match self.slack[i] {
                Some(slack) => w[slack],
                None => meta.row_lower[self.rows[i]] * self.row_scale[i],
            };
            *residual = rows[i] - target;
        }
    }

    /// The largest violation of rows, in the user's units, from scaled row values. (Bounds always hold.)
    pub fn violation(&self, rows: &[f64]) -> f64 {
        let meta = self.model.meta();
        let beyond = |i: usize| {
            let value = rows[i] / self.row_scale[i];
            (meta.row_lower[self.rows[i]] - value).max(value - meta.row_upper[self.rows[i]]).max(0.0)
        };
        (0..self.rows.len()).map(beyond).fold(0.0, f64::max)
    }

    /// The largest violation of the rows by scaled values, relative to the limits where those are large.
    pub fn scaled_violation(&self, rows: &[f64]) -> f64 {
        let meta = self.model.meta();
        let beyond = |i: usize| {
            let scale = self.row_scale[i];
            let (lower, upper) = (meta.row_lower[self.rows[i]] * scale, meta.row_upper[self.rows[i]] * scale);
            let (below, above) = (lower - rows[i], rows[i] - upper);
            (below / lower.abs().max(1.0)).max(above / upper.abs().max(1.0)).max(0.0)
        };
        (0..self.rows.len()).map(beyond).fold(0.0, f64::max)
    }

    /// The larger limit of each row by size, unscaled; 0 where it has none.
    pub fn limit_sizes(&self) -> Vec<f64> {
        let meta = self.model.meta();
        let size = |&row: &usize| {
            let limits = [meta.row_lower[row], meta.row_upper[row]].into_iter().filter(|limit| limit.is_finite());
            limits.map(f64::abs).fold(0.0, f64::max)
        };
        self.rows.iter().map(size).collect()
    }

    /// The model's row multipliers from scaled ones.
    pub fn multipliers(&self, y: &[f64]) -> Vec<f64> {
        let mut multipliers = vec![0.0; self.model.meta().rows()];
        for ((&i, scale), y) in self.rows.iter().zip(&self.row_scale).zip(y) {
            multipliers[i] = y * scale / self.objective_scale;
        }
        multipliers
    }
}

/// How far a limit is eased; an infinite one is not.
fn eased(limit: f64, ease: f64) -> f64 {
    if limit.is_finite() { ease * limit.abs().max(1.0) } else { 0.0 }
}
