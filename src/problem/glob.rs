//! Patterns for names: `*` stands for any letters, `?` for one.

use wildmatch::WildMatch;

/// Whether the whole name matches.
///
/// ```
/// use ribopt::problem::glob::matches;
/// assert!(matches("web*", "web_12") && matches("?b", "ab") && matches("*", ""));
/// assert!(!matches("web", "web1"));
/// ```
pub fn matches(pattern: &str, name: &str) -> bool {
    WildMatch::new(pattern).matches(name)
}
