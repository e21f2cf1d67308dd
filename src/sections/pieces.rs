//! Sections put together from upright rectangles: `i-section` (two different flanges), `channel`, `angle`.
//!
//! Moments are sums over pairs of rectangles, a_i·a_j·(c_i − c_j)²/A, free of the cancellation of the parallel-axis theorem.

use super::build::{monomial, radius};
use super::{Form, Given, Kind, evaluate};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::{Binary, Unary};
use crate::geometry::polygon::Ring;

/// An I with two different flanges: a web tw × hw between a flange b_top × tf_top and one b_bottom × tf_bottom.
pub struct ISection;

/// A channel: a web tw × hw on the left of two flanges b × tf, whose width b takes the web in; overall height h = hw + 2·tf.
pub struct Channel;

/// An angle: an upright leg t × h and, at its foot, a level one to the overall width b, of the same thickness.
pub struct Angle;

static I_SECTION: &[Form] = &[Form { kind: "i-section", dimensions: &["tw", "hw", "b_top", "tf_top", "b_bottom", "tf_bottom"] }];
static CHANNEL: &[Form] = &[
    Form { kind: "channel", dimensions: &["tw", "hw", "b", "tf"] },
    Form { kind: "channel", dimensions: &["tw", "b", "tf", "h"] },
];
static ANGLE: &[Form] = &[Form { kind: "angle", dimensions: &["b", "h", "t"] }];

/// An upright rectangle: its sides, and its middle from the lower left corner of the whole.
#[derive(Clone, Copy)]
struct Piece {
    sides: [NodeId; 2],
    middle: [NodeId; 2],
}

/// Rectangles that do not overlap, with the extents of the whole.
struct Pieces {
    list: Vec<Piece>,
    extent: [NodeId; 2],
}

impl Pieces {
    fn areas(&self, graph: &mut Graph) -> Vec<NodeId> {
        self.list.iter().map(|piece| graph.multiply(piece.sides[0], piece.sides[1])).collect()
    }

    fn area(&self, graph: &mut Graph) -> NodeId {
        let areas = self.areas(graph);
        graph.sum(&areas)
    }

    /// Σ over pairs of a_i·a_j·(c_i − c_j)·(d_i − d_j)/A, coordinates c and d.
    fn between(&self, graph: &mut Graph, c: usize, d: usize) -> NodeId {
        let (areas, area) = (self.areas(graph), self.area(graph));
        let mut terms = Vec::new();
        for i in 0..self.list.len() {
            for j in 0..i {
                let [first, second] = [c, d].map(|k| graph.subtract(self.list[i].middle[k], self.list[j].middle[k]));
                terms.push(monomial(graph, 1.0, &[(areas[i], 1.0), (areas[j], 1.0), (first, 1.0), (second, 1.0), (area, -1.0)]));
            }
        }
        graph.sum(&terms)
    }

    /// ∫x_d² dA about the centroid: Iy for d = 0, Ix for d = 1.
    fn moment(&self, graph: &mut Graph, d: usize) -> NodeId {
        let own: Vec<NodeId> = self
            .list
            .iter()
            .map(|piece| monomial(graph, 1.0 / 12.0, &[(piece.sides[1 - d], 1.0), (piece.sides[d], 3.0)]))
            .collect();
        let (own, between) = (graph.sum(&own), self.between(graph, d, d));
        graph.add(own, between)
    }

    /// The centroid's distance from the left (d = 0) or lower edge (d = 1).
    fn centroid(&self, graph: &mut Graph, d: usize) -> NodeId {
        let areas = self.areas(graph);
        let firsts: Vec<NodeId> =
            areas.iter().zip(&self.list).map(|(area, piece)| graph.multiply(*area, piece.middle[d])).collect();
        let (first, area) = (graph.sum(&firsts), self.area(graph));
        graph.divide(first, area)
    }

    /// The centroid's distance from the right or upper edge.
    fn beyond(&self, graph: &mut Graph, d: usize) -> NodeId {
        let centroid = self.centroid(graph, d);
        graph.subtract(self.extent[d], centroid)
    }

    /// Moment over the distance to one edge.
    fn modulus(&self, graph: &mut Graph, d: usize, beyond: bool) -> NodeId {
        let distance = if beyond { self.beyond(graph, d) } else { self.centroid(graph, d) };
        let moment = self.moment(graph, d);
        graph.divide(moment, distance)
    }

    fn smaller_modulus(&self, graph: &mut Graph, d: usize) -> NodeId {
        let (low, high) = (self.modulus(graph, d, false), self.modulus(graph, d, true));
        graph.binary(Binary::Min, low, high)
    }

    /// (Ix + Iy)/2 − √(((Ix − Iy)/2)² + Ixy²)
    fn least_moment(&self, graph: &mut Graph) -> NodeId {
        let (ix, iy, ixy) = (self.moment(graph, 1), self.moment(graph, 0), self.between(graph, 0, 1));
        let (sum, difference) = (graph.add(ix, iy), graph.subtract(ix, iy));
        let squares = [monomial(graph, 0.25, &[(difference, 2.0)]), graph.power(ixy, 2.0)];
        let square = graph.sum(&squares);
        let (half, root) = (graph.scale(0.5, sum), graph.unary(Unary::Sqrt, square));
        graph.subtract(half, root)
    }

