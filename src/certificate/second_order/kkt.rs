//! The scaled KKT matrix over free variables and active rows, and what its inertia says.

mod flat;

use super::system::{Hessian, places, weight};
use crate::certificate::parameters::second_order::POWER_STEPS;
use crate::certificate::point::Point;
use crate::linear_algebra::entries::Symmetric;
use crate::linear_algebra::saddle_point::{DEPENDENT, DUAL};
use crate::linear_algebra::{Effort, FactorizationError, Inertia};
use crate::math::split_mix::SplitMix;

/// [S + shift, Aᵀ; A, −δI]
pub(in crate::certificate) struct Kkt<'a> {
    point: &'a Point<'a>,
    free: Vec<usize>,
    /// Entries of S: (place among the free, place, value).
    hessian: Vec<(u32, u32, f64)>,
    /// Entries of A, each row divided by its slope: (row, place among the free, value).
    rows: Vec<(u32, u32, f64)>,
    /// Magnitudes of the rows of S.
    size: Vec<f64>,
    /// What each row of A was divided by.
    slopes: Vec<f64>,
    held: usize,
    matrix: Symmetric,
}

impl<'a> Kkt<'a> {
    pub(in crate::certificate) fn new(
        point: &'a Point<'a>,
        hessian: &Hessian,
        free: &[usize],
        held: &[usize],
    ) -> Result<Self, FactorizationError> {
        let place = places(point.meta().variables(), free);
        let entry = |(at, (row, column)): (usize, (usize, usize))| match (place[row], place[column]) {
            (u32::MAX, _) | (_, u32::MAX) => None,
            (row, column) => Some((row, column, hessian.values[at])),
        };
        let entries = point.meta().hessian.iter().enumerate().filter_map(entry).collect();
        let size = free.iter().map(|&j| hessian.size[j]).collect();
        Kkt::assemble(point, free, held, (entries, size), Symmetric::curved)
    }

    /// Only A matters.
    pub(in crate::certificate) fn without_hessian(
        point: &'a Point<'a>,
        free: &'a [usize],
        held: &[usize],
    ) -> Result<Self, FactorizationError> {
        Kkt::assemble(point, free, held, (Vec::new(), vec![0.0; free.len()]), Symmetric::new)
    }

    fn assemble(
        point: &'a Point<'a>,
        free: &[usize],
        held: &[usize],
        (hessian, size): (Vec<(u32, u32, f64)>, Vec<f64>),
        build: impl Fn(usize, &[(u32, u32)]) -> Result<Symmetric, FactorizationError>,
    ) -> Result<Self, FactorizationError> {
        point.in_time()?;
        let place = places(point.meta().variables(), free);
        let (mut rows, slopes) = (Vec::new(), held.iter().map(|&i| point.slopes[i]).collect());
        for (k, &i) in held.iter().enumerate() {
            let of_free = point.row_in_sizes(i).filter(|&(j, _)| place[j] != u32::MAX);
            rows.extend(of_free.map(|(j, value)| (k as u32, place[j], value)));
        }
        let p = free.len() as u32;
        let mut positions: Vec<_> = (0..p + held.len() as u32).map(|k| (k, k)).collect();
        positions.extend(hessian.iter().map(|&(row, column, _)| (row, column)));
        positions.extend(rows.iter().map(|&(row, column, _)| (p + row, column)));
        let matrix = build(free.len() + held.len(), &positions)?;
        Ok(Kkt { point, free: free.to_vec(), hessian, rows, size, slopes, held: held.len(), matrix })
    }

    /// Factorises with S shifted by `shift` times its rows' magnitudes; true where S then has negative curvature on the null space of A.
    pub(in crate::certificate) fn has_negative_curvature(
        &mut self,
        shift: f64,
        effort: Effort,
    ) -> Result<bool, FactorizationError> {
        let size = &self.size;
        let diagonal = size.iter().map(|&size| shift * weight(size)).chain(std::iter::repeat_n(-DUAL, self.held));
        let entries = diagonal.chain(self.hessian.iter().map(|e| e.2)).chain(self.rows.iter().map(|e| e.2));
        Ok(inertia(self.point, &mut self.matrix, entries, effort)?.negative > self.held)
    }

    /// Whether the rows of A are linearly dependent: [I Aᵀ; A εI] gains a positive eigenvalue for every singular value below √ε.
    pub(in crate::certificate) fn dependent_rows(&mut self) -> Result<bool, FactorizationError> {
        if self.held == 0 {
            return Ok(false);
        }
        if self.held > self.free.len() {
            return Ok(true);
        }
        let diagonal = std::iter::repeat_n(1.0, self.free.len()).chain(std::iter::repeat_n(DEPENDENT, self.held));
        let entries = diagonal.chain(self.hessian.iter().map(|_| 0.0)).chain(self.rows.iter().map(|e| e.2));
        match inertia(self.point, &mut self.matrix, entries, Effort::Any) {
            // As near to dependent as rounding can tell.
            Err(FactorizationError::Uncertain) => Ok(true),
            inertia => Ok(inertia?.negative < self.held),
        }
    }

