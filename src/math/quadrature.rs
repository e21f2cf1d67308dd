//! Adaptive quadrature on an interval: Gauss–Kronrod (7, 15) with global bisection, as QUADPACK's `qag`
//! (Piessens et al., QUADPACK, Springer 1983), for the norms of functions and for the note's integrals 2.5.1.

use std::collections::BinaryHeap;

/// An integral (or a norm from one).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integral {
    /// Its value.
    pub value: f64,
    /// Estimate of its absolute error, on the safe side for smooth integrands.
    pub error: f64,
    /// How often the integrand was evaluated.
    pub evaluations: usize,
}

/// Why there is no integral.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum QuadratureError {
    /// The interval is not finite, or runs backwards where that has no meaning.
    #[error("the interval from {a} to {b} cannot be integrated over; give finite ends in order")]
    Interval {
        /// Left end.
        a: f64,
        /// Right end.
        b: f64,
    },
    /// The integrand is no finite number somewhere.
    #[error("the integrand is {value} at x = {x}; split the interval there or leave the point out")]
    NoNumber {
        /// Where.
        x: f64,
        /// NaN or infinite.
        value: f64,
    },
    /// The tolerance was not reached.
    #[error("the tolerance was not reached in {} evaluations: {} ± {}; loosen it or split the interval at kinks", best.evaluations, best.value, best.error)]
    NotConverged {
        /// What was reached.
        best: Integral,
    },
}

/// Most pieces the interval is cut into.
const MAX_PIECES: usize = 5000;

/// Kronrod's nodes on [0, 1] of [−1, 1], outermost first (QUADPACK `qk15`); odd positions are Gauss's.
#[allow(clippy::excessive_precision)]
const NODES: [f64; 8] = [
    0.991_455_371_120_812_639_206_854_697_526_329,
    0.949_107_912_342_758_524_526_189_684_047_851,
    0.864_864_423_359_769_072_789_712_788_640_926,
    0.741_531_185_599_394_439_863_864_773_280_788,
    0.586_087_235_467_691_130_294_144_838_258_730,
    0.405_845_151_377_397_166_906_606_412_076_961,
    0.207_784_955_007_898_467_600_689_403_773_245,
    0.0,
];
#[allow(clippy::excessive_precision)]
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224_963_732_008_058_970,
    0.063_092_092_629_978_553_290_700_663_189_204,
    0.104_790_010_322_250_183_839_876_322_541_518,
    0.140_653_259_715_525_918_745_189_590_510_238,
    0.169_004_726_639_267_902_826_583_426_598_550,
    0.190_350_578_064_785_409_913_256_402_421_014,
    0.204_432_940_075_298_892_414_161_999_234_649,
    0.209_482_141_084_727_828_012_999_174_891_714,
];
#[allow(clippy::excessive_precision)]
const GAUSS: [f64; 4] = [
    0.129_484_966_168_869_693_270_611_432_679_082,
    0.279_705_391_489_276_667_901_467_771_423_780,
    0.381_830_050_505_118_944_950_369_775_488_975,
    0.417_959_183_673_469_387_755_102_040_816_327,
];

/// One piece of the interval; the worst comes first out of the heap.
#[derive(Clone, Copy, PartialEq)]
struct Piece {
    a: f64,
    b: f64,
    value: f64,
    /// ∫|f|: the tolerance is relative to its sum.
    magnitude: f64,
    error: f64,
}

impl Eq for Piece {}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.error.total_cmp(&other.error).then(other.a.total_cmp(&self.a))
    }
}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// ∫ f dx from a to b (b < a turns the sign), until the estimated error is at most `tolerance`·∫|f| dx.
///
/// ```
/// let integral = ribopt::math::integrate(|x| x.exp(), 0.0, 1.0, 1e-13)?;
/// assert!((integral.value - (std::f64::consts::E - 1.0)).abs() < 1e-13);
/// # Ok::<(), ribopt::math::quadrature::QuadratureError>(())
/// ```
///
/// # Errors
/// An interval that is not finite, a value of f that is not finite, or a tolerance out of reach (the best value comes along).
pub fn integrate(mut f: impl FnMut(f64) -> f64, a: f64, b: f64, tolerance: f64) -> Result<Integral, QuadratureError> {
    if !(a.is_finite() && b.is_finite() && (b - a).is_finite()) {
        return Err(QuadratureError::Interval { a, b });
    }
    let mut pieces = BinaryHeap::from([piece(&mut f, a, b)?]);
    loop {
        let best = total(&pieces);
        let size: f64 = pieces.iter().map(|piece| piece.magnitude).sum();
        if best.error <= tolerance * size {
            return Ok(best);
        }
        let Some(worst) = pieces.pop() else { return Ok(best) };
        let middle = worst.a + 0.5 * (worst.b - worst.a);
        // An error at the level of rounding will not fall any further.
        let stuck = worst.error <= 50.0 * f64::EPSILON * worst.magnitude || middle == worst.a || middle == worst.b;
        if stuck || pieces.len() + 2 > MAX_PIECES {
            return Err(QuadratureError::NotConverged { best });
        }
        pieces.push(piece(&mut f, worst.a, middle)?);
        pieces.push(piece(&mut f, middle, worst.b)?);
    }
}

