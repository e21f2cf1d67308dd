//! `channel`: a web tw × hw on the left of two flanges b × tf, whose width b takes the web in; overall height h = hw + 2·tf.

use super::build::{monomial, radius, symmetric_modulus};
use super::pieces::{Piece, Pieces, about_centroid};
use super::rectangles::{Band, plastic_between_flanges, plastic_modulus, torsion};
use super::{Form, Given, Kind, evaluate};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// The channel with level flanges.
pub struct Channel;

static FORMS: &[Form] = &[
    Form { kind: "channel", dimensions: &["tw", "hw", "b", "tf"] },
    Form { kind: "channel", dimensions: &["tw", "b", "tf", "h"] },
];

struct Shape {
    tw: NodeId,
    hw: NodeId,
    b: NodeId,
    tf: NodeId,
    h: NodeId,
}

impl Shape {
    fn of(graph: &mut Graph, given: &Given) -> Option<Shape> {
        let find = |name| given.form.dimensions.iter().position(|known| *known == name).map(|at| given.dimensions[at]);
        let (tw, b, tf) = (find("tw")?, find("b")?, find("tf")?);
        let both = graph.scale(2.0, tf);
        Some(match (find("hw"), find("h")) {
            (Some(hw), _) => Shape { tw, hw, b, tf, h: graph.add(hw, both) },
            (None, Some(h)) => Shape { tw, hw: graph.subtract(h, both), b, tf, h },
            (None, None) => return None,
        })
    }

    fn pieces(&self, graph: &mut Graph) -> Pieces {
        let [half_web, half_b, half_tf, half_h] = [self.tw, self.b, self.tf, self.h].map(|length| graph.scale(0.5, length));
        let top = graph.subtract(self.h, half_tf);
        let flange = [self.b, self.tf];
        let list = vec![
            Piece { sides: [self.tw, self.hw], middle: [half_web, half_h] },
            Piece { sides: flange, middle: [half_b, half_tf] },
            Piece { sides: flange, middle: [half_b, top] },
        ];
        Pieces { list, extent: [self.b, self.h] }
    }

    /// tf·c³·k²/12·(3·c·tf + 2·k·tw)/(6·c·tf + k·tw), with c = b − tw/2 and k = h − tf along the middle lines.
    fn warping(&self, graph: &mut Graph) -> NodeId {
        let half = graph.scale(0.5, self.tw);
        let (c, k) = (graph.subtract(self.b, half), graph.subtract(self.h, self.tf));
        let (flange, web) = (graph.multiply(c, self.tf), graph.multiply(k, self.tw));
        let above = [graph.scale(3.0, flange), graph.scale(2.0, web)];
        let below = [graph.scale(6.0, flange), web];
        let (above, below) = (graph.sum(&above), graph.sum(&below));
        monomial(graph, 1.0 / 12.0, &[(self.tf, 1.0), (c, 3.0), (k, 2.0), (above, 1.0), (below, -1.0)])
    }

    fn plastic(&self, graph: &mut Graph) -> NodeId {
        let arm = graph.subtract(self.h, self.tf);
        plastic_between_flanges(graph, [self.b, self.tf, arm], [self.tw, self.hw], 1.0)
    }

    /// Across: the web with the flanges' ends over its whole height, then both flanges.
    fn plastic_across(&self, graph: &mut Graph) -> NodeId {
        let (flanges, beside) = (graph.scale(2.0, self.tf), graph.subtract(self.b, self.tw));
        let layers = [Band { width: self.h, thickness: self.tw }, Band { width: flanges, thickness: beside }];
        plastic_modulus(graph, &layers)
    }
}

impl Kind for Channel {
    fn name(&self) -> &'static str {
        "channel"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/channel.toml")
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "tw",
            "hw",
            "b",
            "tf",
            "h",
            "A",
            "Ix",
            "Iy",
            "Wx",
            "Wy",
            "Wy_left",
            "Wy_right",
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "J",
            "Iw",
            "x_left",
            "x_right",
            "perimeter",
            "width",
            "height",
        ]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let shape = Shape::of(graph, given)?;
        let pieces = shape.pieces(graph);
        Some(match name {
            "tw" => shape.tw,
            "hw" => shape.hw,
            "b" => shape.b,
            "tf" => shape.tf,
            "h" => shape.h,
            "Wx" => {
                let moment = pieces.moment(graph, 1);
                symmetric_modulus(graph, moment, shape.h)
            }
            "Wplx" => shape.plastic(graph),
            "Wply" => shape.plastic_across(graph),
            "J" => torsion(graph, &[(shape.hw, shape.tw), (shape.b, shape.tf), (shape.b, shape.tf)]),
            "Iw" => shape.warping(graph),
            // 2·h + 4·b − 2·tw
            "perimeter" => {
                let double = graph.scale(2.0, shape.b);
                let sum = graph.add(shape.h, double);
                let open = graph.subtract(sum, shape.tw);
                graph.scale(2.0, open)
            }
            // Where it is used to place the outline; by symmetry half the height.
            "y_bottom" => graph.scale(0.5, shape.h),
            "Ixy" | "Imin" | "Wx_top" | "Wx_bottom" | "y_top" => return None,
            _ => return pieces.property(graph, name).or_else(|| radius(self, graph, given, name)),
        })
    }

    /// Web, lower and upper flange.
    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        let Some(shape) = Shape::of(graph, given) else { return Vec::new() };
        let pieces = shape.pieces(graph);
        pieces.areas(graph)
    }

    fn positive(&self) -> &'static [&'static str] {
        &["hw"]
    }

    fn posynomial_volume(&self, form: &Form) -> bool {
        !form.dimensions.contains(&"h")
    }

    fn rings(&self, form: &Form, given: &[f64], _: &[Ring], _: f64) -> Vec<Ring> {
        let of = |name| evaluate(self, form, given, &[], name);
        let [Some(tw), Some(b), Some(tf), Some(h)] = [of("tw"), of("b"), of("tf"), of("h")] else { return Vec::new() };
        let ring = [[0.0, 0.0], [b, 0.0], [b, tf], [tw, tf], [tw, h - tf], [b, h - tf], [b, h], [0.0, h]];
        about_centroid(self, form, given, &ring, "x_left")
    }
}
