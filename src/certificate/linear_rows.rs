//! The linear rows of a model, for what follows from them alone.

use crate::model::Model;

/// lower ≤ Σ a_j·x_j ≤ upper, over variables that are not fixed.
pub(super) struct Line {
    pub(super) entries: Vec<(usize, f64)>,
    pub(super) lower: f64,
    pub(super) upper: f64,
    /// What fixed variables' terms amount to: what is accepted of the row is a share of these, too.
    pub(super) fixed: f64,
}

/// The linear rows, and the Jacobian they are read from; a row's constant, fixed variables' terms with it, is taken off its limits. `None`
/// where the model has no value at its start.
pub(super) fn of(model: &dyn Model) -> Option<(Vec<Option<Line>>, Vec<f64>)> {
    let meta = model.meta();
    if !(0..meta.rows()).any(|i| meta.is_row_linear(i)) {
        return None;
    }
    let x = &meta.start;
    let (mut rows, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
    model.constraints(x, &mut rows).ok()?;
    model.jacobian(x, &mut jacobian).ok()?;
    let line = |i: usize| {
        let all = meta.jacobian.range(i).map(|at| (meta.jacobian.columns[at] as usize, jacobian[at])).filter(|e| e.1 != 0.0);
        let (fixed, entries): (Vec<_>, Vec<(usize, f64)>) = all.partition(|&(j, _)| meta.is_fixed(j));
        let term = |&(j, a): &(usize, f64)| a * x[j];
        let size = |entries: &[(usize, f64)]| entries.iter().map(|entry| term(entry).abs()).sum::<f64>();
        let (count, fixed) = (fixed.len() + entries.len(), size(&fixed));
        let error = (count + 4) as f64 * f64::EPSILON * (rows[i].abs() + fixed + size(&entries));
        let constant = rows[i] - entries.iter().map(term).sum::<f64>();
        Line { entries, lower: meta.row_lower[i] - constant - error, upper: meta.row_upper[i] - constant + error, fixed }
    };
    let lines = (0..meta.rows()).map(|i| meta.is_row_linear(i).then(|| line(i))).collect();
    Some((lines, jacobian))
}
