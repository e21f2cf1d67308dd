//! Columns of the table of ribs that make a rib a member: start, end, material, orientation, joints.

use super::super::super::Assembly;
use super::{filled, find, scalar};
use crate::input::declaration::structure::MemberEntry;
use crate::input::source::Written;
use crate::input::table::{Row, Table};
use crate::problem::mistake_code::MistakeCode;

/// They are these where the table has both `start` and `end`; else columns of these names are data.
pub(in crate::input::check) struct MemberColumns {
    start: usize,
    end: usize,
    material: Option<usize>,
    joints: Option<usize>,
    roll: Option<usize>,
    shear: Option<usize>,
    up: [Option<usize>; 3],
    /// `both`, `start` or `end`.
    hinges: Option<usize>,
    /// Forces released at the start and at the end.
    hinges_at: [Option<usize>; 2],
    offset: [[Option<usize>; 3]; 2],
}

impl MemberColumns {
    /// The columns, if the table has them.
    pub fn of(table: &Table) -> Option<MemberColumns> {
        let along = |stem: &str| ["x", "y", "z"].map(|axis| find(table, &format!("{stem}_{axis}")));
        Some(MemberColumns {
            start: find(table, "start")?,
            end: find(table, "end")?,
            material: find(table, "material"),
            joints: find(table, "joints"),
            roll: find(table, "roll"),
            shear: find(table, "shear"),
            up: along("up"),
            hinges: find(table, "hinges"),
            hinges_at: ["hinges_start", "hinges_end"].map(|name| find(table, name)),
            offset: ["offset_start", "offset_end"].map(along),
        })
    }

    /// Whether a column is one of them.
    pub fn has(&self, at: usize) -> bool {
        let [start, end] = self.offset;
        let single = [self.material, self.joints, self.roll, self.shear, self.hinges];
        let lists = self.up.iter().chain(&self.hinges_at).chain(&start).chain(&end).chain(&single);
        self.start == at || self.end == at || lists.into_iter().any(|column| *column == Some(at))
    }

    /// Whether a row's rib is a member.
    pub fn given(&self, row: &Row) -> bool {
        [self.start, self.end].into_iter().any(|at| !row.field(at).is_empty())
    }
}

impl Assembly<'_> {
    /// What a row says of its member.
    pub(in crate::input::check) fn member_cells(&mut self, row: &Row, columns: &MemberColumns) -> MemberEntry {
        let text = |at: Option<usize>| filled(row, at).map(|at| row.written(at));
        let words = |at: Option<usize>| filled(row, at).map(|at| words(row, at)).unwrap_or_default();
        MemberEntry {
            start: text(Some(columns.start)),
            end: text(Some(columns.end)),
            material: text(columns.material),
            joints: text(columns.joints),
            roll: columns.roll.and_then(|at| scalar(row, at)),
            shear: filled(row, columns.shear).is_some_and(|at| self.flag(row, at)),
            up: self.along_cells(row, columns.up, "up"),
            hinged: text(columns.hinges),
            hinges: columns.hinges_at.map(words),
            offset: columns.offset.map(|columns| self.along_cells(row, columns, "offset")),
            key: None,
        }
    }

    fn flag(&mut self, row: &Row, at: usize) -> bool {
        let known = ["true", "false", "1", "0", "yes", "no"];
        let word = row.field(at).to_lowercase();
        if !known.contains(&word.as_str()) {
            self.findings.mistake(
                MistakeCode::WrongType,
                row.place(at),
                format!("`{}` is neither true nor false", row.field(at)),
                "expected true or false",
            );
        }
        ["true", "1", "yes"].contains(&word.as_str())
    }
}

fn words(row: &Row, at: usize) -> Vec<Written> {
    let word = |word: &str| Written { text: word.to_owned(), place: row.place(at), inside: None };
    row.field(at).split_whitespace().map(word).collect()
}
