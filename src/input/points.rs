//! Points as one text, for cells of tables and for the command line.

use crate::geometry::polygon::Ring;

/// Reads `x y; x y; …`: pairs by semicolons, the two numbers of a pair by blanks or a comma. After a bar come the points of a hole.
///
/// ```
/// assert_eq!(ribopt::input::points("0 0; 0.4, 0; 0.4 0.3"), Ok(vec![vec![[0.0, 0.0], [0.4, 0.0], [0.4, 0.3]]]));
/// assert_eq!(ribopt::input::points("0 0; 3 0; 0 3 | 1 1; 1.5 1; 1 1.5").unwrap().len(), 2);
/// assert!(ribopt::input::points("0 0; 1").is_err());
/// ```
///
/// # Errors
/// A sentence about the first pair that is none.
pub fn points(text: &str) -> Result<Vec<Ring>, String> {
    text.split('|').map(ring).collect()
}

fn ring(text: &str) -> Result<Ring, String> {
    let pairs = text.trim().trim_end_matches(';').split(';');
    pairs.map(|pair| one(pair).ok_or_else(|| format!("`{}` is no point; expected `x y; x y; …`", pair.trim()))).collect()
}

fn one(pair: &str) -> Option<[f64; 2]> {
    let words = pair.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty());
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    numbers?.try_into().ok()
}
