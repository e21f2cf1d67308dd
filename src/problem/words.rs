//! Numbers with their nouns.

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
