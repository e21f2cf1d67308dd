//! The problem file (TOML) and its tables (CSV) become a checked [`Problem`].
//!
//! Path → text (`load`) → tables of fields with places (`fields`) → the file as declared (`declaration`) → names
//! looked up and numbers computed (`check`). Mistakes are collected on the way and shown in one go.

mod additions;
mod check;
mod codes;
mod declaration;
mod document;
mod example;
mod explain;
mod fields;
mod findings;
mod load;
mod mistake;
mod parse_tables;
mod points;
mod schema;
mod source;
mod table;
mod table_lines;

use std::path::{Path, PathBuf};

use crate::problem::mistake_code::MistakeCode;
use sha2::{Digest, Sha256};
use toml::de::DeTable;

use crate::problem::Problem;
pub use additions::Additions;
pub use check::{Dimensions, Measured};
pub use document::Document;
pub use example::{example, examples};
pub use explain::explain;
use fields::Reader;
use findings::Findings;
pub use mistake::{Mistake, Mistakes, render};
pub use points::points;
pub use schema::schema;
use source::{Place, Source};
use table::Tables;

/// What a problem file gives.
#[derive(Debug, Clone)]
pub struct Input {
    /// The checked problem; [`Problem::warnings`] repeats the warnings in one line each.
    pub problem: Problem,
    /// SHA-256 of the file and its tables, in this order, in hexadecimal.
    pub sha256: String,
    /// What the user should hear of, in the order of the file.
    pub warnings: Vec<Mistake>,
    /// The file and its tables.
    pub files: Vec<PathBuf>,
    /// What its numbers measure.
    pub dimensions: Dimensions,
    /// The numbers of the additions' constants.
    pub constants: Vec<f64>,
}

/// Reads a problem file and its tables.
///
/// # Errors
/// Every mistake of the file and its tables.
///
/// ```
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("rib.toml");
/// std::fs::write(&path, "minimize = \"b*h\"\n[variables]\nb = { lower = 1 }\nh = { lowr = 2 }\n")?;
/// let mistakes = ribopt::input::read(&path).unwrap_err();
/// assert_eq!(mistakes.list[0].message, "unknown key `lowr`");
/// assert_eq!((mistakes.list[0].line, mistakes.list[0].column), (4, 7));
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn read(path: &Path) -> Result<Input, Mistakes> {
    read_with(path, &Additions::default(), &|_| {})
}

/// How far the reading of a table has come.
#[derive(Debug, Clone, Copy)]
pub struct Progress<'a> {
    /// The table.
    pub table: &'a Path,
    /// Bytes read.
    pub read: u64,
    /// Bytes in all.
    pub size: u64,
}

/// [`read`] with additions to the file. Calls `watch` every now and then while tables are read.
///
/// # Errors
/// Every mistake of the file, its tables and the additions.
pub fn read_with(path: &Path, additions: &Additions, watch: &dyn Fn(Progress<'_>)) -> Result<Input, Mistakes> {
    let (source, bytes) = load::load(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut input = understand(&source, &bytes, folder, additions, watch)?;
    input.files.insert(0, path.to_path_buf());
    Ok(input)
}

/// Reads a problem from a text instead of a file; `name` is what mistakes call it. Its tables are looked for in the current folder.
///
/// # Errors
/// Every mistake of the text and its tables.
pub fn read_text(name: &str, text: &str) -> Result<Input, Mistakes> {
    read_text_in(name, text, Path::new(""), &[])
}

/// [`read_text`] with tables looked for in `folder`, and some of the text's numbers replaced as by [`Additions::changes`].
///
/// # Errors
/// Every mistake of the text, its tables and the overrides.
pub fn read_text_in(name: &str, text: &str, folder: &Path, overrides: &[String]) -> Result<Input, Mistakes> {
    let source = Source::new(name.to_owned(), text.to_owned());
    understand(&source, text.as_bytes(), folder, &Additions::changing(overrides), &|_| {})
}

fn understand(
    source: &Source,
    bytes: &[u8],
    folder: &Path,
    additions: &Additions,
    watch: &dyn Fn(Progress<'_>),
) -> Result<Input, Mistakes> {
    let mut checksum = Sha256::new();
    checksum.update(bytes);
    let mut findings = Findings::default();
    let (document, errors) = DeTable::parse_recoverable(&source.text);
    let mut reader = Reader::new(source, &mut findings);
    let mut declared = parse_tables::parse_tables(document.get_ref(), &mut reader);
    let units = reader.units;
    additions.declare(&mut declared);
    let arguments = additions.arguments();
    if !errors.is_empty() {
        syntax(source, &errors, &mut findings);
        return Err(findings.into_parts(source, &arguments).0);
    }
    let mut tables = Tables { folder, units: &units, checksum: &mut checksum, watch };
    let check::Checked { mut problem, findings, dimensions, constants } =
        check::check(declared, source, findings, additions, &mut tables);
    let clean = findings.clean();
    let files = findings.tables.iter().map(|(path, _)| path.clone()).collect();
    let (mistakes, warnings) = findings.into_parts(source, &arguments);
    if !clean {
        return Err(mistakes);
    }
    problem.warnings = warnings.iter().map(one_line).collect();
    let sha256 = checksum.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(Input { problem, sha256, warnings, files, dimensions, constants })
}

/// Mistakes of the TOML itself. What the walk found on the same lines is only their consequence.
fn syntax(source: &Source, errors: &[toml::de::Error], findings: &mut Findings) {
    let end = source.text.len();
    let span = |error: &toml::de::Error| error.span().unwrap_or(end..end);
    let lines: Vec<usize> = errors.iter().map(|error| source.line(span(error).start)).collect();
    findings.forget_lines(source, &lines);
    let mut seen = Vec::new();
    for (error, line) in errors.iter().zip(lines) {
        // After the first error of a line the rest of it is read out of step.
        if !seen.contains(&line) {
            seen.push(line);
            let help = error.message().contains("duplicate key").then(|| earlier(source, span(error)));
            findings.mistake(MistakeCode::Toml, Place::file(span(error)), error.message(), help.flatten());
        }
    }
}

/// Where a key stood first: the nearest line above, in the same table, that begins with it.
fn earlier(source: &Source, key: std::ops::Range<usize>) -> Option<String> {
    let (text, before) = (source.text.get(key.clone())?, source.text.get(..key.start)?);
    // The last piece is what stands before the key on its own line.
    let above: Vec<&str> = before.split('\n').collect();
    let within = above.iter().enumerate().rev().skip(1).take_while(|(_, line)| !line.trim_start().starts_with('['));
    let begins = |line: &str| line.trim_start().strip_prefix(text).is_some_and(|rest| rest.trim_start().starts_with('='));
    let first = within.filter(|(_, line)| begins(line)).last().map(|(at, _)| at + 1)?;
    Some(format!("the first stands at {}:{first}; keep one of the two", source.name))
}

fn one_line(warning: &Mistake) -> String {
    match warning.line {
        0 => warning.message.clone(),
        line => format!("{}:{line}: {}", warning.file, warning.message),
    }
}
