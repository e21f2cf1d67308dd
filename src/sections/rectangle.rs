//! `rectangle`: width b, height h.

use super::{Form, Given, Kind, Length};
use crate::expression::graph::{Graph, NodeId};

/// The rectangle b × h.
pub struct Rectangle;

static FORMS: &[Form] = &[Form { kind: "rectangle", dimensions: &["b", "h"] }];

impl Kind for Rectangle {
    fn name(&self) -> &'static str {
        "rectangle"
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &["b", "h", "A", "Ix", "Iy", "Wx", "Wy", "width", "height"]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let (b, h) = (given.dimensions[0], given.dimensions[1]);
        Some(match name {
            "b" | "width" => b,
            "h" | "height" => h,
            "A" => graph.multiply(b, h),
            "Ix" => monomial(graph, b, h, 3.0, 12.0),
            "Iy" => monomial(graph, h, b, 3.0, 12.0),
            "Wx" => monomial(graph, b, h, 2.0, 6.0),
            "Wy" => monomial(graph, h, b, 2.0, 6.0),
            _ => return None,
        })
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        vec![graph.multiply(given.dimensions[0], given.dimensions[1])]
    }

    fn part_factors(&self, _: &Form) -> &'static [[Length; 2]] {
        const WHOLE: &[[Length; 2]] = &[[Length::of(0), Length::of(1)]];
        WHOLE
    }

    fn rings(&self, _: &Form, given: &[f64], _: &[[f64; 2]], _: f64) -> Vec<Vec<[f64; 2]>> {
        let (x, y) = (given[0] / 2.0, given[1] / 2.0);
        vec![vec![[-x, -y], [x, -y], [x, y], [-x, y]]]
    }
}

/// `a · bⁿ / divisor`
fn monomial(graph: &mut Graph, a: NodeId, b: NodeId, exponent: f64, divisor: f64) -> NodeId {
    let power = graph.power(b, exponent);
    let product = graph.multiply(a, power);
    graph.scale(1.0 / divisor, product)
}
