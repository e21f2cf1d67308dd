//! What governs and what it costs; how far every rib is used.

use maud::{Markup, html};
use serde_json::Value;

use super::Left;
use super::tables::{Csv, MOST_ROWS, left_out, shown, table};

/// Limits that are shown, the costliest first.
const MOST_LIMITS: usize = 50;

/// Active limits with their price, the costliest first.
pub(super) fn governing(left: &Left) -> Markup {
    let values = left.result.get("variables");
    let limits = ["constraints", "bounds"].into_iter().flat_map(|key| left.list(key));
    let mut rows: Vec<(f64, Vec<String>)> = limits.filter_map(|entry| row(entry, values, left)).collect();
    rows.sort_by(|a, b| b.0.total_cmp(&a.0));
    let all = rows.len();
    let rows: Vec<Vec<String>> = rows.into_iter().take(MOST_LIMITS).map(|(_, row)| row).collect();
    html! {
        @if !rows.is_empty() {
            h2 { "What governs" }
            p { "Active limits, and what the objective gains or loses, to first order, when the limit is raised by 1 or by 1 %." }
            (table(&["limit", "side", "at", "unit", "per unit", "per +1 %"], &rows, "constraints.csv"))
            @if all > MOST_LIMITS { p { (all - MOST_LIMITS) " more in " code { "constraints.csv" } " and " code { "variables.csv" } "." } }
        }
    }
}

/// An active limit with a price; `None` for any other. A bound is where its variable is.
fn row(entry: &Value, values: Option<&Value>, left: &Left) -> Option<(f64, Vec<String>)> {
    let text = |key: &str| entry.get(key).and_then(Value::as_str);
    let side = text("active").filter(|side| *side != "none")?;
    let sensitivity = entry.get("sensitivity")?.as_f64().filter(|value| *value != 0.0)?;
    let limit = entry.get(if side == "lower" { "lower" } else { "upper" });
    let at = limit.or_else(|| values?.get(text("name")?)).and_then(Value::as_f64);
    let per_cent = at.map(|at| sensitivity * at.abs() / 100.0);
    let number = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
    let (factor, unit) = left.told(text("unit"));
    let (of_objective, _) = left.told_objective();
    let (at, per_unit) = (at.map(|at| factor * at), Some(of_objective * sensitivity / factor));
    let per_cent = per_cent.map(|change| of_objective * change);
    let row = vec![text("name")?.to_owned(), side.to_owned(), number(at), unit, number(per_unit), number(per_cent)];
    Some((per_cent.unwrap_or(0.0).abs(), row))
}

/// The rib a row is about.
fn rib_of<'r>(csv: &Csv, row: &'r [String]) -> Option<&'r str> {
    match csv.column("rib") {
        Some(_) => Some(csv.cell(row, "rib")),
        None => (csv.cell(row, "of") == "rib").then(|| csv.cell(row, "item")),
    }
}

/// One line per rib, or per limit where there are no ribs of a structure: a bar of how far it is used.
pub(super) fn utilisation(left: &Left) -> Markup {
    let by_rib = left.table("utilisation.csv").filter(|table| !table.rows.is_empty());
    let (csv, file, columns) = match by_rib {
        Some(csv) => (csv, "utilisation.csv", ["rib", "utilisation", "governs", "case", "station", "point"]),
        None => match left.table("limits.csv") {
            Some(csv) => (csv, "limits.csv", ["name", "percent", "constraint", "of", "item", "side"]),
            None => return html! {},
        },
    };
    // A share, or per cent.
    let scale = if file == "utilisation.csv" { 100.0 } else { 1.0 };
    let per_cent = |row: &[String]| csv.cell(row, columns[1]).parse::<f64>().ok().map(|value| scale * value);
    html! {
        h2 { "Utilisation" }
        div class="wide" { table class="sortable" {
            thead { tr { th { (columns[0]) } th { "per cent of the limit" } @for title in &columns[2..] { th { (title) } } } }
            tbody { @for row in csv.rows.iter().take(MOST_ROWS) { tr data-rib=[rib_of(&csv, row)] {
                td { (csv.cell(row, columns[0])) }
                @match per_cent(row) {
                    Some(value) => td class="number" data-value=(value) {
                        meter min="0" max="100" value=(value.clamp(0.0, 100.0)) {} " " (shown(&format!("{value:.1}")))
                    }
                    None => td {}
                }
                @for column in &columns[2..] { td { (csv.cell(row, column)) } }
            } } }
        } }
        (left_out(csv.rows.len(), file))
    }
}
