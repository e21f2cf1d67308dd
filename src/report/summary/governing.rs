//! What governs a certified point, and what each limit costs.

use std::io::{self, Write};

use super::{MOST_LINES, share_text};
use crate::crosscheck::Status;
use crate::report::Findings;
use crate::report::governing::{Governing, Group, Limit, per_cent};
use crate::report::number::significant;
use crate::report::text::{TextTable, count};
use crate::units::Label;

/// The costliest limits one by one, all of them by group.
///
/// # Errors
/// Whatever the writer says.
pub(super) fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    if findings.outcome.status != Status::Certified {
        return Ok(());
    }
    let governing = Governing::of(findings, MOST_LINES);
    if governing.with_cost == 0 {
        return writeln!(out, "\nNothing governs: no row or bound holds the optimum.");
    }
    // In the unit it is told in, as prices are.
    let (of_objective, _) = Label::parts(findings.about.shown.objective());
    let objective = of_objective * findings.objective().unwrap_or(f64::NAN);
    writeln!(out, "\nWhat governs, and what each limit costs (first order, per unit and per cent of the limit)")?;
    let mut table = TextTable::new(2, &["limit", "side", "at", "multiplier", "per unit", "per +1 %", "of objective"]);
    let (shown, mut units) = (&findings.about.shown, Vec::new());
    for limit in &governing.costliest {
        let label = if limit.is_row { shown.row(&limit.name) } else { shown.variable(&limit.name) };
        let (factor, unit) = Label::parts(label);
        table.add(limit_row(limit, [factor, of_objective], objective));
        units.push(unit);
    }
    table.note("unit", units);
    write!(out, "{table}")?;
    if governing.costliest.iter().any(|limit| limit.name.contains('#')) {
        writeln!(out, "  name#2: the part of this row that is made from the second argument of its max, min or abs")?;
    }
    if !governing.groups.is_empty() {
        writeln!(out, "\n  all {} governing limits by group", governing.with_cost)?;
        let mut table = TextTable::new(2, &["group", "side", "limits", "per +1 % of all", "of objective"]);
        for group in governing.groups.iter().take(MOST_LINES) {
            table.add(group_row(group, of_objective, objective));
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

/// With how many of what is told one of the file's own is, of limit and objective.
fn limit_row(limit: &Limit, [factor, of_objective]: [f64; 2], objective: f64) -> Vec<String> {
    let change = of_objective * per_cent(limit.held.sensitivity, limit.limit);
    let price = of_objective / factor;
    let (change, share) = if limit.limit == 0.0 { (f64::NAN, f64::NAN) } else { (change, change / objective) };
    let mut row = vec![limit.name.clone(), limit.side.as_str().into()];
    row.extend(
        [factor * limit.limit, price * limit.held.multiplier, price * limit.held.sensitivity, change]
            .map(|value| significant(value, 5)),
    );
    row.push(share_text(share));
    row
}

fn group_row(group: &Group, of_objective: f64, objective: f64) -> Vec<String> {
    let change = if group.per_cent == 0.0 { f64::NAN } else { of_objective * group.per_cent };
    let (change, share) = (significant(change, 5), share_text(change / objective));
    vec![group.name.clone(), group.side.as_str().into(), group.count.to_string(), change, share]
}
