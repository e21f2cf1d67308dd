//! Cubic interpolating splines, the pieces a·x³ + b·x² + c·x + d of note (1.5.9) joined with two continuous derivatives.

use super::{SplineError, finite, rising, same_length};
use crate::math::banded::Banded;

/// What holds at the two ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EndCondition {
    /// Second derivatives are zero.
    Natural,
    /// First derivatives are given.
    Clamped {
        /// At the first point.
        first: f64,
        /// At the last.
        last: f64,
    },
    /// The two pieces at each end are one cubic; with three points one parabola, with two a line.
    NotAKnot,
}

/// A cubic spline through points, twice continuously differentiable. Kept as values and slopes at the points.
#[derive(Debug, Clone, PartialEq)]
pub struct CubicSpline {
    x: Vec<f64>,
    y: Vec<f64>,
    slopes: Vec<f64>,
}

impl CubicSpline {
    /// Through the points `(x[i], y[i])`, at least two, x rising. O(n).
    ///
    /// ```
    /// use ribopt::splines::{CubicSpline, EndCondition};
    /// let x = [0.0, 1.0, 2.0, 4.0];
    /// let spline = CubicSpline::new(&x, &x.map(|x| x * x * x), EndCondition::NotAKnot)?;
    /// assert!((spline.evaluate(3.0)? - 27.0).abs() < 1e-13);
    /// assert!((spline.derivative(3.0, 1)? - 27.0).abs() < 1e-13);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// Lists of unequal length, fewer than two points, abscissae that do not rise, numbers that are not finite.
    pub fn new(x: &[f64], y: &[f64], ends: EndCondition) -> Result<Self, SplineError> {
        rising("abscissa", x)?;
        same_length("the ordinates", x.len(), y.len())?;
        finite("ordinate", y)?;
        if let EndCondition::Clamped { first, last } = ends {
            finite("end slope", [&first, &last])?;
        }
        if x.len() < 2 {
            return Err(SplineError::TooFewPoints { count: x.len(), least: 2 });
        }
        let slopes = slopes(x, y, ends)?;
        Ok(CubicSpline { x: x.to_vec(), y: y.to_vec(), slopes })
    }

    /// First and last abscissa.
    pub fn domain(&self) -> (f64, f64) {
        (self.x[0], self.x[self.x.len() - 1])
    }

    /// Its value at x.
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn evaluate(&self, x: f64) -> Result<f64, SplineError> {
        self.derivative(x, 0)
    }

    /// The derivative of any order at x (order 0: the value; from the right at a point where the third one jumps).
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn derivative(&self, x: f64, order: usize) -> Result<f64, SplineError> {
        let (from, to) = self.domain();
        if !(from <= x && x <= to) {
            return Err(SplineError::Outside { x, from, to });
        }
        let at = self.x.partition_point(|knot| *knot <= x).clamp(1, self.x.len() - 1) - 1;
        let [d, c, b, a] = self.piece(at);
        let s = x - self.x[at];
        Ok(match order {
            0 => ((a * s + b) * s + c) * s + d,
            1 => (3.0 * a * s + 2.0 * b) * s + c,
            2 => 6.0 * a * s + 2.0 * b,
            3 => 6.0 * a,
            _ => 0.0,
        })
    }

    /// Coefficients of the piece right of point i in powers of x − x[i], lowest first.
    fn piece(&self, i: usize) -> [f64; 4] {
        let h = self.x[i + 1] - self.x[i];
        let (m0, m1, chord) = (self.slopes[i], self.slopes[i + 1], (self.y[i + 1] - self.y[i]) / h);
        [self.y[i], m0, (3.0 * chord - 2.0 * m0 - m1) / h, (m0 + m1 - 2.0 * chord) / (h * h)]
    }
}

