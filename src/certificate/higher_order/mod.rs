//! What second order leaves open: steps of finite length along directions that are flat, and values at other points.

mod finite_steps;
mod slopes;
mod trial_point;

pub(super) use finite_steps::{confirm, find};
pub(super) use trial_point::Trial;
