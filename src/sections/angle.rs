//! `angle`: an upright leg t × h and, at its foot, a level one to the overall width b, of the same thickness.

use super::build::radius;
use super::pieces::{Piece, Pieces, about_centroid};
use super::rectangles::{Band, plastic_modulus, torsion};
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// The angle of two legs.
pub struct Angle;

static FORMS: &[Form] = &[Form { kind: "angle", dimensions: &["b", "h", "t"] }];

impl Angle {
    fn pieces(graph: &mut Graph, given: &Given) -> Option<Pieces> {
        let [b, h, t] = *given.dimensions else { return None };
        let rest = graph.subtract(b, t);
        let [half_t, half_h, half_rest] = [t, h, rest].map(|length| graph.scale(0.5, length));
        let beside = graph.add(t, half_rest);
        let list = vec![Piece { sides: [t, h], middle: [half_t, half_h] }, Piece { sides: [rest, t], middle: [beside, half_t] }];
        Some(Pieces { list, extent: [b, h] })
    }
}

impl Kind for Angle {
    fn name(&self) -> &'static str {
        "angle"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/angle.toml")
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "b",
            "h",
            "t",
            "bi",
            "hi",
            "A",
            "Ix",
            "Iy",
            "Ixy",
            "Imin",
            "Wx",
            "Wx_top",
            "Wx_bottom",
            "Wy",
            "Wy_left",
            "Wy_right",
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "imin",
            "J",
            "x_left",
            "x_right",
            "y_top",
            "y_bottom",
            "perimeter",
            "width",
            "height",
        ]
    }

    /// `bi` and `hi` are the clear lengths of the legs; `Imin` and `imin` belong to the weaker principal axis.
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let [b, h, t] = *given.dimensions else { return None };
        let pieces = Angle::pieces(graph, given)?;
        Some(match name {
            "b" => b,
            "h" => h,
            "t" => t,
            "bi" => graph.subtract(b, t),
            "hi" => graph.subtract(h, t),
            "J" => {
                let rest = graph.subtract(b, t);
                torsion(graph, &[(h, t), (rest, t)])
            }
            "Wplx" => plastic(graph, b, h, t),
            "Wply" => plastic(graph, h, b, t),
            "perimeter" => {
                let sum = graph.add(b, h);
                graph.scale(2.0, sum)
            }
            _ => return pieces.property(graph, name).or_else(|| radius(self, graph, given, name)),
        })
    }

    /// The upright leg, and the level one beside it.
    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        Angle::pieces(graph, given).map_or_else(Vec::new, |pieces| pieces.areas(graph))
    }

    fn positive(&self) -> &'static [&'static str] {
        &["bi", "hi"]
    }

    fn rings(&self, form: &Form, given: &[f64], _: &[Ring], _: f64) -> Vec<Ring> {
        let [b, h, t] = *given else { return Vec::new() };
        let ring = [[0.0, 0.0], [b, 0.0], [b, t], [t, t], [t, h], [0.0, h]];
        about_centroid(self, form, given, &ring, "x_left")
    }
}

/// Bending up and down of a leg `width` along the axis, at whose edge the other one stands up to `height`.
fn plastic(graph: &mut Graph, width: NodeId, height: NodeId, t: NodeId) -> NodeId {
    let standing = graph.subtract(height, t);
    plastic_modulus(graph, &[Band { width, thickness: t }, Band { width: t, thickness: standing }])
}
