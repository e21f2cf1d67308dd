//! Interval arithmetic with outward rounding: the result holds every value the operation takes where it is defined.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::expression::operators::{Binary, Unary};
use crate::math::special;

/// Just above π and π/2, as the nearest numbers lie below.
const HALF_TURN: f64 = PI.next_up();
const QUARTER_TURN: f64 = FRAC_PI_2.next_up();

/// `lower ≤ value ≤ upper`; the ends may be infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs)]
pub struct Interval {
    pub lower: f64,
    pub upper: f64,
}

impl Interval {
    /// Nothing known.
    pub const WHOLE: Interval = Interval { lower: f64::NEG_INFINITY, upper: f64::INFINITY };
    const NON_NEGATIVE: Interval = Interval { lower: 0.0, upper: f64::INFINITY };

    /// From bounds; what is no interval becomes [`Interval::WHOLE`].
    pub fn new(lower: f64, upper: f64) -> Self {
        if lower <= upper { Interval { lower, upper } } else { Interval::WHOLE }
    }

    /// One number.
    pub fn point(value: f64) -> Self {
        Interval::new(value, value)
    }

    /// The number, where it is only one.
    pub fn as_point(self) -> Option<f64> {
        (self.lower == self.upper && self.lower.is_finite()).then_some(self.lower)
    }

    /// No value is negative.
    pub fn is_non_negative(self) -> bool {
        self.lower >= 0.0
    }

    /// No value is positive.
    pub fn is_non_positive(self) -> bool {
        self.upper <= 0.0
    }

    pub(crate) fn add(self, other: Self) -> Self {
        Interval::new(down(sum(self.lower, other.lower)), up(sum(self.upper, other.upper)))
    }

    pub(crate) fn negate(self) -> Self {
        Interval { lower: -self.upper, upper: -self.lower }
    }

    pub(crate) fn subtract(self, other: Self) -> Self {
        self.add(other.negate())
    }

    pub(crate) fn multiply(self, other: Self) -> Self {
        let ends = [
            product(self.lower, other.lower),
            product(self.lower, other.upper),
            product(self.upper, other.lower),
            product(self.upper, other.upper),
        ];
        let result = hull(&ends);
        let same_sign = self.is_non_negative() && other.is_non_negative() || self.is_non_positive() && other.is_non_positive();
        if same_sign { Interval { lower: result.lower.max(0.0), ..result } } else { result }
    }

    pub(crate) fn divide(self, other: Self) -> Self {
        if other.lower < 0.0 && other.upper > 0.0 || other == Interval::point(0.0) {
            return Interval::WHOLE;
        }
        self.multiply(other.reciprocal())
    }

    /// Of an interval that has zero at one end at the most.
    fn reciprocal(self) -> Self {
        let negative = self.upper <= 0.0;
        let Interval { lower, upper } = if negative { self.negate() } else { self };
        let inverse = Interval {
            lower: down(quotient(1.0, upper)).max(0.0),
            upper: if lower == 0.0 { f64::INFINITY } else { up(quotient(1.0, lower)) },
        };
        if negative { inverse.negate() } else { inverse }
    }

    /// The smallest interval around both.
    pub fn union(self, other: Self) -> Self {
        Interval::new(self.lower.min(other.lower), self.upper.max(other.upper))
    }

    fn minimum(self, other: Self) -> Self {
        Interval { lower: self.lower.min(other.lower), upper: self.upper.min(other.upper) }
    }

    /// Where all values below zero are outside the domain.
    fn clamped(self) -> Self {
        Interval { lower: self.lower.max(0.0), upper: self.upper.max(0.0) }
    }

    /// Widened by more than a library function's error.
    fn widened(self) -> Self {
        let widen = |value: f64, step: fn(f64) -> f64| (0..4).fold(value, |value, _| step(value));
        Interval::new(widen(self.lower, f64::next_down), widen(self.upper, f64::next_up))
    }

