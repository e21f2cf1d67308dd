//! Variables whose value an equation states: their bounds say nothing more, and where they hold with it the barrier has no interior to
//! be in, and multipliers have no bound (x = 1 with x ≤ 1).

use super::Model;

/// Rounding errors of a value from a row, in units of the last place: those of the row, of its limit and of the quotient.
const ROUNDINGS: f64 = 8.0;

/// Which of the free variables (ascending) a linear equation in one variable states within their bounds, in their order. `x` is any point
/// within the bounds.
pub fn stated(model: &dyn Model, free: &[usize], x: &[f64]) -> Vec<bool> {
    let meta = model.meta();
    let of_one = |i: usize| -> Option<(usize, usize)> {
        let of_the_free = |j: &u32| free.binary_search(&(*j as usize)).is_ok();
        let equation = meta.row_lower[i] == meta.row_upper[i] && meta.is_row_linear(i);
        let mut columns = meta.jacobian.row(i).iter().filter(|j| of_the_free(j));
        let only = columns.next().filter(|_| equation && columns.next().is_none())?;
        Some((i, *only as usize))
    };
    let rows: Vec<(usize, usize)> = (0..meta.rows()).filter_map(of_one).collect();
    let mut stated = vec![false; free.len()];
    if rows.is_empty() {
        return stated;
    }
    let (mut values, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
    // Where the model has no values at x, the run ends there anyway.
    if model.constraints(x, &mut values).and_then(|()| model.jacobian(x, &mut jacobian)).is_err() {
        return stated;
    }
    for (i, j) in rows {
        let Some(at) = meta.jacobian.position(i, j as u32) else { continue };
        let value = x[j] + (meta.row_lower[i] - values[i]) / jacobian[at];
        let size = x[j].abs().max(meta.row_lower[i].abs().max(values[i].abs()) / jacobian[at].abs());
        let rounding = ROUNDINGS * f64::EPSILON * size;
        if meta.lower[j] <= value + rounding && value - rounding <= meta.upper[j] {
            stated[free.binary_search(&j).unwrap_or_default()] = true;
        }
    }
    stated
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::closures::{Closures, Function};

    /// What one row lower ≤ Σ aⱼ·xⱼ ≤ upper states of x and y, where x ≤ `most`.
    fn stated_by(most: f64, coefficients: &[(usize, f64)], limits: [f64; 2]) -> Vec<bool> {
        let model = Closures::new(&["x", "y"], &[0.5, 0.5], &[0.0, 0.0], &[most, 1.0]);
        let model = model.row("row", limits[0], limits[1], Function::affine(0.0, coefficients));
        stated(&model, &[0, 1], &[0.5, 0.5])
    }

    #[test]
    fn what_equations_state_within_their_bounds() {
        // 3x = 3: at the upper bound, within, beyond.
        assert_eq!(stated_by(1.0, &[(0, 3.0)], [3.0; 2]), [true, false]);
        assert_eq!(stated_by(2.0, &[(0, 3.0)], [3.0; 2]), [true, false]);
        assert_eq!(stated_by(0.9, &[(0, 3.0)], [3.0; 2]), [false, false]);
        // Two variables, or a range, state nothing.
        assert_eq!(stated_by(2.0, &[(0, 1.0), (1, 1.0)], [1.0; 2]), [false, false]);
        assert_eq!(stated_by(2.0, &[(0, 3.0)], [0.0, 3.0]), [false, false]);
    }
}
