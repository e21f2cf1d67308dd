//! Bending in one plane of a member: moments and shear forces from the rotations of its ends against the chord, and deflections.

use super::Beam;
use crate::expression::graph::{Graph, NodeId};
use crate::structure::algebra::Algebra;
use crate::structure::loads::{Term, Way};

/// One plane of bending.
pub struct Bending<'b, 'a> {
    beam: &'b Beam<'a>,
    way: Way,
    /// The section's moment of inertia and its shear area in this plane.
    inertia: &'static str,
    shear_area: &'static str,
    /// The component of the moment at the start; that at the end follows.
    first: usize,
}

impl<'b, 'a> Bending<'b, 'a> {
    /// The plane x–z: My, Vz, Ix.
    pub fn vertical(beam: &'b Beam<'a>) -> Self {
        Bending { beam, way: Way::Vertical, inertia: "Ix", shear_area: "Asy", first: 3 }
    }

    /// The plane x–y: Mz, Vy, Iy.
    pub fn lateral(beam: &'b Beam<'a>) -> Self {
        Bending { beam, way: Way::Lateral, inertia: "Iy", shear_area: "Asx", first: 1 }
    }

    fn terms(&self, graph: &mut Graph) -> Vec<Term<NodeId>> {
        self.beam.terms(graph).into_iter().filter(|term| term.way == self.way).collect()
    }

    fn keeps(&self, end: usize) -> bool {
        self.beam.components[self.first + end]
    }

    /// b_end(x): the moment at x from a unit moment at one end.
    fn influence(end: usize, x: f64) -> f64 {
        if end == 0 { 1.0 - x } else { x }
    }

    /// The moment at the start (`end` 0) or at the end (1).
    pub fn end_moment(&self, graph: &mut Graph, end: usize) -> NodeId {
        if !self.keeps(end) {
            return graph.constant(0.0);
        }
        if let Some(forces) = self.beam.forces {
            return forces[self.first + end];
        }
        match self.beam.section.is_prismatic() && !self.beam.deforms_in_shear {
            true => self.prismatic(graph, end),
            false => self.by_flexibility(graph, end),
        }
    }

    /// EI/L·(4e_i − 2e_j), or 3EI/L·e_i where the other end is released, less the same of the loads' deformations, which are polynomials
    /// over EI: E and I cancel there.
    fn prismatic(&self, graph: &mut Graph, end: usize) -> NodeId {
        let beam = self.beam;
        let factors = if self.keeps(1 - end) { [4.0, -2.0] } else { [3.0, 0.0] };
        let inertia = beam.section.property(graph, 0.0, self.inertia);
        let stiffness = graph.multiply(beam.young, inertia);
        let stiffness = graph.divide(stiffness, beam.length);
        let mut rotation = Vec::new();
        for (which, factor) in [(end, factors[0]), (1 - end, factors[1])] {
            rotation.push(Algebra::scale(graph, factor, beam.deformations[self.first + which]));
        }
        if let Some(curvature) = self.free_curvature(graph, 0.0) {
            // v_i = v_j = κ0·L/2
            let turned = graph.multiply(curvature, beam.length);
            rotation.push(graph.scale(-0.5 * (factors[0] + factors[1]), turned));
        }
        let rotation = graph.sum(&rotation);
        let mut moment = vec![Algebra::multiply(graph, stiffness, rotation)];
        let terms = self.terms(graph);
        let points = beam.quadrature(&terms, None);
        for term in &terms {
            let integral = |which: usize| -> f64 {
                points.iter().map(|&(x, weight)| weight * Self::influence(which, x) * term.spread.moment(x)).sum()
            };
            let fixed = factors[0] * integral(end) + factors[1] * integral(1 - end);
            moment.push(graph.scale(-fixed, term.value));
        }
        graph.sum(&moment)
    }

    /// q = f⁻¹(e − v), of the components that are kept.
    fn by_flexibility(&self, graph: &mut Graph, end: usize) -> NodeId {
        let terms = self.terms(graph);
        let points = self.beam.quadrature(&terms, None);
        let rest = |graph: &mut Graph, which: usize| {
            let free = self.free_rotation(graph, &terms, &points, which);
            graph.subtract(self.beam.deformations[self.first + which], free)
        };
        let own = self.flexibility(graph, &points, end, end);
        let rotation = rest(graph, end);
        if !self.keeps(1 - end) {
            return graph.divide(rotation, own);
        }
        let (other, across) = (self.flexibility(graph, &points, 1 - end, 1 - end), self.flexibility(graph, &points, 0, 1));
        let beyond = rest(graph, 1 - end);
        let (forth, back) = (graph.multiply(other, rotation), graph.multiply(across, beyond));
        let numerator = graph.subtract(forth, back);
        let (product, square) = (graph.multiply(own, other), graph.multiply(across, across));
        let determinant = graph.subtract(product, square);
        graph.divide(numerator, determinant)
    }

