//! Gauss's rule on pieces of a member.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// Points per piece where the integrand is a polynomial over E·I of a tapered member: with the largest ratio of a dimension between a
/// piece's ends below 3, ∫dx/h³ is exact to 8e−12 (measured; 12 points).
pub const TAPERED: usize = 12;

/// The same where a member is cut into two pieces or more: the largest ratio is below √3 then, and the nearest pole of 1/h³ so far away that
/// the polynomial through 8 values errs by (ρ = 7.3)⁻⁸ = 1e−7 at the most, of four pieces by 6e−10 (Trefethen, *Approximation Theory and
/// Approximation Practice*, theorem 8.2).
pub const TAPERED_PIECE: usize = 8;

/// Points per piece where the integrand is a polynomial of degree 7 at the most: exact.
pub const POLYNOMIAL: usize = 4;

/// Points and weights on [0, 1].
///
/// ```
/// use ribopt::structure::quadrature::gauss;
/// let fifth: f64 = gauss(4).iter().map(|(x, weight)| weight * x.powi(5)).sum();
/// assert!((fifth - 1.0 / 6.0).abs() < 1e-15);
/// ```
pub fn gauss(points: usize) -> Vec<(f64, f64)> {
    (0..points).map(|at| point(points, at)).collect()
}

/// The root of the Legendre polynomial P_n by Newton's method from Chebyshev's estimate, and its weight.
fn point(n: usize, at: usize) -> (f64, f64) {
    let mut x = (PI * (at as f64 + 0.75) / (n as f64 + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..100 {
        let (value, derivative) = legendre(n, x);
        slope = derivative;
        let step = value / derivative;
        x -= step;
        if step.abs() < 1e-16 {
            slope = legendre(n, x).1;
            break;
        }
    }
    (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
}

/// P_n(x) and its derivative, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

/// Weights that integrate from 0 to each point of a rule: row k has ∫₀^{x_k} ℓ_j for the Lagrange polynomials ℓ_j through the points,
/// exact for polynomials of a degree below their number.
///
/// ```
/// use ribopt::structure::quadrature::{cumulative, gauss};
/// let rule = gauss(4);
/// for (&(x, _), row) in rule.iter().zip(cumulative(&rule)) {
///     let integral: f64 = row.iter().zip(&rule).map(|(q, (at, _))| q * at * at).sum();
///     assert!((integral - x.powi(3) / 3.0).abs() < 1e-15);
/// }
/// ```
pub fn cumulative(rule: &[(f64, f64)]) -> Vec<Vec<f64>> {
    let lagrange = |j: usize, at: f64| -> f64 {
        let others = rule.iter().enumerate().filter(|(k, _)| *k != j);
        others.map(|(_, &(x, _))| (at - x) / (rule[j].0 - x)).product()
    };
    let integral = |upper: f64, j: usize| -> f64 { rule.iter().map(|&(x, w)| upper * w * lagrange(j, upper * x)).sum() };
    rule.iter().map(|&(upper, _)| (0..rule.len()).map(|j| integral(upper, j)).collect()).collect()
}

/// Points and weights on [0, 1] cut at `breaks` (ascending, inside), so many on each piece: up to [`TAPERED`].
pub fn pieces(breaks: &[f64], points: usize) -> Vec<(f64, f64)> {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    let rules = RULES.get_or_init(|| (0..=TAPERED).map(gauss).collect());
    let rule = &rules[points.min(TAPERED)];
    let ends: Vec<f64> = std::iter::once(0.0).chain(breaks.iter().copied()).chain([1.0]).collect();
    let piece = |ends: &[f64]| {
        let (start, width) = (ends[0], ends[1] - ends[0]);
        rule.iter().map(move |(x, weight)| (start + width * x, width * weight))
    };
    ends.windows(2).flat_map(piece).collect()
}

/// Breaks that cut a member whose dimensions change by up to `ratio` between its ends into pieces over which they change by 3 at
/// the most: equal ratios for growing and for shrinking dimensions.
pub fn graded(ratio: f64) -> Vec<f64> {
    const LARGEST: f64 = 3.0;
    if ratio.is_nan() || ratio <= LARGEST || ratio.is_infinite() {
        return Vec::new();
    }
    let pieces = (ratio.ln() / LARGEST.ln()).ceil() as i32;
    let growing = (1..pieces).map(|k| (ratio.powf(f64::from(k) / f64::from(pieces)) - 1.0) / (ratio - 1.0));
    let mut breaks: Vec<f64> = growing.flat_map(|at| [at, 1.0 - at]).collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    breaks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_points_integrate_polynomials_of_degree_23() {
        for degree in 0..24 {
            let sum: f64 = gauss(TAPERED).iter().map(|(x, weight)| weight * x.powi(degree)).sum();
            assert!((sum * f64::from(degree + 1) - 1.0).abs() < 1e-14, "{degree}: {sum}");
        }
    }

    /// ∫dx/(1 + (ρ−1)x)³ = (1 − 1/ρ²)/(2(ρ − 1)), either way round.
    #[test]
    fn graded_pieces_follow_steep_tapers() {
        for ratio in [2.5, 6.0, 20.0] {
            let exact = (1.0 - 1.0 / (ratio * ratio)) / (2.0 * (ratio - 1.0));
            for reversed in [false, true] {
                let height = |x: f64| 1.0 + (ratio - 1.0) * if reversed { 1.0 - x } else { x };
                let sum: f64 = pieces(&graded(ratio), TAPERED).iter().map(|&(x, w)| w / height(x).powi(3)).sum();
                assert!((sum / exact - 1.0).abs() < 1e-11, "{ratio} {reversed}: {sum} {exact}");
            }
        }
    }
}
