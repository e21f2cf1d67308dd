//! Does the objective go on falling for ever? A stationary point far down a tail (exp(x) towards −∞, a valley along x·y = 1) passes
//! every local test although no minimum is attained.
//!
//! [`Valley`] follows the floor of the Lagrangian's valley outwards from a point: one variable is moved on in growing steps, the
//! others are led back to the active rows and to stationarity by Newton steps at each. Distances double, so that neither the
//! origin nor the units of the variables matter.
//!
//! [`Terrain`] follows ways that need no derivatives: straight ones, power curves, and the way to an edge of the domain.

mod floor;
mod height;
pub mod parameters;
mod valley;
mod ways;

pub use floor::newton;
pub use height::{Fall, last_digits, with_digits_moved};
pub use valley::{Site, Valley, moves_most};
pub use ways::{Ray, Terrain, is_farther, size};