    fn increasing(self, f: impl Fn(f64) -> f64) -> Self {
        Interval::new(f(self.lower), f(self.upper)).widened()
    }

    fn magnitude(self) -> Self {
        match (self.is_non_negative(), self.is_non_positive()) {
            (true, _) => self,
            (_, true) => self.negate(),
            _ => Interval { lower: 0.0, upper: self.upper.max(-self.lower) },
        }
    }

    /// `self ^ exponent`
    pub(crate) fn power(self, exponent: f64) -> Self {
        let whole = exponent.fract() == 0.0;
        let even = exponent % 2.0 == 0.0;
        let base = if !whole {
            self.clamped()
        } else if even {
            self.magnitude()
        } else {
            self
        };
        if exponent < 0.0 {
            return Interval::point(1.0).divide(base.power(-exponent));
        }
        let raised = if exponent == 2.0 {
            Interval { lower: down(product(base.lower, base.lower)), upper: up(product(base.upper, base.upper)) }
        } else if exponent == 0.0 || exponent == 1.0 {
            return if exponent == 0.0 { Interval::point(1.0) } else { base };
        } else {
            base.increasing_power(exponent)
        };
        if base.is_non_negative() { raised.clamped() } else { raised }
    }

    /// `powi` may err by an ulp per multiplication; `powf` by less.
    fn increasing_power(self, exponent: f64) -> Self {
        let raise = |value| Binary::Power.evaluate(value, exponent);
        let slack = 4.0 * f64::EPSILON * exponent.abs().max(1.0);
        let widen = |value: f64, sign: f64| value + sign * slack * value.abs();
        let (lower, upper) = (widen(raise(self.lower), -1.0), widen(raise(self.upper), 1.0));
        Interval::new(lower.next_down(), upper.next_up())
    }

    /// The values of a function.
    pub(crate) fn unary(self, op: Unary) -> Self {
        match op {
            Unary::Negate => self.negate(),
            Unary::Abs => self.magnitude(),
            Unary::Sqrt => self.clamped().increasing(f64::sqrt).clamped(),
            Unary::Exp => self.increasing(f64::exp).clamped(),
            Unary::Log => self.clamped().increasing(f64::ln),
            Unary::Log10 => self.clamped().increasing(f64::log10),
            Unary::Sin | Unary::Cos => Interval { lower: -1.0, upper: 1.0 },
            Unary::Tan if self.lower >= 0.0 && self.upper <= FRAC_PI_2 => self.increasing(f64::tan).clamped(),
            Unary::Tan => Interval::WHOLE,
            Unary::Asin if self.is_non_negative() => Interval { lower: 0.0, upper: QUARTER_TURN },
            Unary::Asin => Interval { lower: -QUARTER_TURN, upper: QUARTER_TURN },
            Unary::Acos => Interval { lower: 0.0, upper: HALF_TURN },
            Unary::Atan => self.increasing(f64::atan).keep_sign(self),
            Unary::Sinh => self.increasing(f64::sinh).keep_sign(self),
            Unary::Cosh => Interval { lower: 1.0, ..self.magnitude().increasing(f64::cosh) },
            Unary::Tanh => self.increasing(f64::tanh).keep_sign(self),
            Unary::Erf => self.increasing(special::erf).keep_sign(self),
            // Its minimum is −0.1215.
            Unary::LnGamma => Interval { lower: -0.122, upper: f64::INFINITY },
        }
    }

    /// For functions with the sign of their argument.
    fn keep_sign(self, argument: Self) -> Self {
        if argument.is_non_negative() { self.clamped() } else { self }
    }

    /// The values of an operator.
    pub(crate) fn binary(self, op: Binary, other: Self) -> Self {
        match op {
            Binary::Add => self.add(other),
            Binary::Subtract => self.subtract(other),
            Binary::Multiply => self.multiply(other),
            Binary::Divide => self.divide(other),
            Binary::Power => match other.as_point() {
                Some(exponent) => self.power(exponent),
                None if self.is_non_negative() => Interval::NON_NEGATIVE,
                None => Interval::WHOLE,
            },
            Binary::Atan2 => Interval { lower: -HALF_TURN, upper: HALF_TURN },
            Binary::Min => self.minimum(other),
            Binary::Max => self.negate().minimum(other.negate()).negate(),
        }
    }
}

