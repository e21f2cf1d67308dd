//! Sign-constrained sparse least squares: min ½‖g + By‖² + ½‖Ty‖² with y_k ≥ 0, ≤ 0 or free.
//!
//! Block principal pivoting (Portugal, Júdice, Vicente 1994: "A comparison of block pivoting and interior-point algorithms for
//! linear least squares problems with nonnegative variables") on the augmented system, which stays sparse where BᵀB does not.
//! Dependent columns are tamed by a proximal term whose bias the outer repetitions remove.

use super::active_set::{self, ActiveSet};
use super::matrix::Symmetric;
use super::normal_equations::NormalEquations;
use crate::linear_algebra::FactorizationError;

/// The proximal weight ε², relative to columns of size one: below the squares of the distances that decide.
pub(super) const PROXIMAL: f64 = 1e-13;
const REPETITIONS: usize = 12;
/// Likewise from multipliers that are nearly right.
const REFINEMENTS: usize = 2;

/// One column of B with its sign and weight.
pub(super) struct Column<'a> {
    /// (position in g, value)
    pub(super) entries: &'a [(u32, f64)],
    /// +1: y ≥ 0; −1: y ≤ 0; 0: free.
    pub(super) sign: f64,
    /// The column's entry of T.
    pub(super) weight: f64,
    /// Whether y starts out as free to move.
    pub(super) basic: bool,
}

impl Column<'_> {
    /// bᵀr
    pub(super) fn dot(&self, residual: &[f64]) -> f64 {
        self.entries.iter().map(|&(row, value)| value * residual[row as usize]).sum()
    }
}

/// g + By
pub(super) fn residual(g: &[f64], columns: &[Column<'_>], y: &[f64]) -> Vec<f64> {
    let mut residual = g.to_vec();
    for (column, &y) in columns.iter().zip(y) {
        for &(row, value) in column.entries {
            residual[row as usize] += value * y;
        }
    }
    residual
}

/// The minimiser y.
pub(super) fn solve(g: &[f64], columns: &[Column<'_>]) -> Result<Vec<f64>, FactorizationError> {
    if active_set::fits(g.len(), columns.len()) {
        let mut set = ActiveSet::new(g, columns);
        if let Ok(y) = repeated(columns.len(), |centre| set.solve(centre).ok_or(())) {
            return Ok(y);
        }
    }
    pivoted(g, columns, Symmetric::new).or_else(|_| pivoted(g, columns, Symmetric::sparse))
}

/// The same for one of very many small systems, with room used over and over again.
pub(super) fn solve_one_of_many(
    g: &[f64],
    columns: &[Column<'_>],
    room: &mut NormalEquations,
) -> Result<Vec<f64>, FactorizationError> {
    if room.fill(g, columns) {
        let found = Pivoting::new(g, columns, &mut *room).solve(&vec![0.0; columns.len()]);
        if found.is_ok() {
            return found;
        }
    }
    pivoted(g, columns, Symmetric::one_of_many).or_else(|_| solve(g, columns))
}

/// The minimiser nearest to `centre`, all columns free to move, whatever their signs.
pub(super) fn nearest(g: &[f64], columns: &[Column<'_>], centre: &[f64]) -> Result<Vec<f64>, FactorizationError> {
    let mut system = Augmented::new(g, columns, Symmetric::sparse)?;
    let basic = vec![true; columns.len()];
    let mut y = centre.to_vec();
    for pass in 0..REFINEMENTS {
        y = system.stationary(&basic, pass == 0, &y)?;
    }
    Ok(y)
}

type Build = fn(usize, &[(u32, u32)]) -> Result<Symmetric, FactorizationError>;

fn pivoted(g: &[f64], columns: &[Column<'_>], build: Build) -> Result<Vec<f64>, FactorizationError> {
    let mut pivoting = Pivoting::new(g, columns, Augmented::new(g, columns, build)?);
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

/// Least squares over some of the columns, whatever their signs.
pub(super) trait Stationary {
    /// The minimiser y over the `basic` columns, zero elsewhere, with the proximal term around `centre`. `is_new`: the columns
    /// are others than the last time.
    fn stationary(&mut self, basic: &[bool], is_new: bool, centre: &[f64]) -> Result<Vec<f64>, FactorizationError>;
}

struct Pivoting<'a, S> {
    g: &'a [f64],
    columns: &'a [Column<'a>],
    basic: Vec<bool>,
    is_new: bool,
    method: S,
}

impl<'a, S: Stationary> Pivoting<'a, S> {
    fn new(g: &'a [f64], columns: &'a [Column<'a>], method: S) -> Self {
        let basic = columns.iter().map(|column| column.basic || column.sign == 0.0).collect();
        Pivoting { g, columns, basic, is_new: true, method }
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

/// From [I B; Bᵀ −(T²+ε²)]·[−r; y] = [−g; −ε²·centre], over the basic columns.
struct Augmented<'a> {
    g: &'a [f64],
    columns: &'a [Column<'a>],
    matrix: Symmetric,
}

impl<'a> Augmented<'a> {
    fn new(g: &'a [f64], columns: &'a [Column<'a>], build: Build) -> Result<Self, FactorizationError> {
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
        self.matrix.factor(entries).map(|_| ())
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

#[cfg(test)]
mod tests {
    use super::*;

    fn column(entries: &[(u32, f64)], sign: f64) -> Column<'_> {
        Column { entries, sign, weight: 0.0, basic: true }
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
        let unit = [[(0, 1.0)], [(1, 1.0)]];
        let far = |entry: usize| Column { weight: 5e-6, ..column(&unit[entry], -1.0) };
        let y =
            solve(&[1.0, 1.0, 0.0], &[column(&[(0, 1.0), (2, 1.0)], -1.0), column(&[(1, 1.0), (2, -1.0)], -1.0), far(0), far(1)])
                .unwrap();
        assert!((y[0] + 1.0).abs() < 1e-9 && (y[1] + 1.0).abs() < 1e-9 && y[2].abs() < 1e-9, "{y:?}");
    }

    #[test]
    fn it_agrees_with_trying_every_set_of_signs() {
        let g = [-1.0, 0.3, -0.7, 0.2];
        let dense = [[1.0, 0.2, -0.5, 0.1], [0.4, -1.0, 0.3, 0.8], [-0.6, 0.5, 1.0, -0.2], [0.9, 0.9, -0.1, 1.0]];
        let entries = dense.map(|c| [(0, c[0]), (1, c[1]), (2, c[2]), (3, c[3])]);
        let columns: Vec<_> = entries.iter().map(|entries| column(entries, 1.0)).collect();
        let y = solve(&g, &columns).unwrap();
        let residual: Vec<f64> = (0..4).map(|r| g[r] + (0..4).map(|k| dense[k][r] * y[k]).sum::<f64>()).collect();
        for k in 0..4 {
            let slope: f64 = (0..4).map(|r| dense[k][r] * residual[r]).sum();
            assert!(y[k] >= 0.0 && slope > -1e-9 && (y[k] * slope).abs() < 1e-9, "{k}: y {} slope {slope}", y[k]);
        }
    }
}
