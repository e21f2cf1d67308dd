//! Values of the variables that stand for minima, maxima and absolute values.

use super::Model;
use crate::problem::kinks::Auxiliary;

/// Gives the auxiliaries among the variables, those that end before `end`, the values that follow from the others: each is the largest
/// (or smallest) of the pieces that its rows bound it by. `first` is the first of these rows.
pub(super) fn complete(model: &dyn Model, auxiliaries: &[Auxiliary], first: usize, end: usize, x: &mut [f64]) {
    let Some(begin) = end.checked_sub(auxiliaries.len()).filter(|_| !auxiliaries.is_empty() && end <= x.len()) else { return };
    let kept = x[begin..end].to_vec();
    x[begin..end].fill(0.0);
    let levels = auxiliaries.iter().map(|auxiliary| auxiliary.level).max().unwrap_or(0);
    let mut values = vec![0.0; model.meta().rows()];
    for level in 0..=levels {
        // Rows of the user may have no value while the auxiliaries are zero; those that bound the auxiliaries are read alone.
        let _ = model.constraints(x, &mut values);
        for (at, auxiliary) in auxiliaries.iter().enumerate().filter(|(_, auxiliary)| auxiliary.level == level) {
            // A row of these is piece − t, and t is zero: one row per constraint.
            let begins = first + auxiliary.constraints.start - auxiliaries[0].constraints.start;
            let pieces = &values[begins..begins + auxiliary.constraints.len()];
            let decides = if auxiliary.above { f64::max } else { f64::min };
            let value = pieces.iter().copied().reduce(decides).filter(|_| pieces.iter().all(|piece| piece.is_finite()));
            x[begin + at] = value.unwrap_or(kept[at]);
        }
    }
}