    /// ∫b_i·b_j/EI dx, and with shear ±1/L²·∫dx/(G·A_s).
    fn flexibility(&self, graph: &mut Graph, points: &[(f64, f64)], i: usize, j: usize) -> NodeId {
        let weight = |x: f64| Self::influence(i, x) * Self::influence(j, x);
        let bending = self.integral(graph, points, self.inertia, self.beam.young, &|_, x| Some(Weight::Number(weight(x))));
        if !self.beam.deforms_in_shear {
            return bending;
        }
        let sign = if i == j { 1.0 } else { -1.0 };
        let shear_modulus = self.shear_modulus(graph);
        let shear = self.integral(graph, points, self.shear_area, shear_modulus, &|_, _| Some(Weight::Number(sign)));
        let per_length = graph.divide(shear, self.beam.length);
        let per_length = graph.divide(per_length, self.beam.length);
        graph.add(bending, per_length)
    }

    /// v: ∫b·(M_p/EI + κ0)dx, and with shear ∓1/L·∫V_p/(G·A_s)dx.
    fn free_rotation(&self, graph: &mut Graph, terms: &[Term<NodeId>], points: &[(f64, f64)], end: usize) -> NodeId {
        let mut parts = Vec::new();
        if !terms.is_empty() {
            let moment = |graph: &mut Graph, x: f64| {
                let moment = sum_of(graph, terms, &|term| Self::influence(end, x) * term.spread.moment(x));
                Some(Weight::Node(moment))
            };
            parts.push(self.integral(graph, points, self.inertia, self.beam.young, &moment));
            if self.beam.deforms_in_shear {
                let sign = if end == 0 { -1.0 } else { 1.0 };
                // V_p = value/L·m', and the factor 1/L of b_V.
                let force =
                    |graph: &mut Graph, x: f64| Some(Weight::Node(sum_of(graph, terms, &|term| sign * term.spread.shear(x))));
                let shear_modulus = self.shear_modulus(graph);
                let shear = self.integral(graph, points, self.shear_area, shear_modulus, &force);
                let shear = graph.divide(shear, self.beam.length);
                parts.push(graph.divide(shear, self.beam.length));
            }
        }
        parts.extend(self.free_curvature_integral(graph, points, &|x| Self::influence(end, x)));
        graph.sum(&parts)
    }

    /// L·∫weight·κ0 dξ, where a gradient of temperature bends the member.
    fn free_curvature_integral(&self, graph: &mut Graph, points: &[(f64, f64)], weight: &dyn Fn(f64) -> f64) -> Option<NodeId> {
        let mut parts = Vec::new();
        for &(x, share) in points {
            let curvature = self.free_curvature(graph, x)?;
            parts.push(graph.scale(share * weight(x), curvature));
        }
        let sum = graph.sum(&parts);
        Some(graph.multiply(sum, self.beam.length))
    }

    /// κ0 = −α·ΔT/height.
    fn free_curvature(&self, graph: &mut Graph, x: f64) -> Option<NodeId> {
        let gradient = self.beam.loads.gradient.filter(|_| self.way == Way::Vertical)?;
        let height = self.beam.section.property(graph, x, "height");
        let curvature = graph.divide(gradient, height);
        Some(graph.scale(-1.0, curvature))
    }

    fn shear_modulus(&self, graph: &mut Graph) -> NodeId {
        self.beam.shear.unwrap_or_else(|| graph.constant(f64::NAN))
    }

    /// L/k·∫weight/P dξ for a property P of the section and a modulus k.
    fn integral(
        &self,
        graph: &mut Graph,
        points: &[(f64, f64)],
        property: &str,
        modulus: NodeId,
        weight: &dyn Fn(&mut Graph, f64) -> Option<Weight>,
    ) -> NodeId {
        let prismatic = self.beam.section.is_prismatic();
        let (mut parts, mut number) = (Vec::new(), 0.0);
        for &(x, share) in points {
            let node = match weight(graph, x) {
                None => continue,
                Some(Weight::Number(factor)) if prismatic => {
                    number += share * factor;
                    continue;
                }
                Some(Weight::Number(factor)) => graph.constant(share * factor),
                Some(Weight::Node(node)) => graph.scale(share, node),
            };
            parts.push(if prismatic {
                node
            } else {
                let value = self.beam.section.property(graph, x, property);
                Algebra::divide(graph, node, value)
            });
        }
        if number != 0.0 {
            parts.push(graph.constant(number));
        }
        let mut integral = graph.sum(&parts);
        if prismatic {
            let value = self.beam.section.property(graph, 0.0, property);
            integral = Algebra::divide(graph, integral, value);
        }
        let integral = Algebra::multiply(graph, integral, self.beam.length);
        Algebra::divide(graph, integral, modulus)
    }

