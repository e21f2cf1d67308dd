//! The last of a violation taken off an answer no certificate will pass: where no multipliers exist, an objective bought with
//! a violation within the tolerance may be far below the true minimum.

use super::Answer;
use super::session::Session;

/// Steps at the most; where gradients vanish each one takes off only a share of the way.
const STEPS: usize = 400;
/// Work in all, in entries of the Jacobian.
const WORK: usize = 20_000_000;

/// Projects a feasible answer's point onto its most violated row within the bounds, again and again, until every row is met exactly
/// (Kaczmarz' method, in the variables' own sizes). Keeps the point only where the violation became less.
pub(super) fn polish(session: &Session<'_>, answer: &mut Answer) {
    let Some(before) = answer.certificate.as_ref().filter(|certificate| answer.feasible && !certificate.certified) else {
        return;
    };
    if before.primal_infeasibility == 0.0 {
        return;
    }
    let violation = before.primal_infeasibility;
    let Some(x) = projected(session, &answer.solution.x, &before.variable_scales) else { return };
    let mut moved = answer.clone();
    (moved.solution.x, moved.solution.multipliers) = (x, None);
    session.judge_again(&mut moved);
    if moved.certificate.as_ref().is_some_and(|certificate| certificate.primal_infeasibility < violation) {
        moved.remarks.push("moved until it meets every limit to the last digit".into());
        *answer = moved;
    }
}

fn projected(session: &Session<'_>, x: &[f64], scales: &[f64]) -> Option<Vec<f64>> {
    let (model, meta) = (session.task.model, session.task.model.meta());
    let (mut x, mut rows, mut jacobian) = (x.to_vec(), vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
    for _ in 0..STEPS.min(WORK / (jacobian.len() + 1)) {
        meta.clamp(&mut x);
        model.constraints(&x, &mut rows).ok()?;
        let violation = |i: usize| (meta.row_lower[i] - rows[i]).max(0.0) - (rows[i] - meta.row_upper[i]).max(0.0);
        let worst = (0..rows.len()).max_by(|&a, &b| violation(a).abs().total_cmp(&violation(b).abs()))?;
        let lack = violation(worst);
        if lack == 0.0 {
            break;
        }
        model.jacobian(&x, &mut jacobian).ok()?;
        // A variable on a bound that would hold it does not take part.
        let moves = |&(j, slope): &(usize, f64)| if lack * slope > 0.0 { x[j] < meta.upper[j] } else { x[j] > meta.lower[j] };
        let entries = meta.jacobian.range(worst).map(|at| (meta.jacobian.columns[at] as usize, jacobian[at]));
        let entries: Vec<(usize, f64)> = entries.filter(moves).collect();
        let length: f64 = entries.iter().map(|&(j, slope)| (slope * scales[j]).powi(2)).sum();
        if !(length > 0.0 && length.is_finite()) {
            break;
        }
        for (j, slope) in entries {
            x[j] += lack * slope * scales[j] * scales[j] / length;
        }
    }
    Some(x)
}
