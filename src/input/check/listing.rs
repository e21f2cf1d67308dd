//! The values a variable may take.

use crate::input::source::Place;

/// The values a variable may take, before its bounds are known.
#[derive(Clone)]
pub(super) struct Listing {
    pub place: Place,
    pub values: Values,
}

/// How they are given.
#[derive(Clone)]
pub(super) enum Values {
    /// From the lower bound in steps.
    Step(f64),
    Given(Vec<f64>),
    /// Whole numbers.
    Integer,
}