fn total(pieces: &BinaryHeap<Piece>) -> Integral {
    // In one order, whatever the heap's: the same call gives the same bits.
    let mut sorted: Vec<&Piece> = pieces.iter().collect();
    sorted.sort_by(|p, q| p.a.total_cmp(&q.a));
    let (value, error) = sorted.iter().fold((0.0, 0.0), |(value, error), piece| (value + piece.value, error + piece.error));
    Integral { value, error, evaluations: 15 * (2 * pieces.len() - 1) }
}

/// One application of the pair of rules.
fn piece(f: &mut impl FnMut(f64) -> f64, a: f64, b: f64) -> Result<Piece, QuadratureError> {
    let (middle, half) = (a + 0.5 * (b - a), 0.5 * (b - a));
    let mut at = |x: f64| {
        let value = f(x);
        if value.is_finite() { Ok(value) } else { Err(QuadratureError::NoNumber { x, value }) }
    };
    let mut values = [[0.0; 2]; 8];
    for (pair, node) in values.iter_mut().zip(NODES) {
        *pair = if node == 0.0 { [at(middle)?, 0.0] } else { [at(middle - half * node)?, at(middle + half * node)?] };
    }
    let weighted = |g: &dyn Fn(f64) -> f64| -> f64 {
        let centre = KRONROD[7] * g(values[7][0]);
        values[..7].iter().zip(KRONROD).fold(centre, |sum, (pair, weight)| sum + weight * (g(pair[0]) + g(pair[1])))
    };
    let (kronrod, magnitude) = (weighted(&|y| y), weighted(&f64::abs));
    let gauss = GAUSS[3] * values[7][0] + (0..3).map(|k| GAUSS[k] * (values[2 * k + 1][0] + values[2 * k + 1][1])).sum::<f64>();
    let spread = weighted(&|y| (y - 0.5 * kronrod).abs());
    let error = estimate((kronrod - gauss).abs(), spread).max(f64::EPSILON * magnitude);
    let length = half.abs();
    Ok(Piece { a, b, value: kronrod * half, magnitude: magnitude * length, error: error * length })
}

/// QUADPACK's estimate from the difference of the rules and ∫|f − mean|.
fn estimate(difference: f64, spread: f64) -> f64 {
    if difference == 0.0 || spread == 0.0 { difference } else { spread * (200.0 * difference / spread).powf(1.5).min(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn polynomials_up_to_degree_22_are_exact(degree in 0..=22i32, a in -2.0..2.0f64, b in -2.0..2.0f64) {
            let rule = piece(&mut |x: f64| x.powi(degree), a, b).unwrap();
            let exact = (b.powi(degree + 1) - a.powi(degree + 1)) / f64::from(degree + 1);
            let size = (a.abs().max(b.abs())).powi(degree + 1) + 1e-300;
            prop_assert!((rule.value - exact).abs() <= 1e-14 * size, "{} {exact}", rule.value);
        }
    }

    #[test]
    fn difficult_integrands() {
        let kink = integrate(|x| (x - 0.3).abs(), 0.0, 1.0, 1e-10).unwrap();
        assert!((kink.value - 0.29).abs() <= 1e-10);
        let root = integrate(f64::sqrt, 0.0, 1.0, 1e-10).unwrap();
        assert!((root.value - 2.0 / 3.0).abs() <= 1e-10);
        let odd = integrate(|x| x.powi(3), -1.0, 1.0, 1e-12).unwrap();
        assert!(odd.value.abs() <= 1e-15);
        let backwards = integrate(|x| x, 1.0, 0.0, 1e-12).unwrap();
        assert!((backwards.value + 0.5).abs() <= 1e-15);
    }

    #[test]
    fn failures_say_where() {
        assert!(matches!(integrate(|x| 1.0 / x, -1.0, 1.0, 1e-8), Err(QuadratureError::NoNumber { x: 0.0, .. })));
        assert!(matches!(integrate(|x| x, 0.0, f64::INFINITY, 1e-8), Err(QuadratureError::Interval { .. })));
        let wild = integrate(|x| (1.0 / x).sin() / x, 1e-9, 1.0, 1e-12);
        assert!(matches!(wild, Err(QuadratureError::NotConverged { best }) if best.error > 0.0), "{wild:?}");
    }
}
