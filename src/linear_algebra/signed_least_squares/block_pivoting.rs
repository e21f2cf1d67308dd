//! Block principal pivoting (Portugal, Júdice, Vicente 1994: "A comparison of block pivoting and interior-point algorithms for
//! linear least squares problems with nonnegative variables") on the augmented system, which stays sparse where BᵀB does not.

use std::time::Instant;

use super::problem::{Column, PROXIMAL, Stationary, residual};
use crate::linear_algebra::FactorizationError;
use crate::linear_algebra::entries::Symmetric;

const REPETITIONS: usize = 12;

pub(super) type Build = fn(usize, &[(u32, u32)]) -> Result<Symmetric, FactorizationError>;

pub(super) fn pivoted(
    g: &[f64],
    columns: &[Column<'_>],
    until: Option<Instant>,
    build: Build,
) -> Result<Vec<f64>, FactorizationError> {
    let mut pivoting = Pivoting::new(g, columns, until, Augmented::new(g, columns, build)?);
    repeated(columns.len(), |centre| pivoting.solve(centre).map(|y| (y, pivoting.is_settled)))
}

/// Moves the proximal term's centre after the minimiser until both are the same, or what is found is none: `solve` says whether it is.
pub(super) fn repeated<E>(columns: usize, mut solve: impl FnMut(&[f64]) -> Result<(Vec<f64>, bool), E>) -> Result<Vec<f64>, E> {
    let mut y = vec![0.0; columns];
    for _ in 0..REPETITIONS {
        let (next, is_settled) = solve(&y)?;
        let moved = next.iter().zip(&y).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        let size = next.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
        y = next;
        if !is_settled || moved <= 1e-13 * size {
            break;
        }
    }
    Ok(y)
}

pub(super) struct Pivoting<'a, S> {
    g: &'a [f64],
    columns: &'a [Column<'a>],
    basic: Vec<bool>,
    is_new: bool,
    /// Whether the last search ended with no column on the wrong side.
    is_settled: bool,
    /// When to take what is there.
    until: Option<Instant>,
    method: S,
}

impl<'a, S: Stationary> Pivoting<'a, S> {
    pub(super) fn new(g: &'a [f64], columns: &'a [Column<'a>], until: Option<Instant>, method: S) -> Self {
        let basic = columns.iter().map(|column| column.basic || column.sign == 0.0).collect();
        Pivoting { g, columns, basic, is_new: true, is_settled: false, until, method }
    }

    /// The minimiser with the proximal term around `centre`.
    pub(super) fn solve(&mut self, centre: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let (mut fewest, mut patience) = (usize::MAX, 5);
        let mut y = self.stationary(centre)?;
        self.is_settled = false;
        for _ in 0..(20 + 3 * self.columns.len()).min(300) {
            let wrong = self.wrong(&y, centre);
            self.is_settled = wrong.is_empty();
            let Some(&last) = wrong.last().filter(|_| !is_over(self.until)) else { break };
            if wrong.len() < fewest {
                (fewest, patience) = (wrong.len(), 5);
            } else {
                patience = usize::saturating_sub(patience, 1);
            }
            // Murty's rule (the last one only) cannot cycle; blocks are faster while they make progress.
            let swapped = if patience > 0 { &wrong[..] } else { std::slice::from_ref(&last) };
            for &k in swapped {
                self.basic[k] = !self.basic[k];
            }
            self.is_new = true;
            y = self.stationary(centre)?;
        }
        for (y, column) in y.iter_mut().zip(self.columns) {
            if *y * column.sign < 0.0 {
                *y = 0.0;
            }
        }
        Ok(y)
    }

    fn stationary(&mut self, centre: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let is_new = std::mem::replace(&mut self.is_new, false);
        self.method.stationary(&self.basic, is_new, centre)
    }

    /// Columns on the wrong side: basic with the wrong sign, or at zero although moving would help.
    fn wrong(&self, y: &[f64], centre: &[f64]) -> Vec<usize> {
        let residual = residual(self.g, self.columns, y);
        let is_wrong = |&k: &usize| {
            let column = &self.columns[k];
            let slope = (column.dot(&residual) - PROXIMAL * centre[k]) * column.sign;
            if self.basic[k] { y[k] * column.sign < -1e-15 } else { slope < -1e-15 }
        };
        (0..self.columns.len()).filter(|&k| self.columns[k].sign != 0.0).filter(is_wrong).collect()
    }
}

/// Whether that moment has come.
pub(super) fn is_over(until: Option<Instant>) -> bool {
    until.is_some_and(|until| Instant::now() >= until)
}

/// From [I B; Bᵀ −(T²+ε²)]·[−r; y] = [−g; −ε²·centre], over the basic columns.
pub(super) struct Augmented<'a> {
    g: &'a [f64],
    columns: &'a [Column<'a>],
    matrix: Symmetric,
}

impl<'a> Augmented<'a> {
    pub(super) fn new(g: &'a [f64], columns: &'a [Column<'a>], build: Build) -> Result<Self, FactorizationError> {
        let p = g.len() as u32;
        let mut positions: Vec<_> = (0..p + columns.len() as u32).map(|k| (k, k)).collect();
        for (k, column) in columns.iter().enumerate() {
            positions.extend(column.entries.iter().map(|&(row, _)| (p + k as u32, row)));
        }
        Ok(Augmented { g, columns, matrix: build(g.len() + columns.len(), &positions)? })
    }

    fn factor(&mut self, basic: &[bool]) -> Result<(), FactorizationError> {
        let columns = self.columns;
        let diagonal =
            |(k, column): (usize, &Column<'_>)| if basic[k] { -(column.weight * column.weight + PROXIMAL) } else { -1.0 };
        let entry = |k: usize, value: f64| if basic[k] { value } else { 0.0 };
        let couplings = columns.iter().enumerate().flat_map(|(k, c)| c.entries.iter().map(move |&(_, value)| entry(k, value)));
        let entries = std::iter::repeat_n(1.0, self.g.len()).chain(columns.iter().enumerate().map(diagonal)).chain(couplings);
        self.matrix.factor(entries)
    }
}

impl Stationary for Augmented<'_> {
    fn stationary(&mut self, basic: &[bool], is_new: bool, centre: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        if is_new {
            self.factor(basic)?;
        }
        let pull = |k: usize| if basic[k] { -PROXIMAL * centre[k] } else { 0.0 };
        let right: Vec<f64> = self.g.iter().map(|g| -g).chain((0..basic.len()).map(pull)).collect();
        let mut solution = self.matrix.solve(&right)?;
        Ok(solution.split_off(self.g.len()))
    }
}
