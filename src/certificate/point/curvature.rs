//! What curvature has a say in: the objective's scale where the slope at the point measures nothing, and the sizes of variables that are
//! known only so.

use super::{Point, slopes};
use crate::certificate::parameters::sizes::{RESIZABLE, RESIZED, SIGNIFICANT};
use crate::certificate::scales;
use crate::model::{EvaluationError, Model};

impl Point<'_> {
    /// Where the objective is nearly stationary by itself, its slope at x measures nothing; what its curvature makes of the sizes
    /// does: max_j Σ_k |∂²f/∂x_j∂x_k|·d_j·d_k, the slope one size away.
    pub(in crate::certificate) fn add_curvature(&mut self) -> Result<(), EvaluationError> {
        let meta = self.meta();
        if meta.objective_is_linear || !self.bends.is_empty() {
            return Ok(());
        }
        let mut values = vec![0.0; meta.hessian.len()];
        self.origin.model.hessian(self.x, 1.0, &vec![0.0; meta.rows()], &mut values)?;
        let mut slopes = vec![0.0; self.x.len()];
        let moves = |&((row, column), _): &((usize, usize), f64)| !meta.is_fixed(row) && !meta.is_fixed(column);
        for ((row, column), value) in meta.hessian.iter().zip(values).filter(moves) {
            let bend = (value * self.sizes[row] * self.sizes[column]).abs();
            slopes[row] += bend;
            if row != column {
                slopes[column] += bend;
            }
        }
        let steepest = slopes.iter().copied().fold(0.0, f64::max);
        if steepest.is_finite() {
            self.sigma = self.sigma.max(steepest);
            self.bends = self.passed_on(&slopes);
        }
        Ok(())
    }

    /// What rows pass on from variable to variable: a multiplier is as uncertain as the slopes it balances, by d_k·∂c_i/∂x_k.
    fn passed_on(&self, bends: &[f64]) -> Vec<f64> {
        let (meta, mut all) = (self.meta(), bends.to_vec());
        for i in 0..meta.rows() {
            let entry = |at: usize| {
                let j = meta.jacobian.columns[at] as usize;
                (j, (self.jacobian[at] * self.sizes[j]).abs())
            };
            let significant = |&(_, slope): &(usize, f64)| slope > SIGNIFICANT * self.slopes[i];
            let multiplier = meta.jacobian.range(i).map(entry).filter(significant).map(|(k, slope)| bends[k] / slope);
            let multiplier = multiplier.fold(0.0, f64::max);
            meta.jacobian.range(i).map(entry).for_each(|(j, slope)| all[j] = all[j].max(multiplier * slope));
        }
        all
    }

    /// What a slope along variable j is measured by: curvature counts for the variables that it bends alone, so that one whose
    /// size is far off hides nothing of the others.
    pub(in crate::certificate) fn scale_of(&self, j: usize) -> f64 {
        let own = self.bends.get(j).map_or(self.sigma, |bend| bend.max(self.steepest));
        if own > 0.0 { own } else { self.scale() }
    }

    /// How steep the objective is about x; see [`scales::slope_about`].
    pub(in crate::certificate) fn slope_about(&self) -> f64 {
        scales::slope_about(self.origin, self.x, &self.sizes)
    }

    /// Whether the size of variable j is not |x_j| but what is known of it otherwise.
    pub(in crate::certificate) fn is_size_known_otherwise(&self, j: usize) -> bool {
        self.x[j].abs() < self.sizes[j]
    }

    /// Variables whose size is known otherwise get the size in which the Lagrangian's own curvature is as large as `slope`, where it
    /// is curvature that tells what a unit is: where over a step in that variable alone the slope changes as the second derivative
    /// says. `bend(j)` is ∂²L/∂x_j²·d_j². Others keep theirs.
    pub(in crate::certificate) fn resize_by_curvature(&mut self, bend: impl Fn(usize) -> f64, slope: f64) {
        let bends = (0..self.x.len()).filter(|&j| self.is_size_known_otherwise(j)).map(|j| (j, bend(j).abs() / slope));
        let bends = bends.filter(|&(_, bend)| bend > 0.0 && bend.is_finite()).take(RESIZABLE);
        let tells = |&(j, bend): &(usize, f64)| scales::is_quadratic(self, j, bend * slope / self.sizes[j]);
        let resized: Vec<(usize, f64)> = bends.filter(tells).collect();
        if resized.is_empty() {
            return;
        }
        self.plain_sizes.clone_from(&self.sizes);
        for (j, bend) in resized {
            self.sizes[j] *= bend.sqrt().recip().clamp(1.0 / RESIZED, RESIZED);
        }
        self.slopes = slopes(self.meta(), &self.jacobian, &self.sizes);
        self.bends.clear();
    }

    /// The variables' sizes whatever the curvature.
    pub(in crate::certificate) fn plain_sizes(&self) -> &[f64] {
        if self.plain_sizes.is_empty() { &self.sizes } else { &self.plain_sizes }
    }
}
