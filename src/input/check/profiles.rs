//! `[profiles]`: degrees and knots checked.

use super::Assembly;
use crate::input::declaration::{Declaration, Degree, ProfileEntry};
use crate::input::fields::Scalar;
use crate::input::source::Place;
use crate::problem::Profile;
use crate::problem::mistake_code::MistakeCode;
use crate::splines::{KnotVector, SplineError};

/// The highest degree; polynomials of more wiggle.
const MOST: f64 = 20.0;

impl Assembly<'_> {
    /// All profiles; one with a mistake is stood in for, so that its uses are not mistakes as well.
    pub(super) fn profiles(&mut self, declared: &Declaration) {
        for entry in &declared.profiles {
            let Some(&(first, size)) = self.variables.get(entry.variable) else { continue };
            let count = size.unwrap_or(1) as usize;
            let control = declared.variables.get(entry.variable).and_then(|variable| variable.size.as_ref());
            let control = control.map_or(entry.name.place, Scalar::place);
            let knots = self.knots(entry, count, control);
            let Some(knots) = knots.or_else(|| KnotVector::clamped_uniform(0, count, 0.0, 1.0).ok()) else { continue };
            self.problem.profiles.push(Profile { name: entry.name.text.clone(), first, knots });
        }
    }

    fn knots(&mut self, entry: &ProfileEntry, count: usize, control: Place) -> Option<KnotVector> {
        let degree = self.degree(&entry.degree)?;
        let Some((scalars, place)) = &entry.knots else {
            let made = KnotVector::clamped_uniform(degree, count, 0.0, 1.0);
            return made
                .map_err(|error| self.findings.mistake(MistakeCode::Profile, control, error.to_string(), "or lower the degree"))
                .ok();
        };
        let values: Option<Vec<f64>> = scalars.iter().map(|scalar| self.constant(scalar)).collect();
        let made = self.checked(degree, values?, count);
        made.map_err(|(error, help)| {
            let at = match error {
                SplineError::FallingKnots { position, .. } | SplineError::NotFinite { position, .. } => {
                    scalars.get(position - 1).map_or(*place, Scalar::place)
                }
                _ => *place,
            };
            self.findings.mistake(MistakeCode::Profile, at, error.to_string(), help);
        })
        .ok()
    }

    /// Knots that fit the control values and span the line from 0 to 1.
    fn checked(&self, degree: usize, values: Vec<f64>, controls: usize) -> Result<KnotVector, (SplineError, String)> {
        let (knots, expected) = (values.len(), controls + degree + 1);
        let remedy = || format!("{controls} control values of degree {degree} take {expected} knots, rising from 0 to 1");
        if values.iter().all(|value| value.is_finite()) && values.is_sorted() && knots != expected {
            return Err((SplineError::KnotCount { knots, controls, degree }, remedy()));
        }
        let made = KnotVector::new(degree, values).map_err(|error| (error, remedy()))?;
        let (from, to) = made.domain();
        let outside = [0.0, 1.0].into_iter().find(|end| !(from <= *end && *end <= to));
        match outside {
            Some(x) => {
                Err((SplineError::Outside { x, from, to }, format!("{}: divide the knots by the line's length", remedy())))
            }
            None => Ok(made),
        }
    }

    fn degree(&mut self, degree: &Degree) -> Option<usize> {
        let scalar = match degree {
            Degree::Fixed(degree) => return Some(*degree as usize),
            Degree::Given(scalar) => scalar,
        };
        let value = self.constant(scalar)?;
        if value.fract() != 0.0 || !(0.0..=MOST).contains(&value) {
            let message = format!("a B-spline cannot have degree {value}");
            self.findings.mistake(
                MistakeCode::OutOfRange,
                scalar.place(),
                message,
                format!("`degree` is a whole number from 0 to {MOST}"),
            );
            return None;
        }
        Some(value as usize)
    }
}
