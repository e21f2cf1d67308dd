//! The summary a person reads after a run: what the point is, what governs, what each limit costs, how far all are used, and
//! last what the solvers did.

use std::io::{self, Write};

use super::governing::{Governing, Group, Limit, per_cent};
use super::number::{percent, short, significant};
use super::text::{TextTable, count, listing, plain, shortened};
use super::{Findings, Volumes};
use crate::backends::Termination;
use crate::crosscheck::{Answer, Conflict, Status};

/// At most this many limits, rows or variables are shown one by one.
const MOST_LINES: usize = 12;

/// At most this many letters of an objective.
const LONGEST_EXPRESSION: usize = 100;

/// At most this many of a verdict.
const LONGEST_MESSAGE: usize = 2000;

/// Laws that differ by more than this are worth a warning.
const VOLUME_DIFFERENCE: f64 = 0.01;

/// Writes the summary.
///
/// # Errors
/// Whatever the writer says.
pub fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    heading(findings, out)?;
    verdict(findings, out)?;
    point(findings, out)?;
    governing(findings, out)?;
    if let Some(table) = findings.utilisation {
        table.write(out)?;
    }
    conflict(findings, out)?;
    volumes(findings, out)?;
    minima(findings, out)?;
    backends(findings, out)
}

fn heading(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let (about, meta) = (findings.about, findings.model.meta());
    let sizes = format!("{}, {}", count(meta.variables(), "variable"), count(meta.rows(), "constraint row"));
    writeln!(out, "{} ({}): {sizes}, {}", about.title, about.file, findings.class)?;
    if !about.changes.is_empty() {
        writeln!(out, "changed for this run: {}", about.changes.join(", "))?;
    }
    if !about.units.is_empty() {
        let labels: Vec<String> = about.units.iter().map(|(name, label)| format!("{name} in {label}")).collect();
        writeln!(out, "units: {}", labels.join(", "))?;
    }
    Ok(())
}

fn verdict(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let outcome = findings.outcome;
    writeln!(out, "\n{}: {}", outcome.status.as_str(), shortened(&outcome.message, LONGEST_MESSAGE))?;
    if let Some(remedy) = &outcome.remedy {
        writeln!(out, "what to do: {}", shortened(remedy, LONGEST_MESSAGE))?;
    }
    if let Some(objective) = findings.objective() {
        writeln!(out, "{} = {}{}", brief(&findings.about.objective), significant(objective, 10), objective_unit(findings))?;
        if let Some(bound) = findings.lower_bound() {
            let gap = (objective - bound).abs();
            let share = gap / objective.abs().max(bound.abs()).max(f64::MIN_POSITIVE);
            let gap = if gap == 0.0 { "exactly".into() } else { format!("within {} (relative) of", significant(share, 2)) };
            writeln!(out, "{gap} the best possible, {}", significant(bound, 10))?;
        }
    }
    Ok(())
}

/// The first part of an expression that fills lines.
fn brief(expression: &str) -> String {
    match expression.char_indices().nth(LONGEST_EXPRESSION) {
        Some((end, _)) => format!("{} …", &expression[..end]),
        None => expression.into(),
    }
}

fn objective_unit(findings: &Findings<'_>) -> String {
    let is_volume = matches!(findings.about.objective.as_str(), "volume" | "volume_frustum" | "volume_prismatoid");
    match findings.about.unit("length") {
        Some(length) if is_volume => format!(" {length}³"),
        _ => String::new(),
    }
}

fn backends(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let outcome = findings.outcome;
    if outcome.answers.is_empty() {
        return measures(findings, out);
    }
    let header =
        ["backend", "algorithm", "point", "objective", "iterations", "evaluations", "seconds", "primal", "dual", "compl."];
    let mut table = TextTable::new(3, &header);
    for answer in &outcome.answers {
        table.add(backend_row(findings, answer));
    }
    write!(out, "\n{table}")?;
    for answer in &outcome.answers {
        writeln!(out, "  {}: {}", answer.backend, shortened(&answer.solution.message, LONGEST_MESSAGE))?;
        for remark in &answer.remarks {
            writeln!(out, "    {remark}")?;
        }
    }
    if let Some(agreement) = outcome.agreement {
        let word = if agreement.agree { "agree" } else { "do not agree" };
        let size = outcome.objective.map_or(1.0, f64::abs).max(f64::MIN_POSITIVE);
        let (f, x) = (significant(agreement.objective_difference / size, 2), significant(agreement.variable_difference, 2));
        writeln!(out, "  the backends {word}: relative to their sizes, objectives differ by {f}, variables by up to {x}")?;
    }
    Ok(())
}

