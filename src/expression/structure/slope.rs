//! Whether operations rise or fall in an operand, over the ranges of their operands.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Interval;
use crate::expression::operators::{Binary, Unary};

/// How a value changes as an operand grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slope {
    /// It never falls.
    Rising,
    /// It never rises.
    Falling,
    /// Neither is proved.
    Mixed,
}

use Slope::{Falling, Mixed, Rising};

impl Slope {
    /// Of a function followed by one that falls.
    pub fn turned(self) -> Self {
        match self {
            Rising => Falling,
            Falling => Rising,
            Mixed => Mixed,
        }
    }

    /// Rising where the factor is not negative, falling where it is not positive.
    pub fn of_factor(factor: Interval) -> Self {
        match factor {
            _ if factor.is_non_negative() => Rising,
            _ if factor.is_non_positive() => Falling,
            _ => Mixed,
        }
    }

    /// Of a function of one argument over a range that lies inside its domain.
    pub fn of_unary(op: Unary, range: Interval) -> Self {
        let by_sign = |negative: Slope, positive: Slope| match (range.is_non_negative(), range.is_non_positive()) {
            (true, _) => positive,
            (_, true) => negative,
            _ => Mixed,
        };
        let within = |lower: f64, upper: f64| range.lower >= lower && range.upper <= upper;
        match op {
            Unary::Negate => Falling,
            Unary::Exp | Unary::Atan | Unary::Sinh | Unary::Tanh | Unary::Erf => Rising,
            Unary::Sqrt | Unary::Log | Unary::Log10 if range.is_non_negative() => Rising,
            Unary::Asin if within(-1.0, 1.0) => Rising,
            Unary::Acos if within(-1.0, 1.0) => Falling,
            Unary::Abs | Unary::Cosh => by_sign(Falling, Rising),
            Unary::Tan if within(-FRAC_PI_2, FRAC_PI_2) => Rising,
            Unary::Sin if within(-FRAC_PI_2, FRAC_PI_2) => Rising,
            Unary::Cos if within(-PI, PI) => by_sign(Rising, Falling),
            // It falls as far as 1.4616… and rises from there.
            Unary::LnGamma if range.lower >= 1.47 => Rising,
            _ => Mixed,
        }
    }

    /// Of u ↦ u^p.
    pub fn of_power(base: Interval, exponent: f64) -> Self {
        let (whole, even) = (exponent.fract() == 0.0, exponent % 2.0 == 0.0);
        let positive = base.is_non_negative();
        match exponent {
            0.0 => Mixed,
            p if whole && !even && p > 0.0 => Rising,
            p if positive => Slope::of_factor(Interval::point(p)),
            p if whole && base.is_non_positive() => Slope::of_factor(Interval::point(if even { -p } else { p })),
            _ => Mixed,
        }
    }

    /// In the first operand of an operator.
    pub fn in_left(op: Binary, left: Interval, right: Interval) -> Self {
        match op {
            Binary::Add | Binary::Subtract | Binary::Min | Binary::Max => Rising,
            Binary::Multiply | Binary::Divide => Slope::of_factor(right),
            Binary::Power => match right.as_point() {
                Some(exponent) => Slope::of_power(left, exponent),
                None if left.is_non_negative() => Slope::of_factor(right),
                None => Mixed,
            },
            Binary::Atan2 => Mixed,
        }
    }

    /// In the second operand of an operator.
    pub fn in_right(op: Binary, left: Interval, right: Interval) -> Self {
        let one_sign = right.is_non_negative() || right.is_non_positive();
        match op {
            Binary::Add | Binary::Min | Binary::Max => Rising,
            Binary::Subtract => Falling,
            Binary::Multiply => Slope::of_factor(left),
            Binary::Divide if one_sign => Slope::of_factor(left.negate()),
            Binary::Power if left.lower >= 1.0 => Rising,
            Binary::Power if left.lower > 0.0 && left.upper <= 1.0 => Falling,
            Binary::Divide | Binary::Power | Binary::Atan2 => Mixed,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// −1, 0 or 1: the sign of the difference, rounding aside.
    fn keeps(slope: Slope, before: f64, after: f64) -> bool {
        let slack = 1e-12 * (before.abs() + after.abs());
        match slope {
            _ if before.is_nan() || after.is_nan() || before.is_infinite() || after.is_infinite() => true,
            Rising => after >= before - slack,
            Falling => after <= before + slack,
            Mixed => true,
        }
    }

    proptest! {
        #[test]
        fn slopes_hold(a in -4.0_f64..4.0, w in 0.0_f64..3.0, b in -4.0_f64..4.0, v in 0.0_f64..2.0, s in 0.0_f64..1.0, t in 0.0_f64..1.0, u in 0.0_f64..1.0) {
            let (x, y) = (Interval::new(a, a + w), Interval::new(b, b + v));
            let (low, high) = (a + w * s.min(t), a + w * s.max(t));
            let at = b + v * u;
            for (name, op) in Unary::NAMED {
                prop_assert!(keeps(Slope::of_unary(op, x), op.evaluate(low), op.evaluate(high)), "{name} {x:?}");
            }
            for op in [Binary::Add, Binary::Subtract, Binary::Multiply, Binary::Divide, Binary::Min, Binary::Max, Binary::Power] {
                prop_assert!(keeps(Slope::in_left(op, x, y), op.evaluate(low, at), op.evaluate(high, at)), "{op:?} {x:?} {y:?}");
                prop_assert!(keeps(Slope::in_right(op, y, x), op.evaluate(at, low), op.evaluate(at, high)), "{op:?} {y:?} {x:?}");
            }
            for p in [-2.0, -1.0, 1.0, 2.0, 3.0, 0.5, -1.5] {
                prop_assert!(keeps(Slope::of_power(x, p), Binary::Power.evaluate(low, p), Binary::Power.evaluate(high, p)), "{x:?}^{p}");
            }
        }
    }
}
