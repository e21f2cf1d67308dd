//! What each kind of mistake and warning means: the parts of `docs/mistakes.md`.

use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;

const PAGE: &str = include_str!("../../docs/mistakes.md");

/// What a kind of mistake means, with an example that is wrong and one that is right (Markdown, ends with a newline); without a name,
/// all kinds and what they are about.
///
/// # Errors
/// A sentence naming what is known.
///
/// ```
/// assert!(ribopt::input::explain(Some("circle"))?.contains("need one another"));
/// assert!(ribopt::input::explain(Some("circel")).unwrap_err().contains("did you mean `circle`?"));
/// assert!(ribopt::input::explain(None)?.contains("unknown-key"));
/// # Ok::<(), String>(())
/// ```
pub fn explain(code: Option<&str>) -> Result<String, String> {
    let Some(wanted) = code else {
        let line = |code: &MistakeCode| {
            let kind = if code.is_warning() { " (a warning)" } else { "" };
            format!("{:18} {}{kind}\n", code.name(), first_sentence(code.name()))
        };
        return Ok(MistakeCode::ALL.iter().map(line).collect());
    };
    match part(wanted) {
        Some(text) => {
            let is_warning = MistakeCode::ALL.iter().any(|code| code.name() == wanted && code.is_warning());
            let title = if is_warning { format!("{wanted}: a warning") } else { wanted.to_owned() };
            Ok(format!("{title}\n\n{}\n", text.trim()))
        }
        None => {
            let names = || MistakeCode::ALL.iter().map(|code| code.name());
            let help = did_you_mean(wanted, names()).unwrap_or_else(|| "`ribopt explain` lists them".to_owned());
            Err(format!("there is no kind of mistake or warning `{wanted}`; {help}"))
        }
    }
}

/// The text under a heading.
fn part(code: &str) -> Option<&'static str> {
    PAGE.split("\n## ").skip(1).find_map(|part| part.strip_prefix(code)?.strip_prefix('\n'))
}

/// Up to a colon, an opening bracket or the first full stop.
fn first_sentence(code: &str) -> &'static str {
    let text = part(code).unwrap_or_default().trim_start();
    let end = text.find(". ").or_else(|| text.find(".\n")).unwrap_or(text.len());
    text[..end].split([':', ';']).next().unwrap_or_default()
}
