//! Exact fractions: exponents of dimensions.

use num_rational::Ratio as Fraction;

/// An exponent, in lowest terms.
pub type Ratio = Fraction<i64>;

/// The largest denominator an exponent is read with: 2/3, 0.475, but no irrational number.
const LARGEST_DENOMINATOR: i64 = 1000;

/// The fraction of small denominator that a number is meant for, up to its last digits; `None` for any other.
///
/// ```
/// use ribopt::units::{Ratio, meant_by};
/// assert_eq!(meant_by(2.0 / 3.0), Some(Ratio::new(2, 3)));
/// assert_eq!(meant_by(std::f64::consts::PI), None);
/// ```
pub fn meant_by(value: f64) -> Option<Ratio> {
    (1..=LARGEST_DENOMINATOR).find_map(|bottom| {
        let top = (value * bottom as f64).round();
        // Two roundings: of the number itself and of the product.
        let meant = (top / bottom as f64 - value).abs() <= 2.0 * f64::EPSILON * value.abs();
        (meant && top.abs() < 1e9).then(|| Ratio::new(top as i64, bottom))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_meant_for_fractions_or_not() {
        assert_eq!(meant_by(0.475), Some(Ratio::new(19, 40)));
        assert_eq!(meant_by(-0.5), Some(Ratio::new(-1, 2)));
        assert_eq!(meant_by(f64::NAN), None);
        assert_eq!(meant_by(1e300), None);
    }
}
