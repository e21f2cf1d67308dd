//! The critical cone: strictly active limits hold as equalities, weakly active ones on one side.
//!
//! With Q = W^½⁻¹ S W^½⁻¹ + shift over the loose variables (W the scales of the rows of S), A the strict rows and G the weakly active
//! limits, inwards, every row of the length one, the matrix [Q Aᵀ Gᵀ; A −δ 0; G 0 −δ] is factorised and solved for right-hand
//! sides (0, 0, s): then u minimises uᵀQu + (|Au|² + |Gu − s|²)/δ, whose value sᵀMs is (as the multipliers are −Ms) known
//! with it. Q is positive on the cone {Au = 0, Gu ≥ 0} where it is on its largest subspace and M is copositive: for u in the
//! cone and s = Gu ≥ 0, uᵀQu ≥ sᵀMs ≥ 0. Conversely, what is weakened by δ is |Q|²δ/4 of curvature at the most. Rows may depend
//! on one another.

use faer::Mat;

use super::system::{Active, Choice, Hessian, weight};
use crate::certificate::Side;
use crate::certificate::parameters::second_order::{DELTA, MOST, WORK};
use crate::certificate::point::Point;
use crate::linear_algebra::entries::Symmetric;
use crate::linear_algebra::near_null_space::Rows;
use crate::linear_algebra::saddle_point::DEPENDENT;
use crate::linear_algebra::{Effort, FactorizationError};

/// How the matrix is stored and factorised: [`Symmetric::curved`] or [`Symmetric::one_of_many`].
pub(super) type Build = fn(usize, &[(u32, u32)]) -> Result<Symmetric, FactorizationError>;

pub(super) struct Cone<'a> {
    point: &'a Point<'a>,
    loose: Vec<usize>,
    /// The unknowns' directions over the loose variables in their scales, where they are not these variables.
    basis: Option<Mat<f64>>,
    unknowns: usize,
    strict: usize,
    weak: usize,
    /// W^½⁻¹, over the loose variables.
    scale: Vec<f64>,
    /// Entries of Q, A and G: (row, column, value).
    hessian: Vec<(u32, u32, f64)>,
    strict_rows: Vec<(u32, u32, f64)>,
    weak_rows: Vec<(u32, u32, f64)>,
    matrix: Symmetric,
}

impl<'a> Cone<'a> {
    pub(super) fn new(
        point: &'a Point<'a>,
        active: &Active<'_>,
        hessian: &Hessian,
        choice: &Choice,
        build: Build,
    ) -> Result<Self, FactorizationError> {
        point.in_time()?;
        let (loose, strict) = (choice.loose_variables(), choice.strict_rows());
        // One of many components must not cost what all of them do.
        let place = |j: usize| loose.binary_search(&j).ok();
        let scale: Vec<f64> = loose.iter().map(|&j| weight(hessian.size[j]).sqrt().recip()).collect();
        let pattern = &point.meta().hessian;
        let entry = |a: usize, at: usize| {
            let b = place(pattern.columns[at] as usize)?;
            Some((a as u32, b as u32, hessian.values[at] * scale[a] * scale[b]))
        };
        let of_row = |(a, &row): (usize, &usize)| pattern.range(row).filter_map(move |at| entry(a, at));
        let entries: Vec<(u32, u32, f64)> = loose.iter().enumerate().flat_map(of_row).collect();
        let row = |i: usize, sign: f64| -> Vec<(u32, f64)> {
            let inside =
                point.row_in_sizes(i).filter(|&(_, value)| value != 0.0).filter_map(|(j, value)| Some((place(j)?, value)));
            let scaled: Vec<_> = inside.map(|(at, value)| (at as u32, sign * value * scale[at])).collect();
            let length = scaled.iter().map(|entry| entry.1 * entry.1).sum::<f64>().sqrt();
            scaled.into_iter().map(|(j, value)| (j, value / length)).collect()
        };
        let inwards = |side: Side| if side == Side::Upper { -1.0 } else { 1.0 };
        let strict_rows: Vec<_> = strict.iter().map(|&i| row(i, 1.0)).collect();
        let bounds =
            choice.weak_bounds.iter().map(|&j| place(j).map(|at| (at as u32, inwards(active.bounds[j]))).into_iter().collect());
        let rows = choice.weak_rows.iter().map(|&i| row(i, inwards(active.rows[i])));
        let weak_rows: Vec<_> = bounds.chain(rows).collect();
        let (p, m, k) = (loose.len(), strict.len(), weak_rows.len());
        let listed = |rows: Vec<Vec<(u32, f64)>>, first: usize| -> Vec<(u32, u32, f64)> {
            let entry =
                |(at, row): (usize, Vec<(u32, f64)>)| row.into_iter().map(move |(j, value)| ((first + at) as u32, j, value));
            rows.into_iter().enumerate().flat_map(entry).collect()
        };
        let (strict_rows, weak_rows) = (listed(strict_rows, p), listed(weak_rows, p + m));
        let mut positions: Vec<(u32, u32)> = (0..(p + m + k) as u32).map(|at| (at, at)).collect();
        positions.extend(entries.iter().chain(&strict_rows).chain(&weak_rows).map(|entry| (entry.0, entry.1)));
        let matrix = build(p + m + k, &positions)?;
        Ok(Cone {
            point,
            loose,
            basis: None,
            unknowns: p,
            strict: m,
            weak: k,
            scale,
            hessian: entries,
            strict_rows,
            weak_rows,
            matrix,
        })
    }

