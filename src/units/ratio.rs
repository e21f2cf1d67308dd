//! Exact fractions: exponents of dimensions.

/// A fraction in lowest terms, its denominator positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ratio {
    top: i64,
    bottom: i64,
}

/// The largest denominator an exponent is read with: 2/3, 0.475, but no irrational number.
const LARGEST_DENOMINATOR: i64 = 1000;

impl Ratio {
    /// 0.
    pub const ZERO: Ratio = Ratio { top: 0, bottom: 1 };
    /// 1.
    pub const ONE: Ratio = Ratio { top: 1, bottom: 1 };

    /// A whole number.
    pub const fn whole(value: i64) -> Ratio {
        Ratio { top: value, bottom: 1 }
    }

    /// The fraction; `None` where it does not fit, or has no value.
    pub fn new(top: i128, bottom: i128) -> Option<Ratio> {
        if bottom == 0 {
            return None;
        }
        let common = gcd(top.unsigned_abs(), bottom.unsigned_abs()) as i128 * bottom.signum();
        Some(Ratio { top: (top / common).try_into().ok()?, bottom: (bottom / common).try_into().ok()? })
    }

    /// The fraction of small denominator that a number is meant for, up to its last digits.
    ///
    /// ```
    /// use ribopt::units::Ratio;
    /// assert_eq!(Ratio::of(2.0 / 3.0), Ratio::new(2, 3));
    /// assert_eq!(Ratio::of(std::f64::consts::PI), None);
    /// ```
    pub fn of(value: f64) -> Option<Ratio> {
        (1..=LARGEST_DENOMINATOR).find_map(|bottom| {
            let top = (value * bottom as f64).round();
            // Two roundings: of the number itself and of the product.
            let meant = (top / bottom as f64 - value).abs() <= 2.0 * f64::EPSILON * value.abs();
            if meant && top.abs() < 1e9 { Ratio::new(top as i128, bottom.into()) } else { None }
        })
    }

    /// Whether it is 0.
    pub fn is_zero(self) -> bool {
        self.top == 0
    }

    /// Numerator and denominator.
    pub fn parts(self) -> (i64, i64) {
        (self.top, self.bottom)
    }

    /// The sum; `None` where it does not fit.
    pub fn plus(self, other: Ratio) -> Option<Ratio> {
        let (a, b) = (i128::from(self.top), i128::from(self.bottom));
        let (c, d) = (i128::from(other.top), i128::from(other.bottom));
        Ratio::new(a.checked_mul(d)?.checked_add(c.checked_mul(b)?)?, b.checked_mul(d)?)
    }

    /// The product; `None` where it does not fit.
    pub fn times(self, other: Ratio) -> Option<Ratio> {
        Ratio::new(i128::from(self.top) * i128::from(other.top), i128::from(self.bottom) * i128::from(other.bottom))
    }

    /// 1/self; `None` for 0.
    pub fn inverse(self) -> Option<Ratio> {
        Ratio::new(self.bottom.into(), self.top.into())
    }

    /// −self.
    pub fn negative(self) -> Option<Ratio> {
        Some(Ratio { top: self.top.checked_neg()?, bottom: self.bottom })
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a.max(1) } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_exact_or_none() {
        let half = Ratio::new(2, -4).unwrap();
        assert_eq!(half.parts(), (-1, 2));
        assert_eq!(half.plus(Ratio::new(1, 3).unwrap()), Ratio::new(-1, 6));
        assert_eq!(half.inverse().unwrap().times(half), Some(Ratio::ONE));
        assert_eq!(Ratio::ZERO.inverse(), None);
        assert_eq!(Ratio::whole(i64::MAX).plus(Ratio::ONE), None);
        assert_eq!(Ratio::of(0.475), Ratio::new(19, 40));
        assert_eq!(Ratio::of(f64::NAN), None);
        assert_eq!(Ratio::of(1e300), None);
    }
}
