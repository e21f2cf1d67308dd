//! Which values of the model's derivatives belong to the variables and rows that are kept.

use crate::model::Pattern;

/// One value of a derivative: where it stands in the model's pattern, and its scale.
pub(super) struct Entry {
    pub source: usize,
    pub factor: f64,
}

/// Which free variable each model variable is.
fn positions(free: &[usize], variables: usize) -> Vec<Option<u32>> {
    let mut position = vec![None; variables];
    for (at, &j) in free.iter().enumerate() {
        position[j] = Some(at as u32);
    }
    position
}

pub(super) fn select_jacobian(pattern: &Pattern, rows: &[usize], free: &[usize], variables: usize) -> (Pattern, Vec<Entry>) {
    let position = positions(free, variables);
    let (mut selected, mut entries) = (Pattern::default(), Vec::new());
    for &row in rows {
        for source in pattern.range(row) {
            if let Some(column) = position[pattern.columns[source] as usize] {
                selected.columns.push(column);
                entries.push(Entry { source, factor: 1.0 });
            }
        }
        selected.offsets.push(selected.columns.len());
    }
    (selected, entries)
}

pub(super) fn select_hessian(pattern: &Pattern, free: &[usize], variables: usize) -> (Pattern, Vec<Entry>) {
    // Free variables keep their order, so the lower triangle of the selection is the selection of the lower triangle.
    select_jacobian(pattern, free, free, variables)
}
