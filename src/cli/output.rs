//! Standard output and standard error, without a panic where nobody reads them any more.

use std::io::{self, BufWriter, Write};

use super::failure::Failure;

/// Writes to standard output. A reader that has gone away (`ribopt … | head`) is no failure.
///
/// # Errors
/// Where it cannot be written to for another reason, such as a full disk.
pub fn print(content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    let written = content(&mut out).and_then(|()| out.flush());
    // What did not go out is not tried again when the buffer is dropped.
    let _ = out.into_parts();
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Output(error)),
        _ => Ok(()),
    }
}

/// A line on standard error.
pub fn note(text: &str) {
    // With standard error closed there is nobody left to tell.
    let _ = writeln!(io::stderr(), "{text}");
}

/// Warnings of the reader, already rendered, on standard error.
pub fn tell(rendered: &[String]) {
    for warning in rendered {
        note(warning.trim_end());
    }
}

/// Further warnings, one line each.
pub fn warn(warnings: &[String]) {
    for warning in warnings {
        note(&format!("warning: {warning}"));
    }
}
