//! `[tables]`: sections and ribs by the million, row by row.

mod columns;

use super::Assembly;
use super::data::{infinite, put};
use super::items::{Given, GivenValue};
use super::listing::Listing;
use crate::expression::ast::Collection;
use crate::input::declaration::{self, Declaration, ListEntry, Name, Range};
use crate::input::fields::Scalar;
use crate::input::source::Written;
use crate::input::table::{Row, Tables};
use crate::problem::VolumeLaw;
use crate::problem::mistake_code::MistakeCode;
use columns::{Dimension, RibColumns, SectionColumns};

impl Assembly<'_> {
    /// Reads all tables, and joins all ribs to their sections and nodes.
    pub(super) fn tables(&mut self, declared: &Declaration, tables: &mut Tables<'_>) {
        self.structure_before_ribs(declared, tables);
        self.file_members(&declared.ribs);
        if let Some(written) = &declared.section_table {
            self.section_table(written, tables);
        }
        if let Some(written) = &declared.rib_table {
            self.rib_table(written, tables);
        }
        self.late_ends(&declared.ribs);
    }

    fn section_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        // Until the columns are known.
        let before = (self.without.sections, self.without.table);
        (self.without.sections, self.without.table) = (true, true);
        let Some(mut table) = tables.open(written, &mut self.findings) else { return };
        self.columns_of(&table, Some(Collection::Sections));
        let Some(columns) = SectionColumns::of(&table, &mut self.section_data, &mut self.findings) else { return };
        while let Some(row) = table.next(&mut self.findings) {
            self.section_row(&row, &columns);
        }
        table.say_how(&mut self.findings);
        self.without.sections = before.0 || table.ragged;
        self.without.table = before.1 || (table.ragged && self.problem.sections.names.is_empty());
    }

    fn section_row(&mut self, row: &Row, columns: &SectionColumns) {
        let name = Name { text: row.field(columns.name).to_owned(), place: row.place(columns.name) };
        let kind = self.kind(row.field(columns.kind), row.place(columns.kind));
        let mut given = Vec::with_capacity(4);
        for dimension in &columns.dimensions {
            given.extend(self.cell(row, dimension));
        }
        let points = columns.points.and_then(|at| self.points_cell(row, at));
        if let Some(s) = self.section(&name, kind, given, points) {
            for &(at, column) in &columns.data {
                put(&mut self.section_data, &mut self.findings, row, at, column, s as usize);
            }
        }
    }

    /// A dimension of a row; `None` where its cells are empty.
    fn cell<'n>(&mut self, row: &Row, columns: &'n Dimension) -> Option<Given<'n>> {
        let filled = |at: Option<usize>| at.filter(|&at| !row.field(at).is_empty());
        let parts = [columns.lower, columns.upper, columns.start, columns.step, columns.values].map(filled);
        let (value, any) = (filled(columns.value), parts.iter().flatten().next().copied());
        let place = row.place(value.or(any)?);
        if let (Some(_), Some(at)) = (value, any) {
            let message = format!("dimension `{}` is given twice", columns.name);
            self.findings.mistake(MistakeCode::BothGiven, row.place(at), message, "either the value or its bounds");
        }
        let value = match value {
            Some(at) => match row.number(at) {
                Some(value) => GivenValue::Fixed(value),
                None => GivenValue::Expression(row.written(at)),
            },
            None => {
                let [lower, upper] = [parts[0], parts[1]].map(|at| at.and_then(|at| self.bound_cell(row, at)));
                let start = parts[2].and_then(|at| self.cell_constant(row, at));
                GivenValue::Own(Range { lower, upper, start }, self.list_cells(row, parts[3], parts[4]))
            }
        };
        Some(Given { name: &columns.name, place, value })
    }

    /// The list a dimension takes its value from, by a step or by its values.
    fn list_cells(&mut self, row: &Row, step: Option<usize>, values: Option<usize>) -> Option<Listing> {
        if let (Some(_), Some(second)) = (step, values) {
            self.findings.mistake(MistakeCode::BothGiven, row.place(second), "two lists of one size", "keep `step` or `values`");
            return None;
        }
        let at = step.or(values)?;
        let place = row.place(at);
        let values = match row.numbers(at) {
            Some(values) if step.is_none() => {
                declaration::Listing::Values(values.into_iter().map(|value| Scalar::Number(value, place)).collect())
            }
            None if step.is_none() => {
                let help = "numbers with blanks between them, as 0.1 0.2 0.3";
                self.findings.mistake(MistakeCode::NoNumber, place, "these are no numbers", help);
                return None;
            }
            _ => declaration::Listing::Step(
                row.number(at).map_or_else(|| Scalar::Expression(row.written(at)), |step| Scalar::Number(step, place)),
            ),
        };
        self.listing(&ListEntry { place, values })
    }

    /// A number or a constant expression.
    fn cell_constant(&mut self, row: &Row, at: usize) -> Option<f64> {
        match row.number(at) {
            Some(value) if value.is_infinite() => {
                infinite(row, at, &mut self.findings);
                None
            }
            Some(value) => Some(value),
            None => self.constant(&Scalar::Expression(row.written(at))),
        }
    }

    /// The same, or `inf` for an open bound.
    fn bound_cell(&mut self, row: &Row, at: usize) -> Option<f64> {
        match row.field(at).to_lowercase().as_str() {
            "inf" | "+inf" => Some(f64::INFINITY),
            "-inf" => Some(f64::NEG_INFINITY),
            _ => self.cell_constant(row, at),
        }
    }

    fn rib_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        let before = std::mem::replace(&mut self.without.table, true);
        let Some(mut table) = tables.open(written, &mut self.findings) else { return };
        self.columns_of(&table, Some(Collection::Ribs));
        let Some(columns) = RibColumns::of(&table, self) else { return };
        while let Some(row) = table.next(&mut self.findings) {
            self.rib_row(&row, &columns);
        }
        table.say_how(&mut self.findings);
        self.without.table = before || (table.ragged && self.problem.ribs.names.is_empty());
    }

    fn rib_row(&mut self, row: &Row, columns: &RibColumns) {
        let name = Name { text: row.field(columns.name).to_owned(), place: row.place(columns.name) };
        let member = columns.member.as_ref().filter(|member| member.given(row));
        let given = columns.length.filter(|&at| !row.field(at).is_empty());
        let given = given.and_then(|at| Some((self.cell_constant(row, at)?, row.place(at))));
        let given = given.map(|(value, place)| (self.length(value, place), place));
        if given.is_none() && member.is_none() && columns.length.is_none_or(|at| row.field(at).is_empty()) {
            let place = row.place(columns.length.unwrap_or(columns.name));
            let help = match columns.member {
                Some(_) => "fill the cells `start` and `end`, or `length`",
                None => "expected a positive number",
            };
            self.findings.mistake(MistakeCode::RibEnds, place, format!("rib `{}` has no length", name.text), help);
        }
        let length = given.map_or(1.0, |(length, _)| length);
        let law = columns.law.map_or(VolumeLaw::default(), |at| self.law_cell(row, at));
        let Some(r) = self.rib(&name, length, law) else { return };
        self.ends_of_row(row, columns, r, &name);
        if let Some(member) = member {
            let entry = self.member_cells(row, member);
            self.member(r, &name, &entry, given);
        }
        for &(at, column) in &columns.data {
            put(&mut self.rib_data, &mut self.findings, row, at, column, r as usize);
        }
    }

    fn law_cell(&mut self, row: &Row, at: usize) -> VolumeLaw {
        let text = row.field(at);
        if text.is_empty() {
            return VolumeLaw::default();
        }
        VolumeLaw::named(text).unwrap_or_else(|| {
            let message = format!("unknown volume law `{text}`");
            self.findings.mistake(MistakeCode::UnknownChoice, row.place(at), message, "known: frustum, prismatoid");
            VolumeLaw::default()
        })
    }

    fn ends_of_row(&mut self, row: &Row, columns: &RibColumns, r: u32, name: &Name) {
        let filled = |at: Option<usize>| at.filter(|&at| !row.field(at).is_empty());
        match (filled(columns.section), filled(columns.from), filled(columns.to)) {
            (Some(at), None, None) => {
                let both = self.end(row.field(at), row.place(at));
                self.connect(r, both, both, name.place);
            }
            (None, Some(from), Some(to)) => {
                let from = self.end(row.field(from), row.place(from));
                let to = self.end(row.field(to), row.place(to));
                self.connect(r, from, to, name.place);
            }
            _ => {
                let message = format!("rib `{}` needs `from` and `to`, or `section`", name.text);
                self.findings.mistake(MistakeCode::RibEnds, name.place, message, "fill either the one cell or the other two");
            }
        }
    }
}
