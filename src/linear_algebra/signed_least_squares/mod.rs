//! Sign-constrained sparse least squares: min ½‖g + By‖² + ½‖Ty‖² with y_k ≥ 0, ≤ 0 or free.
//!
//! Dependent columns are tamed by a proximal term whose bias the outer repetitions remove.

mod active_set;
mod block_pivoting;
mod normal_equations;
mod problem;

use std::time::Instant;

use active_set::ActiveSet;
use block_pivoting::{Augmented, Pivoting, pivoted, repeated};
pub use normal_equations::NormalEquations;
pub use problem::Column;
use problem::Stationary;

use crate::linear_algebra::FactorizationError;
use crate::linear_algebra::entries::Symmetric;

/// Steps that move the proximal term's centre, from multipliers that are nearly right.
const REFINEMENTS: usize = 2;
/// Times columns are left out of such multipliers: what loses its sign there is next to zero.
const LEFT_OUT: usize = 4;

/// The minimiser nearest to `centre` over the columns that keep their signs: those that would lose them, by more than `rounding` of the largest,
/// are left out one after another, and none is taken in again.
///
/// # Errors
/// The augmented matrix has no factors.
pub fn nearest(g: &[f64], columns: &[Column<'_>], centre: &[f64], rounding: f64) -> Result<Vec<f64>, FactorizationError> {
    let mut system = Augmented::new(g, columns, Symmetric::sparse)?;
    let mut basic = vec![true; columns.len()];
    let mut y = centre.to_vec();
    let (mut is_new, mut passes, mut factors) = (true, 0, 0);
    while passes < REFINEMENTS && factors <= LEFT_OUT {
        let next = system.stationary(&basic, is_new, &y)?;
        factors += usize::from(is_new);
        let least = -rounding * next.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let lost: Vec<usize> = (0..columns.len()).filter(|&k| basic[k] && columns[k].sign * next[k] < least).collect();
        lost.iter().for_each(|&k| basic[k] = false);
        is_new = !lost.is_empty();
        if !is_new {
            (y, passes) = (next, passes + 1);
        }
    }
    y.iter_mut().zip(columns).filter(|(y, column)| **y * column.sign < 0.0).for_each(|(y, _)| *y = 0.0);
    Ok(y)
}

/// The minimiser y; what was found by `until`, which may be none, where that comes first.
///
/// # Errors
/// The augmented matrix has no factors.
pub fn solve(g: &[f64], columns: &[Column<'_>], until: Option<Instant>) -> Result<Vec<f64>, FactorizationError> {
    if active_set::fits(g.len(), columns.len()) {
        let mut set = ActiveSet::new(g, columns, until);
        if let Ok(y) = repeated(columns.len(), |centre| set.solve(centre).map(|y| (y, true)).ok_or(())) {
            return Ok(y);
        }
    }
    pivoted(g, columns, until, Symmetric::new).or_else(|_| pivoted(g, columns, until, Symmetric::sparse))
}

/// The same for one of very many small systems, with room used over and over again.
///
/// # Errors
/// The augmented matrix has no factors.
pub fn solve_one_of_many(
    g: &[f64],
    columns: &[Column<'_>],
    room: &mut NormalEquations,
    until: Option<Instant>,
) -> Result<Vec<f64>, FactorizationError> {
    if room.fill(g, columns) {
        let found = Pivoting::new(g, columns, until, &mut *room).solve(&vec![0.0; columns.len()]);
        if found.is_ok() {
            return found;
        }
    }
    pivoted(g, columns, until, Symmetric::one_of_many).or_else(|_| solve(g, columns, until))
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
        let y = solve(&[-1.0, 1.0], &[column(&[(0, 1.0)], 1.0), column(&[(1, 1.0)], 1.0)], None).unwrap();
        assert!((y[0] - 1.0).abs() < 1e-12 && y[1] == 0.0, "{y:?}");
    }

    #[test]
    fn duplicated_columns_share_and_leave_no_residual() {
        let twice = [column(&[(0, 1.0), (1, 0.5)], 1.0), column(&[(0, 1.0), (1, 0.5)], 1.0)];
        let y = solve(&[-2.0, -1.0], &twice, None).unwrap();
        assert!((y[0] + y[1] - 2.0).abs() < 1e-9, "{y:?}");
    }

    #[test]
    fn a_nearly_dependent_pair_is_resolved() {
        let pair = [column(&[(0, 1.0)], 0.0), column(&[(0, 1.0), (1, 1e-3)], 0.0)];
        let y = solve(&[-1.0, -1e-3], &pair, None).unwrap();
        assert!(y[0].abs() < 1e-8 && (y[1] - 1.0).abs() < 1e-8, "{y:?}");
    }

    #[test]
    fn of_two_explanations_the_nearer_limit_carries_the_multiplier() {
        // Columns 0 and 1 alone balance g; 2 and 3 could take their place, but lie 5e−6 away.
        let unit = [[(0, 1.0)], [(1, 1.0)]];
        let far = |entry: usize| Column { weight: 5e-6, ..column(&unit[entry], -1.0) };
        let y = solve(
            &[1.0, 1.0, 0.0],
            &[column(&[(0, 1.0), (2, 1.0)], -1.0), column(&[(1, 1.0), (2, -1.0)], -1.0), far(0), far(1)],
            None,
        )
        .unwrap();
        assert!((y[0] + 1.0).abs() < 1e-9 && (y[1] + 1.0).abs() < 1e-9 && y[2].abs() < 1e-9, "{y:?}");
    }

    #[test]
    fn it_agrees_with_trying_every_set_of_signs() {
        let g = [-1.0, 0.3, -0.7, 0.2];
        let dense = [[1.0, 0.2, -0.5, 0.1], [0.4, -1.0, 0.3, 0.8], [-0.6, 0.5, 1.0, -0.2], [0.9, 0.9, -0.1, 1.0]];
        let entries = dense.map(|c| [(0, c[0]), (1, c[1]), (2, c[2]), (3, c[3])]);
        let columns: Vec<_> = entries.iter().map(|entries| column(entries, 1.0)).collect();
        let y = solve(&g, &columns, None).unwrap();
        let residual: Vec<f64> = (0..4).map(|r| g[r] + (0..4).map(|k| dense[k][r] * y[k]).sum::<f64>()).collect();
        for k in 0..4 {
            let slope: f64 = (0..4).map(|r| dense[k][r] * residual[r]).sum();
            assert!(y[k] >= 0.0 && slope > -1e-9 && (y[k] * slope).abs() < 1e-9, "{k}: y {} slope {slope}", y[k]);
        }
    }
}