/// Slopes at the points, from the continuity of the second derivative and the end conditions: a band system.
fn slopes(x: &[f64], y: &[f64], ends: EndCondition) -> Result<Vec<f64>, SplineError> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let chord: Vec<f64> = y.windows(2).zip(&h).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();
    if ends == EndCondition::NotAKnot && n < 4 {
        return Ok(parabola(&h, &chord));
    }
    let (mut matrix, mut right) = (Banded::zeros(n, 1, 1), vec![[0.0]; n]);
    for i in 1..n - 1 {
        *matrix.entry(i, i - 1) = h[i];
        *matrix.entry(i, i) = 2.0 * (h[i - 1] + h[i]);
        *matrix.entry(i, i + 1) = h[i - 1];
        right[i] = [3.0 * (h[i] * chord[i - 1] + h[i - 1] * chord[i])];
    }
    let mut end = |row: usize, next: usize, [own, other, value]: [f64; 3]| {
        *matrix.entry(row, row) = own;
        *matrix.entry(row, next) = other;
        right[row] = [value];
    };
    match ends {
        EndCondition::Natural => {
            end(0, 1, [2.0, 1.0, 3.0 * chord[0]]);
            end(n - 1, n - 2, [2.0, 1.0, 3.0 * chord[n - 2]]);
        }
        EndCondition::Clamped { first, last } => {
            end(0, 1, [1.0, 0.0, first]);
            end(n - 1, n - 2, [1.0, 0.0, last]);
        }
        EndCondition::NotAKnot => {
            end(0, 1, not_a_knot_row([h[0], h[1]], [chord[0], chord[1]]));
            end(n - 1, n - 2, not_a_knot_row([h[n - 2], h[n - 3]], [chord[n - 2], chord[n - 3]]));
        }
    }
    matrix.solve(&mut right).map_err(|singular| SplineError::Undetermined { function: singular.row + 1 })?;
    Ok(right.into_iter().map(|[slope]| slope).collect())
}

/// Equal third derivatives left and right of the second point, the slope of the third point eliminated
/// (de Boor, *A Practical Guide to Splines*, IV).
fn not_a_knot_row([h0, h1]: [f64; 2], [chord0, chord1]: [f64; 2]) -> [f64; 3] {
    let both = h0 + h1;
    [h1, both, ((h0 + 2.0 * both) * h1 * chord0 + h0 * h0 * chord1) / both]
}

/// Slopes of the parabola through three points, or of the line through two.
fn parabola(h: &[f64], chord: &[f64]) -> Vec<f64> {
    match (h, chord) {
        ([h0, h1], [left, right]) => {
            let bend = (right - left) / (h0 + h1);
            vec![left - bend * h0, left + bend * h0, right + bend * h1]
        }
        _ => vec![chord[0]; 2],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splines::reference::reference;

    const ENDS: [(&str, EndCondition); 3] = [
        ("natural", EndCondition::Natural),
        ("not-a-knot", EndCondition::NotAKnot),
        ("clamped", EndCondition::Clamped { first: 0.7, last: -0.4 }),
    ];

    #[test]
    fn values_and_derivatives_as_scipy() {
        let data = reference();
        for (name, ends) in ENDS {
            let spline = CubicSpline::new(&data.x, &data.y, ends).unwrap();
            for (order, expected) in data.cubic[name].iter().enumerate() {
                let size = expected.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
                for (x, scipy) in data.at.iter().zip(expected) {
                    let ours = spline.derivative(*x, order).unwrap();
                    assert!((ours - scipy).abs() < 1e-11 * size, "{name} {order} {x}: {ours} {scipy}");
                }
            }
        }
    }

    #[test]
    fn two_three_and_four_points_as_scipy() {
        let data = reference();
        for (count, by_name) in &data.few {
            let n: usize = count.parse().unwrap();
            for (name, ends) in ENDS {
                let spline = CubicSpline::new(&data.x[..n], &data.y[..n], ends).unwrap();
                for (at, scipy) in by_name[name].iter().enumerate() {
                    let (from, to) = spline.domain();
                    let ours = spline.evaluate((from + (to - from) * at as f64 / 6.0).min(to)).unwrap();
                    assert!((ours - scipy).abs() < 1e-13, "{n} {name}: {ours} {scipy}");
                }
            }
        }
    }

    #[test]
    fn bad_data_are_refused() {
        let natural = EndCondition::Natural;
        assert!(matches!(CubicSpline::new(&[0.0], &[1.0], natural), Err(SplineError::TooFewPoints { count: 1, least: 2 })));
        assert!(matches!(CubicSpline::new(&[0.0, 0.0], &[1.0, 1.0], natural), Err(SplineError::NotRising { .. })));
        assert!(matches!(CubicSpline::new(&[0.0, 1.0], &[1.0], natural), Err(SplineError::Length { .. })));
        assert!(matches!(CubicSpline::new(&[0.0, 1.0], &[1.0, f64::NAN], natural), Err(SplineError::NotFinite { .. })));
        let line = CubicSpline::new(&[0.0, 1.0], &[1.0, 2.0], natural).unwrap();
        assert!(matches!(line.evaluate(1.1), Err(SplineError::Outside { .. })));
    }
}
