//! Numbers as text: exact ones for files, short ones for people.

pub use crate::log::{exact, push_exact};

/// As [`push_exact`], with open bounds left empty.
pub fn push_exact_or_open(text: &mut String, value: f64) {
    if value.is_finite() {
        push_exact(text, value);
    }
}

/// About six significant digits, as people read them: `0.0412`, `1.25e-7`, `-`, `inf`.
///
/// ```
/// assert_eq!(ribopt::report::number::short(1.0 / 3.0), "0.333333");
/// assert_eq!(ribopt::report::number::short(123456789.0), "1.23457e8");
/// ```
pub fn short(value: f64) -> String {
    significant(value, 6)
}

/// With this many significant digits, trailing zeros dropped.
pub fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return "-".into();
    }
    if value.is_infinite() || value == 0.0 {
        return if value == 0.0 { "0".into() } else { format!("{value}") };
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..7).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        return without_trailing_zeros(&format!("{value:.decimals$}")).into();
    }
    format!("{}e{exponent}", without_trailing_zeros(mantissa))
}

/// Four digits and the unit raised to a power, where there is a unit: `0.0412 m²`.
pub fn with_unit_power(value: f64, unit: Option<&str>, power: u32) -> String {
    let raised = ["", "", "²", "³"].get(power as usize).copied().unwrap_or("");
    unit.map_or_else(|| significant(value, 4), |unit| format!("{} {unit}{raised}", significant(value, 4)))
}

/// A share as a percentage: `1.25 %`.
pub fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 3))
}

fn without_trailing_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn exact_text_reads_back_bit_for_bit(value in proptest::num::f64::ANY) {
            prop_assume!(!value.is_nan());
            prop_assert_eq!(exact(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }

        #[test]
        fn short_text_is_within_its_digits(value in proptest::num::f64::NORMAL) {
            let read: f64 = short(value).parse().unwrap();
            prop_assert!(((read - value) / value).abs() <= 5.1e-6 || !read.is_finite(), "{value:e} {read:e}");
        }
    }

    #[test]
    fn short_text_is_readable() {
        let texts = [0.0, 1.0, -0.25, 1234567.0, 12345678.0, 1e-4, 1e-5, f64::NAN, f64::INFINITY].map(short);
        assert_eq!(texts, ["0", "1", "-0.25", "1234567", "1.23457e7", "0.0001", "1e-5", "-", "inf"]);
    }
}