    /// The direction of lowest curvature on the null space of A, relative to S's magnitudes, by inverse iteration; in the user's
    /// variables, its largest relative entry 1. `None` where its curvature, computed anew, is not below −shift.
    pub(in crate::certificate) fn lowest_direction(&mut self, shift: f64) -> Result<Option<Vec<f64>>, FactorizationError> {
        let mut raised = 4.0 * shift;
        while raised < 1e12 && self.has_negative_curvature(raised, Effort::Any)? {
            raised *= 4.0;
        }
        let mut v: Vec<f64> = (0..self.free.len()).map(scattered).collect();
        for _ in 0..POWER_STEPS {
            self.point.in_time()?;
            let right =
                (0..v.len()).map(|k| weight(self.size[k]) * v[k]).chain(std::iter::repeat_n(0.0, self.held)).collect::<Vec<_>>();
            v = self.matrix.solve(&right)?;
            v.truncate(self.free.len());
            let size = v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            if !(size > 0.0 && size.is_finite()) {
                return Ok(None);
            }
            v.iter_mut().for_each(|v| *v /= size);
        }
        Ok((self.rayleigh(&v) < -0.5 * shift).then(|| self.in_user_variables(&v)))
    }

    /// Factorises [S + |S| + I, Aᵀ; A, −δI]: steps with it go downhill and back to the rows, and never far.
    pub(in crate::certificate) fn factor_proximal(&mut self) -> Result<(), FactorizationError> {
        let diagonal = self.size.iter().map(|size| size + 1.0).chain(std::iter::repeat_n(-DUAL, self.held));
        let entries = diagonal.chain(self.hessian.iter().map(|e| e.2)).chain(self.rows.iter().map(|e| e.2));
        factor(self.point, &mut self.matrix, entries)
    }

    /// Factorises [I Aᵀ; A −δI]: steps with it are the shortest back to the rows.
    pub(in crate::certificate) fn factor_projection(&mut self) -> Result<(), FactorizationError> {
        let diagonal = std::iter::repeat_n(1.0, self.free.len()).chain(std::iter::repeat_n(-DUAL, self.held));
        let entries = diagonal.chain(self.hessian.iter().map(|_| 0.0)).chain(self.rows.iter().map(|e| e.2));
        factor(self.point, &mut self.matrix, entries)
    }

    /// What row k of A was divided by.
    pub(in crate::certificate) fn slope(&self, k: usize) -> f64 {
        self.slopes[k]
    }

    /// The product of [S Aᵀ; A 0] with a vector.
    pub(super) fn product(&self, v: &[f64]) -> Vec<f64> {
        let (p, mut product) = (self.free.len(), vec![0.0; v.len()]);
        let mut add = |a: usize, b: usize, value: f64| {
            product[a] += value * v[b];
            if a != b {
                product[b] += value * v[a];
            }
        };
        self.hessian.iter().for_each(|&(row, column, value)| add(row as usize, column as usize, value));
        self.rows.iter().for_each(|&(row, column, value)| add(p + row as usize, column as usize, value));
        product
    }

    /// Solves with the factors found last: over the free variables, in their scales, then the rows.
    pub(in crate::certificate) fn solve(&self, right: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        self.matrix.solve(right)
    }

    /// One of several steps that correct one another.
    pub(in crate::certificate) fn chord_step(&self, right: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        self.matrix.solve_once(right)
    }

    /// vᵀSv over vᵀWv, W the magnitudes.
    fn rayleigh(&self, v: &[f64]) -> f64 {
        let weight: f64 = v.iter().enumerate().map(|(k, v)| weight(self.size[k]) * v * v).sum();
        self.bend(v) / weight
    }

    /// vᵀSv
    pub(super) fn bend(&self, v: &[f64]) -> f64 {
        let term = |&(row, column, value): &(u32, u32, f64)| {
            let product = value * v[row as usize] * v[column as usize];
            if row == column { product } else { 2.0 * product }
        };
        self.hessian.iter().map(term).sum::<f64>()
    }

    fn in_user_variables(&self, v: &[f64]) -> Vec<f64> {
        let mut direction = vec![0.0; self.point.meta().variables()];
        for (&j, v) in self.free.iter().zip(v) {
            direction[j] = v * self.point.sizes[j];
        }
        direction
    }
}

fn factor(point: &Point<'_>, matrix: &mut Symmetric, entries: impl Iterator<Item = f64>) -> Result<(), FactorizationError> {
    point.in_time()?;
    matrix.factor(entries)
}

fn inertia(
    point: &Point<'_>,
    matrix: &mut Symmetric,
    entries: impl Iterator<Item = f64>,
    effort: Effort,
) -> Result<Inertia, FactorizationError> {
    point.in_time()?;
    matrix.inertia(entries, effort)
}

/// A fixed number in [0.5, 1.5) with no pattern to it, so that no eigenvector is missed by symmetry.
pub(super) fn scattered(k: usize) -> f64 {
    0.5 + SplitMix::share(k as u64)
}
