//! The outline of a thick polyline as nodes: vertices linear in the thicknesses, the polygon sums of note 2.5 over them.

use super::build::{extreme, monomial};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::{Binary, Unary};
use crate::geometry::Centreline;
use crate::geometry::polyline::OffsetVertex;

/// Rings of vertices as nodes, about the middle of the centre line.
pub(super) struct Outline {
    rings: Vec<Vec<[NodeId; 2]>>,
    /// Sides of the outline along the segments, as lengths.
    sides: Vec<NodeId>,
}

impl Outline {
    /// `None` where a segment has no thickness.
    pub(super) fn new(
        graph: &mut Graph,
        line: &Centreline,
        stepped: bool,
        thickness: impl Fn(usize) -> Option<NodeId>,
    ) -> Option<Self> {
        let each = (0..line.segments()).map(thickness).collect::<Option<Vec<_>>>()?;
        let middle = middle(line);
        let mut rings = Vec::new();
        for ring in line.outline(stepped) {
            let vertices: Vec<_> =
                ring.iter().map(|vertex| [0, 1].map(|d| coordinate(graph, vertex, middle, &each, d))).collect();
            rings.push(vertices);
        }
        let sides = line.sides_along(stepped).iter().map(|side| linear(graph, side.length, &side.terms, &each)).collect();
        Some(Outline { rings, sides })
    }

    /// Σ over the edges of a term in (x1, y1, x2, y2) and w = x1·y2 − x2·y1.
    fn sum(&self, graph: &mut Graph, term: impl Fn(&mut Graph, [[NodeId; 2]; 2]) -> NodeId) -> NodeId {
        let mut terms = Vec::new();
        for ring in &self.rings {
            for (p, q) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let (down, up) = (graph.multiply(p[0], q[1]), graph.multiply(q[0], p[1]));
                let w = graph.subtract(down, up);
                let factor = term(graph, [*p, *q]);
                terms.push(graph.multiply(w, factor));
            }
        }
        graph.sum(&terms)
    }

    pub(super) fn area(&self, graph: &mut Graph) -> NodeId {
        let sum = self.sum(graph, |graph, _| graph.constant(1.0));
        graph.scale(0.5, sum)
    }

    /// ∫x_d dA about the line's middle, d = 0 for x, 1 for y.
    fn first(&self, graph: &mut Graph, d: usize) -> NodeId {
        let sum = self.sum(graph, |graph, [p, q]| graph.add(p[d], q[d]));
        graph.scale(1.0 / 6.0, sum)
    }

    /// ∫x_d² dA about the centroid: Iy for d = 0, Ix for d = 1.
    pub(super) fn moment(&self, graph: &mut Graph, d: usize) -> NodeId {
        let sum = self.sum(graph, |graph, [p, q]| {
            let squares = [graph.power(p[d], 2.0), graph.multiply(p[d], q[d]), graph.power(q[d], 2.0)];
            graph.sum(&squares)
        });
        let about_middle = graph.scale(1.0 / 12.0, sum);
        let (first, area) = (self.first(graph, d), self.area(graph));
        let steiner = monomial(graph, 1.0, &[(first, 2.0), (area, -1.0)]);
        graph.subtract(about_middle, steiner)
    }

    /// ∫xy dA about the centroid.
    pub(super) fn product_moment(&self, graph: &mut Graph) -> NodeId {
        let sum = self.sum(graph, |graph, [[x1, y1], [x2, y2]]| {
            let (outer, inner) =
                ([graph.multiply(x1, y2), graph.multiply(x2, y1)], [graph.multiply(x1, y1), graph.multiply(x2, y2)]);
            let inner = inner.map(|product| graph.scale(2.0, product));
            graph.sum(&[outer, inner].concat())
        });
        let about_middle = graph.scale(1.0 / 24.0, sum);
        let (sx, sy, area) = (self.first(graph, 1), self.first(graph, 0), self.area(graph));
        let steiner = monomial(graph, 1.0, &[(sx, 1.0), (sy, 1.0), (area, -1.0)]);
        graph.subtract(about_middle, steiner)
    }

    /// The largest coordinate d (`sign` +1), or the negated smallest (−1).
    fn reach(&self, graph: &mut Graph, d: usize, sign: f64) -> Option<NodeId> {
        let signed: Vec<NodeId> = self
            .rings
            .first()?
            .iter()
            .map(|vertex| if sign > 0.0 { vertex[d] } else { graph.unary(Unary::Negate, vertex[d]) })
            .collect();
        extreme(graph, Binary::Max, &signed)
    }

    /// Moment over the distance from the centroid to the outermost vertex on one side.
    pub(super) fn modulus(&self, graph: &mut Graph, d: usize, sign: f64) -> Option<NodeId> {
        let (reach, first, area) = (self.reach(graph, d, sign)?, self.first(graph, d), self.area(graph));
        let centroid = monomial(graph, sign, &[(first, 1.0), (area, -1.0)]);
        let (distance, moment) = (graph.subtract(reach, centroid), self.moment(graph, d));
        Some(graph.divide(moment, distance))
    }

    /// Width (d = 0) or height (d = 1).
    pub(super) fn extent(&self, graph: &mut Graph, d: usize) -> Option<NodeId> {
        let (high, low) = (self.reach(graph, d, 1.0)?, self.reach(graph, d, -1.0)?);
        Some(graph.add(high, low))
    }

    /// The shortest side along a segment.
    pub(super) fn clear(&self, graph: &mut Graph) -> Option<NodeId> {
        extreme(graph, Binary::Min, &self.sides)
    }
}

/// The centroid of the centre line: close to the section's, against cancellation.
fn middle(line: &Centreline) -> [f64; 2] {
    let points = line.points();
    let ends = points.iter().zip(points.iter().cycle().skip(1)).take(line.segments());
    let weighted =
        |d: usize| ends.clone().enumerate().map(|(k, (p, q))| line.segment_length(k) * (p[d] + q[d]) / 2.0).sum::<f64>();
    [weighted(0) / line.length(), weighted(1) / line.length()]
}

fn coordinate(graph: &mut Graph, vertex: &OffsetVertex, middle: [f64; 2], each: &[NodeId], d: usize) -> NodeId {
    linear(graph, vertex.point[d] - middle[d], &vertex.terms.map(|(segment, by)| (segment, by[d])), each)
}

/// constant + Σ factor·thickness
fn linear(graph: &mut Graph, constant: f64, terms: &[(usize, f64)], each: &[NodeId]) -> NodeId {
    let mut sum = graph.constant(constant);
    for (segment, factor) in terms.iter().filter(|(_, factor)| *factor != 0.0) {
        let term = graph.scale(*factor, each[*segment]);
        sum = graph.add(sum, term);
    }
    sum
}
