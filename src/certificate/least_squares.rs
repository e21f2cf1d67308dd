//! Sign-constrained sparse least squares: min ½‖g + By‖² + ½‖Ty‖² with y_k ≥ 0, ≤ 0 or free.
//!
//! Block principal pivoting (Portugal, Júdice, Vicente 1994: "A comparison of block pivoting and interior-point algorithms for
//! linear least squares problems with nonnegative variables") on the augmented system, which stays sparse where BᵀB does not.
//! Dependent columns are tamed by a proximal term whose bias the outer repetitions remove.

use super::active_set::{self, ActiveSet};
use super::matrix::Symmetric;
use crate::linear_algebra::FactorizationError;

/// The proximal weight ε², relative to columns of size one: below the squares of the distances that decide.
pub(super) const PROXIMAL: f64 = 1e-13;
const REPETITIONS: usize = 12;

/// One column of B with its sign and weight.
pub(super) struct Column {
    /// (position in g, value)
    pub(super) entries: Vec<(u32, f64)>,
    /// +1: y ≥ 0; −1: y ≤ 0; 0: free.
    pub(super) sign: f64,
    /// The column's entry of T.
    pub(super) weight: f64,
    /// Whether y starts out as free to move.
    pub(super) basic: bool,
}

impl Column {
    /// bᵀr
    pub(super) fn dot(&self, residual: &[f64]) -> f64 {
        self.entries.iter().map(|&(row, value)| value * residual[row as usize]).sum()
    }
}

/// g + By
pub(super) fn residual(g: &[f64], columns: &[Column], y: &[f64]) -> Vec<f64> {
    let mut residual = g.to_vec();
    for (column, &y) in columns.iter().zip(y) {
        for &(row, value) in &column.entries {
            residual[row as usize] += value * y;
        }
    }
    residual
}

/// The minimiser y.
pub(super) fn solve(g: &[f64], columns: &[Column]) -> Result<Vec<f64>, FactorizationError> {
    if active_set::fits(g.len(), columns.len()) {
        let mut set = ActiveSet::new(g, columns);
        if let Ok(y) = repeated(columns.len(), |centre| set.solve(centre).ok_or(())) {
            return Ok(y);
        }
    }
    pivoted(g, columns, Symmetric::new)
}

/// The same for one of very many small systems.
pub(super) fn solve_one_of_many(g: &[f64], columns: &[Column]) -> Result<Vec<f64>, FactorizationError> {
    pivoted(g, columns, Symmetric::one_of_many).or_else(|_| solve(g, columns))
}

type Build = fn(usize, &[(u32, u32)]) -> Result<Symmetric, FactorizationError>;

fn pivoted(g: &[f64], columns: &[Column], build: Build) -> Result<Vec<f64>, FactorizationError> {
    let mut pivoting = Pivoting::new(g, columns, build)?;
    repeated(columns.len(), |centre| pivoting.solve(centre))
}

/// Moves the proximal term's centre after the minimiser until both are the same.
fn repeated<E>(columns: usize, mut solve: impl FnMut(&[f64]) -> Result<Vec<f64>, E>) -> Result<Vec<f64>, E> {
    let mut y = vec![0.0; columns];
    for _ in 0..REPETITIONS {
        let next = solve(&y)?;
        let moved = next.iter().zip(&y).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        let size = next.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
        y = next;
        if moved <= 1e-13 * size {
            break;
        }
    }
    Ok(y)
}

struct Pivoting<'a> {
    g: &'a [f64],
    columns: &'a [Column],
    matrix: Symmetric,
    basic: Vec<bool>,
    /// Whether the factors are those of `basic`.
    is_factored: bool,
}

impl<'a> Pivoting<'a> {
    fn new(g: &'a [f64], columns: &'a [Column], build: Build) -> Result<Self, FactorizationError> {
        let p = g.len() as u32;
        let mut positions: Vec<_> = (0..p + columns.len() as u32).map(|k| (k, k)).collect();
        for (k, column) in columns.iter().enumerate() {
            positions.extend(column.entries.iter().map(|&(row, _)| (p + k as u32, row)));
        }
        let matrix = build(g.len() + columns.len(), &positions)?;
        let basic = columns.iter().map(|column| column.basic || column.sign == 0.0).collect();
        Ok(Pivoting { g, columns, matrix, basic, is_factored: false })
    }

    /// The minimiser with the proximal term around `centre`.
    fn solve(&mut self, centre: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let (mut fewest, mut patience) = (usize::MAX, 5);
        let mut y = self.stationary(centre)?;
        for _ in 0..(20 + 3 * self.columns.len()).min(300) {
            let wrong = self.wrong(&y, centre);
            let Some(&last) = wrong.last() else { break };
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
            self.is_factored = false;
            y = self.stationary(centre)?;
        }
        for (y, column) in y.iter_mut().zip(self.columns) {
            if *y * column.sign < 0.0 {
                *y = 0.0;
            }
        }
        Ok(y)
    }

