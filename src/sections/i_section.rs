//! `i-section`: an I with two different flanges, a web tw × hw between a flange b_top × tf_top and one b_bottom × tf_bottom.

use super::build::{monomial, radius, symmetric_modulus};
use super::pieces::{Piece, Pieces};
use super::rectangles::{Band, on_axis, plastic_modulus, torsion};
use super::{Form, Given, Kind, evaluate};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Binary;
use crate::geometry::polygon::Ring;

/// The I section of two flanges.
pub struct ISection;

static FORMS: &[Form] = &[Form { kind: "i-section", dimensions: &["tw", "hw", "b_top", "tf_top", "b_bottom", "tf_bottom"] }];

struct Shape {
    tw: NodeId,
    hw: NodeId,
    top: [NodeId; 2],
    bottom: [NodeId; 2],
    h: NodeId,
}

impl Shape {
    fn of(graph: &mut Graph, given: &Given) -> Option<Shape> {
        let [tw, hw, b_top, tf_top, b_bottom, tf_bottom] = *given.dimensions else { return None };
        let h = graph.sum(&[hw, tf_top, tf_bottom]);
        Some(Shape { tw, hw, top: [b_top, tf_top], bottom: [b_bottom, tf_bottom], h })
    }

    /// About the axis of symmetry, which is at x = 0.
    fn pieces(&self, graph: &mut Graph) -> Pieces {
        let axis = graph.constant(0.0);
        let [half_web, half_top, half_bottom] = [self.hw, self.top[1], self.bottom[1]].map(|length| graph.scale(0.5, length));
        let web = graph.add(self.bottom[1], half_web);
        let top = graph.subtract(self.h, half_top);
        let list = vec![
            Piece { sides: [self.tw, self.hw], middle: [axis, web] },
            Piece { sides: self.top, middle: [axis, top] },
            Piece { sides: self.bottom, middle: [axis, half_bottom] },
        ];
        let flanges = graph.binary(Binary::Max, self.top[0], self.bottom[0]);
        let width = graph.binary(Binary::Max, flanges, self.tw);
        Pieces { list, extent: [width, self.h] }
    }

    /// About the level with half the area on either side.
    fn plastic(&self, graph: &mut Graph) -> NodeId {
        let layers = [self.bottom, [self.tw, self.hw], self.top];
        plastic_modulus(graph, &layers.map(|[width, thickness]| Band { width, thickness }))
    }

    /// hs²·I1·I2/(I1 + I2), with the flanges' own moments about the axis of symmetry and the distance of their middles.
    fn warping(&self, graph: &mut Graph) -> NodeId {
        let own = |graph: &mut Graph, [b, tf]: [NodeId; 2]| monomial(graph, 1.0 / 12.0, &[(tf, 1.0), (b, 3.0)]);
        let (top, bottom) = (own(graph, self.top), own(graph, self.bottom));
        let halves = [graph.scale(0.5, self.top[1]), self.hw, graph.scale(0.5, self.bottom[1])];
        let (distance, both) = (graph.sum(&halves), graph.add(top, bottom));
        monomial(graph, 1.0, &[(distance, 2.0), (top, 1.0), (bottom, 1.0), (both, -1.0)])
    }
}

impl Kind for ISection {
    fn name(&self) -> &'static str {
        "i-section"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/i-section.toml")
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "tw",
            "hw",
            "b_top",
            "tf_top",
            "b_bottom",
            "tf_bottom",
            "h",
            "A",
            "Ix",
            "Iy",
            "Wx",
            "Wx_top",
            "Wx_bottom",
            "Wy",
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "J",
            "Iw",
            "y_top",
            "y_bottom",
            "perimeter",
            "width",
            "height",
        ]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        if let Some(at) = given.form.dimensions.iter().position(|known| *known == name) {
            return given.dimensions.get(at).copied();
        }
        let shape = Shape::of(graph, given)?;
        let pieces = shape.pieces(graph);
        Some(match name {
            "h" => shape.h,
            "Wy" => {
                let (moment, width) = (pieces.moment(graph, 0), pieces.extent[0]);
                symmetric_modulus(graph, moment, width)
            }
            "J" => torsion(graph, &[(shape.hw, shape.tw), (shape.top[0], shape.top[1]), (shape.bottom[0], shape.bottom[1])]),
            "Wplx" => shape.plastic(graph),
            "Wply" => on_axis(graph, &[(shape.tw, shape.hw), (shape.top[0], shape.top[1]), (shape.bottom[0], shape.bottom[1])]),
            "Iw" => shape.warping(graph),
            // 2·(b_top + b_bottom + h − tw)
            "perimeter" => {
                let sum = graph.sum(&[shape.top[0], shape.bottom[0], shape.h]);
                let open = graph.subtract(sum, shape.tw);
                graph.scale(2.0, open)
            }
            "Ixy" | "Imin" | "Wy_left" | "Wy_right" | "x_left" | "x_right" => return None,
            _ => return pieces.property(graph, name).or_else(|| radius(self, graph, given, name)),
        })
    }

    /// Web, upper and lower flange.
    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        let Some(shape) = Shape::of(graph, given) else { return Vec::new() };
        let pieces = shape.pieces(graph);
        pieces.areas(graph)
    }

    fn posynomial_volume(&self, _: &Form) -> bool {
        true
    }

    fn rings(&self, form: &Form, given: &[f64], _: &[Ring], _: f64) -> Vec<Ring> {
        let [tw, hw, b_top, tf_top, b_bottom, tf_bottom] = *given else { return Vec::new() };
        let (w, top, bottom, under, h) = (tw / 2.0, b_top / 2.0, b_bottom / 2.0, tf_bottom + hw, tf_bottom + hw + tf_top);
        let Some(y) = evaluate(self, form, given, &[], "y_bottom") else { return Vec::new() };
        let ring = [
            [-bottom, 0.0],
            [bottom, 0.0],
            [bottom, tf_bottom],
            [w, tf_bottom],
            [w, under],
            [top, under],
            [top, h],
            [-top, h],
            [-top, under],
            [-w, under],
            [-w, tf_bottom],
            [-bottom, tf_bottom],
        ];
        vec![ring.map(|[x, at]| [x, at - y]).to_vec()]
    }
}
