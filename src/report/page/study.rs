//! The page about a study: what came of its points, pictures, the table, the study itself.

use maud::{Markup, html};

use super::document::{document, figure};
use super::tables::{Csv, table};

/// What a study's folder holds.
#[derive(Debug, Default)]
pub struct StudyLeft {
    /// The problem's title.
    pub title: String,
    /// `table.csv`
    pub table: String,
    /// Pictures by their file names, as SVG.
    pub pictures: Vec<(String, String)>,
    /// The study's file and the problem's, where they are still there, with their texts.
    pub inputs: Vec<(String, String)>,
    /// How many points the study has.
    pub points: usize,
}

/// Captions by file name.
const CAPTIONS: &[(&str, &str)] = &[
    ("front.svg", "The front"),
    ("course.svg", "The objective over a varied name"),
    ("map.svg", "The objective over both varied names"),
    ("tornado.svg", "What moves the objective most"),
    ("parallel.svg", "All points"),
];

/// The page about a study.
///
/// ```
/// use ribopt::report::page::{StudyLeft, study_page};
/// let table = "point,span,status,objective\n0,6,certified,1.5\n1,8,infeasible,\n".to_owned();
/// let html = study_page(&StudyLeft { title: "A <beam>".into(), table, ..StudyLeft::default() });
/// assert!(html.contains("A &lt;beam&gt;") && html.contains("1 certified, 1 infeasible") && !html.contains("://"));
/// ```
pub fn study_page(left: &StudyLeft) -> String {
    let csv = Csv::of(&left.table);
    let pictures = CAPTIONS.iter().filter_map(|(name, caption)| {
        let (_, svg) = left.pictures.iter().find(|(known, _)| known == name)?;
        Some((*caption, svg.as_str()))
    });
    let body = html! {
        h1 { (left.title) }
        dl class="facts" {
            dt { "Points" } dd { (csv.rows.len()) ": " (counts(&csv)) }
            @if left.points > csv.rows.len() { dt { "Missing" } dd { (left.points - csv.rows.len()) } }
        }
        @for (caption, svg) in pictures { (figure(caption, svg)) }
        h2 { "Points" }
        (table(&csv.header(), &csv.rows, "table.csv"))
        h2 { "Input" }
        @for (name, text) in &left.inputs { details { summary { (name) } pre { (text) } } }
        footer { "page made by ribopt " (env!("CARGO_PKG_VERSION")) }
    };
    document(&left.title, &body, &Markup::default())
}

/// `70 certified, 5 infeasible`
fn counts(csv: &Csv) -> String {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for row in &csv.rows {
        let status = csv.cell(row, "status");
        match counts.iter_mut().find(|(known, _)| *known == status) {
            Some((_, count)) => *count += 1,
            None => counts.push((status, 1)),
        }
    }
    counts.iter().map(|(status, count)| format!("{count} {status}")).collect::<Vec<_>>().join(", ")
}
