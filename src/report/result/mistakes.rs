//! A run that could not begin: the mistakes, as JSON.

use std::io::{self, Write};

use serde::Serialize;

use super::{FORMAT, write_value};

/// A mistake of the command line or the problem file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mistake {
    /// What `ribopt explain` explains it by, where it is one of the problem file.
    pub code: Option<&'static str>,
    /// The file it is in.
    pub file: Option<String>,
    /// Line, counted from 1.
    pub line: Option<usize>,
    /// Column, counted from 1 in characters.
    pub column: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What was expected, the nearest known name, the remedy.
    pub help: Option<String>,
}

impl Mistake {
    /// A mistake that is in no file.
    pub fn of_command(message: String) -> Mistake {
        Mistake { code: None, file: None, line: None, column: None, message, help: None }
    }
}

/// Writes the object that stands for a run that could not begin.
///
/// # Errors
/// Whatever the writer says.
pub fn write_mistakes(message: &str, mistakes: &[Mistake], out: &mut dyn Write) -> io::Result<()> {
    #[derive(Serialize)]
    struct Refused<'a> {
        format: &'static str,
        version: &'static str,
        status: &'static str,
        message: &'a str,
        mistakes: &'a [Mistake],
    }
    let version = env!("CARGO_PKG_VERSION");
    let refused = Refused { format: FORMAT, version, status: "invalid-input", message, mistakes };
    write_value(&refused, out)
}
