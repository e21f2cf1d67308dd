//! All roots at once by the Ehrlich–Aberth iteration (Aberth, *Math. Comp.* 27, 1973), started on Bini's circles
//! (*Numer. Algorithms* 13, 1996).
//!
//! The iteration runs in about a hundred bits per degree. Double precision would lose three quarters of the digits of a
//! fourfold root; here every root of the polynomial *as given* comes out right to double precision, clusters included.

use nalgebra::Complex;

use super::wide::{Wide, WideComplex, power_of_two, wide};
use super::{Polynomial, PolynomialError};

/// Highest degree whose roots are found.
const MAX_DEGREE: usize = 32;
/// Corrections below 2^−SETTLED of the root end the iteration.
const SETTLED: isize = 76;
/// Parts below 2^−NEGLIGIBLE of the root are zero: the root is real, or purely imaginary.
const NEGLIGIBLE: isize = 70;

impl Polynomial {
    /// All roots, each as often as its multiplicity, sorted by real and then by imaginary part. Complex ones come in
    /// conjugate pairs; a real root has the imaginary part 0 exactly.
    ///
    /// ```
    /// use nalgebra::Complex;
    /// use ribopt::math::Polynomial;
    /// let roots = Polynomial::cubic(1.0, -1.0, 1.0, -1.0)?.roots()?;
    /// assert_eq!(roots, [Complex::new(0.0, -1.0), Complex::new(0.0, 1.0), Complex::new(1.0, 0.0)]);
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    ///
    /// # Errors
    /// A degree above 32, or an iteration that does not settle.
    pub fn roots(&self) -> Result<Vec<Complex<f64>>, PolynomialError> {
        let degree = self.degree();
        if degree > MAX_DEGREE {
            return Err(PolynomialError::DegreeTooHigh { degree, limit: MAX_DEGREE });
        }
        // Roots at zero are split off exactly.
        let trailing = self.coefficients().iter().rev().take_while(|coefficient| **coefficient == 0.0).count();
        let zeros = trailing.min(degree);
        let mut roots = vec![Complex::new(0.0, 0.0); zeros];
        roots.extend(Iteration::new(&self.coefficients()[..=degree - zeros]).run()?.iter().map(rounded));
        // Conjugates agree to the last bit already, so that this order is one of pairs.
        roots.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
        Ok(roots)
    }

    /// The real roots in rising order, each as often as its multiplicity.
    ///
    /// ```
    /// use ribopt::math::Polynomial;
    /// assert_eq!(Polynomial::quadratic(1.0, -2.0, 1.0)?.real_roots()?, [1.0, 1.0]);
    /// assert!(Polynomial::quadratic(1.0, 0.0, 1.0)?.real_roots()?.is_empty());
    /// # Ok::<(), ribopt::math::polynomial::PolynomialError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Polynomial::roots`].
    pub fn real_roots(&self) -> Result<Vec<f64>, PolynomialError> {
        Ok(self.roots()?.iter().filter(|root| root.im == 0.0).map(|root| root.re).collect())
    }
}

struct Iteration {
    bits: usize,
    /// Highest power first; first and last are not zero.
    coefficients: Vec<Wide>,
    roots: Vec<WideComplex>,
}

impl Iteration {
    fn new(coefficients: &[f64]) -> Self {
        let degree = coefficients.len() - 1;
        let bits = 96 * degree + 64;
        let roots = starting_circles(coefficients, bits);
        Iteration { bits, coefficients: coefficients.iter().map(|value| wide(*value, bits)).collect(), roots }
    }

    fn run(mut self) -> Result<Vec<WideComplex>, PolynomialError> {
        let limit = 200 * (self.roots.len() + 1);
        let mut settled = vec![false; self.roots.len()];
        for _ in 0..limit {
            for (k, done) in settled.iter_mut().enumerate().filter(|(_, done)| !**done) {
                *done = self.improve(k);
            }
            if settled.iter().all(|done| *done) {
                return Ok(self.roots);
            }
        }
        Err(PolynomialError::NotConverged { iterations: limit })
    }

    /// One correction of root k: w = N/(1 − N·Σ 1/(z − z_j)) with Newton's N = p/p'. True once it is negligible.
    fn improve(&mut self, k: usize) -> bool {
        let z = &self.roots[k];
        let (value, slope) = self.value_and_slope(z);
        if value.square() == Wide::ZERO {
            return true;
        }
        let others = self.roots.iter().enumerate().filter(|(j, _)| *j != k);
        let one = WideComplex { re: wide(1.0, self.bits), im: wide(0.0, self.bits) };
        let mut repulsion = WideComplex { re: wide(0.0, self.bits), im: wide(0.0, self.bits) };
        // Two iterates on one spot do not push one another: the next step parts them, or they are one root.
        for (_, other) in others {
            if let Some(push) = one.divide(&z.subtract(other)) {
                repulsion = repulsion.add(&push);
            }
        }
        let divisor = slope.subtract(&value.multiply(&repulsion));
        let Some(step) = value.divide(&divisor) else { return false };
        let next = z.subtract(&step);
        let settled = step.square() <= next.square() * power_of_two(-2 * SETTLED, self.bits);
        self.roots[k] = next;
        settled
    }

    /// p and p' by Horner's rule.
    fn value_and_slope(&self, z: &WideComplex) -> (WideComplex, WideComplex) {
        let zero = || WideComplex { re: wide(0.0, self.bits), im: wide(0.0, self.bits) };
        self.coefficients.iter().fold((zero(), zero()), |(value, slope), coefficient| {
            (value.multiply(z).add_real(coefficient), slope.multiply(z).add(&value))
        })
    }
}

/// Starting points on circles whose radii are the slopes of the Newton polygon of log2|coefficients|.
fn starting_circles(coefficients: &[f64], bits: usize) -> Vec<WideComplex> {
    let degree = coefficients.len() - 1;
    // Height of the power i.
    let height = |i: usize| coefficients[degree - i].abs().log2();
    let mut roots = Vec::with_capacity(degree);
    let mut i = 0;
    while i < degree {
        let slope = |j: usize| (height(j) - height(i)) / (j - i) as f64;
        let next = (i + 1..=degree).fold(i + 1, |best, j| if slope(j) >= slope(best) { j } else { best });
        let radius = -slope(next);
        let scale = power_of_two(radius.floor() as isize, bits) * wide(radius.fract().rem_euclid(1.0).exp2(), bits);
        for k in 0..next - i {
            let angle = std::f64::consts::TAU * k as f64 / (next - i) as f64 + 0.7 + i as f64;
            roots.push(WideComplex { re: wide(angle.cos(), bits) * &scale, im: wide(angle.sin(), bits) * &scale });
        }
        i = next;
    }
    roots
}

/// To double precision, negligible parts dropped.
fn rounded(root: &WideComplex) -> Complex<f64> {
    let negligible = |part: &Wide| part * part <= root.square() * power_of_two(-2 * NEGLIGIBLE, part.precision().max(64));
    let part = |part: &Wide| if negligible(part) { 0.0 } else { part.to_f64().value() };
    Complex::new(part(&root.re), part(&root.im))
}
