//! `circle`: diameter d.

use std::f64::consts::PI;

use super::build::{monomial, radius};
use super::defaults::{Defaults, length};
use super::fibre::{AROUND, Fibre, Points, UPRIGHT, around};
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::Superellipse;
use crate::geometry::polygon::Ring;

/// The solid circle.
pub struct Circle;

static FORMS: &[Form] = &[Form { kind: "circle", dimensions: &["d"] }];

static DEFAULTS: Defaults = Defaults {
    dimensions: &[length("d", 0.02, 1.5, 0.2)],
    proportions: &[("thickness", "d >= thickness")],
    thickness: 0.03,
    height: ("d", 1.0),
};

impl Kind for Circle {
    fn name(&self) -> &'static str {
        "circle"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/circle.toml")
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &["d", "A", "Ix", "Iy", "Wx", "Wy", "Wplx", "Wply", "ix", "iy", "J", "Asx", "Asy", "perimeter", "width", "height"]
    }

    /// J is exact; shear areas 6/7·A (Cowper, *J. Appl. Mech.* 33, 1966, at ν = 0).
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let d = given.dimensions[0];
        let mut power = |factor, exponent| monomial(graph, factor, &[(d, exponent)]);
        Some(match name {
            "d" | "width" | "height" => d,
            "A" => power(PI / 4.0, 2.0),
            "Ix" | "Iy" => power(PI / 64.0, 4.0),
            "Wx" | "Wy" => power(PI / 32.0, 3.0),
            "J" => power(PI / 32.0, 4.0),
            "Asx" | "Asy" => power(6.0 / 7.0 * PI / 4.0, 2.0),
            "Wplx" | "Wply" => power(1.0 / 6.0, 3.0),
            "perimeter" => power(PI, 1.0),
            _ => return radius(self, graph, given, name),
        })
    }

    fn points(&self, _: &Form) -> Points {
        Points { normal: AROUND, upright: UPRIGHT, shear: AROUND }
    }

    /// Points on the circumference: shear 4V/3A where it lies across the force, torsion T·d/2J.
    fn fibre(&self, graph: &mut Graph, given: &Given, point: &str) -> Option<Fibre> {
        around(self, graph, given, 4.0 / 3.0, point)
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    fn posynomial_volume(&self, _: &Form) -> bool {
        true
    }

    fn rings(&self, _: &Form, given: &[f64], _: &[Ring], tolerance: f64) -> Vec<Ring> {
        ring(given[0], tolerance).into_iter().collect()
    }

    fn matching_rings(&self, _: &Form, given: &[f64], _: &[Ring]) -> Vec<Ring> {
        matching_ring(given[0]).into_iter().collect()
    }
}

/// A circle of diameter d as a polygon inside it, anticlockwise.
pub(super) fn ring(d: f64, tolerance: f64) -> Option<Vec<[f64; 2]>> {
    Superellipse::new(d / 2.0, d / 2.0, 2.0).ok()?.polygon(tolerance).ok()
}

/// The same with a fixed number of points and the circle's area.
pub(super) fn matching_ring(d: f64) -> Option<Vec<[f64; 2]>> {
    Some(Superellipse::new(d / 2.0, d / 2.0, 2.0).ok()?.polygon_of_equal_area(super::QUARTER))
}
