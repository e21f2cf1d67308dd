//! The verdict in plain sentences, with a remedy where there is one.

use super::session::Session;
use super::{Answer, Conflict, LimitMove, Outcome, Status};
use crate::backends::Termination;
use crate::certificate::Extent;
use crate::expression::display::plain;

/// Names shown at the most.
const SHOWN: usize = 6;

pub(super) fn certified(outcome: &mut Outcome) {
    let reach = if outcome.scope == Extent::Global { "the global minimum" } else { "a local minimum" };
    let mut message = format!("The point is {reach}: feasible, stationary, and no direction the limits allow leads down.");
    if outcome.better_point_elsewhere {
        message.push_str(" But a backend holds a feasible point with a lower objective, which is not certified.");
        outcome.remedy = Some("run again with --start from that answer, or with --starts N".into());
    }
    for (k, answer) in outcome.answers.iter().enumerate() {
        if Some(k) != outcome.best && !answer.is_certified() {
            let how = if answer.solution.termination == Termination::Refused { "was not run" } else { "did not get there" };
            let why = why(answer);
            message.push_str(&format!(" {} {how}: {}.", answer.backend, why.trim_start_matches("not run: ")));
        }
    }
    let all_pass = outcome.answers.iter().all(|answer| answer.is_certified());
    if let Some(agreement) = outcome.agreement.filter(|agreement| all_pass && !agreement.agree) {
        let apart = agreement.objective_difference;
        message.push_str(&format!(" The backends ended at different minima ({apart:.3e} apart in the objective)."));
        outcome.remedy.get_or_insert_with(|| "look for the best one with --starts N".into());
    }
    // One of the remarks says the minimiser may not be unique; where another is shown, this says more.
    let known = |text: &&String| !(outcome.minimiser_is_not_unique && text.contains("may not be unique"));
    let remarks = outcome.certificate.iter().flat_map(|certificate| &certificate.messages).filter(known);
    message.extend(remarks.map(|text| sentence(text)));
    if outcome.minimiser_is_not_unique {
        message.push_str(" The minimiser is not unique: the backends hold different points of equal value.");
    }
    if outcome.scope == Extent::Global && outcome.lower_bound.is_none() {
        message.push_str(" No lower bound is printed: some variables are open on a side that no limit closes.");
    }
    outcome.message = message;
}

/// Whoever has tried some starts is told of more than these.
pub(super) fn more_starts_than(outcome: &mut Outcome, run: usize) {
    let more = format!("--starts {} (this run had {run})", 4 * run);
    outcome.remedy = outcome.remedy.take().map(|remedy| remedy.replace("--starts N", &more));
}

pub(super) fn starts_left_out(outcome: &mut Outcome, run: usize, wanted: usize) {
    outcome.message.push_str(&format!(" Only {run} of {wanted} starts were run before the end."));
}

pub(super) fn interrupted(outcome: &mut Outcome) {
    outcome.message = format!("Interrupted; what was found before is certified. {}", outcome.message);
}

pub(super) fn diverging(session: &Session<'_>, outcome: &mut Outcome) {
    let names = variables(session, &outcome.runaway);
    if outcome.status == Status::Unbounded {
        outcome.message =
            format!("The objective is unbounded: it falls without end along a direction that stays feasible, in {names}.");
        outcome.remedy = Some(format!("bound {names}, or add the constraint that is missing"));
    } else {
        outcome.message = format!("The minimum is not attained: the objective settles while {names} runs off without end.");
        outcome.remedy = Some(format!("bound {names}"));
    }
}

pub(super) fn infeasible(session: &Session<'_>, outcome: &mut Outcome, conflict: &Conflict) {
    let (infeasible, conflicting) = if outcome.scope == Extent::Global {
        ("infeasible", "conflict")
    } else {
        ("locally infeasible", "are locally conflicting")
    };
    let model = session.task.model;
    let rows: Vec<_> = conflict.rows.iter().map(|&i| format!("row {}", model.row_name(i))).collect();
    let side = |upper: bool| if upper { "upper" } else { "lower" };
    let bounds = conflict.bounds.iter().map(|&(j, upper)| format!("the {} bound of {}", side(upper), model.variable_name(j)));
    let all: Vec<_> = rows.into_iter().chain(bounds).collect();
    let reach = if outcome.scope == Extent::Global { "no point" } else { "no point nearby" };
    let mut message = format!("The problem is {infeasible}: {reach} meets every limit, and this one misses them least.");
    match all.len() {
        0 => {}
        1 => message.push_str(&format!(" {} alone cannot be met.", capital(&all[0]))),
        _ => message.push_str(&format!(" Together {conflicting}: {}.", list(&all))),
    }
    outcome.message = message;
    let moves: Vec<_> = conflict.alternatives.iter().map(|found| change(session, found)).collect();
    outcome.remedy = (!moves.is_empty()).then(|| {
        let lead = if moves.len() > 1 { "any one of these is enough" } else { "this is enough" };
        format!("{lead}: {}", alternatives(&moves))
    });
}