    /// M(x) = M_i(1 − x) + M_j·x + M_p(x).
    pub fn moment(&self, graph: &mut Graph, x: f64) -> NodeId {
        let mut parts = Vec::new();
        for end in 0..2 {
            let influence = Self::influence(end, x);
            if influence != 0.0 {
                let moment = self.end_moment(graph, end);
                parts.push(graph.scale(influence, moment));
            }
        }
        let terms = self.terms(graph);
        parts.push(sum_of(graph, &terms, &|term| term.spread.moment(x)));
        graph.sum(&parts)
    }

    /// M(x)/EI, of an unloaded member.
    pub fn curvature(&self, graph: &mut Graph, x: f64) -> NodeId {
        let moment = self.moment(graph, x);
        let inertia = self.beam.section.property(graph, x, self.inertia);
        let stiffness = Algebra::multiply(graph, self.beam.young, inertia);
        Algebra::divide(graph, moment, stiffness)
    }

    /// V(x) = (M_j − M_i)/L + V_p(x).
    pub fn shear_force(&self, graph: &mut Graph, x: f64) -> NodeId {
        let (start, end) = (self.end_moment(graph, 0), self.end_moment(graph, 1));
        let difference = graph.subtract(end, start);
        let terms = self.terms(graph);
        let loads = sum_of(graph, &terms, &|term| term.spread.shear(x));
        let both = graph.add(difference, loads);
        Algebra::divide(graph, both, self.beam.length)
    }

    /// The deflection from the chord at x: −∫G(x, s)(M/EI + κ0)ds + ∫V·v̄/(G·A_s)ds with v̄ = −(1 − x) left of x and x right of it.
    pub fn deflection(&self, graph: &mut Graph, x: f64) -> NodeId {
        let terms = self.terms(graph);
        let points = self.beam.quadrature(&terms, Some(x));
        // G(x, s)/L
        let green = |s: f64| if x <= s { x * (1.0 - s) } else { s * (1.0 - x) };
        let ends = [self.end_moment(graph, 0), self.end_moment(graph, 1)];
        let curvature = |graph: &mut Graph, s: f64| {
            let mut parts = vec![sum_of(graph, &terms, &|term| -green(s) * term.spread.moment(s))];
            for (end, &moment) in ends.iter().enumerate() {
                parts.push(Algebra::scale(graph, -green(s) * Self::influence(end, s), moment));
            }
            Some(Weight::Node(graph.sum(&parts)))
        };
        let bending = self.integral(graph, &points, self.inertia, self.beam.young, &curvature);
        let bending = graph.multiply(bending, self.beam.length);
        let mut parts = vec![bending];
        if let Some(free) = self.free_curvature_integral(graph, &points, &|s| -green(s)) {
            parts.push(graph.multiply(free, self.beam.length));
        }
        if self.beam.deforms_in_shear {
            let force = |graph: &mut Graph, s: f64| {
                let side = if s < x { x - 1.0 } else { x };
                let (forward, back) = (graph.scale(side, ends[1]), graph.scale(-side, ends[0]));
                let loads = sum_of(graph, &terms, &|term| side * term.spread.shear(s));
                Some(Weight::Node(graph.sum(&[forward, back, loads])))
            };
            let shear_modulus = self.shear_modulus(graph);
            let shear = self.integral(graph, &points, self.shear_area, shear_modulus, &force);
            parts.push(Algebra::divide(graph, shear, self.beam.length));
        }
        graph.sum(&parts)
    }
}

/// What an integrand has above the property.
enum Weight {
    Number(f64),
    Node(NodeId),
}

/// Σ factor(term)·value.
fn sum_of(graph: &mut Graph, terms: &[Term<NodeId>], factor: &dyn Fn(&Term<NodeId>) -> f64) -> NodeId {
    let parts: Vec<NodeId> = terms.iter().map(|term| Algebra::scale(graph, factor(term), term.value)).collect();
    graph.sum(&parts)
}