/// The certificate of a point that no backend found.
fn measures(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(certificate) = &findings.outcome.certificate else { return Ok(()) };
    let measures = [certificate.primal_infeasibility, certificate.dual_infeasibility, certificate.complementarity];
    let [primal, dual, complementarity] = measures.map(|value| significant(value, 3));
    writeln!(out, "primal infeasibility {primal}, dual infeasibility {dual}, complementarity {complementarity}")?;
    for message in &certificate.messages {
        writeln!(out, "  {message}")?;
    }
    Ok(())
}

fn backend_row(findings: &Findings<'_>, answer: &Answer) -> Vec<String> {
    let solution = &answer.solution;
    let measure = |get: fn(&crate::certificate::Certificate) -> f64| {
        answer.certificate.as_ref().map_or("-".into(), |certificate| significant(get(certificate), 2))
    };
    if solution.termination == Termination::Refused {
        let mut row = vec![answer.backend.into(), solution.algorithm.clone(), "refused".into()];
        row.resize(10, "-".into());
        return row;
    }
    let certified = answer.is_certified();
    vec![
        answer.backend.into(),
        solution.algorithm.clone(),
        if certified { "certified".into() } else { "not certified".into() },
        answer.objective.map_or("-".into(), |value| significant(findings.in_users_sense(value), 10)),
        solution.iterations.map_or("-".into(), |iterations| iterations.to_string()),
        solution.evaluations.to_string(),
        significant(solution.seconds, 3),
        measure(|certificate| certificate.primal_infeasibility),
        measure(|certificate| certificate.dual_infeasibility),
        measure(|certificate| certificate.complementarity),
    ]
}

fn point(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let outcome = findings.outcome;
    let meta = findings.model.meta();
    let mut table = TextTable::new(1, &["variable", "value", "lower", "upper"]);
    for (j, &value) in outcome.x.iter().enumerate().take(MOST_LINES) {
        table.add(vec![findings.model.variable_name(j), short(value), short(meta.lower[j]), short(meta.upper[j])]);
    }
    if !table.is_empty() {
        write!(out, "\n{table}")?;
    }
    if outcome.x.len() > MOST_LINES {
        writeln!(out, "  … {} more in variables.csv", outcome.x.len() - MOST_LINES)?;
    }
    Ok(())
}

fn governing(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    if findings.outcome.status != Status::Certified {
        return Ok(());
    }
    let governing = Governing::of(findings, MOST_LINES);
    if governing.with_cost == 0 {
        return writeln!(out, "\nNothing governs: no row or bound holds the optimum.");
    }
    let objective = findings.objective().unwrap_or(f64::NAN);
    writeln!(out, "\nWhat governs, and what each limit costs (first order, per unit and per cent of the limit)")?;
    let mut table = TextTable::new(2, &["limit", "side", "at", "multiplier", "per unit", "per +1 %", "of objective"]);
    for limit in &governing.costliest {
        table.add(limit_row(limit, objective));
    }
    write!(out, "{table}")?;
    if governing.costliest.iter().any(|limit| limit.name.contains('#')) {
        writeln!(out, "  name#2: the part of this row that is made from the second argument of its max, min or abs")?;
    }
    if !governing.groups.is_empty() {
        writeln!(out, "\n  all {} governing limits by group", governing.with_cost)?;
        let mut table = TextTable::new(2, &["group", "side", "limits", "per +1 % of all", "of objective"]);
        for group in governing.groups.iter().take(MOST_LINES) {
            table.add(group_row(group, objective));
        }
        write!(out, "{table}")?;
    }
    if governing.without_cost > 0 {
        writeln!(out, "  {} without costing anything", count(governing.without_cost, "more limit") + " met exactly")?;
    }
    let certificate = findings.outcome.certificate.as_ref();
    if certificate.is_some_and(|certificate| certificate.multipliers_not_unique) {
        writeln!(out, "  The active limits are dependent: these multipliers are one choice of many.")?;
    }
    if findings.outcome.minimiser_is_not_unique {
        writeln!(out, "  The minimiser is not unique: the backends hold different points of equal value.")?;
    } else if certificate.is_some_and(|certificate| certificate.minimiser_may_not_be_unique) {
        writeln!(out, "  The minimiser may not be unique: the objective is flat in some direction.")?;
    }
    Ok(())
}

fn limit_row(limit: &Limit, objective: f64) -> Vec<String> {
    let change = per_cent(limit.held.sensitivity, limit.limit);
    let (change, share) = if limit.limit == 0.0 { (f64::NAN, f64::NAN) } else { (change, change / objective) };
    let mut row = vec![limit.name.clone(), limit.side.as_str().into()];
    row.extend([limit.limit, limit.held.multiplier, limit.held.sensitivity, change].map(|value| significant(value, 5)));
    row.push(share_text(share));
    row
}