    /// The stationary point over the basic columns, from [I B; Bᵀ −(T²+ε²)]·[−r; y] = [−g; −ε²·centre].
    fn stationary(&mut self, centre: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        if !self.is_factored {
            self.factor()?;
            self.is_factored = true;
        }
        let (p, columns) = (self.g.len(), self.columns);
        let pull = |k: usize| if self.basic[k] { -PROXIMAL * centre[k] } else { 0.0 };
        let right: Vec<f64> = self.g.iter().map(|g| -g).chain((0..columns.len()).map(pull)).collect();
        let mut solution = self.matrix.solve(&right)?;
        Ok(solution.split_off(p))
    }

    fn factor(&mut self) -> Result<(), FactorizationError> {
        let (basic, columns) = (&self.basic, self.columns);
        let diagonal = |(k, column): (usize, &Column)| if basic[k] { -(column.weight * column.weight + PROXIMAL) } else { -1.0 };
        let entry = |k: usize, value: f64| if basic[k] { value } else { 0.0 };
        let couplings = columns.iter().enumerate().flat_map(|(k, c)| c.entries.iter().map(move |&(_, value)| entry(k, value)));
        let entries = std::iter::repeat_n(1.0, self.g.len()).chain(columns.iter().enumerate().map(diagonal)).chain(couplings);
        self.matrix.factor(entries).map(|_| ())
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

#[cfg(test)]
mod tests {
    use super::*;

    fn column(entries: &[(u32, f64)], sign: f64) -> Column {
        Column { entries: entries.to_vec(), sign, weight: 0.0, basic: true }
    }

    #[test]
    fn a_multiplier_of_the_wrong_sign_stays_zero() {
        // r = (-1 + y1, 1 + y2), both y ≥ 0: the first takes everything, the second must not move.
        let y = solve(&[-1.0, 1.0], &[column(&[(0, 1.0)], 1.0), column(&[(1, 1.0)], 1.0)]).unwrap();
        assert!((y[0] - 1.0).abs() < 1e-12 && y[1] == 0.0, "{y:?}");
    }

    #[test]
    fn duplicated_columns_share_and_leave_no_residual() {
        let twice = [column(&[(0, 1.0), (1, 0.5)], 1.0), column(&[(0, 1.0), (1, 0.5)], 1.0)];
        let y = solve(&[-2.0, -1.0], &twice).unwrap();
        assert!((y[0] + y[1] - 2.0).abs() < 1e-9, "{y:?}");
    }

    #[test]
    fn a_nearly_dependent_pair_is_resolved() {
        let pair = [column(&[(0, 1.0)], 0.0), column(&[(0, 1.0), (1, 1e-3)], 0.0)];
        let y = solve(&[-1.0, -1e-3], &pair).unwrap();
        assert!(y[0].abs() < 1e-8 && (y[1] - 1.0).abs() < 1e-8, "{y:?}");
    }

    #[test]
    fn of_two_explanations_the_nearer_limit_carries_the_multiplier() {
        // Columns 0 and 1 alone balance g; 2 and 3 could take their place, but lie 5e−6 away.
        let far = |entry: u32| Column { weight: 5e-6, ..column(&[(entry, 1.0)], -1.0) };
        let y =
            solve(&[1.0, 1.0, 0.0], &[column(&[(0, 1.0), (2, 1.0)], -1.0), column(&[(1, 1.0), (2, -1.0)], -1.0), far(0), far(1)])
                .unwrap();
        assert!((y[0] + 1.0).abs() < 1e-9 && (y[1] + 1.0).abs() < 1e-9 && y[2].abs() < 1e-9, "{y:?}");
    }

    #[test]
    fn it_agrees_with_trying_every_set_of_signs() {
        let g = [-1.0, 0.3, -0.7, 0.2];
        let dense = [[1.0, 0.2, -0.5, 0.1], [0.4, -1.0, 0.3, 0.8], [-0.6, 0.5, 1.0, -0.2], [0.9, 0.9, -0.1, 1.0]];
        let columns: Vec<_> = dense.iter().map(|c| column(&[(0, c[0]), (1, c[1]), (2, c[2]), (3, c[3])], 1.0)).collect();
        let y = solve(&g, &columns).unwrap();
        let residual: Vec<f64> = (0..4).map(|r| g[r] + (0..4).map(|k| dense[k][r] * y[k]).sum::<f64>()).collect();
        for k in 0..4 {
            let slope: f64 = (0..4).map(|r| dense[k][r] * residual[r]).sum();
            assert!(y[k] >= 0.0 && slope > -1e-9 && (y[k] * slope).abs() < 1e-9, "{k}: y {} slope {slope}", y[k]);
        }
    }
}
