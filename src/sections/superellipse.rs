//! `superellipse`: semi-axes a (half the width) and b (half the height), exponent r, fixed or variable; note 2.2.

use std::f64::consts::PI;

use super::build::monomial;
use super::defaults::{Defaults, fixed_number, length};
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Unary;
use crate::geometry::Superellipse as Curve;
use crate::geometry::polygon::Ring;

/// The solid |x/a|^r + |y/b|^r ≤ 1.
pub struct Superellipse;

static FORMS: &[Form] = &[Form { kind: "superellipse", dimensions: &["a", "b", "r"] }];

static DEFAULTS: Defaults = Defaults {
    dimensions: &[length("a", 0.01, 0.25, 0.05), length("b", 0.02, 0.75, 0.15), fixed_number("r", 2.5)],
    proportions: &[("slenderness", "b <= slenderness*a"), ("thickness", "2*a >= thickness")],
    thickness: 0.03,
    height: ("b", 2.0),
};

impl Kind for Superellipse {
    fn name(&self) -> &'static str {
        "superellipse"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/superellipse.toml")
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &["a", "b", "r", "A", "Ix", "Iy", "Wx", "Wy", "J", "width", "height"]
    }

    /// J is Saint-Venant's A⁴/(4π²(Ix + Iy)): exact for the ellipse; for a/b from 1/4 to 4 within 3 % for r from 1.5 to 4, 8 % for r ≥ 1.
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let [a, b, r] = *given.dimensions else { return None };
        Some(match name {
            "a" => a,
            "b" => b,
            "r" => r,
            "width" => graph.scale(2.0, a),
            "height" => graph.scale(2.0, b),
            "A" => area(graph, a, b, r),
            "Ix" => moment(graph, r, &[(a, 1.0), (b, 3.0)]),
            "Iy" => moment(graph, r, &[(a, 3.0), (b, 1.0)]),
            "Wx" => moment(graph, r, &[(a, 1.0), (b, 2.0)]),
            "Wy" => moment(graph, r, &[(a, 2.0), (b, 1.0)]),
            "J" => {
                let (area, ix, iy) =
                    (area(graph, a, b, r), moment(graph, r, &[(a, 1.0), (b, 3.0)]), moment(graph, r, &[(a, 3.0), (b, 1.0)]));
                let polar = graph.add(ix, iy);
                monomial(graph, 1.0 / (4.0 * PI * PI), &[(area, 4.0), (polar, -1.0)])
            }
            _ => return None,
        })
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    /// With one fixed r at both ends; a variable r makes it none.
    fn posynomial_volume(&self, _: &Form) -> bool {
        true
    }

    fn rings(&self, _: &Form, given: &[f64], _: &[Ring], tolerance: f64) -> Vec<Ring> {
        let [a, b, r] = *given else { return Vec::new() };
        let ring = Curve::new(a, b, r).and_then(|curve| curve.polygon(tolerance));
        ring.into_iter().collect()
    }

    fn matching_rings(&self, _: &Form, given: &[f64], _: &[Ring]) -> Vec<Ring> {
        let [a, b, r] = *given else { return Vec::new() };
        Curve::new(a, b, r).map(|curve| curve.polygon_of_equal_area(super::QUARTER)).into_iter().collect()
    }
}

/// A = 4ab·Γ(1+1/r)²/Γ(1+2/r), by ln Γ.
fn area(graph: &mut Graph, a: NodeId, b: NodeId, r: NodeId) -> NodeId {
    let (one, two) = (ln_gamma(graph, 1.0, r), ln_gamma(graph, 2.0, r));
    let double = graph.scale(2.0, one);
    let factor = exponential_of_difference(graph, double, two);
    monomial(graph, 4.0, &[(factor, 1.0), (a, 1.0), (b, 1.0)])
}

/// 4/3·Γ(1+1/r)Γ(1+3/r)/Γ(1+4/r) times powers of a and b: the moments, and the moduli, whose powers are lower by one.
fn moment(graph: &mut Graph, r: NodeId, powers: &[(NodeId, f64)]) -> NodeId {
    let (one, three, four) = (ln_gamma(graph, 1.0, r), ln_gamma(graph, 3.0, r), ln_gamma(graph, 4.0, r));
    let sum = graph.add(one, three);
    let factor = exponential_of_difference(graph, sum, four);
    monomial(graph, 4.0 / 3.0, &[&[(factor, 1.0)], powers].concat())
}

/// ln Γ(1 + k/r)
fn ln_gamma(graph: &mut Graph, k: f64, r: NodeId) -> NodeId {
    let (one, k) = (graph.constant(1.0), graph.constant(k));
    let share = graph.divide(k, r);
    let argument = graph.add(one, share);
    graph.unary(Unary::LnGamma, argument)
}

fn exponential_of_difference(graph: &mut Graph, left: NodeId, right: NodeId) -> NodeId {
    let difference = graph.subtract(left, right);
    graph.unary(Unary::Exp, difference)
}
