//! Text files as people save them: byte-order marks, UTF-16, any line ends; their lines and words with line numbers.

use std::borrow::Cow;
use std::io::Read;

use super::FormatError;

/// Everything a source holds.
pub(super) fn bytes(mut source: impl Read) -> Result<Vec<u8>, FormatError> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes).map_err(|cause| FormatError::Content(cause.to_string()))?;
    Ok(bytes)
}

/// Text of any Unicode encoding. UTF-16 is told by its byte-order mark or by zeros in every other byte; bytes that are no UTF-8 become replacement
/// characters, so that comments in other encodings do no harm.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, FormatError> {
    match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => Ok(String::from_utf8_lossy(rest)),
        [0xFF, 0xFE, 0, 0, ..] | [0, 0, 0xFE, 0xFF, ..] => {
            Err(FormatError::Content("the text is UTF-32; save it as UTF-8".into()))
        }
        [0xFF, 0xFE, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => utf16(rest, u16::from_be_bytes),
        [1..=255, 0, 1..=255, 0, ..] => utf16(bytes, u16::from_le_bytes),
        [0, 1..=255, 0, 1..=255, ..] => utf16(bytes, u16::from_be_bytes),
        _ => Ok(String::from_utf8_lossy(bytes)),
    }
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<Cow<'_, str>, FormatError> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(FormatError::Content("the text is UTF-16 with half a character at its end; save it as UTF-8".into()));
    }
    let text: String = char::decode_utf16(pairs.iter().map(|&pair| unit(pair))).map(|c| c.unwrap_or('\u{FFFD}')).collect();
    Ok(Cow::Owned(text))
}

/// Hands out the lines of a text one by one, ended by LF, CR LF or CR; `#` starts a comment.
pub(super) struct Lines<'a> {
    rest: &'a str,
    joined: String,
    /// The number of the line handed out last, from 1.
    pub number: usize,
    /// Join a line ending in `\` with the next (OBJ).
    pub continued: bool,
}

impl<'a> Lines<'a> {
    pub fn new(text: &'a str) -> Self {
        Lines { rest: text, joined: String::new(), number: 0, continued: false }
    }

    /// The next line as it stands; `None` at the end.
    pub fn raw(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let bytes = self.rest.as_bytes();
        let end = bytes.iter().position(|&byte| byte == b'\n' || byte == b'\r').unwrap_or(bytes.len());
        let after = match bytes[end..] {
            [b'\r', b'\n', ..] => end + 2,
            [] => end,
            _ => end + 1,
        };
        let line = &self.rest[..end];
        self.rest = &self.rest[after..];
        Some(line)
    }

    /// The next line without its comment; `None` at the end.
    pub fn next(&mut self) -> Option<&str> {
        self.joined.clear();
        loop {
            let Some(raw) = self.raw() else {
                return if self.joined.is_empty() { None } else { Some(&self.joined) };
            };
            let line = raw.split_once('#').map_or(raw, |(line, _)| line).trim_end();
            match line.strip_suffix('\\').filter(|_| self.continued) {
                Some(part) => {
                    self.joined.push_str(part);
                    self.joined.push(' ');
                }
                None if self.joined.is_empty() => return Some(line),
                None => {
                    self.joined.push_str(line);
                    return Some(&self.joined);
                }
            }
        }
    }
}

/// The next word as a number.
pub(super) fn number<'a, T: std::str::FromStr>(words: &mut impl Iterator<Item = &'a str>, what: &str) -> Result<T, String> {
    let word = words.next().ok_or_else(|| format!("{what} is missing"))?;
    word.parse().map_err(|_| format!("expected {what}, found '{word}'"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "v 1 2 3\nf 1\n";
        let utf16 = |unit: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(unit).collect::<Vec<u8>>();
        let (little, big) = (utf16(u16::to_le_bytes), utf16(u16::to_be_bytes));
        for bytes in [
            text.as_bytes().to_vec(),
            [b"\xEF\xBB\xBF", text.as_bytes()].concat(),
            [b"\xFF\xFE", little.as_slice()].concat(),
            [b"\xFE\xFF", big.as_slice()].concat(),
            little,
            big,
        ] {
            assert_eq!(decode(&bytes).unwrap(), text);
        }
        assert!(decode(b"\xFF\xFE\0\0v\0\0\0").unwrap_err().to_string().contains("UTF-32"));
    }

    #[test]
    fn lines_end_in_three_ways() {
        let mut lines = Lines::new("a # b\r\nc\rd\n\ne");
        let found: Vec<String> = std::iter::from_fn(|| lines.next().map(String::from)).collect();
        assert_eq!((found, lines.number), (["a", "c", "d", "", "e"].map(String::from).to_vec(), 5));
    }
}
