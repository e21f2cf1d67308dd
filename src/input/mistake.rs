//! What is wrong with the input: where, what, and what to do about it.

use std::fmt;
use std::ops::Range;

use crate::problem::mistake_code::MistakeCode;

/// Mistakes shown at the most; the rest is counted.
pub const SHOWN: usize = 100;

/// One mistake (or one warning) at one place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// What kind of mistake or warning it is; mistakes of the command line have none.
    pub code: Option<MistakeCode>,
    /// The file as the user named it, or `--set`.
    pub file: String,
    /// Line, counted from 1; 0 where the file as a whole is meant.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// The line itself.
    pub text: String,
    /// What the carets point at: characters of `text`.
    pub caret: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What was expected, the nearest known name, the remedy.
    pub help: Option<String>,
}

/// All mistakes of a problem file and its tables, in the order in which they stand there.
#[derive(Debug, Clone, PartialEq, Eq, Default, thiserror::Error)]
pub struct Mistakes {
    /// The first `SHOWN` of them.
    pub list: Vec<Mistake>,
    /// How many more there are.
    pub more: usize,
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, mistake) in self.list.iter().enumerate() {
            if at > 0 {
                writeln!(f)?;
            }
            f.write_str(&render(mistake, "mistake"))?;
        }
        if self.more > 0 {
            writeln!(f, "\nand {} more", self.more)?;
        }
        Ok(())
    }
}

/// The way compilers show it: label and message, place, the line with carets under it, help. Plain text, ends with a newline.
///
/// ```
/// let mistake = ribopt::input::Mistake {
///     code: Some(ribopt::problem::mistake_code::MistakeCode::NoNumber), file: "rib.toml".into(), line: 3, column: 9, text: "lower = nan".into(), caret: 8..11,
///     message: "`lower` is no number".into(), help: Some("give a number".into()),
/// };
/// let expected = "mistake[no-number]: `lower` is no number\n --> rib.toml:3:9\n  |\n3 | lower = nan\n  |         ^^^\n  = help: give a number\n";
/// assert_eq!(ribopt::input::render(&mistake, "mistake"), expected);
/// ```
pub fn render(mistake: &Mistake, label: &str) -> String {
    let number = mistake.line.to_string();
    let margin = if mistake.line == 0 { 1 } else { number.len() };
    let kind = mistake.code.map_or(String::new(), |code| format!("[{code}]"));
    let mut out = format!("{label}{kind}: {}\n", mistake.message);
    if mistake.line == 0 {
        out += &format!("{:margin$}--> {}\n", "", mistake.file);
    } else {
        let (text, before, carets) = shown(mistake);
        out += &format!("{:margin$}--> {}:{}:{}\n", "", mistake.file, mistake.line, mistake.column);
        out += &format!("{:margin$} |\n{number} | {text}\n{:margin$} | {before}{carets}\n", "", "");
    }
    for line in mistake.help.iter().flat_map(|help| help.lines()) {
        out += &format!("{:margin$} = help: {line}\n", "");
    }
    out
}

/// Characters of a line shown to the left and right of the caret's start.
const WINDOW: usize = 120;

/// The line (a long one cut down to the neighbourhood of the carets), the blanks before the carets, and the carets.
fn shown(mistake: &Mistake) -> (String, String, String) {
    let start = mistake.caret.start;
    let first = start.saturating_sub(WINDOW);
    let visible = |c: char| if c.is_control() && c != '\t' { '\u{fffd}' } else { c };
    let characters = || mistake.text.chars().map(visible);
    let cut = characters().count() > start + WINDOW;
    let text: String = characters().skip(first).take(start - first + WINDOW).collect();
    let blank = |c: char| if c == '\t' { '\t' } else { ' ' };
    let before: String = characters().skip(first).take(start - first).map(blank).collect();
    let carets = "^".repeat(mistake.caret.len().clamp(1, WINDOW));
    let (left, indent) = if first > 0 { ("…", " ") } else { ("", "") };
    (format!("{left}{text}{}", if cut { "…" } else { "" }), format!("{indent}{before}"), carets)
}
