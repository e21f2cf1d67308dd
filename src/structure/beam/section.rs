//! The section along a member: dimensions vary linearly from one end to the other.

use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;
use crate::sections::{self, Form, Given};

/// Sections of one form at both ends.
#[derive(Debug, Clone, Copy)]
pub struct Tapered<'a> {
    /// The form both are given in.
    pub form: &'static Form,
    /// Points, for kinds drawn by points.
    pub outline: &'a [Ring],
    /// Dimensions at the start, in the form's order.
    pub start: &'a [NodeId],
    /// Dimensions at the end.
    pub end: &'a [NodeId],
}

impl Tapered<'_> {
    /// Whether both ends are alike.
    pub fn is_prismatic(&self) -> bool {
        self.start == self.end
    }

    /// The dimensions at the fraction x.
    pub fn dimensions(&self, graph: &mut Graph, x: f64) -> Vec<NodeId> {
        if x == 0.0 || self.is_prismatic() {
            return self.start.to_vec();
        }
        if x == 1.0 {
            return self.end.to_vec();
        }
        let between = |(&start, &end): (&NodeId, &NodeId)| {
            if start == end {
                return start;
            }
            let (start, end) = (graph.scale(1.0 - x, start), graph.scale(x, end));
            graph.add(start, end)
        };
        self.start.iter().zip(self.end).map(between).collect()
    }

    /// A property at the fraction x; `None` where the kind does not offer it.
    pub fn offered(&self, graph: &mut Graph, x: f64, name: &str) -> Option<NodeId> {
        let dimensions = self.dimensions(graph, x);
        let given = Given { form: self.form, dimensions: &dimensions, outline: self.outline };
        if let Some(at) = self.form.dimensions.iter().position(|given| *given == name) {
            return Some(dimensions[at]);
        }
        sections::kind(self.form.kind)?.property(graph, &given, name)
    }

    /// A property that the reader has found the kind to offer; no number where it does not.
    pub fn property(&self, graph: &mut Graph, x: f64, name: &str) -> NodeId {
        self.offered(graph, x, name).unwrap_or_else(|| graph.constant(f64::NAN))
    }

    /// c0, c1, c2 of A(ξ) = c0 + c1·ξ + c2·ξ² through the areas at both ends and in the middle: exact for areas that are products
    /// of two dimensions.
    pub fn area_coefficients(&self, graph: &mut Graph) -> Vec<NodeId> {
        let start = self.property(graph, 0.0, "A");
        if self.is_prismatic() {
            return vec![start];
        }
        let (middle, end) = (self.property(graph, 0.5, "A"), self.property(graph, 1.0, "A"));
        let mut combined = |factors: [f64; 3]| {
            let parts =
                [(factors[0], start), (factors[1], middle), (factors[2], end)].map(|(factor, area)| graph.scale(factor, area));
            graph.sum(&parts)
        };
        let (linear, quadratic) = (combined([-3.0, 4.0, -1.0]), combined([2.0, -4.0, 2.0]));
        vec![start, linear, quadratic]
    }

    /// ∫A dξ.
    pub fn mean_area(&self, graph: &mut Graph) -> NodeId {
        let coefficients = self.area_coefficients(graph).into_iter().enumerate();
        let parts: Vec<NodeId> = coefficients.map(|(power, area)| graph.scale(1.0 / (power as f64 + 1.0), area)).collect();
        graph.sum(&parts)
    }
}