/// `a.h.upper 100 -> 178.6 (+78.6 %, the least)`
fn change(session: &Session<'_>, found: &LimitMove) -> String {
    let per_cent = 100.0 * found.relative() * (found.to - found.from).signum();
    let relative = (found.from != 0.0).then(|| format!("{per_cent:+.3} %"));
    let least = found.least.then(|| "the least".to_string());
    let remarks: Vec<String> = relative.into_iter().chain(least).collect();
    let remarks = if remarks.is_empty() { String::new() } else { format!(" ({})", remarks.join(", ")) };
    format!("{} {} -> {}{remarks}", found.limit.label(session.task.model), plain(found.from), plain(found.to))
}

/// A violation of no more than this share of a limit's scale is little.
const LITTLE: f64 = 1e-3;

pub(super) fn no_feasible_point(outcome: &mut Outcome) {
    let little = outcome.certificate.as_ref().is_some_and(|own| own.primal_infeasibility <= LITTLE);
    let how = if little { "by little" } else { "least of those found" };
    outcome.message =
        format!("No feasible point was found; that there is none is not proved. This point misses the limits {how}.");
    outcome.remedy = Some("start from a feasible point with --start, or try many with --starts N".into());
}

pub(super) fn undecided(session: &Session<'_>, outcome: &mut Outcome) {
    let reasons: Vec<_> = outcome.answers.iter().map(|answer| format!("{}: {}", answer.backend, why(answer))).collect();
    let (lead, remedy) = match outcome.status {
        Status::Interrupted => ("Interrupted; this is the best point so far.", None),
        Status::LimitReached => {
            ("A limit was reached before any point passed.", Some("raise max_seconds, max_evaluations or max_iterations"))
        }
        Status::InvalidValue => {
            ("The model gave a value that is no number.", Some("bound the variables away from where the term has no value"))
        }
        Status::NotAttained => ("The minimum is not attained.", Some("bound the variables that run off")),
        _ => ("No point passed the certificate.", Some("try another start or algorithm, or --starts N")),
    };
    outcome.message = format!("{lead} {}.", reasons.join("; "));
    outcome.remedy = remedy.map(String::from);
    let vanishing = session.task.substitution.map_or_else(Vec::new, |other| other.vanishing(&outcome.x));
    if outcome.status == Status::Uncertified && !vanishing.is_empty() {
        let difference = |&(a, b): &(usize, usize)| variables(session, &[a, b]).replace(", ", " − ");
        let names = list(&vanishing.iter().map(difference).collect::<Vec<_>>());
        outcome
            .message
            .push_str(&format!(" The best answer lets {names} vanish, where the objective has no slope to prove it by."));
        outcome.remedy = Some(format!("keep {names} above a least value by a constraint"));
    }
}

/// Why an answer is not certified.
fn why(answer: &Answer) -> String {
    // Of a point nobody had the time or the means to improve there is nothing to say.
    if matches!(answer.solution.termination, Termination::Refused | Termination::LimitReached | Termination::Interrupted) {
        return answer.solution.message.trim_end_matches('.').to_string();
    }
    let tests = answer.certificate.iter().flat_map(|certificate| certificate.messages.iter().cloned());
    let (message, invalid) = (&answer.solution.message, &answer.solution.invalid);
    let untold = invalid.iter().filter(|invalid| !message.contains(invalid.as_str())).cloned();
    let all: Vec<_> = untold.chain(tests.take(2)).chain([message.clone()]).collect();
    let all: Vec<_> = all.iter().map(|text| text.trim_end_matches('.')).filter(|text| !text.is_empty()).collect();
    all.join(" — ")
}

fn variables(session: &Session<'_>, places: &[usize]) -> String {
    list(&places.iter().map(|&j| session.task.model.variable_name(j)).collect::<Vec<_>>())
}

pub(super) fn list(names: &[String]) -> String {
    let mut shown = names.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > SHOWN {
        shown.push_str(&format!(" and {} more", names.len() - SHOWN));
    }
    shown
}

fn alternatives(moves: &[String]) -> String {
    let mut shown = moves.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", or ");
    if moves.len() > SHOWN {
        shown.push_str(&format!(", and {} more", moves.len() - SHOWN));
    }
    shown
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn sentence(text: &str) -> String {
    format!(" {}.", capital(text))
}
