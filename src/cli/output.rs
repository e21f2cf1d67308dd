//! Standard output and standard error, without a panic where nobody reads them any more.

use std::io::{self, BufWriter, Write};

use super::failure::Failure;
use ribopt::problem::words::shortened;

/// Writes to standard output. A reader that has gone away (`ribopt … | head`) is no failure.
///
/// # Errors
/// Where it cannot be written to for another reason, such as a full disk.
pub fn print(content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    let mut out = Plain(BufWriter::new(io::stdout().lock()));
    let written = content(&mut out).and_then(|()| out.flush());
    // What did not go out is not tried again when the buffer is dropped.
    let _ = out.0.into_parts();
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Output(error)),
        _ => Ok(()),
    }
}

/// A line on standard error.
pub fn note(text: &str) {
    // With standard error closed there is nobody left to tell.
    let mut err = Plain(io::stderr());
    let _ = writeln!(err, "{text}");
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
        note(&format!("warning: {}", shortened(warning, LONGEST)));
    }
}

/// Characters of a warning at the most.
const LONGEST: usize = 400;

/// Lets through what can be read: a problem file's texts do not steer the terminal.
struct Plain<W: Write>(W);

/// Whether a byte acts on a terminal. (Beyond ASCII, control characters are made of two bytes: see below.)
fn acts(byte: u8) -> bool {
    (byte < 0x20 && byte != b'\n' && byte != b'\t') || byte == 0x7f
}

/// U+0080 to U+009F begin with this byte, and letters such as ä with its neighbour.
const SECOND_CONTROLS: u8 = 0xc2;

impl<W: Write> Write for Plain<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let control = |pair: &[u8]| pair[0] == SECOND_CONTROLS && pair[1] < 0xa0;
        if bytes.iter().any(|&byte| acts(byte)) || bytes.windows(2).any(control) {
            let text = String::from_utf8_lossy(bytes);
            let shown: String =
                text.chars().map(|c| if c.is_control() && c != '\n' && c != '\t' { '\u{fffd}' } else { c }).collect();
            self.0.write_all(shown.as_bytes())?;
        } else {
            self.0.write_all(bytes)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_steers_the_terminal() {
        let mut out = Plain(Vec::new());
        out.write_all("\u{1b}[31mred\u{7} ∂(x) ä\u{9b}2J\tm\n".as_bytes()).unwrap();
        assert_eq!(String::from_utf8(out.0).unwrap(), "\u{fffd}[31mred\u{fffd} ∂(x) ä\u{fffd}2J\tm\n");
    }
}