    /// What all three kinds offer besides their own dimensions.
    fn property(&self, graph: &mut Graph, name: &str) -> Option<NodeId> {
        Some(match name {
            "A" => self.area(graph),
            "Ix" => self.moment(graph, 1),
            "Iy" => self.moment(graph, 0),
            "Ixy" => self.between(graph, 0, 1),
            "Imin" => self.least_moment(graph),
            "Wx" => self.smaller_modulus(graph, 1),
            "Wx_top" => self.modulus(graph, 1, true),
            "Wx_bottom" => self.modulus(graph, 1, false),
            "Wy" => self.smaller_modulus(graph, 0),
            "Wy_left" => self.modulus(graph, 0, false),
            "Wy_right" => self.modulus(graph, 0, true),
            "x_left" => self.centroid(graph, 0),
            "x_right" => self.beyond(graph, 0),
            "y_bottom" => self.centroid(graph, 1),
            "y_top" => self.beyond(graph, 1),
            "width" => self.extent[0],
            "height" => self.extent[1],
            _ => return None,
        })
    }
}

/// Σ length·thickness³/3: thin walls without fillets.
fn torsion(graph: &mut Graph, walls: &[(NodeId, NodeId)]) -> NodeId {
    let terms: Vec<NodeId> =
        walls.iter().map(|(length, thickness)| monomial(graph, 1.0 / 3.0, &[(*length, 1.0), (*thickness, 3.0)])).collect();
    graph.sum(&terms)
}

/// The outline moved so that its centroid is the origin.
fn about_centroid(kind: &dyn Kind, form: &Form, given: &[f64], ring: &[[f64; 2]], from_left: &str) -> Vec<Ring> {
    let of = |name| evaluate(kind, form, given, &[], name);
    let (Some(x), Some(y)) = (of(from_left), of("y_bottom")) else { return Vec::new() };
    vec![ring.iter().map(|point| [point[0] - x, point[1] - y]).collect()]
}

struct IShape {
    tw: NodeId,
    hw: NodeId,
    top: [NodeId; 2],
    bottom: [NodeId; 2],
    h: NodeId,
}

impl IShape {
    fn of(graph: &mut Graph, given: &Given) -> Option<IShape> {
        let [tw, hw, b_top, tf_top, b_bottom, tf_bottom] = *given.dimensions else { return None };
        let h = graph.sum(&[hw, tf_top, tf_bottom]);
        Some(IShape { tw, hw, top: [b_top, tf_top], bottom: [b_bottom, tf_bottom], h })
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
        I_SECTION
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
        let shape = IShape::of(graph, given)?;
        let pieces = shape.pieces(graph);
        Some(match name {
            "h" => shape.h,
            "Wy" => {
                let (moment, width) = (pieces.moment(graph, 0), pieces.extent[0]);
                super::build::symmetric_modulus(graph, moment, width)
            }
            "J" => torsion(graph, &[(shape.hw, shape.tw), (shape.top[0], shape.top[1]), (shape.bottom[0], shape.bottom[1])]),
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
        let Some(shape) = IShape::of(graph, given) else { return Vec::new() };
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

struct ChannelShape {
    tw: NodeId,
    hw: NodeId,
    b: NodeId,
    tf: NodeId,
    h: NodeId,
}

impl ChannelShape {
    fn of(graph: &mut Graph, given: &Given) -> Option<ChannelShape> {
        let find = |name| given.form.dimensions.iter().position(|known| *known == name).map(|at| given.dimensions[at]);
        let (tw, b, tf) = (find("tw")?, find("b")?, find("tf")?);
        let both = graph.scale(2.0, tf);
        Some(match (find("hw"), find("h")) {
            (Some(hw), _) => ChannelShape { tw, hw, b, tf, h: graph.add(hw, both) },
            (None, Some(h)) => ChannelShape { tw, hw: graph.subtract(h, both), b, tf, h },
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

    /// b·tf·(h − tf) + tw·hw²/4
    fn plastic(&self, graph: &mut Graph) -> NodeId {
        let arm = graph.subtract(self.h, self.tf);
        let flanges = monomial(graph, 1.0, &[(self.b, 1.0), (self.tf, 1.0), (arm, 1.0)]);
        let web = monomial(graph, 0.25, &[(self.tw, 1.0), (self.hw, 2.0)]);
        graph.add(flanges, web)
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
        CHANNEL
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
        let shape = ChannelShape::of(graph, given)?;
        let pieces = shape.pieces(graph);
        Some(match name {
            "tw" => shape.tw,
            "hw" => shape.hw,
            "b" => shape.b,
            "tf" => shape.tf,
            "h" => shape.h,
            "Wx" => {
                let moment = pieces.moment(graph, 1);
                super::build::symmetric_modulus(graph, moment, shape.h)
            }
            "Wplx" => shape.plastic(graph),
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
        let Some(shape) = ChannelShape::of(graph, given) else { return Vec::new() };
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
        ANGLE
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
