//! A CSV table read row by row; its bytes go into the checksum on the way.

mod units;

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crate::problem::mistake_code::MistakeCode;
use csv::StringRecord;
use sha2::{Digest, Sha256};

use super::Progress;
use super::findings::Findings;
use super::load::reason;
use super::source::{Place, Written};
use crate::problem::words::count;
use crate::units::{System, Unit};
use units::decimal;

/// An open table.
pub(super) struct Table<'a> {
    reader: csv::Reader<Summed<'a>>,
    record: StringRecord,
    /// What separates its fields.
    separator: u8,
    /// Whether a number with a decimal comma was met.
    commas: std::cell::Cell<bool>,
    /// Whether a row was passed over after a mistake.
    pub ragged: bool,
    /// Column names.
    pub headers: Vec<String>,
    /// The units of columns such as `h [mm]`, and what one of each is in the file's own.
    pub units: Vec<Option<(Unit, f64)>>,
    number: u8,
}

/// One row.
pub(super) struct Row<'r> {
    record: &'r StringRecord,
    units: &'r [Option<(Unit, f64)>],
    /// Set where a decimal comma is met; `None` where commas separate fields.
    commas: Option<&'r std::cell::Cell<bool>>,
    line: u32,
    table: u8,
}

/// What may separate fields, the usual one first.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// Bytes of a header that are looked at for separators.
const HEADER: u64 = 1 << 16;

/// Where tables are, and who hears of what is read.
pub(super) struct Tables<'a> {
    /// The problem file's folder.
    pub folder: &'a Path,
    /// What the file's numbers are in.
    pub units: &'a System,
    /// Of all that is read.
    pub checksum: &'a mut Sha256,
    pub watch: &'a dyn Fn(Progress<'_>),
}

/// A reader that adds what it reads to a checksum and tells how far it is.
struct Summed<'a> {
    file: File,
    path: PathBuf,
    read: u64,
    size: u64,
    checksum: &'a mut Sha256,
    watch: &'a dyn Fn(Progress<'_>),
}

impl Read for Summed<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.checksum.update(&buffer[..count]);
        self.read += count as u64;
        (self.watch)(Progress { table: &self.path, read: self.read, size: self.size });
        Ok(count)
    }
}

impl Tables<'_> {
    /// Opens the table `written` names, beside the problem file; `None` after a mistake.
    pub fn open(&mut self, written: &Written, findings: &mut Findings) -> Option<Table<'_>> {
        let path = self.folder.join(&written.text);
        // A device may go on for ever.
        let opened = File::open(&path).and_then(|file| match file.metadata()? {
            metadata if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            metadata if metadata.is_file() => Ok((file, metadata.len())),
            _ => Err(io::Error::other("it is no regular file")),
        });
        let (file, size) = match opened {
            Ok(opened) => opened,
            Err(error) => {
                let (cause, _) = reason(&error);
                let message = format!("cannot read the table {}: {cause}", path.display());
                findings.mistake(MistakeCode::File, written.place, message, "the path is taken from the problem file's folder");
                return None;
            }
        };
        let number = findings.tables.len() as u8;
        findings.tables.push((path.clone(), path.display().to_string()));
        findings.separators.push(b',');
        let separator = separator(&file).unwrap_or(b',');
        findings.separators[number as usize] = separator;
        let summed = Summed { file, path, read: 0, size, checksum: self.checksum, watch: self.watch };
        let mut builder = csv::ReaderBuilder::new();
        builder.has_headers(false).flexible(true).buffer_capacity(1 << 18).delimiter(separator);
        let (reader, record) = (builder.from_reader(summed), StringRecord::new());
        let commas = std::cell::Cell::new(false);
        let (headers, units) = (Vec::new(), Vec::new());
        let mut table = Table { reader, record, separator, commas, ragged: false, headers, units, number };
        table.read_headers(findings)?;
        table.read_units(self.units, findings);
        Some(table)
    }
}

