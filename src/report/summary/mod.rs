//! The summary a person reads after a run: what the point is, what governs, what each limit costs, how far all are used, and
//! last what the solvers did.

mod backends;
mod conflict;
mod governing;

use std::io::{self, Write};

use super::checks;
use super::number::{percent, short, significant};
use super::text::{TextTable, count, plain, shortened};
use super::{Findings, Volumes};
use crate::units::Label;

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
    chosen(findings, out)?;
    governing::write(findings, out)?;
    if let Some(table) = findings.utilisation {
        table.write(&findings.about.shown, out)?;
    }
    conflict::write(findings, out)?;
    volumes(findings, out)?;
    checks::write_titles(&findings.about.checks, out)?;
    minima(findings, out)?;
    backends::write(findings, out)
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
        let (factor, unit) = objective_unit(findings);
        writeln!(out, "{} = {}{unit}", brief(&findings.about.objective), significant(factor * objective, 10))?;
        if let Some(bound) = findings.lower_bound() {
            let gap = (objective - bound).abs();
            let share = gap / objective.abs().max(bound.abs()).max(f64::MIN_POSITIVE);
            let gap = if gap == 0.0 { "exactly".into() } else { format!("within {} (relative) of", significant(share, 2)) };
            writeln!(out, "{gap} the best possible, {}", significant(factor * bound, 10))?;
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

/// What the objective is told in: how many of it one of the file's own is, and its name.
fn objective_unit(findings: &Findings<'_>) -> (f64, String) {
    if let Some(label) = findings.about.shown.objective() {
        return (label.factor, format!(" {}", label.name));
    }
    let is_volume = matches!(findings.about.objective.as_str(), "volume" | "volume_frustum" | "volume_prismatoid");
    match findings.about.unit("length") {
        Some(length) if is_volume => (1.0, format!(" {length}³")),
        _ => (1.0, String::new()),
    }
}

fn point(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let outcome = findings.outcome;
    let meta = findings.model.meta();
    let mut table = TextTable::new(1, &["variable", "value", "lower", "upper"]);
    let mut units = Vec::new();
    for (j, &value) in outcome.x.iter().enumerate().take(MOST_LINES) {
        let name = findings.model.variable_name(j);
        let (factor, unit) = Label::parts(findings.about.shown.variable(&name));
        let [value, lower, upper] = [value, meta.lower[j], meta.upper[j]].map(|number| short(factor * number));
        table.add(vec![name, value, lower, upper]);
        units.push(unit);
    }
    table.note("unit", units);
    if !table.is_empty() {
        write!(out, "\n{table}")?;
    }
    if outcome.x.len() > MOST_LINES {
        writeln!(out, "  … {} more in variables.csv", outcome.x.len() - MOST_LINES)?;
    }
    Ok(())
}

/// Rows of catalogues.
fn chosen(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    if findings.about.chosen.is_empty() {
        return Ok(());
    }
    let mut table = TextTable::new(2, &["section", "from its catalogue"]);
    findings.about.chosen.iter().for_each(|(section, row)| table.add(vec![section.clone(), row.clone()]));
    write!(out, "\n{table}")
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
    if findings.about.has_structure {
        writeln!(out, "{}", super::structure::AXES)?;
    } else if findings.about.has_sections {
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

/// Per cent, or nothing to speak of.
fn share_text(share: f64) -> String {
    if share.is_finite() { percent(share) } else { "-".into() }
}
