//! One page of HTML about a run, from what the run left: to be read, printed and handed on. Nothing is fetched when it is opened.

mod backends;
mod document;
mod limits;
mod several;
mod space;
mod study;
mod tables;
#[cfg(test)]
mod tests;

use maud::{Markup, html};
use serde_json::Value;

use super::number::significant;
use document::figure;
pub use study::{StudyLeft, study_page};
use tables::Csv;

/// What a folder of results holds.
#[derive(Debug, Default)]
pub struct Left {
    /// `result.json`
    pub result: Value,
    /// Tables by their file names, as CSV.
    pub tables: Vec<(String, String)>,
    /// Pictures by their file names, as SVG.
    pub pictures: Vec<(String, String)>,
    /// The ribs in space, as `network.json`.
    pub network: Option<String>,
    /// Problem file and tables with their texts, where they are still there.
    pub inputs: Vec<(String, String)>,
    /// Whether the inputs are those that were solved; `None` where they could not be read.
    pub unchanged: Option<bool>,
}

impl Left {
    fn table(&self, name: &str) -> Option<Csv> {
        self.tables.iter().find(|(known, _)| known == name).map(|(_, text)| Csv::of(text))
    }

    fn text(&self, pointer: &str) -> &str {
        self.result.pointer(pointer).and_then(Value::as_str).unwrap_or_default()
    }

    /// What numbers in one of the file's units are told in: how many of it one is, and its name.
    fn told(&self, own: Option<&str>) -> (f64, String) {
        let Some(own) = own else { return (1.0, String::new()) };
        let shown = self.result.pointer("/problem/show").and_then(|show| show.get(own));
        let parts = shown.and_then(|shown| Some((shown.get(1)?.as_f64()?, shown.get(0)?.as_str()?.to_owned())));
        parts.unwrap_or_else(|| (1.0, own.to_owned()))
    }

    fn told_objective(&self) -> (f64, String) {
        self.told(self.result.pointer("/problem/objective_unit").and_then(Value::as_str))
    }

    fn list(&self, key: &str) -> &[Value] {
        self.result.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }
}

/// A number as people read it; a dash for what is none.
fn number(value: Option<&Value>) -> String {
    value.and_then(Value::as_f64).map_or_else(|| "–".to_owned(), |value| significant(value, 6))
}

/// The page about one run or several.
///
/// ```
/// use ribopt::report::page::{Left, page};
/// let result = serde_json::json!({ "status": "certified", "problem": { "title": "One <rib>" }, "objective": 1.5 });
/// let html = page(&[Left { result, ..Left::default() }]);
/// assert!(html.contains("One &lt;rib&gt;") && !html.contains("://"));
/// ```
pub fn page(lefts: &[Left]) -> String {
    let title = lefts.iter().map(|left| left.text("/problem/title")).collect::<Vec<_>>().join(", ");
    let body = html! {
        @if lefts.len() > 1 { (several::beside_each_other(lefts)) }
        @for (at, left) in lefts.iter().enumerate() { article id={ "run-" (at + 1) } { (run(left)) } }
    };
    document::document(&title, &body, &space::script(lefts))
}

/// All about one run.
fn run(left: &Left) -> Markup {
    html! {
        h1 { (left.text("/problem/title")) }
        (verdict(left))
        (facts(left))
        (limits::governing(left))
        (space::view(left))
        (limits::utilisation(left))
        (tables::sizes(left))
        (tables::ribs(left))
        (pictures(left))
        (backends::section(left))
        (tables::variables(left))
        (remarks(left))
        (input(left))
    }
}

/// What the words of the status prove.
fn meaning(status: &str, scope: &str) -> &'static str {
    match (status, scope) {
        ("certified", "global") => "No design that meets the limits is better: this is proved.",
        ("certified", _) => {
            "A minimum: feasible, stationary, and no direction the limits leave leads down. Others may lie elsewhere."
        }
        ("uncertified", _) => "The best point found. It is not proved to be a minimum.",
        ("infeasible", "global") => "No design meets all limits: this is proved.",
        ("infeasible", _) => "No design near those that were tried meets all limits.",
        ("unbounded", _) => "The objective falls without end: a limit is missing.",
        ("not-attained", _) => "The objective settles while variables run away: a bound is missing.",
        ("limit-reached" | "interrupted", _) => "The run ended before it was done.",
        _ => "The problem has no value here.",
    }
}

