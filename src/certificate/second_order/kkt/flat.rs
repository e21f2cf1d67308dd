//! Directions along which S hardly bends.

use nalgebra::{DMatrix, SymmetricEigen};
use rayon::prelude::*;

use super::super::spans::{beyond, is_new};
use super::{Kkt, factor, inertia, scattered};
use crate::certificate::parameters::second_order::{DELTA, FLAT_SHIFT, FLAT_STEPS};
use crate::linear_algebra::saddle_point::DUAL;
use crate::linear_algebra::{Effort, FactorizationError};
use crate::math::dot;

/// Rounds of the decomposition of a small matrix, which needs two or three for each of its rows.
const ROUNDS: usize = 1000;

impl Kkt<'_> {
    /// Whether a direction on the null space of A bends by less than `flat`, in units of σ, or by hardly more: in variables that S bends by 1
    /// and with rows of the length one, as in [`super::super::cone`].
    pub(in crate::certificate) fn is_flat(&mut self, flat: f64) -> Result<bool, FactorizationError> {
        let scale: Vec<f64> = self.size.iter().map(|size| (size + flat).sqrt().recip()).collect();
        let mut lengths = vec![0.0; self.held];
        let in_scale = |&(row, column, value): &(u32, u32, f64)| (row as usize, value * scale[column as usize]);
        self.rows.iter().map(in_scale).for_each(|(row, value)| lengths[row] += value * value);
        let diagonal = scale.iter().map(|scale| -flat * scale * scale).chain(std::iter::repeat_n(-DELTA, self.held));
        let hessian = self.hessian.iter().map(|&(row, column, value)| scale[row as usize] * value * scale[column as usize]);
        let rows = self.rows.iter().map(in_scale).map(|(row, value)| value / lengths[row].max(f64::MIN_POSITIVE).sqrt());
        match inertia(self.point, &mut self.matrix, diagonal.chain(hessian).chain(rows), Effort::Any) {
            // As near to flat as rounding can tell.
            Err(FactorizationError::Uncertain) => Ok(true),
            inertia => Ok(inertia?.negative > self.held),
        }
    }

    /// Directions on the null space of A along which S bends by less than `flat`, in units of σ: inverse iteration from `most`
    /// different places, and what these are mixed of. In the user's variables, the largest relative entry of each 1.
    pub(in crate::certificate) fn flat_directions(
        &mut self,
        most: usize,
        flat: f64,
    ) -> Result<Vec<Vec<f64>>, FactorizationError> {
        let diagonal = std::iter::repeat_n(FLAT_SHIFT, self.free.len()).chain(std::iter::repeat_n(-DUAL, self.held));
        factor(self.point, &mut self.matrix, diagonal.chain(self.hessian.iter().chain(&self.rows).map(|entry| entry.2)))?;
        let p = self.free.len();
        // Quadrants first, then single variables.
        let quadrants = (most / 3).min(1 << p.min(16).saturating_sub(1)).max(1);
        let singles = p.min(most.saturating_sub(quadrants));
        let flattest = |k: usize| {
            self.point.in_time()?;
            let sign = |at: usize| if (k * (at + 1) / 2 + (k >> (at % 4))).is_multiple_of(2) || k == 0 { 1.0 } else { -1.0 };
            let start = |at: usize| match k.checked_sub(quadrants) {
                None => sign(at) * scattered(at),
                Some(single) if at == single * p / singles => 1.0,
                Some(_) => 0.0,
            };
            let mut v: Vec<f64> = (0..p).map(start).collect();
            let mut size = 0.0;
            for step in 1..=FLAT_STEPS {
                v.extend(std::iter::repeat_n(0.0, self.held));
                // Only the last decides how well the rows are met.
                v = if step < FLAT_STEPS { self.matrix.solve_once(&v)? } else { self.matrix.solve(&v)? };
                v.truncate(p);
                size = v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
                v.iter_mut().for_each(|v| *v /= size);
            }
            let is_flat = size > 0.0 && size.is_finite() && self.bend(&v).abs() <= flat * dot(&v, &v);
            Ok(is_flat.then_some(v))
        };
        let all: Result<Vec<Option<Vec<f64>>>, FactorizationError> =
            (0..quadrants + singles).into_par_iter().map(flattest).collect();
        let (mut found, mut basis) = (Vec::<Vec<f64>>::new(), Vec::<Vec<f64>>::new());
        for v in all?.into_iter().flatten() {
            basis.extend(beyond(&basis, &v));
            if is_new(&found, &v) {
                found.push(v);
            }
        }
        for v in self.apart(&basis) {
            if self.bend(&v).abs() <= FLAT_SHIFT * dot(&v, &v) && is_new(&found, &v) {
                found.push(v);
            }
        }
        Ok(found.iter().map(|v| self.in_user_variables(v)).collect())
    }

    /// The directions within the span of an orthonormal basis along which S bends each by itself (Rayleigh and Ritz): inverse iteration mixes
    /// those whose curvature is within its shift, and a direction that a fourth power falls along is hidden by one that bends a little.
    fn apart(&self, basis: &[Vec<f64>]) -> Vec<Vec<f64>> {
        if basis.len() < 2 {
            return Vec::new();
        }
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
        let alone: Vec<f64> = basis.iter().map(|v| self.bend(v)).collect();
        let both = |i: usize, j: usize| 0.5 * (self.bend(&sum(&basis[i], &basis[j])) - alone[i] - alone[j]);
        let small = DMatrix::from_fn(basis.len(), basis.len(), |i, j| if i == j { alone[i] } else { both(i, j) });
        let mixed = |share: &[f64]| {
            let part = |at: usize| basis.iter().zip(share).map(|(v, share)| share * v[at]).sum();
            let mut v: Vec<f64> = (0..self.free.len()).map(part).collect();
            let largest = v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            v.iter_mut().for_each(|v| *v /= largest);
            v
        };
        let eigen =
            small.iter().all(|entry| entry.is_finite()).then(|| SymmetricEigen::try_new(small, f64::EPSILON, ROUNDS)).flatten();
        eigen.map_or_else(Vec::new, |eigen| eigen.eigenvectors.column_iter().map(|share| mixed(share.as_slice())).collect())
    }
}
