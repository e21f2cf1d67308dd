//! What an infeasible structure lacks even where every rib is as strong as its bounds allow.

use super::Subject;
use super::remaining::Remaining;
use crate::crosscheck::{Outcome, Status};
use crate::model::Model;
use crate::report::number::short;

/// Limits named.
const MOST_NAMED: usize = 3;

/// Says which limits are not met with every variable at its upper bound, where an analysed structure is infeasible and all bounds are closed.
pub(super) fn explain(subject: &Subject, outcome: &mut Outcome, remaining: &Remaining) {
    if outcome.status == Status::Infeasible
        && remaining.settings(&subject.settings).is_some()
        && let Some(words) = lacking(subject)
    {
        outcome.message = format!("{} {words}", outcome.message);
    }
}

fn lacking(subject: &Subject) -> Option<String> {
    let model = subject.analysis()?;
    let meta = model.meta();
    if !meta.upper.iter().all(|upper| upper.is_finite()) {
        return None;
    }
    let mut rows = vec![0.0; meta.rows()];
    model.constraints(&meta.upper, &mut rows).ok()?;
    let accepted = subject.settings.constraint_tolerance;
    let excess = |i: usize| (rows[i] - meta.row_upper[i]).max(meta.row_lower[i] - rows[i]);
    let limit = |i: usize| if rows[i] > meta.row_upper[i] { meta.row_upper[i] } else { meta.row_lower[i] };
    let is_missed = |&i: &usize| excess(i) > accepted * limit(i).abs().max(rows[i].abs());
    let mut missed: Vec<usize> = (0..meta.rows()).filter(is_missed).collect();
    if missed.is_empty() {
        return None;
    }
    missed.sort_by(|&a, &b| (excess(b) / limit(b).abs()).total_cmp(&(excess(a) / limit(a).abs())));
    let named = |&i: &usize| format!("{} is {}, its limit {}", meta.names.row(i), short(rows[i]), short(limit(i)));
    let words: Vec<String> = missed.iter().take(MOST_NAMED).map(named).collect();
    let more = match missed.len() - words.len() {
        0 => String::new(),
        more => format!("; {more} more are not met"),
    };
    Some(format!("Even with every variable at its upper bound {}{more}.", words.join("; ")))
}