    /// The same cone over a basis of the null space of the strict rows: exact where these nearly depend on one another, and dense. `None` where it
    /// has too many dimensions.
    pub(super) fn within_strict_rows(&self) -> Result<Option<Self>, FactorizationError> {
        self.point.in_time()?;
        let p = self.unknowns;
        let rows: Vec<(u32, u32, f64)> = self.strict_rows.iter().map(|&(row, j, value)| (row - p as u32, j, value)).collect();
        let most = MOST.min(WORK / self.order().max(1));
        let Some(basis) = (Rows { count: self.strict, columns: p, entries: &rows }).null_space(most)? else { return Ok(None) };
        let d = basis.ncols();
        let mut curved = Mat::<f64>::zeros(p, d);
        let mut weak = Mat::<f64>::zeros(self.weak, d);
        for k in 0..d {
            for &(a, b, value) in &self.hessian {
                let (a, b) = (a as usize, b as usize);
                curved[(a, k)] += value * basis[(b, k)];
                if a != b {
                    curved[(b, k)] += value * basis[(a, k)];
                }
            }
            let first = p + self.strict;
            self.weak_rows.iter().for_each(|&(row, j, value)| weak[(row as usize - first, k)] += value * basis[(j as usize, k)]);
        }
        let reduced = basis.transpose() * &curved;
        let lower = (0..d).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let hessian: Vec<_> = lower.map(|(i, j)| (i as u32, j as u32, 0.5 * (reduced[(i, j)] + reduced[(j, i)]))).collect();
        // A limit that strict rows hold keeps nothing more.
        let lengths: Vec<f64> = (0..self.weak).map(|i| weak.row(i).norm_l2()).collect();
        let kept = (0..self.weak).filter(|&i| lengths[i] > DEPENDENT.sqrt());
        let weak_rows: Vec<_> = kept
            .enumerate()
            .flat_map(|(at, i)| {
                let (weak, length) = (&weak, lengths[i]);
                (0..d).map(move |j| ((d + at) as u32, j as u32, weak[(i, j)] / length))
            })
            .collect();
        let k = weak_rows.len() / d.max(1);
        let mut positions: Vec<(u32, u32)> = (0..(d + k) as u32).map(|at| (at, at)).collect();
        positions.extend(hessian.iter().chain(&weak_rows).map(|entry| (entry.0, entry.1)));
        let matrix = Symmetric::one_of_many(d + k, &positions)?;
        Ok(Some(Cone {
            point: self.point,
            loose: self.loose.clone(),
            basis: Some(basis),
            unknowns: d,
            strict: 0,
            weak: k,
            scale: self.scale.clone(),
            hessian,
            strict_rows: Vec::new(),
            weak_rows,
            matrix,
        }))
    }

