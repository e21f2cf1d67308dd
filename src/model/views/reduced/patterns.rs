//! Where the reduced derivatives stand, and the congruence that gives its Hessian.

use crate::model::states::States;
use crate::model::{Meta, Pattern};

/// Whether no state occurs in a row.
pub(super) fn knows_no_state(meta: &Meta, row: usize, first_state: usize) -> bool {
    meta.jacobian.row(row).last().is_none_or(|&last| (last as usize) < first_state)
}

/// Rows with states depend on every design variable that some state equation knows.
pub(super) fn jacobian_pattern(own: &Meta, states: States) -> Pattern {
    let n = states.first_variable;
    let mut through = vec![false; n];
    for row in states.first_row..own.rows() {
        own.jacobian.row(row).iter().filter(|&&j| (j as usize) < n).for_each(|&j| through[j as usize] = true);
    }
    let all: Vec<u32> = (0..n as u32).filter(|&j| through[j as usize]).collect();
    // Written down as it stands, row by row: with thousands of rows and variables there is a lot of it.
    let mut pattern = Pattern::default();
    for row in 0..states.first_row {
        let design = own.jacobian.row(row).iter().copied().filter(|&j| (j as usize) < n);
        if knows_no_state(own, row, n) {
            pattern.columns.extend(design);
        } else {
            let first = pattern.columns.len();
            pattern.columns.extend(&all);
            let beside = pattern.columns.len();
            pattern.columns.extend(design.filter(|&j| !through[j as usize]));
            if pattern.columns.len() > beside {
                pattern.columns[first..].sort_unstable();
            }
        }
        pattern.offsets.push(pattern.columns.len());
    }
    pattern
}

pub(super) fn dense_lower(n: usize) -> Pattern {
    let mut pattern = Pattern::default();
    for row in 0..n as u32 {
        pattern.columns.extend(0..=row);
        pattern.offsets.push(pattern.columns.len());
    }
    pattern
}

/// [I U]ᵀ·H·[I; U] for the lower triangle of H over design and states, as a dense lower triangle by rows.
pub(super) fn congruence(pattern: &Pattern, hessian: &[f64], columns: &[Vec<f64>], values: &mut [f64]) {
    let n = columns.len();
    values.fill(0.0);
    let triangle = |row: usize, column: usize| row.max(column) * (row.max(column) + 1) / 2 + row.min(column);
    // H·[I; U]: products of every state row, then of the mixed ones.
    let states = pattern.rows() - n;
    let mut through = vec![vec![0.0; states]; n];
    for (at, (row, column)) in pattern.iter().enumerate() {
        let value = hessian[at];
        match (row.checked_sub(n), column.checked_sub(n)) {
            (None, _) => values[triangle(row, column)] += value,
            (Some(state), None) => through[column][state] += value,
            (Some(left), Some(right)) => {
                for (j, column) in columns.iter().enumerate() {
                    // Half of Uᵀ·L_uu·U: the other half comes with the transposed product below.
                    through[j][left] += 0.5 * value * column[right];
                    if left != right {
                        through[j][right] += 0.5 * value * column[left];
                    }
                }
            }
        }
    }
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for i in 0..n {
        for j in 0..=i {
            values[triangle(i, j)] += dot(&through[i], &columns[j]) + dot(&through[j], &columns[i]);
        }
    }
}
