//! Linear rows that are multiples of one another and ask for different things: x + y = 1 beside 2x + 2y = 2.000002. No point meets both,
//! however far away rounding hides it.

use std::cell::LazyCell;
use std::collections::HashMap;

use super::linear_rows::Line;

/// A row that contradicts one it is an exact multiple of, by more than `ease` of the magnitudes of their limits and of their terms at variables
/// of these sizes.
pub(super) fn contradiction(lines: &[Option<Line>], sizes: impl Fn() -> Vec<f64>, ease: f64) -> Option<usize> {
    let sizes = LazyCell::new(sizes);
    let mut alike: HashMap<Vec<usize>, Vec<usize>> = HashMap::new();
    let with_entries = lines.iter().enumerate().filter_map(|(i, line)| Some((i, line.as_ref()?)));
    for (i, line) in with_entries.filter(|(_, line)| !line.entries.is_empty()) {
        let others = alike.entry(line.entries.iter().map(|entry| entry.0).collect()).or_default();
        let contradicts = |&other: &usize| lines[other].as_ref().is_some_and(|other| are_apart(line, other, &sizes, ease));
        if others.iter().take(LOOKED_AT).any(contradicts) {
            return Some(i);
        }
        others.push(i);
    }
    None
}

/// Rows over the same variables a row is compared with.
const LOOKED_AT: usize = 8;

fn are_apart(a: &Line, b: &Line, sizes: &LazyCell<Vec<f64>, impl FnOnce() -> Vec<f64>>, ease: f64) -> bool {
    let (first, second) = (a.entries[0].1, b.entries[0].1);
    let is_multiple = a.entries.iter().zip(&b.entries).all(|(a, b)| are_equal_products(first, b.1, second, a.1));
    if !is_multiple {
        return false;
    }
    // Both in units of the first row.
    let (lower, upper) = if first / second > 0.0 { (b.lower, b.upper) } else { (b.upper, b.lower) };
    let (lower, upper) = (lower * (first / second), upper * (first / second));
    if lower <= a.upper && a.lower <= upper {
        return false;
    }
    let fixed = a.fixed.max(b.fixed * (first / second).abs());
    let terms = a.entries.iter().map(|&(j, a)| (a * sizes[j]).abs()).fold(fixed, f64::max);
    let apart = |least: f64, most: f64| least - most > ease * terms.max(least.abs()).max(most.abs());
    apart(lower, a.upper) || apart(a.lower, upper)
}

/// a·b = c·d to the last digit: the rounded products and what rounding has taken from them are equal.
fn are_equal_products(a: f64, b: f64, c: f64, d: f64) -> bool {
    let (one, other) = (a * b, c * d);
    one == other && one.is_finite() && a.mul_add(b, -one) == c.mul_add(d, -other)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(entries: &[(usize, f64)], lower: f64, upper: f64) -> Option<Line> {
        Some(Line { entries: entries.to_vec(), lower, upper, fixed: 0.0 })
    }

    #[test]
    fn multiples_contradict_one_another() {
        let one = || line(&[(0, 1.0), (1, 1.0)], 1.0, 1.0);
        let twice = |limit: f64| line(&[(0, -2.0), (1, -2.0)], -limit, -limit);
        assert_eq!(contradiction(&[one(), twice(2.000002)], || vec![1.0, 1.0], 4e-8), Some(1));
        assert_eq!(contradiction(&[one(), twice(2.0)], || vec![1.0, 1.0], 4e-8), None);
        // Beside terms of this size that is within the tolerance.
        assert_eq!(contradiction(&[one(), twice(2.000002)], || vec![1e3, 1.0], 4e-8), None);
        // Nor beside fixed variables' terms.
        let fixed = Line { fixed: 1e3, ..twice(2.000002).unwrap() };
        assert_eq!(contradiction(&[one(), Some(fixed)], || vec![1.0, 1.0], 4e-8), None);
        // No multiple.
        let other = line(&[(0, 2.0), (1, 2.0 + 1e-15)], 3.0, 3.0);
        assert_eq!(contradiction(&[one(), other], || vec![1.0, 1.0], 4e-8), None);
        // One-sided rows that leave room, and that do not.
        let at_most = || line(&[(0, 1.0)], f64::NEG_INFINITY, 1.0);
        let at_least = |limit: f64| line(&[(0, 3.0)], limit, f64::INFINITY);
        assert_eq!(contradiction(&[at_most(), at_least(2.0)], || vec![1.0], 4e-8), None);
        assert_eq!(contradiction(&[at_most(), at_least(3.1)], || vec![1.0], 4e-8), Some(1));
    }
}
