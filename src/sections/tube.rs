//! `tube`: outer diameter d, wall thickness t.

use std::f64::consts::PI;

use super::build::{monomial, radius, symmetric_modulus};
use super::defaults::{Defaults, length};
use super::fibre::{AROUND, Fibre, Points, UPRIGHT, around};
use super::{Form, Given, Kind, circle};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// The round tube.
pub struct Tube;

static FORMS: &[Form] = &[Form { kind: "tube", dimensions: &["d", "t"] }];

static DEFAULTS: Defaults = Defaults {
    dimensions: &[length("d", 0.05, 1.5, 0.2), length("t", 0.003, 0.02, 0.008)],
    proportions: &[("slenderness", "d <= 10*slenderness*t"), ("thickness", "t >= thickness")],
    thickness: 0.004,
    height: ("d", 1.0),
};

impl Kind for Tube {
    fn name(&self) -> &'static str {
        "tube"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/tube.toml")
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "d",
            "t",
            "di",
            "A",
            "Ix",
            "Iy",
            "Wx",
            "Wy",
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "J",
            "Asx",
            "Asy",
            "perimeter",
            "width",
            "height",
        ]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let (d, t) = (given.dimensions[0], given.dimensions[1]);
        Some(match name {
            "d" | "width" | "height" => d,
            "t" => t,
            "di" => inner(graph, d, t),
            "A" => area(graph, d, t),
            "Ix" | "Iy" => moment(graph, d, t),
            // Exact.
            "J" => {
                let moment = moment(graph, d, t);
                graph.scale(2.0, moment)
            }
            "Wx" | "Wy" => {
                let moment = moment(graph, d, t);
                symmetric_modulus(graph, moment, d)
            }
            "Asx" | "Asy" => shear_area(graph, d, t),
            "Wplx" | "Wply" => plastic(graph, d, t),
            // The outer one, which is painted.
            "perimeter" => graph.scale(PI, d),
            _ => return radius(self, graph, given, name),
        })
    }

    fn points(&self, _: &Form) -> Points {
        Points { normal: AROUND, upright: UPRIGHT, shear: AROUND }
    }

    /// Points on the circumference: shear 2V/A (thin walls) where it lies across the force, torsion T·d/2J.
    fn fibre(&self, graph: &mut Graph, given: &Given, point: &str) -> Option<Fibre> {
        around(self, graph, given, 2.0, point)
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        vec![area(graph, given.dimensions[0], given.dimensions[1])]
    }

    fn positive(&self) -> &'static [&'static str] {
        &["di"]
    }

    fn rings(&self, _: &Form, given: &[f64], _: &[Ring], tolerance: f64) -> Vec<Ring> {
        rings(given, |d| circle::ring(d, tolerance))
    }

    fn matching_rings(&self, _: &Form, given: &[f64], _: &[Ring]) -> Vec<Ring> {
        rings(given, circle::matching_ring)
    }
}

/// The outer circle and, clockwise, the hole.
fn rings(given: &[f64], ring: impl Fn(f64) -> Option<Vec<[f64; 2]>>) -> Vec<Ring> {
    let hole = ring(given[0] - 2.0 * given[1]).map(|mut hole| {
        hole.reverse();
        hole
    });
    ring(given[0]).into_iter().chain(hole).collect()
}

/// Inner diameter d − 2t.
fn inner(graph: &mut Graph, d: NodeId, t: NodeId) -> NodeId {
    let walls = graph.scale(2.0, t);
    graph.subtract(d, walls)
}

/// A = π·t·(d − t)
fn area(graph: &mut Graph, d: NodeId, t: NodeId) -> NodeId {
    let middle = graph.subtract(d, t);
    monomial(graph, PI, &[(t, 1.0), (middle, 1.0)])
}

/// I = A·(d² + di²)/16, π/64·(d⁴ − di⁴) without its cancellation.
fn moment(graph: &mut Graph, d: NodeId, t: NodeId) -> NodeId {
    let (inner, area) = (inner(graph, d, t), area(graph, d, t));
    let squares = sum_of_squares(graph, d, inner);
    monomial(graph, 1.0 / 16.0, &[(area, 1.0), (squares, 1.0)])
}

/// Cowper's hollow circle (*J. Appl. Mech.* 33, 1966) at ν = 0: A·6(1 + m²)²/(7(1 + m²)² + 20m²), m = di/d: from 6/7 of a full circle to
/// 1/2 of a thin wall. Within 0.5 % of sectionproperties' finite elements.
fn shear_area(graph: &mut Graph, d: NodeId, t: NodeId) -> NodeId {
    let (inner, area) = (inner(graph, d, t), area(graph, d, t));
    let squares = sum_of_squares(graph, d, inner);
    let square = monomial(graph, 7.0, &[(squares, 2.0)]);
    let mixed = monomial(graph, 20.0, &[(d, 2.0), (inner, 2.0)]);
    let divisor = graph.add(square, mixed);
    monomial(graph, 6.0, &[(area, 1.0), (squares, 2.0), (divisor, -1.0)])
}

/// t·(d² + d·di + di²)/3, (d³ − di³)/6 without its cancellation.
fn plastic(graph: &mut Graph, d: NodeId, t: NodeId) -> NodeId {
    let inner = inner(graph, d, t);
    let (squares, mixed) = (sum_of_squares(graph, d, inner), graph.multiply(d, inner));
    let sum = graph.add(squares, mixed);
    monomial(graph, 1.0 / 3.0, &[(t, 1.0), (sum, 1.0)])
}

fn sum_of_squares(graph: &mut Graph, a: NodeId, b: NodeId) -> NodeId {
    let (a, b) = (graph.power(a, 2.0), graph.power(b, 2.0));
    graph.add(a, b)
}
