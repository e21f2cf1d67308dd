//! Numbers of the structure: constants, lists along axes, and what variables may enter.

use super::super::Assembly;
use crate::input::declaration::structure::Vector;
use crate::input::fields::Scalar;
use crate::input::source::Place;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::resolve::Stage;
use crate::problem::structure::Plane;
use crate::problem::words::{brief, count};
use crate::problem::{Dimension, Formula};

impl Assembly<'_> {
    /// Components along the axes of the plane, 0 along the others.
    pub(super) fn along(&mut self, vector: &Vector, what: &str) -> Option<[f64; 3]> {
        self.parts_along(vector, what, self.building.structure.plane.axes())
    }

    /// Components along a member's own axes: x and z in a plane.
    pub(super) fn along_member(&mut self, vector: &Vector, what: &str) -> Option<[f64; 3]> {
        let axes = if self.building.structure.plane == Plane::Space { &[0, 1, 2][..] } else { &[0, 2][..] };
        self.parts_along(vector, what, axes)
    }

    /// The vector's parts along these axes, 0 along the others.
    fn parts_along(&mut self, vector: &Vector, what: &str, axes: &[usize]) -> Option<[f64; 3]> {
        let parts = vector.parts.iter().map(|part| self.finite(part)).collect::<Vec<Option<f64>>>();
        self.fits(vector, axes.len(), what)?;
        let mut along = [0.0; 3];
        for (&axis, part) in axes.iter().zip(parts) {
            along[axis] = part?;
        }
        Some(along)
    }

    /// Components about the axes: three in space, one in a plane. About a member's own axes the plane's normal is ±y.
    pub(super) fn about(&mut self, vector: &Vector, local: bool) -> Option<[f64; 3]> {
        let plane = self.building.structure.plane;
        let parts = vector.parts.iter().map(|part| self.finite(part)).collect::<Vec<Option<f64>>>();
        let expected = if plane == Plane::Space { 3 } else { 1 };
        self.fits(vector, expected, "moment")?;
        match (plane, local, parts[..].first().copied().flatten()?) {
            (Plane::Space, ..) => Some([parts[0]?, parts[1]?, parts[2]?]),
            (Plane::Xz, _, about) => Some([0.0, about, 0.0]),
            (Plane::Xy, false, about) => Some([0.0, 0.0, about]),
            // Heights point to the left: y = z × x is −Z.
            (Plane::Xy, true, about) => Some([0.0, -about, 0.0]),
        }
    }

    /// The mistake of a list that is too short or too long.
    pub(super) fn fits(&mut self, vector: &Vector, expected: usize, what: &str) -> Option<()> {
        let found = vector.parts.len();
        if found == expected {
            return Some(());
        }
        if self.building.plane_unknown {
            return None; // the plane's mistake is told already
        }
        let numbers = |found: usize| count(found, "number");
        let plane = self.building.structure.plane;
        let space = match plane.name() {
            Some(name) => format!("the plane \"{name}\""),
            None => "space".to_owned(),
        };
        let help = match (plane.name(), expected, found) {
            (None, 3, 2) => "add the third, or say plane = \"xz\" or \"xy\" under [structure]".to_owned(),
            (Some(_), 2, 3) => "leave one out, or leave `plane` out".to_owned(),
            (Some(_), 1, _) => "a moment in a plane is one number, about its normal".to_owned(),
            _ => format!("expected {}", numbers(expected)),
        };
        let message = format!("{what}: {}, but {space} takes {expected}", numbers(found));
        self.findings.mistake(MistakeCode::Coordinates, vector.place, message, help);
        None
    }

    /// A constant that is finite.
    pub(super) fn finite(&mut self, scalar: &Scalar) -> Option<f64> {
        let value = self.constant(scalar)?;
        if value.is_finite() {
            return Some(value);
        }
        self.findings.mistake(
            MistakeCode::NoNumber,
            scalar.place(),
            format!("this cannot be {value}"),
            "expected a finite number",
        );
        None
    }

    pub(super) fn is_positive(&mut self, value: f64, place: Place, what: &str) -> bool {
        if value <= 0.0 {
            self.findings.mistake(
                MistakeCode::OutOfRange,
                place,
                format!("{what} cannot be {}", brief(value)),
                "expected a positive number",
            );
        }
        value > 0.0
    }

    /// A number, or an expression in parameters, variables, and definitions made of these.
    pub(super) fn quantity(&mut self, scalar: &Scalar) -> Option<Dimension> {
        let Scalar::Expression(written) = scalar else { return self.finite(scalar).map(Dimension::Constant) };
        let ast = self.parsed(written, crate::expression::parse::parse)?;
        let formula = self.resolved(written, None, Stage::Variables, |resolver| resolver.scalar(&ast))?;
        match formula {
            Formula::Constant(value) if value.is_finite() => Some(Dimension::Constant(value)),
            Formula::Constant(value) => {
                self.findings.mistake(
                    MistakeCode::NoNumber,
                    written.place,
                    format!("this cannot be {value}"),
                    "expected a finite number",
                );
                None
            }
            Formula::Variable(j) => Some(Dimension::Variable(j)),
            formula => {
                self.problem.dimension_formulas.push(formula);
                Some(Dimension::Formula(self.problem.dimension_formulas.len() as u32 - 1))
            }
        }
    }
}
