//! Numbers with their nouns; texts of the user's as they may stand in a line.

use std::borrow::Cow;

/// `1 variable`, `3 variables`, `2 entries`.
///
/// ```
/// use ribopt::problem::words::count;
/// assert_eq!([count(1, "row"), count(0, "row"), count(2, "entry")], ["1 row", "0 rows", "2 entries"]);
/// ```
pub fn count(number: usize, one: &str) -> String {
    match one.strip_suffix('y') {
        _ if number == 1 => format!("1 {one}"),
        Some(stem) if !stem.ends_with(['a', 'e', 'o', 'u']) => format!("{number} {stem}ies"),
        _ => format!("{number} {one}s"),
    }
}

/// Characters of a name or a text shown in a line of a table.
const LONGEST: usize = 60;

/// A text of the user's as it may stand in a line: no control characters, no marks that turn the direction of writing, and not
/// longer than a line can take.
///
/// ```
/// use ribopt::problem::words::shown;
/// assert_eq!(shown("\u{1b}[31mred\nline"), "\u{fffd}[31mred\u{fffd}line");
/// assert_eq!(shown(&"y".repeat(70_000)).chars().count(), 60);
/// ```
pub fn shown(text: &str) -> String {
    let long = text.chars().nth(LONGEST).is_some();
    let kept = if long { LONGEST - 1 } else { LONGEST };
    let mut shown: String = plain(text).chars().take(kept).collect();
    if long {
        shown.push('…');
    }
    shown
}

/// A text whose characters all show, none acts on a terminal; line breaks too become signs.
pub fn plain(text: &str) -> Cow<'_, str> {
    if text.chars().any(acts) { text.chars().map(|c| if acts(c) { '\u{fffd}' } else { c }).collect() } else { text.into() }
}

/// Control characters, and those that change the direction of what follows.
fn acts(c: char) -> bool {
    c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A name as a cell of a table that a spreadsheet may open: what would begin a formula there is quoted by an apostrophe.
///
/// ```
/// use ribopt::problem::words::cell;
/// assert_eq!(cell("=cmd|'/c calc'!A1"), "'=cmd|'/c calc'!A1");
/// assert_eq!(cell("support.b"), "support.b");
/// ```
pub fn cell(name: &str) -> Cow<'_, str> {
    match plain(name) {
        name if name.starts_with(['=', '+', '-', '@']) => format!("'{name}").into(),
        name => name,
    }
}

/// A sentence cut in its middle where it would fill more than this many characters: what it is about stands at its beginning, what
/// was done at its end.
///
/// ```
/// use ribopt::problem::words::shortened;
/// assert_eq!(shortened("brief", 20), "brief");
/// assert_eq!(shortened(&format!("begin{}end", "x".repeat(99)), 10), "beginx … xend");
/// ```
pub fn shortened(text: &str, most: usize) -> Cow<'_, str> {
    let length = text.chars().count();
    if length <= most {
        return text.into();
    }
    let (head, tail) = (most * 3 / 5, most - most * 3 / 5);
    let (first, last): (String, String) = (text.chars().take(head).collect(), text.chars().skip(length - tail).collect());
    format!("{first} … {last}").into()
}

/// A number as a message shows it: not with three hundred digits.
///
/// ```
/// use ribopt::problem::words::brief;
/// assert_eq!([brief(0.25), brief(1e300), brief(-12.0)], ["0.25", "1e300", "-12"]);
/// ```
pub fn brief(value: f64) -> String {
    let text = value.to_string();
    if text.len() > 18 { format!("{value:e}") } else { text }
}
