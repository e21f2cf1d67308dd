//! Quadratic, cubic, quartic and biquadratic polynomials, note (1.5.6) to (1.5.10): values, derivatives, all roots.

mod roots;
mod wide;

use nalgebra::Complex;

/// A polynomial with real coefficients, the highest power first, as the note writes them: `a·x³ + b·x² + c·x + d`.
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial {
    coefficients: Vec<f64>,
}

/// Why a polynomial or its roots cannot be had.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PolynomialError {
    /// No coefficients at all.
    #[error("a polynomial needs at least one coefficient")]
    Empty,
    /// A coefficient is NaN or infinite.
    #[error("coefficient {position} is {value}; coefficients must be finite")]
    NotFinite {
        /// Counted from 1, the highest power first.
        position: usize,
        /// What stands there.
        value: f64,
    },
    /// The leading coefficient is zero: the degree is lower than said.
    #[error("the leading coefficient is zero, so this is not of degree {degree}; leave the coefficient out")]
    LeadingZero {
        /// The degree it would have.
        degree: usize,
    },
    /// Degrees beyond what the roots are meant for.
    #[error("roots are found up to degree {limit}, not {degree}")]
    DegreeTooHigh {
        /// The polynomial's.
        degree: usize,
        /// The largest.
        limit: usize,
    },
    /// The iteration did not settle.
    #[error("the roots did not settle in {iterations} iterations")]
    NotConverged {
        /// How many were made.
        iterations: usize,
    },
}

impl Polynomial {
    /// From its coefficients, the highest power first.
    ///
    /// ```
    /// use ribopt::math::Polynomial;
    /// let p = Polynomial::new(&[2.0, 0.0, -3.0])?;
    /// assert_eq!(p.evaluate(2.0), 5.0);
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    ///
    /// # Errors
    /// No coefficients, one that is not finite, or a leading zero.
    pub fn new(coefficients: &[f64]) -> Result<Self, PolynomialError> {
        let Some(leading) = coefficients.first() else { return Err(PolynomialError::Empty) };
        if let Some(at) = coefficients.iter().position(|value| !value.is_finite()) {
            return Err(PolynomialError::NotFinite { position: at + 1, value: coefficients[at] });
        }
        if *leading == 0.0 && coefficients.len() > 1 {
            return Err(PolynomialError::LeadingZero { degree: coefficients.len() - 1 });
        }
        Ok(Polynomial { coefficients: coefficients.to_vec() })
    }

    /// `a·x² + b·x + c`, a ≠ 0.
    ///
    /// # Errors
    /// As [`Polynomial::new`].
    pub fn quadratic(a: f64, b: f64, c: f64) -> Result<Self, PolynomialError> {
        Self::new(&[a, b, c])
    }

    /// `a·x³ + b·x² + c·x + d`, a ≠ 0, note (1.5.9).
    ///
    /// ```
    /// use ribopt::math::Polynomial;
    /// let roots = Polynomial::cubic(1.0, -6.0, 11.0, -6.0)?.real_roots()?;
    /// assert_eq!(roots, [1.0, 2.0, 3.0]);
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Polynomial::new`].
    pub fn cubic(a: f64, b: f64, c: f64, d: f64) -> Result<Self, PolynomialError> {
        Self::new(&[a, b, c, d])
    }

    /// `a·x⁴ + b·x³ + c·x² + d·x + e`, a ≠ 0, note (1.5.6).
    ///
    /// ```
    /// use ribopt::math::Polynomial;
    /// // (3x − 1)⁴: a root of multiplicity four, to the last bit.
    /// let roots = Polynomial::quartic(81.0, -108.0, 54.0, -12.0, 1.0)?.real_roots()?;
    /// assert_eq!(roots, [1.0 / 3.0; 4]);
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Polynomial::new`].
    pub fn quartic(a: f64, b: f64, c: f64, d: f64, e: f64) -> Result<Self, PolynomialError> {
        Self::new(&[a, b, c, d, e])
    }

    /// `a·x⁴ + c·x² + e`, a ≠ 0, note (1.5.7), where "biquartic" is printed for *biquadratic*.
    ///
    /// ```
    /// use ribopt::math::Polynomial;
    /// let roots = Polynomial::biquadratic(1.0, -5.0, 4.0)?.real_roots()?;
    /// assert_eq!(roots, [-2.0, -1.0, 1.0, 2.0]);
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Polynomial::new`].
    pub fn biquadratic(a: f64, c: f64, e: f64) -> Result<Self, PolynomialError> {
        Self::new(&[a, 0.0, c, 0.0, e])
    }

    /// The coefficients, the highest power first.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The degree; 0 for a constant.
    pub fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    /// Its value at x, by Horner's rule.
    pub fn evaluate(&self, x: f64) -> f64 {
        self.coefficients.iter().fold(0.0, |sum, coefficient| sum.mul_add(x, *coefficient))
    }

    /// Its value at a complex z, by Horner's rule.
    pub fn evaluate_complex(&self, z: Complex<f64>) -> Complex<f64> {
        self.coefficients.iter().fold(Complex::new(0.0, 0.0), |sum, coefficient| sum * z + coefficient)
    }

    /// The derivative, a polynomial again.
    ///
    /// ```
    /// use ribopt::math::Polynomial;
    /// let p = Polynomial::cubic(1.0, 2.0, 3.0, 4.0)?;
    /// assert_eq!(p.derivative().coefficients(), [3.0, 4.0, 3.0]);
    /// assert_eq!(p.derivative().derivative().evaluate(1.0), 10.0);
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    pub fn derivative(&self) -> Polynomial {
        let degree = self.degree();
        if degree == 0 {
            return Polynomial { coefficients: vec![0.0] };
        }
        let terms = self.coefficients[..degree].iter().enumerate();
        Polynomial { coefficients: terms.map(|(at, coefficient)| coefficient * (degree - at) as f64).collect() }
    }
}

#[cfg(test)]
mod tests;