impl Table<'_> {
    fn read_headers(&mut self, findings: &mut Findings) -> Option<()> {
        let place = self.place(1, Place::WHOLE_ROW);
        match self.reader.read_record(&mut self.record) {
            Ok(true) => {}
            Ok(false) => {
                findings.mistake(MistakeCode::File, place, "the table is empty", "its first line names the columns");
                return None;
            }
            Err(error) => {
                findings.mistake(MistakeCode::File, place, said(&error), "save the table as UTF-8 text");
                return None;
            }
        }
        let names = self.record.iter().map(|name| name.trim_start_matches('\u{feff}').trim().to_owned());
        self.headers = names.collect();
        for (at, name) in self.headers.iter().enumerate() {
            let place = self.place(1, at as u16);
            if name.is_empty() {
                findings.mistake(MistakeCode::ReservedName, place, "a column without a name", "name it or remove it");
            } else if self.headers[..at].contains(name) {
                findings.mistake(
                    MistakeCode::DuplicateName,
                    place,
                    format!("two columns are called `{name}`"),
                    "keep one of them",
                );
            }
        }
        Some(())
    }

    /// The next whole row; ragged ones and those that are no text are mistakes and passed over.
    pub fn next(&mut self, findings: &mut Findings) -> Option<Row<'_>> {
        loop {
            let outcome = self.reader.read_record(&mut self.record);
            let line = self.line();
            match outcome {
                Ok(false) => return None,
                Ok(true) if self.record.len() == self.headers.len() => match self.beside_unit() {
                    None => break,
                    Some(at) => {
                        self.ragged = true;
                        let message = "the column has a unit, and this is no number";
                        findings.mistake(
                            MistakeCode::Units,
                            self.place(line, at),
                            message,
                            "leave the unit out of the header and write it into cells",
                        );
                    }
                },
                Ok(true) => {
                    self.ragged = true;
                    let (message, help) = self.misfit();
                    findings.mistake(MistakeCode::Table, self.place(line, Place::WHOLE_ROW), message, help);
                }
                Err(error) => {
                    self.ragged = true;
                    findings.mistake(
                        MistakeCode::File,
                        self.place(line, Place::WHOLE_ROW),
                        said(&error),
                        "save the table as UTF-8 text",
                    );
                    if !matches!(error.kind(), csv::ErrorKind::Utf8 { .. }) {
                        return None;
                    }
                }
            }
        }
        let commas = (self.separator != b',').then_some(&self.commas);
        Some(Row { line: self.line(), record: &self.record, units: &self.units, commas, table: self.number })
    }

    /// What is wrong with a row of another length than the header.
    fn misfit(&self) -> (String, &'static str) {
        if self.record.iter().any(|field| field.contains('\n')) {
            let message = "a quotation mark opens in this row and does not close on it".to_owned();
            return (message, "close it, or double it where it belongs to the text");
        }
        let (found, expected) = (count(self.record.len(), "field"), self.headers.len());
        let message = format!("this row has {found}, the header {expected}");
        let help = match self.separator {
            b';' => "empty cells still need their semicolons",
            b'\t' => "empty cells still need their tabs",
            _ => "empty cells still need their commas",
        };
        (message, help)
    }

    /// Says how the table was read, where that is not as tables are by default.
    pub fn say_how(&self, findings: &mut Findings) {
        let separator = match self.separator {
            b';' => "semicolons",
            b'\t' => "tabs",
            _ => return,
        };
        let commas = if self.commas.get() { "; numbers such as `0,5` were read as 0.5" } else { "" };
        let message = format!("the fields of this table are separated by {separator}{commas}");
        findings.warning(MistakeCode::TableFormat, self.place(1, Place::WHOLE_ROW), message, None);
    }

    /// The line on which the last record ends, which for a record without line breaks is its line.
    fn line(&self) -> u32 {
        self.record.position().map_or(0, |position| position.line() as u32)
    }

    /// A field of a line.
    pub fn place(&self, line: u32, field: u16) -> Place {
        Place::Row { table: self.number, line, field }
    }
}

impl Row<'_> {
    /// The text of a field, blanks around it taken off.
    pub fn field(&self, at: usize) -> &str {
        self.record.get(at).unwrap_or("").trim()
    }

    /// Where a field stands.
    pub fn place(&self, at: usize) -> Place {
        Place::Row { table: self.table, line: self.line, field: at as u16 }
    }

    /// The field as an expression.
    pub fn written(&self, at: usize) -> Written {
        Written { text: self.field(at).to_owned(), place: self.place(at), inside: None }
    }

    /// The field as a number in the file's units, with a decimal comma where commas do not separate fields.
    pub fn number(&self, at: usize) -> Option<f64> {
        self.number_of(at, self.field(at))
    }

    /// The field as numbers with blanks between them.
    pub fn numbers(&self, at: usize) -> Option<Vec<f64>> {
        self.field(at).split_whitespace().map(|text| self.number_of(at, text)).collect()
    }

    fn number_of(&self, at: usize, text: &str) -> Option<f64> {
        let number = decimal(text, self.commas.is_some())?;
        if let Some(commas) = self.commas.filter(|_| text.contains(',')) {
            commas.set(true);
        }
        let unit = self.units.get(at).copied().flatten();
        Some(unit.map_or(number, |(_, one)| number * one))
    }
}

/// What separates the fields of the header: the one of comma, semicolon and tab that stands there most often. The file is at its
/// beginning again afterwards.
fn separator(file: &File) -> Option<u8> {
    let mut head = Vec::new();
    let mut file = file;
    file.take(HEADER).read_to_end(&mut head).ok()?;
    file.seek(SeekFrom::Start(0)).ok()?;
    let (mut counts, mut quoted) = ([0_usize; 3], false);
    for &byte in head.iter().take_while(|byte| **byte != b'\n') {
        quoted ^= byte == b'"';
        if let Some(at) = SEPARATORS.iter().position(|separator| *separator == byte && !quoted) {
            counts[at] += 1;
        }
    }
    let most = (0..3).rev().max_by_key(|&at| counts[at])?;
    Some(SEPARATORS[most])
}

fn said(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Utf8 { .. } => "this row is not UTF-8 text".to_owned(),
        _ => format!("the table cannot be read on: {error}"),
    }
}
