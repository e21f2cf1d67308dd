//! Values of arguments.

use clap::builder::PossibleValuesParser;
use ribopt::problem::settings::BACKENDS;

/// The names a backend may have, built in or not.
pub(super) fn backend_names() -> PossibleValuesParser {
    PossibleValuesParser::new(BACKENDS.iter().map(|backend| backend.name))
}

/// Between 0 and 1.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "a number is expected, such as 1e-6".to_string())?;
    if value > 0.0 && value < 1.0 { Ok(value) } else { Err("a tolerance lies between 0 and 1, such as 1e-6".into()) }
}

/// Finite, 0 or more.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "a number of seconds is expected".to_string())?;
    if value >= 0.0 && value.is_finite() { Ok(value) } else { Err("a number of seconds, 0 or more, is expected".into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_outside_0_to_1_are_refused() {
        for bad in ["0", "1", "-1e-6", "nan", "inf", "x"] {
            assert!(tolerance(bad).is_err(), "{bad}");
        }
        assert_eq!(tolerance("1e-8"), Ok(1e-8));
    }

    #[test]
    fn seconds_are_finite_and_not_negative() {
        for bad in ["-1", "-0.1", "nan", "inf", ""] {
            assert!(seconds(bad).is_err(), "{bad}");
        }
        assert_eq!((seconds("0.5"), seconds("0")), (Ok(0.5), Ok(0.0)));
    }
}