fn verdict(left: &Left) -> Markup {
    let (status, scope) = (left.text("/status"), left.text("/scope"));
    let (factor, unit) = left.told_objective();
    let told = |value: Option<&Value>| number(value.and_then(Value::as_f64).map(|value| Value::from(factor * value)).as_ref());
    let objective = left.result.get("objective").filter(|value| value.is_number());
    html! {
        section class={ "verdict " (status) } {
            p class="status" { (status) @if status == "certified" { ", " (scope) } }
            p { (meaning(status, scope)) }
            @if let Some(value) = objective {
                p class="objective" { (left.text("/problem/objective")) " = " strong { (told(Some(value))) } " " (unit) }
                @if left.result.get("lower_bound").is_some_and(Value::is_number) {
                    p { "No design is " @if left.text("/problem/sense") == "maximize" { "above " } @else { "below " }
                        (told(left.result.get("lower_bound"))) "." }
                }
            }
            p { (left.text("/message")) }
            @if !left.text("/remedy").is_empty() { p { "What to do: " (left.text("/remedy")) } }
        }
    }
}

fn facts(left: &Left) -> Markup {
    let problem = |key: &str| left.result.pointer(&format!("/problem/{key}"));
    let units: Vec<String> = problem("units")
        .and_then(Value::as_object)
        .map(|units| units.iter().map(|(key, label)| format!("{key} in {}", label.as_str().unwrap_or_default())).collect())
        .unwrap_or_default();
    let chosen = left.result.get("chosen").and_then(Value::as_object);
    let length = problem("units").and_then(|units| units.get("length")).and_then(Value::as_str);
    let cubic = length.map(|length| format!(" {length}³")).unwrap_or_default();
    let changes: Vec<&str> =
        problem("changes").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect();
    html! {
        dl class="facts" {
            dt { "Problem" } dd { (left.text("/problem/class")) ", " (number(problem("variables"))) " variables, " (number(problem("constraints"))) " limits" }
            @if !units.is_empty() { dt { "Units" } dd { (units.join(", ")) } }
            @if let Some(volume) = left.result.pointer("/volume/total") { dt { "Volume of the ribs" } dd { (number(Some(volume))) (cubic) } }
            @if left.result.get("mass").is_some_and(Value::is_number) { dt { "Mass of the ribs" } dd { (number(left.result.get("mass"))) } }
            @if !changes.is_empty() { dt { "Changed for this run" } dd { (changes.join(", ")) } }
        }
        @if let Some(chosen) = chosen {
            h2 { "Chosen from catalogues" }
            table { thead { tr { th { "section" } th { "row" } } }
                tbody { @for (section, row) in chosen { tr { td { (section) } td { (row.as_str().unwrap_or_default()) } } } } }
        }
    }
}

/// Captions by file name.
const CAPTIONS: &[(&str, &str)] = &[
    ("sections.svg", "Sections: start and answer"),
    ("ribs.svg", "Ribs along their lines: height and width"),
    ("profiles.svg", "Profiles along the lines"),
    ("network.svg", "The ribs in space"),
    ("displaced.svg", "Displaced shape"),
    ("forces.svg", "Forces along the ribs"),
    ("convergence.svg", "Convergence"),
];

fn pictures(left: &Left) -> Markup {
    let found = CAPTIONS.iter().filter_map(|(name, caption)| {
        let (_, svg) = left.pictures.iter().find(|(known, _)| known == name)?;
        Some((caption, svg))
    });
    let found: Vec<_> = found.collect();
    html! {
        @if !found.is_empty() { h2 { "Pictures" } }
        @for (caption, svg) in found {
            (figure(caption, svg))
        }
    }
}

fn remarks(left: &Left) -> Markup {
    let warnings: Vec<&str> = left.list("warnings").iter().filter_map(Value::as_str).collect();
    let checks = left.list("checks");
    html! {
        @for check in checks {
            h2 { "Check: " (check.get("code").and_then(Value::as_str).unwrap_or_default()) }
            p { (check.get("note").and_then(Value::as_str).unwrap_or_default()) }
            ul { @for line in check.get("assumptions").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str) { li { (line) } } }
        }
        @if !warnings.is_empty() { h2 { "Warnings" } ul { @for warning in warnings { li { (warning) } } } }
    }
}

fn input(left: &Left) -> Markup {
    html! {
        h2 { "Input" }
        p { (left.text("/problem/file")) ", SHA-256 of the file and its tables " code { (left.text("/problem/sha256")) } "." }
        @match left.unchanged {
            Some(true) => {}
            Some(false) => p class="doubt" { "The files below are not those that were solved: they have changed since." }
            None => p class="doubt" { "The files that were solved could not be read again." }
        }
        @for (name, text) in &left.inputs { details { summary { (name) } pre { (text) } } }
        footer { "ribopt " (left.text("/version")) ", page made by " (env!("CARGO_PKG_VERSION")) }
    }
}
