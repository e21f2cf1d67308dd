//! The linear rows of a model, for what follows from them alone.

use crate::model::Model;

/// lower ≤ Σ a_j·x_j ≤ upper
pub(super) struct Line {
    pub(super) entries: Vec<(usize, f64)>,
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// The linear rows, and the Jacobian they are read from; a row's constant is taken off its limits. `None` where the model has no value at its
/// start.
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
        let entries: Vec<(usize, f64)> =
            meta.jacobian.range(i).map(|at| (meta.jacobian.columns[at] as usize, jacobian[at])).filter(|e| e.1 != 0.0).collect();
        let terms: Vec<f64> = entries.iter().map(|&(j, a)| a * x[j]).collect();
        let magnitude = terms.iter().fold(rows[i].abs(), |most: f64, term| most + term.abs());
        let (constant, error) = (rows[i] - terms.iter().sum::<f64>(), (terms.len() + 4) as f64 * f64::EPSILON * magnitude);
        Line { entries, lower: meta.row_lower[i] - constant - error, upper: meta.row_upper[i] - constant + error }
    };
    let lines = (0..meta.rows()).map(|i| meta.is_row_linear(i).then(|| line(i))).collect();
    Some((lines, jacobian))
}
