//! The superellipse |x/a|^r + |y/b|^r = 1, note 2.2.

use crate::math::special::{digamma, ln_gamma};

/// A superellipse of semi-axes a and b and exponent r, centred at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superellipse {
    a: f64,
    b: f64,
    r: f64,
}

/// The note's table of special cases: exponent and curve.
pub const SPECIAL_CASES: [(f64, &str); 5] = [
    (2.0 / 3.0, "(squashed) astroid"),
    (1.0, "(squashed) diamond"),
    (2.0, "ellipse"),
    (2.5, "Piet Hein's superellipse"),
    (4.0, "rectellipse"),
];

/// A semi-axis, the exponent or a tolerance is not positive and finite.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{what} is {value}; it must be positive and finite")]
pub struct NotPositive {
    /// `a`, `b`, `r` or `tolerance`.
    pub what: &'static str,
    /// Its value.
    pub value: f64,
}

/// Deepest halving of one quadrant by [`Superellipse::polygon`]: 2¹⁴ pieces.
const MAX_DEPTH: usize = 14;

impl Superellipse {
    /// From semi-axes and exponent.
    ///
    /// The note's equation (2.2.1) leaves out the absolute values, without which it describes one quadrant only.
    ///
    /// # Errors
    /// [`NotPositive`].
    pub fn new(a: f64, b: f64, r: f64) -> Result<Self, NotPositive> {
        for (what, value) in [("a", a), ("b", b), ("r", r)] {
            positive(what, value)?;
        }
        Ok(Superellipse { a, b, r })
    }

    /// The curve at parameter t in [0, 2π], all four quadrants:
    /// x = a·sgn(cos t)·|cos t|^(2/r), y = b·sgn(sin t)·|sin t|^(2/r) (the note prints the first quadrant's form).
    ///
    /// ```
    /// let squircle = ribopt::geometry::Superellipse::new(1.0, 1.0, 4.0)?;
    /// let [x, y] = squircle.point(0.75 * std::f64::consts::PI);
    /// assert!((x + 0.5f64.powf(0.25)).abs() < 1e-15 && (y - 0.5f64.powf(0.25)).abs() < 1e-15);
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    pub fn point(&self, t: f64) -> [f64; 2] {
        let (sin, cos) = t.sin_cos();
        let bend = |value: f64| value.abs().powf(2.0 / self.r).copysign(value);
        [self.a * bend(cos), self.b * bend(sin)]
    }

    /// Area, note (2.2.2), which equals 4ab·Γ(1+1/r)²/Γ(1+2/r).
    ///
    /// ```
    /// use ribopt::geometry::Superellipse;
    /// let ellipse = Superellipse::new(3.0, 2.0, 2.0)?;
    /// assert!((ellipse.area() - 6.0 * std::f64::consts::PI).abs() < 1e-13);
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    pub fn area(&self) -> f64 {
        let s = 1.0 / self.r;
        4.0 * self.a * self.b * (2.0 * ln_gamma(1.0 + s) - ln_gamma(1.0 + 2.0 * s)).exp()
    }

    /// Ix = ∫y² dA = 4ab³·Γ(1/r)Γ(3/r)/(r²Γ(1+4/r)), written with Γ(1+1/r) and Γ(1+3/r)/3 so that large r keep their digits.
    ///
    /// ```
    /// use ribopt::geometry::Superellipse;
    /// let ellipse = Superellipse::new(3.0, 2.0, 2.0)?;
    /// assert!((ellipse.ix() - std::f64::consts::PI * 3.0 * 8.0 / 4.0).abs() < 1e-13);
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    pub fn ix(&self) -> f64 {
        self.a * self.b.powi(3) * self.moment_factor()
    }

    /// Iy = ∫x² dA: Ix with a and b exchanged. Ixy is zero.
    pub fn iy(&self) -> f64 {
        self.b * self.a.powi(3) * self.moment_factor()
    }

    fn moment_factor(&self) -> f64 {
        let s = 1.0 / self.r;
        4.0 / 3.0 * (ln_gamma(1.0 + s) + ln_gamma(1.0 + 3.0 * s) - ln_gamma(1.0 + 4.0 * s)).exp()
    }

    /// ∂A/∂(a, b, r), with d ln A/dr = (2/r²)[ψ(1+2/r) − ψ(1+1/r)].
    ///
    /// ```
    /// let [da, db, dr] = ribopt::geometry::Superellipse::new(1.0, 2.0, 2.0)?.area_gradient();
    /// assert!((da - 2.0 * std::f64::consts::PI).abs() < 1e-13 && (db - std::f64::consts::PI).abs() < 1e-13 && dr > 0.0);
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    pub fn area_gradient(&self) -> [f64; 3] {
        let (area, s) = (self.area(), 1.0 / self.r);
        [area / self.a, area / self.b, area * 2.0 * s * s * (digamma(1.0 + 2.0 * s) - digamma(1.0 + s))]
    }

    /// ∂Ix/∂(a, b, r), with d ln Ix/dr = −2/r + [4ψ(1+4/r) − ψ(1/r) − 3ψ(3/r)]/r².
    pub fn ix_gradient(&self) -> [f64; 3] {
        let ix = self.ix();
        [ix / self.a, 3.0 * ix / self.b, ix * self.moment_slope()]
    }

    /// ∂Iy/∂(a, b, r).
    pub fn iy_gradient(&self) -> [f64; 3] {
        let iy = self.iy();
        [3.0 * iy / self.a, iy / self.b, iy * self.moment_slope()]
    }

    /// d ln Ix/dr, by ψ(x) = ψ(1+x) − 1/x, which takes the −2/r away.
    fn moment_slope(&self) -> f64 {
        let s = 1.0 / self.r;
        s * s * (4.0 * digamma(1.0 + 4.0 * s) - digamma(1.0 + s) - 3.0 * digamma(1.0 + 3.0 * s))
    }

