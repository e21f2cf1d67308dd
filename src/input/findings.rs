//! Collects mistakes and warnings while the file is read, and gives them their lines in the end.

use std::path::PathBuf;

use super::mistake::{Mistake, Mistakes, SHOWN};
use super::source::{Argument, Place, Source};
use super::table_lines;
use crate::problem::mistake_code::MistakeCode;

/// Findings kept; a file with more is beyond repair, and they are only counted.
const KEPT: usize = 1000;

struct Finding {
    code: MistakeCode,
    place: Place,
    message: String,
    help: Option<String>,
}

/// The mistakes and warnings so far.
#[derive(Default)]
pub(super) struct Findings {
    mistakes: Vec<Finding>,
    uncounted: usize,
    warnings: Vec<Finding>,
    /// CSV tables by number: the file, and the name shown.
    pub tables: Vec<(PathBuf, String)>,
    /// What separates the fields of each.
    pub separators: Vec<u8>,
}

impl Findings {
    /// Something wrong.
    pub fn mistake(&mut self, code: MistakeCode, place: Place, message: impl Into<String>, help: impl Into<Help>) {
        if self.mistakes.len() < KEPT {
            self.mistakes.push(Finding { code, place, message: message.into(), help: help.into().0 });
        } else {
            self.uncounted += 1;
        }
    }

    /// Something the user should hear of.
    pub fn warning(&mut self, code: MistakeCode, place: Place, message: impl Into<String>, help: impl Into<Help>) {
        if self.warnings.len() < KEPT {
            self.warnings.push(Finding { code, place, message: message.into(), help: help.into().0 });
        }
    }

    /// How many mistakes there are so far.
    pub fn mistakes(&self) -> usize {
        self.mistakes.len() + self.uncounted
    }

    /// True while nothing is wrong.
    pub fn clean(&self) -> bool {
        self.mistakes.is_empty()
    }

    /// Forgets mistakes that begin on one of these lines: there the text itself is broken.
    pub fn forget_lines(&mut self, source: &Source, lines: &[usize]) {
        self.mistakes.retain(|finding| match finding.place {
            Place::File { start, .. } => !lines.contains(&source.line(start as usize)),
            _ => true,
        });
    }

    /// The mistakes with their lines, in the order in which they stand.
    pub fn into_parts(self, source: &Source, arguments: &[Argument<'_>]) -> (Mistakes, Vec<Mistake>) {
        let (list, cut) = self.placed(self.mistakes.iter().collect(), source, arguments);
        let (warnings, _) = self.placed(self.warnings.iter().collect(), source, arguments);
        (Mistakes { list, more: cut + self.uncounted }, warnings)
    }

    /// The first of the findings in the file's order, each once, and how many are left out.
    fn placed(&self, mut findings: Vec<&Finding>, source: &Source, arguments: &[Argument<'_>]) -> (Vec<Mistake>, usize) {
        findings.sort_by_key(|finding| finding.place);
        findings.dedup_by(|a, b| a.place == b.place && a.message == b.message);
        let cut = findings.len().saturating_sub(SHOWN);
        findings.truncate(SHOWN);
        let wanted = |number: usize| {
            let of_table = move |finding: &&Finding| match finding.place {
                Place::Row { table, line, .. } if table as usize == number => Some(line as usize),
                _ => None,
            };
            findings.iter().filter_map(of_table).collect::<Vec<usize>>()
        };
        let rows: Vec<_> =
            self.tables.iter().enumerate().map(|(number, (path, _))| table_lines::read(path, &wanted(number))).collect();
        (findings.iter().map(|finding| self.place(finding, source, arguments, &rows)).collect(), cut)
    }

    fn place(&self, finding: &Finding, source: &Source, arguments: &[Argument<'_>], rows: &[table_lines::Lines]) -> Mistake {
        let (code, message, help) = (Some(finding.code), finding.message.clone(), finding.help.clone());
        match finding.place {
            Place::File { start, end } => source.mistake(code, start as usize..end as usize, message, help),
            Place::Argument { number, start, end } => {
                let of = arguments.get(number as usize);
                let argument = Source::new(of.map_or("", |of| of.origin), of.map_or("", |of| of.text).to_owned());
                argument.mistake(code, start as usize..end as usize, message, help)
            }
            Place::Row { table, line, field } => {
                let text = rows.get(table as usize).and_then(|lines| lines.get(&(line as usize))).cloned().unwrap_or_default();
                let separator = self.separators.get(table as usize).copied().unwrap_or(b',');
                let caret = table_lines::field(&text, char::from(separator), field);
                let file = self.tables.get(table as usize).map(|(_, name)| name.clone()).unwrap_or_default();
                Mistake { code, file, line: line as usize, column: caret.start + 1, text, caret, message, help }
            }
            Place::Whole => {
                Mistake { code, file: source.name.clone(), line: 0, column: 0, text: String::new(), caret: 0..0, message, help }
            }
        }
    }
}

/// What may stand for a help: a text, or nothing.
pub(super) struct Help(Option<String>);

impl From<&str> for Help {
    fn from(text: &str) -> Help {
        Help(Some(text.to_owned()))
    }
}

impl From<String> for Help {
    fn from(text: String) -> Help {
        Help(Some(text))
    }
}

impl From<Option<String>> for Help {
    fn from(text: Option<String>) -> Help {
        Help(text)
    }
}
