//! The problem file (TOML) and its tables (CSV) become a checked [`Problem`].
//!
//! Path → text ([`load`]) → tables of fields with places ([`fields`]) → the file as declared ([`declaration`]) → names
//! looked up and numbers computed ([`assemble`]). Mistakes are collected on the way and shown in one go.

mod assemble;
mod declaration;
mod declare;
mod fields;
mod findings;
mod load;
mod mistake;
mod source;
mod table;
mod table_lines;

use std::path::Path;

use sha2::{Digest, Sha256};
use toml::de::DeTable;

use crate::problem::Problem;
use fields::Reader;
use findings::Findings;
pub use mistake::{Mistake, Mistakes, render};
use source::{Place, Source};

/// What a problem file gives.
#[derive(Debug, Clone)]
pub struct Input {
    /// The checked problem; [`Problem::warnings`] repeats the warnings in one line each.
    pub problem: Problem,
    /// SHA-256 of the file and its tables, in this order, in hexadecimal.
    pub sha256: String,
    /// What the user should hear of, in the order of the file.
    pub warnings: Vec<Mistake>,
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
    read_with(path, &[])
}

/// Reads a problem file with some of its numbers replaced, as by `--set`: `NAME.lower=VALUE`, `NAME.upper=VALUE`,
/// `NAME.start=VALUE` for a variable (`depth`, `x`, `x[2]`, `support.b`), `NAME=VALUE` for a parameter.
///
/// # Errors
/// Every mistake of the file, its tables and the overrides.
pub fn read_with(path: &Path, overrides: &[String]) -> Result<Input, Mistakes> {
    let (source, bytes) = load::load(path)?;
    let mut checksum = Sha256::new();
    checksum.update(&bytes);
    let mut findings = Findings::default();
    let (document, errors) = DeTable::parse_recoverable(&source.text);
    let declared = declare::declare(document.get_ref(), &mut Reader { source: &source, findings: &mut findings });
    if !errors.is_empty() {
        syntax(&source, &errors, &mut findings);
        return Err(findings.into_parts(&source, overrides).0);
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let (mut problem, findings) = assemble::assemble(declared, &source, findings, overrides, folder, &mut checksum);
    let clean = findings.clean();
    let (mistakes, warnings) = findings.into_parts(&source, overrides);
    if !clean {
        return Err(mistakes);
    }
    problem.warnings = warnings.iter().map(one_line).collect();
    let sha256 = checksum.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(Input { problem, sha256, warnings })
}

/// Mistakes of the TOML itself. What the walk found on the same lines is only their consequence.
fn syntax(source: &Source, errors: &[toml::de::Error], findings: &mut Findings) {
    let end = source.text.len();
    let span = |error: &toml::de::Error| error.span().unwrap_or(end..end);
    let lines: Vec<usize> = errors.iter().map(|error| source.line(span(error).start)).collect();
    findings.forget_lines(source, &lines);
    for error in errors {
        let help = error.message().contains("duplicate key").then(|| "keep one of the two".to_owned());
        findings.mistake(Place::file(span(error)), error.message(), help);
    }
}

fn one_line(warning: &Mistake) -> String {
    match warning.line {
        0 => warning.message.clone(),
        line => format!("{}:{line}: {}", warning.file, warning.message),
    }
}
