//! What the columns of a table are.

use crate::input::check::Assembly;
use crate::input::check::data::DataColumns;
use crate::input::check::structure::tables::MemberColumns;
use crate::input::findings::Findings;
use crate::input::table::Table;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::sections::{self, is_dimension};

/// Columns of the table of sections.
pub(super) struct SectionColumns {
    pub name: usize,
    pub kind: usize,
    /// Points as `x y; x y; …`, for kinds that have them.
    pub points: Option<usize>,
    pub dimensions: Vec<Dimension>,
    /// Field and data column.
    pub data: Vec<(usize, usize)>,
}

/// The columns of one dimension: `b`, or `b.lower`, `b.upper`, `b.start`, `b.step`, `b.values`.
#[derive(Default)]
pub(super) struct Dimension {
    pub name: String,
    pub value: Option<usize>,
    pub lower: Option<usize>,
    pub upper: Option<usize>,
    pub start: Option<usize>,
    pub step: Option<usize>,
    /// Numbers with blanks between them.
    pub values: Option<usize>,
}

/// What may stand behind the dot of a dimension.
const PARTS: [&str; 5] = ["lower", "upper", "start", "step", "values"];

/// Columns of the table of ribs.
pub(super) struct RibColumns {
    pub name: usize,
    pub from: Option<usize>,
    pub to: Option<usize>,
    pub section: Option<usize>,
    /// `None` where nodes give it.
    pub length: Option<usize>,
    /// What makes members of the ribs.
    pub member: Option<MemberColumns>,
    pub law: Option<usize>,
    /// Field and data column.
    pub data: Vec<(usize, usize)>,
}

impl SectionColumns {
    /// Sorts out the headers; `None` where a needed column is missing.
    pub fn of(table: &Table, data: &mut DataColumns, findings: &mut Findings) -> Option<SectionColumns> {
        let (name, kind) = (required(table, "name", findings), required(table, "kind", findings));
        let mut columns = SectionColumns { name: name?, kind: kind?, points: None, dimensions: Vec::new(), data: Vec::new() };
        for (at, header) in table.headers.iter().enumerate() {
            match header.split_once('.') {
                _ if at == columns.name || at == columns.kind || header.is_empty() => {}
                Some((dimension, part)) if is_dimension(dimension) => {
                    let entry = columns.dimension(dimension);
                    match part {
                        "lower" => entry.lower = Some(at),
                        "upper" => entry.upper = Some(at),
                        "start" => entry.start = Some(at),
                        "step" => entry.step = Some(at),
                        "values" => entry.values = Some(at),
                        _ => unknown(table, at, did_you_mean(part, PARTS.into_iter()), findings),
                    }
                }
                Some((dimension, _)) => unknown(table, at, did_you_mean(dimension, dimensions()), findings),
                None if header == "points" => columns.points = Some(at),
                None if is_dimension(header) => columns.dimension(header).value = Some(at),
                None if is_property(header) => {
                    let message = format!("`{header}` is a property of sections already");
                    findings.mistake(
                        MistakeCode::ReservedName,
                        table.place(1, at as u16),
                        message,
                        "choose another name for the datum",
                    );
                }
                None => columns.data.push((at, data.column(header))),
            }
        }
        Some(columns)
    }

    fn dimension(&mut self, name: &str) -> &mut Dimension {
        let at = self.dimensions.iter().position(|dimension| dimension.name == name).unwrap_or_else(|| {
            self.dimensions.push(Dimension { name: name.to_owned(), ..Dimension::default() });
            self.dimensions.len() - 1
        });
        &mut self.dimensions[at]
    }
}

impl RibColumns {
    /// Sorts out the headers; `None` where a needed column is missing.
    pub fn of(table: &Table, assembly: &mut Assembly) -> Option<RibColumns> {
        let find = |name: &str| table.headers.iter().position(|header| header == name);
        let member = MemberColumns::of(table);
        let name = required(table, "name", &mut assembly.findings);
        let length = match &member {
            Some(_) => Some(find("length")),
            None => required(table, "length", &mut assembly.findings).map(Some),
        };
        let (from, to, section, law) = (find("from"), find("to"), find("section"), find("volume"));
        if section.is_none() && (from.is_none() || to.is_none()) {
            let place = table.place(1, crate::input::source::Place::WHOLE_ROW);
            let message = "the table of ribs lacks the columns `from` and `to`, or `section`";
            assembly.findings.mistake(MistakeCode::Table, place, message, "add them to the header");
            return None;
        }
        let mut columns = RibColumns { name: name?, from, to, section, length: length?, member, law, data: Vec::new() };
        let known = [Some(columns.name), columns.length, from, to, section, law];
        for (at, header) in table.headers.iter().enumerate() {
            let of_member = columns.member.as_ref().is_some_and(|member| member.has(at));
            if known.contains(&Some(at)) || header.is_empty() || of_member {
                continue;
            }
            if header.contains('.') {
                unknown(table, at, None, &mut assembly.findings);
            } else {
                columns.data.push((at, assembly.rib_data.column(header)));
            }
        }
        Some(columns)
    }
}

fn required(table: &Table, name: &str, findings: &mut Findings) -> Option<usize> {
    let found = table.headers.iter().position(|header| header == name);
    if found.is_none() {
        let place = table.place(1, crate::input::source::Place::WHOLE_ROW);
        let near = did_you_mean(name, table.headers.iter().map(String::as_str)).map(|_| "one header is nearly that");
        let help = near.unwrap_or("add it to the header");
        findings.mistake(MistakeCode::Table, place, format!("the table lacks the column `{name}`"), help);
    }
    found
}

fn unknown(table: &Table, at: usize, near: Option<String>, findings: &mut Findings) {
    let message = format!("unknown column `{}`", table.headers[at]);
    let rule = "a dotted header is part of a dimension: b.lower, b.upper, b.start, b.step, b.values";
    findings.mistake(MistakeCode::Table, table.place(1, at as u16), message, near.unwrap_or_else(|| rule.into()));
}

fn dimensions() -> impl Iterator<Item = &'static str> {
    sections::forms().flat_map(|(_, form)| form.dimensions.iter().copied())
}

fn is_property(name: &str) -> bool {
    sections::KINDS.iter().any(|kind| kind.properties().contains(&name))
}
