//! Knot vectors: checked once, so that everything built on them may rely on it.

use super::{SplineError, finite};

/// Knots t₀ ≤ … ≤ t_{n+p} of n B-splines of degree p; a knot may stand up to p + 1 times.
#[derive(Debug, Clone, PartialEq)]
pub struct KnotVector {
    degree: usize,
    knots: Vec<f64>,
}

impl KnotVector {
    /// From a degree and all knots.
    ///
    /// ```
    /// use ribopt::splines::KnotVector;
    /// let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0])?;
    /// assert_eq!(knots.count(), 4);
    /// assert_eq!(knots.domain(), (0.0, 1.0));
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// Knots that fall, are not finite, stand more than degree + 1 times or are fewer than 2·(degree + 1); an empty domain.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, SplineError> {
        finite("knot", &knots)?;
        if let Some(at) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
            return Err(SplineError::FallingKnots { position: at + 2, value: knots[at + 1], before: knots[at] });
        }
        let count = knots.len().saturating_sub(degree + 1);
        if count < degree + 1 {
            return Err(SplineError::TooFewControls { count, degree });
        }
        let found = KnotVector { degree, knots };
        let (from, to) = found.domain();
        if from == to {
            return Err(SplineError::EmptyDomain { value: from });
        }
        match found.knots.windows(degree + 2).find(|window| window[0] == window[degree + 1]) {
            Some(window) => {
                let (value, most) = (window[0], degree + 1);
                Err(SplineError::TooManyRepeats { value, count: found.multiplicity(value), most })
            }
            None => Ok(found),
        }
    }

    /// Uniform knots for `count` control values on [from, to], clamped: the end knots stand degree + 1 times, so that the curve
    /// starts at the first control value and ends at the last.
    ///
    /// ```
    /// let knots = ribopt::splines::KnotVector::clamped_uniform(3, 5, 0.0, 1.0)?;
    /// assert_eq!(knots.knots(), [0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// `count` below degree + 1, or an interval without length.
    pub fn clamped_uniform(degree: usize, count: usize, from: f64, to: f64) -> Result<Self, SplineError> {
        let Some(spans) = count.checked_sub(degree).filter(|spans| *spans > 0) else {
            return Err(SplineError::TooFewControls { count, degree });
        };
        let inner = (1..spans).map(|k| from + (to - from) * (k as f64 / spans as f64));
        let ends = |value| std::iter::repeat_n(value, degree + 1);
        Self::new(degree, ends(from).chain(inner).chain(ends(to)).collect())
    }

    /// The degree p (the note's order less one).
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Number n of basis functions and control values.
    pub fn count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// The domain [t_p, t_n], on which the basis sums to one.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.count()])
    }

    /// How often a value stands among the knots. There the spline is C^(p−m) for multiplicity m (the note's C^(k−1−m)).
    ///
    /// ```
    /// let knots = ribopt::splines::KnotVector::new(1, vec![0.0, 0.0, 2.0, 2.0, 3.0, 3.0])?;
    /// assert_eq!((knots.multiplicity(2.0), knots.multiplicity(1.0)), (2, 0));
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    pub fn multiplicity(&self, value: f64) -> usize {
        self.knots.partition_point(|knot| *knot <= value) - self.knots.partition_point(|knot| *knot < value)
    }

    /// The index i of the knot span [t_i, t_{i+1}) that holds x, never an empty one; the right end of the domain belongs to the
    /// last span (the note's half-open 1.5.2 would make every basis function zero there).
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn span(&self, x: f64) -> Result<usize, SplineError> {
        let (from, to) = self.domain();
        if !(from <= x && x <= to) {
            return Err(SplineError::Outside { x, from, to });
        }
        let above =
            if x < to { self.knots.partition_point(|knot| *knot <= x) } else { self.knots.partition_point(|knot| *knot < to) };
        Ok(above - 1)
    }

    /// Greville abscissae, the means of p consecutive inner knots of each basis function: control values taken from a straight
    /// line there give the line. For degree 0 the middles of the spans.
    ///
    /// ```
    /// let knots = ribopt::splines::KnotVector::clamped_uniform(3, 5, 0.0, 1.0)?;
    /// let greville = knots.greville();
    /// assert_eq!(greville, [0.0, 1.0 / 6.0, 0.5, 5.0 / 6.0, 1.0]);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    pub fn greville(&self) -> Vec<f64> {
        let p = self.degree;
        let mean = |i: usize| match p {
            0 => 0.5 * (self.knots[i] + self.knots[i + 1]),
            _ => self.knots[i + 1..=i + p].iter().sum::<f64>() / p as f64,
        };
        (0..self.count()).map(mean).collect()
    }

    /// With one more knot at x.
    ///
    /// # Errors
    /// Outside the domain, or a knot already degree + 1 times there.
    pub(super) fn with(&self, x: f64) -> Result<Self, SplineError> {
        let (count, span) = (self.multiplicity(x), self.span(x)?);
        if count > self.degree {
            return Err(SplineError::FullKnot { value: x, count });
        }
        let mut knots = self.knots.clone();
        knots.insert(span + 1, x);
        Ok(KnotVector { degree: self.degree, knots })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_never_empty() {
        let knots = KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0, 3.0, 3.0]).unwrap();
        assert_eq!([0.0, 0.5, 1.0, 2.9, 3.0].map(|x| knots.span(x).unwrap()), [1, 1, 3, 3, 3]);
        assert!(matches!(knots.span(3.1), Err(SplineError::Outside { .. })));
        assert!(matches!(knots.span(f64::NAN), Err(SplineError::Outside { .. })));
    }

    #[test]
    fn bad_knots_are_named() {
        let error = |degree, knots: &[f64]| KnotVector::new(degree, knots.to_vec()).unwrap_err();
        assert_eq!(error(1, &[0.0, 0.0, 2.0, 1.0, 3.0, 3.0]), SplineError::FallingKnots { position: 4, value: 1.0, before: 2.0 });
        assert_eq!(error(3, &[0.0, 0.0, 1.0, 1.0]), SplineError::TooFewControls { count: 0, degree: 3 });
        assert_eq!(error(1, &[0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0]), SplineError::TooManyRepeats { value: 1.0, count: 3, most: 2 });
        assert_eq!(error(1, &[1.0; 4]), SplineError::EmptyDomain { value: 1.0 });
        assert!(matches!(error(0, &[0.0, f64::NAN]), SplineError::NotFinite { position: 2, .. }));
        assert!(matches!(KnotVector::clamped_uniform(3, 3, 0.0, 1.0), Err(SplineError::TooFewControls { count: 3, degree: 3 })));
        assert!(KnotVector::clamped_uniform(2, 5, 1.0, 0.0).is_err());
    }
}