    /// Whether Q, shifted, is positive on the null space of the strict rows, weakly active limits left aside: the sufficient test.
    pub(super) fn is_positive_without_weak_limits(&mut self, shift: f64) -> Result<bool, FactorizationError> {
        self.factor(shift, 0.0, -1.0)
    }

    /// Whether Q, shifted, is positive on the cone's largest subspace, where all limits hold. To be called before the following.
    pub(super) fn is_positive_on_subspace(&mut self, shift: f64) -> Result<bool, FactorizationError> {
        self.factor(shift, 1.0, -DELTA)
    }

    fn factor(&mut self, shift: f64, share: f64, weak: f64) -> Result<bool, FactorizationError> {
        self.point.in_time()?;
        let (p, m, k) = (self.unknowns, self.strict, self.weak);
        let diagonal = std::iter::repeat_n(shift, p).chain(std::iter::repeat_n(-DELTA, m)).chain(std::iter::repeat_n(weak, k));
        let entries = diagonal.chain(self.hessian.iter().chain(&self.strict_rows).map(|entry| entry.2));
        let inertia = self.matrix.inertia(entries.chain(self.weak_rows.iter().map(|entry| share * entry.2)), Effort::Any)?;
        Ok(inertia.positive == p && inertia.negative == m + k)
    }

    /// M, row by row.
    pub(super) fn reduced(&self) -> Result<Vec<f64>, FactorizationError> {
        let (first, k) = (self.unknowns + self.strict, self.weak);
        let mut reduced = Vec::with_capacity(k * k);
        for i in 0..k {
            self.point.in_time()?;
            let mut right = vec![0.0; first + k];
            right[first + i] = 1.0;
            reduced.extend(self.matrix.solve(&right)?[first..].iter().map(|multiplier| -multiplier));
        }
        Ok(reduced)
    }

    /// The direction of least curvature among those that leave the weakly active limits by s, in the user's variables, its
    /// largest relative entry 1. `None` where it is not in the cone, by more than what δ may leave.
    pub(super) fn direction(&self, s: &[f64]) -> Result<Option<Vec<f64>>, FactorizationError> {
        let (p, first) = (self.unknowns, self.unknowns + self.strict);
        let mut right = vec![0.0; first + self.weak];
        right[first..].copy_from_slice(s);
        let mut u = self.matrix.solve(&right)?;
        u.truncate(p);
        let length = u.iter().map(|u| u * u).sum::<f64>().sqrt();
        let mut change = vec![0.0; self.strict + self.weak];
        let rows = self.strict_rows.iter().chain(&self.weak_rows);
        rows.for_each(|&(row, j, value)| change[row as usize - p] += value * u[j as usize]);
        let slack = DELTA.sqrt() * length;
        let is_inside = change[..self.strict].iter().all(|change| change.abs() <= slack)
            && change[self.strict..].iter().all(|change| *change >= -slack);
        let u = match &self.basis {
            Some(basis) => (0..self.loose.len()).map(|j| u.iter().enumerate().map(|(k, u)| basis[(j, k)] * u).sum()).collect(),
            None => u,
        };
        let relative: Vec<f64> = u.iter().zip(&self.scale).map(|(u, scale)| u * scale).collect();
        let largest = relative.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        if !(is_inside && largest > 0.0 && largest.is_finite()) {
            return Ok(None);
        }
        let mut direction = vec![0.0; self.point.meta().variables()];
        for (&j, v) in self.loose.iter().zip(relative) {
            direction[j] = v / largest * self.point.sizes[j];
        }
        Ok(Some(direction))
    }

    /// Rows and variables of the matrix.
    pub(super) fn order(&self) -> usize {
        self.unknowns + self.strict + self.weak
    }

    /// Weakly active limits of the matrix.
    pub(super) fn weak(&self) -> usize {
        self.weak
    }

    /// Whether there are strict rows.
    pub(super) fn has_strict_rows(&self) -> bool {
        self.strict > 0
    }
}
