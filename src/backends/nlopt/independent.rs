//! Which equalities to keep where their gradients depend on one another.
//!
//! SLSQP's subproblem has a solution only where the equalities' gradients are independent (LSEI of Lawson and Hanson, chapter
//! 23.6: otherwise it ends in its first step), and where there are more of them than variables it writes outside its workspace.
//! Rows left out are not forgotten: every point is judged by all rows.

/// Part of a row's length that is rounding once the kept rows' directions are taken out of it: two passes of Gram–Schmidt leave
/// a few ε times the number of rows (Giraud, Langou and Rozložník 2005); at this share dependence and rounding cannot be told apart.
const ROUNDING: f64 = 1e-12;

/// Rows that are independent and span all of them, linear ones first and otherwise the longest remainder first (QR with row
/// interchanges, Golub and Van Loan §5.4). `rows` are dense lines of n numbers; the answer is in increasing order.
pub(super) fn choice(rows: &[&[f64]], is_linear: &[bool]) -> Vec<usize> {
    let lengths: Vec<f64> = rows.iter().map(|row| norm(row)).collect();
    let mut left: Vec<Vec<f64>> = rows.iter().zip(&lengths).map(|(row, &length)| times(row, 1.0 / length)).collect();
    let mut kept = Vec::new();
    let mut is_open: Vec<bool> = lengths.iter().map(|&length| length > 0.0 && length.is_finite()).collect();
    for linear in [true, false] {
        while let Some((row, length)) = longest(&left, |i| is_open[i] && is_linear[i] == linear) {
            is_open[row] = false;
            if length <= ROUNDING {
                break;
            }
            let direction = times(&left[row], 1.0 / length);
            kept.push(row);
            // Twice is enough (Parlett, The Symmetric Eigenvalue Problem §6.9).
            for other in left.iter_mut().zip(&is_open).filter_map(|(other, &open)| open.then_some(other)) {
                remove(&direction, other);
                remove(&direction, other);
            }
        }
    }
    kept.sort_unstable();
    kept
}

fn longest(left: &[Vec<f64>], is_candidate: impl Fn(usize) -> bool) -> Option<(usize, f64)> {
    let lengths = (0..left.len()).filter(|&i| is_candidate(i)).map(|i| (i, norm(&left[i])));
    lengths.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
}

fn remove(direction: &[f64], from: &mut [f64]) {
    let share: f64 = direction.iter().zip(&*from).map(|(d, x)| d * x).sum();
    from.iter_mut().zip(direction).for_each(|(x, d)| *x -= share * d);
}

fn times(row: &[f64], factor: f64) -> Vec<f64> {
    row.iter().map(|value| value * factor).collect()
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|value| value * value).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surplus_rows_go_and_linear_ones_stay() {
        let rows: [&[f64]; 4] = [&[3.0, 1.0], &[1.0, 1.0], &[2.0, 2.0], &[0.0, 0.0]];
        assert_eq!(choice(&rows, &[false, true, true, true]), [0, 1]);
        assert_eq!(choice(&rows, &[true; 4]), [0, 1]);
        assert_eq!(choice(&rows[1..], &[true; 3]), [0]);
        assert_eq!(choice(&[], &[]), Vec::<usize>::new());
    }

    #[test]
    fn no_row_is_lost_that_another_does_not_hold() {
        let rows: Vec<Vec<f64>> =
            (0..6).map(|i| (0..8).map(|j| f64::from(i * j % 7) + f64::from(u8::from(i == j))).collect()).collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        assert_eq!(choice(&rows, &[false; 6]).len(), 6);
        let nearly: [&[f64]; 2] = [&[1.0, 0.0], &[1.0, 1e-9]];
        assert_eq!(choice(&nearly, &[true; 2]), [0, 1]);
    }
}
