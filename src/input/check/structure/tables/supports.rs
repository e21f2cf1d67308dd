//! The table of supports: node or pattern, what it fixes, springs.

use super::super::super::Assembly;
use super::{filled, find, refuse_others, require, scalar};
use crate::input::declaration::Name;
use crate::input::declaration::structure::Fix;
use crate::input::source::Written;
use crate::input::table::{Row, Table, Tables};
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::DIRECTIONS;

/// Stiffness of springs, by direction.
const SPRINGS: [&str; 6] = ["kx", "ky", "kz", "krx", "kry", "krz"];

/// Columns of the table.
struct Columns {
    node: usize,
    fix: usize,
    springs: [Option<usize>; 6],
}

impl Assembly<'_> {
    pub(in crate::input::check::structure) fn support_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        let Some(mut table) = tables.open(written, &mut self.findings) else {
            self.building.unsupported = true;
            return;
        };
        self.columns_of(&table, None);
        let Some(columns) = self.support_columns(&table) else {
            self.building.unsupported = true;
            return;
        };
        while let Some(row) = table.next(&mut self.findings) {
            self.support_row(&row, &columns);
        }
        table.say_how(&mut self.findings);
        self.building.unsupported = table.ragged;
    }

    fn support_columns(&mut self, table: &Table) -> Option<Columns> {
        let known: Vec<&str> = ["node", "fix"].into_iter().chain(SPRINGS).collect();
        refuse_others(table, &known, &mut self.findings);
        let (node, fix) = (require(table, "node", &mut self.findings), require(table, "fix", &mut self.findings));
        Some(Columns { node: node?, fix: fix?, springs: SPRINGS.map(|name| find(table, name)) })
    }

    fn support_row(&mut self, row: &Row, columns: &Columns) {
        let fixed = match self.word_of_support(row.field(columns.fix)) {
            Some(fixed) => fixed,
            None => self.listed_directions(row, columns.fix),
        };
        let mut springs = [0.0; 6];
        for direction in 0..6 {
            let Some(at) = filled(row, columns.springs[direction]) else { continue };
            let key = Name { text: SPRINGS[direction].into(), place: row.place(at) };
            let known = self.direction(DIRECTIONS[direction], key.place);
            let stiffness = scalar(row, at).and_then(|scalar| self.finite(&scalar));
            let stiffness = stiffness.filter(|value| self.not_negative(*value, &key));
            if let (Some(direction), Some(stiffness)) = (known, stiffness) {
                self.spring(&mut springs, fixed, direction, stiffness, key.place);
            }
        }
        self.support(&row.written(columns.node), fixed, springs);
    }

    /// `x z`: directions with blanks between.
    fn listed_directions(&mut self, row: &Row, at: usize) -> [bool; 6] {
        let text = row.field(at);
        if did_you_mean(text, ["fixed", "pinned"].into_iter()).is_some() {
            return self.fixed(&Fix::Word(row.written(at)));
        }
        let list: Vec<Written> = row
            .field(at)
            .split_whitespace()
            .map(|word| Written { text: word.to_owned(), place: row.place(at), inside: None })
            .collect();
        self.directions(&list)
    }
}
