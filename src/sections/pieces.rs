//! Sections put together from upright rectangles (`i-section`, `channel`, `angle`): what they have in common.
//!
//! Moments are sums over pairs of rectangles, a_i·a_j·(c_i − c_j)²/A, free of the cancellation of the parallel-axis theorem.

use super::build::monomial;
use super::{Form, Kind, evaluate};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::{Binary, Unary};
use crate::geometry::polygon::Ring;

/// An upright rectangle: its sides, and its middle from the lower left corner of the whole.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub sides: [NodeId; 2],
    pub middle: [NodeId; 2],
}

/// Rectangles that do not overlap, with the extents of the whole.
pub(super) struct Pieces {
    pub list: Vec<Piece>,
    pub extent: [NodeId; 2],
}

impl Pieces {
    pub fn areas(&self, graph: &mut Graph) -> Vec<NodeId> {
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
    pub fn moment(&self, graph: &mut Graph, d: usize) -> NodeId {
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
    pub fn property(&self, graph: &mut Graph, name: &str) -> Option<NodeId> {
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

/// The outline moved so that its centroid is the origin.
pub(super) fn about_centroid(kind: &dyn Kind, form: &Form, given: &[f64], ring: &[[f64; 2]], from_left: &str) -> Vec<Ring> {
    let of = |name| evaluate(kind, form, given, &[], name);
    let (Some(x), Some(y)) = (of(from_left), of("y_bottom")) else { return Vec::new() };
    vec![ring.iter().map(|point| [point[0] - x, point[1] - y]).collect()]
}