/// A rounded result and whether it is exact.
type Rounded = (f64, bool);

fn down((value, exact): Rounded) -> f64 {
    if exact {
        value
    } else if value.is_nan() {
        f64::NEG_INFINITY
    } else {
        value.next_down()
    }
}

fn up((value, exact): Rounded) -> f64 {
    if exact {
        value
    } else if value.is_nan() {
        f64::INFINITY
    } else {
        value.next_up()
    }
}

/// Knuth's two-sum tells whether a sum is exact.
fn sum(a: f64, b: f64) -> Rounded {
    let s = a + b;
    let part = s - a;
    let error = (a - (s - part)) + (b - part);
    (s, error == 0.0 || a.is_infinite() || b.is_infinite())
}

/// A fused multiply-add tells whether a product is exact, unless it is tiny. Zero times infinity is zero here.
fn product(a: f64, b: f64) -> Rounded {
    if a == 0.0 || b == 0.0 {
        return (0.0, true);
    }
    let p = a * b;
    (p, a.is_infinite() || b.is_infinite() || p.abs() > 1e-280 && a.mul_add(b, -p) == 0.0)
}

fn quotient(a: f64, b: f64) -> Rounded {
    let q = a / b;
    (q, b.is_infinite() || q.abs() > 1e-280 && q.mul_add(-b, a) == 0.0)
}

fn hull(values: &[Rounded; 4]) -> Interval {
    let lower = values.iter().map(|&value| down(value)).fold(f64::INFINITY, f64::min);
    let upper = values.iter().map(|&value| up(value)).fold(f64::NEG_INFINITY, f64::max);
    Interval::new(lower, upper)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn exact_ends_stay_exact() {
        let x = Interval::new(0.5, 2.0);
        assert_eq!(x.subtract(Interval::point(0.5)), Interval::new(0.0, 1.5));
        assert_eq!(x.multiply(x), Interval::new(0.25, 4.0));
        assert_eq!(Interval::new(-1.0, 3.0).power(2.0), Interval::new(0.0, 9.0));
        assert_eq!(Interval::new(0.0, 4.0).power(-1.0), Interval::new(0.25, f64::INFINITY));
        assert_eq!(Interval::new(-1.0, 1.0).divide(Interval::new(-1.0, 1.0)), Interval::WHOLE);
        assert!(Interval::point(0.1).add(Interval::point(0.2)).lower < 0.1 + 0.2);
    }

    proptest! {
        #[test]
        fn holds_every_value(a in -5.0_f64..5.0, width in 0.0_f64..3.0, b in -5.0_f64..5.0, at in 0.0_f64..1.0, exponent in -4_i32..5) {
            let (x, y) = (Interval::new(a, a + width), Interval::new(b, b + width));
            let (px, py) = ((a + at * width).clamp(x.lower, x.upper), (b + at * width).clamp(y.lower, y.upper));
            let holds = |interval: Interval, value: f64| value.is_nan() || interval.lower <= value && value <= interval.upper;
            for op in [Binary::Add, Binary::Subtract, Binary::Multiply, Binary::Divide, Binary::Min, Binary::Max, Binary::Atan2, Binary::Power] {
                prop_assert!(holds(x.binary(op, y), op.evaluate(px, py)), "{op:?} {x:?} {y:?}");
            }
            for (name, op) in Unary::NAMED {
                prop_assert!(holds(x.unary(op), op.evaluate(px)), "{name} {x:?}");
            }
            for exponent in [f64::from(exponent), f64::from(exponent) + 0.5] {
                prop_assert!(holds(x.power(exponent), Binary::Power.evaluate(px, exponent)), "{x:?}^{exponent}");
            }
        }
    }
}
