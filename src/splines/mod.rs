//! B-splines, cubic and bicubic splines, note 1.5.
//!
//! The note counts by order k; here the *degree* p = k − 1 is given, as most of today's libraries do. Knots t₀ ≤ … ≤ t_{n+p},
//! n basis functions, domain [t_p, t_n], closed at both ends.

mod basis;
mod bicubic;
mod cubic;
mod curve;
mod fit;
mod knots;
mod patch;
#[cfg(test)]
mod reference;
mod surface;

pub use basis::Support;
pub use bicubic::BicubicInterpolant;
pub use cubic::{CubicSpline, EndCondition};
pub use curve::BSplineCurve;
pub use fit::{interpolate, least_squares, not_a_knot};
pub use knots::KnotVector;
pub use patch::{BicubicPatch, Corner};
pub use surface::BSplineSurface;

/// Why a spline cannot be had. Positions count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// A knot is smaller than the one before.
    #[error("knot {position} ({value}) is smaller than the one before ({before}); knots must not fall")]
    FallingKnots {
        /// Which.
        position: usize,
        /// Its value.
        value: f64,
        /// The value before.
        before: f64,
    },
    /// A number is NaN or infinite.
    #[error("{what} {position} is {value}; it must be finite")]
    NotFinite {
        /// Of which list.
        what: &'static str,
        /// Which.
        position: usize,
        /// What stands there.
        value: f64,
    },
    /// A knot stands too often: the basis would no longer be continuous.
    #[error("knot {value} stands {count} times; at most {most} for this degree")]
    TooManyRepeats {
        /// The knot.
        value: f64,
        /// How often it stands.
        count: usize,
        /// How often it may: degree + 1, in all.
        most: usize,
    },
    /// Fewer control values than degree + 1.
    #[error("{count} control values are too few for degree {degree}: give at least {least}", least = degree + 1)]
    TooFewControls {
        /// How many there are.
        count: usize,
        /// The degree.
        degree: usize,
    },
    /// Knots and control values do not fit together.
    #[error("{knots} knots do not fit {controls} control values of degree {degree}: there must be {controls} + {degree} + 1")]
    KnotCount {
        /// How many knots.
        knots: usize,
        /// How many control values.
        controls: usize,
        /// The degree.
        degree: usize,
    },
    /// The domain [t_p, t_n] has no length.
    #[error("all knots of the domain coincide at {value}; the last must exceed the first")]
    EmptyDomain {
        /// Where.
        value: f64,
    },
    /// A parameter outside the domain.
    #[error("parameter {x} lies outside the spline's domain [{from}, {to}]")]
    Outside {
        /// The parameter.
        x: f64,
        /// Left end.
        from: f64,
        /// Right end.
        to: f64,
    },
    /// Data of different lengths.
    #[error("{expected} values of {what} were expected, {found} were given")]
    Length {
        /// Of which list.
        what: &'static str,
        /// How many.
        expected: usize,
        /// How many came.
        found: usize,
    },
    /// Too few data points.
    #[error("{count} data points are too few; give at least {least}")]
    TooFewPoints {
        /// How many came.
        count: usize,
        /// How many it takes.
        least: usize,
    },
    /// Abscissae that do not rise.
    #[error("{what} {position} ({value}) does not exceed the one before; they must rise")]
    NotRising {
        /// Of which list.
        what: &'static str,
        /// Which.
        position: usize,
        /// Its value.
        value: f64,
    },
    /// Data and knots leave a control value undetermined (Schoenberg and Whitney).
    #[error("no data point lies under basis function {function}: the data do not determine the spline; use fewer knots there")]
    Undetermined {
        /// Which basis function.
        function: usize,
    },
    /// A knot that would stand too often after insertion.
    #[error("knot {value} already stands {count} times and cannot be inserted again")]
    FullKnot {
        /// The knot.
        value: f64,
        /// Its multiplicity.
        count: usize,
    },
}

/// All values finite?
fn finite<'a>(what: &'static str, values: impl IntoIterator<Item = &'a f64>) -> Result<(), SplineError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((at, value)) => Err(SplineError::NotFinite { what, position: at + 1, value: *value }),
        None => Ok(()),
    }
}

/// Finite and strictly rising?
fn rising(what: &'static str, values: &[f64]) -> Result<(), SplineError> {
    finite(what, values)?;
    match values.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(at) => Err(SplineError::NotRising { what, position: at + 2, value: values[at + 1] }),
        None => Ok(()),
    }
}

/// As many as expected?
fn same_length(what: &'static str, expected: usize, found: usize) -> Result<(), SplineError> {
    if expected == found { Ok(()) } else { Err(SplineError::Length { what, expected, found }) }
}
