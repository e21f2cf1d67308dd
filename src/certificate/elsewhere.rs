//! Lower points that neither curvature nor a way outwards shows: a slope is small in a measure that deceives, or leads far.

use super::far_slopes;
use super::newton::{self, Newton};
use super::point::Point;
use super::runaway::Runaway;
use super::second_order::Active;
use super::types::Tolerances;
use crate::model::Class;

/// Where the slopes left at a point lead.
#[derive(Debug, PartialEq)]
pub(super) enum Elsewhere {
    Nowhere,
    /// Newton's steps lead on, ten times the way there.
    LedOn(Vec<f64>),
    /// To a feasible point far away that is lower: no global minimum.
    FarAway(Vec<f64>),
    /// They fall without end, with these variables.
    Falls(Vec<usize>),
}

impl Elsewhere {
    /// The variables that fall without end.
    pub(super) fn runaway(&self) -> Option<Runaway> {
        match self {
            Elsewhere::Falls(variables) => Some(Runaway::settling(variables.clone())),
            _ => None,
        }
    }

    /// The way there.
    pub(super) fn way(self) -> Option<Vec<f64>> {
        match self {
            Elsewhere::LedOn(way) | Elsewhere::FarAway(way) => Some(way),
            Elsewhere::Nowhere | Elsewhere::Falls(_) => None,
        }
    }
}

/// Follows Newton's own steps and, of a class whose minima are global, the slopes themselves.
pub(super) fn look(point: &Point<'_>, active: &Active<'_>, class: Class, tolerances: &Tolerances) -> Elsewhere {
    let steps = match class == Class::Linear || point.is_over() {
        true => Newton::Stays,
        false => newton::steps(point, active, tolerances.constraint),
    };
    match steps {
        Newton::LeadsTo(way) => Elsewhere::LedOn(way),
        Newton::Falls(variables) => Elsewhere::Falls(variables),
        Newton::Stays if class.is_global() => {
            far_slopes::way_down(point, active.multipliers, tolerances).map_or(Elsewhere::Nowhere, Elsewhere::FarAway)
        }
        Newton::Stays => Elsewhere::Nowhere,
    }
}
