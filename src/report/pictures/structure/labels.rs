//! Numbers beside a drawing: the largest first, none over another.

use super::super::canvas::Canvas;

/// A number that may be written.
pub struct Label {
    /// Where it belongs.
    pub at: [f64; 2],
    /// What decides who comes first.
    pub weight: f64,
    /// The number.
    pub text: String,
}

/// Pixels a letter takes, and a line.
pub const LETTER: f64 = 7.0;
const LINE: f64 = 13.0;

/// Numbers below this share of the largest say nothing.
const LEAST: f64 = 0.02;

/// Writes up to `most` of them, the heaviest first, each centred at its place where nothing stands yet.
pub fn write(canvas: &mut Canvas, mut labels: Vec<Label>, most: usize) {
    labels.retain(|label| label.weight.is_finite() && label.at.iter().all(|at| at.is_finite()));
    labels.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    let largest = labels.first().map_or(0.0, |label| label.weight);
    let mut written: Vec<([f64; 2], f64)> = Vec::new();
    for label in labels.iter().filter(|label| label.weight > LEAST * largest) {
        let width = LETTER * label.text.chars().count() as f64;
        let clear = |(at, other): &([f64; 2], f64)| {
            (at[0] - label.at[0]).abs() > (width + other) / 2.0 || (at[1] - label.at[1]).abs() > LINE
        };
        if written.len() < most && written.iter().all(clear) {
            canvas.number(label.at, &label.text);
            written.push((label.at, width));
        }
    }
}
