//! Sheets of rows as a workbook (XLSX).

use std::io::{self, Write};

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, XlsxError};

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A text; nothing where it is empty.
    Text(String),
    /// A number; nothing where it is not finite.
    Number(f64),
}

impl From<&str> for Cell {
    fn from(text: &str) -> Cell {
        Cell::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Cell {
        Cell::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Cell {
        Cell::Number(number)
    }
}

/// A sheet: titles, and rows below them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sheet {
    /// Its name.
    pub name: String,
    /// Titles of the columns; none, and the rows stand alone.
    pub header: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<Cell>>,
}

impl Sheet {
    /// A sheet without rows.
    pub fn new(name: &str, header: &[&str]) -> Sheet {
        Sheet { name: name.to_owned(), header: header.iter().map(|title| (*title).to_owned()).collect(), rows: Vec::new() }
    }
}

/// Writes a workbook. The same sheets give the same bytes.
///
/// # Errors
/// Whatever the writer says; more rows than a sheet has.
pub fn write(title: &str, sheets: &[Sheet], out: &mut dyn Write) -> io::Result<()> {
    out.write_all(&workbook(title, sheets).map_err(io::Error::other)?)
}

fn workbook(title: &str, sheets: &[Sheet]) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    // No time of day: it would be another file every time.
    let properties = DocProperties::new().set_title(title).set_author("ribopt");
    workbook.set_properties(&properties.set_creation_datetime(&ExcelDateTime::from_ymd(2000, 1, 1)?));
    let bold = Format::new().set_bold();
    for sheet in sheets {
        let written = workbook.add_worksheet();
        written.set_name(&sheet.name)?;
        for (column, title) in sheet.header.iter().enumerate() {
            written.write_string_with_format(0, column as u16, title, &bold)?;
        }
        let first = u32::from(!sheet.header.is_empty());
        if first == 1 {
            written.set_freeze_panes(1, 1)?;
        }
        for (row, cells) in sheet.rows.iter().enumerate() {
            for (column, cell) in cells.iter().enumerate() {
                let (row, column) = (row as u32 + first, column as u16);
                match cell {
                    Cell::Text(text) if !text.is_empty() => _ = written.write_string(row, column, text)?,
                    Cell::Number(number) if number.is_finite() => _ = written.write_number(row, column, *number)?,
                    _ => {}
                }
            }
        }
        written.autofit();
    }
    workbook.save_to_buffer()
}