    /// The curve's name in the note's table [`SPECIAL_CASES`]; with a = b and r = 4, "squircle".
    ///
    /// ```
    /// use ribopt::geometry::Superellipse;
    /// assert_eq!(Superellipse::new(6.0, 5.0, 2.5)?.name(), Some("Piet Hein's superellipse"));
    /// assert_eq!(Superellipse::new(1.0, 1.0, 4.0)?.name(), Some("squircle"));
    /// assert_eq!(Superellipse::new(1.0, 1.0, 3.0)?.name(), None);
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    pub fn name(&self) -> Option<&'static str> {
        if self.r == 4.0 && self.a == self.b {
            return Some("squircle");
        }
        SPECIAL_CASES.iter().find(|(r, _)| (self.r - r).abs() <= 1e-12).map(|(_, name)| *name)
    }

    /// A polygon with vertices on the curve, anticlockwise from (a, 0), nowhere further from it than `tolerance`
    /// (or 4·2¹⁴ points, whichever comes first).
    ///
    /// ```
    /// let circle = ribopt::geometry::Superellipse::new(1.0, 1.0, 2.0)?;
    /// assert_eq!(circle.polygon(0.1)?.len(), 8);
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    ///
    /// # Errors
    /// A tolerance that is not positive and finite.
    pub fn polygon(&self, tolerance: f64) -> Result<Vec<[f64; 2]>, NotPositive> {
        positive("tolerance", tolerance)?;
        let (east, north) = ([self.a, 0.0], [0.0, self.b]);
        let mut quadrant = vec![east];
        self.subdivide(east, north, tolerance, MAX_DEPTH, &mut quadrant);
        // The quadrant from (a, 0) up to, not including, (0, b); the others by mirroring.
        let first = quadrant.iter().copied();
        let second = std::iter::once(north).chain(quadrant[1..].iter().rev().copied()).map(|[x, y]| [-x, y]);
        let upper: Vec<[f64; 2]> = first.chain(second).map(|[x, y]| [x + 0.0, y]).collect();
        let lower = upper.iter().map(|[x, y]| [0.0 - x, 0.0 - y]);
        Ok(upper.iter().copied().chain(lower).collect())
    }

    /// A polygon of `4 · quarter` vertices, anticlockwise from the x axis, of exactly the curve's area. Their number does not
    /// depend on the shape, and for one r the coordinates are proportional to a and b: two such polygons can be joined point
    /// by point. Vertices at equal steps of the parameter, moved outwards by a common factor; 64 vertices lie within 0.1 % of a
    /// circle's radius.
    ///
    /// ```
    /// let ring = ribopt::geometry::Superellipse::new(2.0, 1.0, 2.0)?.polygon_of_equal_area(16);
    /// assert_eq!(ring.len(), 64);
    /// assert!(ring.iter().all(|[x, y]| ((x / 2.0).hypot(*y) - 1.0).abs() < 1e-3));
    /// # Ok::<(), ribopt::geometry::superellipse::NotPositive>(())
    /// ```
    pub fn polygon_of_equal_area(&self, quarter: usize) -> Vec<[f64; 2]> {
        let quarter = quarter.max(1);
        let point = |k: usize| {
            let (quadrant, step) = (k / quarter, k % quarter);
            let (sin, cos) = (std::f64::consts::FRAC_PI_2 * step as f64 / quarter as f64).sin_cos();
            let [near, far] = [cos, sin].map(|share| share.powf(2.0 / self.r));
            let [x, y] = [[near, far], [-far, near], [-near, -far], [far, -near]][quadrant % 4];
            [self.a * x, self.b * y]
        };
        let mut ring: Vec<[f64; 2]> = (0..4 * quarter).map(point).collect();
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        let area = pairs.map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f64>() / 2.0;
        let factor = (self.area() / area).sqrt();
        ring.iter_mut().flatten().for_each(|coordinate| *coordinate *= factor);
        ring
    }

    /// Points between `from` and `to` on one quadrant: the one furthest from the chord halves the arc.
    fn subdivide(&self, from: [f64; 2], to: [f64; 2], tolerance: f64, depth: usize, points: &mut Vec<[f64; 2]>) {
        let normal = [to[1] - from[1], from[0] - to[0]];
        let Some(middle) = self.furthest(normal).filter(|_| depth > 0) else { return };
        let along = normal[0] * (middle[0] - from[0]) + normal[1] * (middle[1] - from[1]);
        if along.abs() <= tolerance * normal[0].hypot(normal[1]) {
            return;
        }
        self.subdivide(from, middle, tolerance, depth - 1, points);
        points.push(middle);
        self.subdivide(middle, to, tolerance, depth - 1, points);
    }

    /// The point of the first quadrant whose normal is parallel to this one, both parts positive; none on a diamond's straight edge.
    fn furthest(&self, [across, up]: [f64; 2]) -> Option<[f64; 2]> {
        if self.r == 1.0 || !(across > 0.0 && up > 0.0) {
            return None;
        }
        // (x/a)^(r−1)/a : (y/b)^(r−1)/b = across : up, in logarithms.
        let ratio = ((self.a * across).ln() - (self.b * up).ln()) / (self.r - 1.0);
        let share = |ratio: f64| (-(-self.r * ratio).exp().ln_1p() / self.r).exp();
        Some([self.a * share(ratio), self.b * share(-ratio)])
    }
}

fn positive(what: &'static str, value: f64) -> Result<(), NotPositive> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(NotPositive { what, value }) }
}

#[cfg(test)]
#[path = "superellipse_tests.rs"]
mod tests;