fn group_row(group: &Group, objective: f64) -> Vec<String> {
    let change = if group.per_cent == 0.0 { f64::NAN } else { group.per_cent };
    let (change, share) = (significant(change, 5), share_text(change / objective));
    vec![group.name.clone(), group.side.as_str().into(), group.count.to_string(), change, share]
}

fn share_text(share: f64) -> String {
    if share.is_finite() { percent(share) } else { "-".into() }
}

fn conflict(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(Conflict { violated_rows, rows, bounds, alternatives, minimal }) = &findings.outcome.conflict else {
        return Ok(());
    };
    let model = findings.model;
    let amounts = |list: &[(usize, f64)]| {
        let list: Vec<String> = list.iter().map(|&(i, by)| format!("{} by {}", model.row_name(i), short(by))).collect();
        listing(list.into_iter(), MOST_LINES)
    };
    if !violated_rows.is_empty() {
        writeln!(out, "\nViolated at the point of least violation: {}", amounts(violated_rows))?;
    }
    if !rows.is_empty() {
        let set = if *minimal { "These conflict, and no part of them does" } else { "These conflict" };
        let place = |i: usize| model.row_place(i).map_or(String::new(), |place| format!(" ({place})"));
        let row_names = rows.iter().map(|&i| model.row_name(i) + &place(i));
        let ends = bounds.iter().map(|&(j, upper)| {
            let side = if upper { "upper" } else { "lower" };
            format!("{side} bound of {}", model.variable_name(j))
        });
        let names: Vec<String> = row_names.chain(ends).collect();
        writeln!(out, "{set}: {}", listing(names.into_iter(), MOST_LINES))?;
    }
    if !alternatives.is_empty() {
        writeln!(out, "\nAny one of these moves makes it feasible")?;
        let mut table = TextTable::new(1, &["limit", "from", "to", "relative", ""]);
        for found in alternatives.iter().take(MOST_LINES) {
            let least = if found.least { "the least" } else { "enough" };
            let (from, to) = (significant(found.from, 6), significant(found.to, 6));
            table.add(vec![found.limit.label(model), from, to, share_text(found.relative()), least.into()]);
        }
        write!(out, "{table}")?;
    }
    Ok(())
}

fn minima(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let minima = &findings.outcome.minima;
    if minima.is_empty() {
        return Ok(());
    }
    let names = 3.min(findings.model.meta().variables());
    let variables: Vec<String> = (0..names).map(|j| findings.model.variable_name(j)).collect();
    let header: Vec<&str> = ["objective", "starts"].into_iter().chain(variables.iter().map(String::as_str)).collect();
    let mut table = TextTable::new(0, &header);
    for minimum in minima.iter().take(MOST_LINES) {
        let mut row = vec![significant(findings.in_users_sense(minimum.objective), 10), minimum.count.to_string()];
        row.extend(minimum.x.iter().take(names).map(|&value| short(value)));
        table.add(row);
    }
    write!(out, "\nDistinct minima found\n{table}")
}

fn volumes(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    if let Some(volumes) = &findings.volumes {
        write_volumes(volumes, findings.about.unit("length"), out)?;
        if let Some(mass) = findings.mass {
            let unit = findings.about.unit("mass").map_or(String::new(), |unit| format!(" {}", plain(unit)));
            writeln!(out, "mass of the ribs: {}{unit}", short(mass))?;
        }
    }
    if findings.about.has_sections {
        writeln!(out, "Ix is about the horizontal axis, the strong one of an upright rib; Eurocode calls it Iy.")?;
    }
    Ok(())
}

/// Both totals, with a warning where the laws differ by more than one per cent.
///
/// # Errors
/// Whatever the writer says.
pub fn write_volumes(volumes: &Volumes, length: Option<&str>, out: &mut dyn Write) -> io::Result<()> {
    let unit = length.map_or(String::new(), |length| format!(" {length}³"));
    let (frustum, prismatoid) = (short(volumes.frustum), short(volumes.prismatoid));
    writeln!(out, "\nvolume of the ribs: {}{unit} (frustum {frustum}, prismatoid {prismatoid})", short(volumes.total))?;
    if volumes.difference() > VOLUME_DIFFERENCE {
        let by = percent(volumes.difference());
        writeln!(
            out,
            "warning: the frustum and the prismatoid totals differ by {by}. The frustum formula gives less than the solid whose\n\
             dimensions vary linearly; use volume = \"prismatoid\" where that solid is built."
        )?;
    }
    Ok(())
}
