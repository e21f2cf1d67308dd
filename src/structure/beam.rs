//! A straight member, prismatic or with linearly varying dimensions, as expression graphs: basic forces from deformations.

mod bending;
mod piece;
mod section;

use super::algebra::Algebra;
use super::loads::{MemberLoads, Spread, Term, Way};
use super::quadrature;
use crate::expression::graph::{Graph, NodeId};
use crate::sections;
pub use bending::Bending;
pub use piece::Piece;
pub use section::Tapered;

/// Which of the basic forces N, Mz_i, Mz_j, My_i, My_j, T a member can carry; the others are released.
pub type Components = [bool; 6];

/// A member with everything its forces depend on as nodes of one graph.
pub struct Beam<'a> {
    /// Its section along the length.
    pub section: Tapered<'a>,
    /// Its length L.
    pub length: NodeId,
    /// E.
    pub young: NodeId,
    /// G, where the material has one.
    pub shear: Option<NodeId>,
    /// What it can carry.
    pub components: Components,
    /// Whether shear deforms it.
    pub deforms_in_shear: bool,
    /// Where the integrals over its length are cut because of its taper.
    pub grading: &'a [f64],
    /// Points on each part between cuts where it tapers.
    pub points: usize,
    /// The loads of the case or combination.
    pub loads: MemberLoads<NodeId>,
    /// The deformations e of the case or combination.
    pub deformations: [NodeId; 6],
    /// The basic forces, where they are known already.
    pub forces: Option<[NodeId; 6]>,
}

/// Internal forces at a station.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Force {
    N,
    Vy,
    Vz,
    T,
    My,
    Mz,
}

impl Force {
    /// All of them, by name.
    pub const NAMED: [(&'static str, Force); 6] =
        [("N", Force::N), ("Vy", Force::Vy), ("Vz", Force::Vz), ("T", Force::T), ("My", Force::My), ("Mz", Force::Mz)];
}

impl Beam<'_> {
    /// Every load as terms, the member's own weight among them: with an area that is quadratic along the length it is three.
    pub fn terms(&self, graph: &mut Graph) -> Vec<Term<NodeId>> {
        let mut terms = self.loads.terms.clone();
        let Some(weight) = self.loads.weight else { return terms };
        for (power, coefficient) in self.section.area_coefficients(graph).into_iter().enumerate() {
            let axial = Algebra::multiply(graph, self.length, coefficient);
            let transverse = Algebra::multiply(graph, self.length, axial);
            let ways =
                [(Way::Axial, weight[0], axial), (Way::Lateral, weight[1], transverse), (Way::Vertical, weight[2], transverse)];
            for (way, component, factor) in ways {
                let value = Algebra::multiply(graph, component, factor);
                if graph.as_constant(value) != Some(0.0) {
                    terms.push(Term { way, spread: Spread::Power(power as u32), value });
                }
            }
        }
        terms
    }

    /// Points and weights for integrals over the length, cut also at `more`.
    fn quadrature(&self, terms: &[Term<NodeId>], more: Option<f64>) -> Vec<(f64, f64)> {
        let loads = terms.iter().flat_map(|term| term.spread.breaks());
        let mut breaks: Vec<f64> =
            self.grading.iter().copied().chain(loads).chain(more.filter(|&x| x > 0.0 && x < 1.0)).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        quadrature::pieces(&breaks, self.points())
    }

    /// Points on each part between cuts.
    fn points(&self) -> usize {
        if self.section.is_prismatic() { quadrature::POLYNOMIAL } else { self.points }
    }

    /// The basic force number `component` (0 where it is released).
    pub fn basic_force(&self, graph: &mut Graph, component: usize) -> NodeId {
        if !self.components[component] {
            return graph.constant(0.0);
        }
        if let Some(forces) = self.forces {
            return forces[component];
        }
        match component {
            0 => self.axial(graph),
            5 => self.torsion(graph),
            at => {
                let bending = if at < 3 { Bending::lateral(self) } else { Bending::vertical(self) };
                bending.end_moment(graph, (at - 1) % 2)
            }
        }
    }

    /// N = (e_N − v_N)/f_N with f_N = ∫dx/EA.
    fn axial(&self, graph: &mut Graph) -> NodeId {
        let mut deformation = self.deformations[0];
        if let Some(strain) = self.loads.strain {
            let free = graph.multiply(strain, self.length);
            deformation = graph.subtract(deformation, free);
        }
        let force = self.rod_force(graph, Way::Axial, deformation, self.young, "A");
        match self.loads.pretension {
            Some(pretension) => graph.add(force, pretension),
            None => force,
        }
    }

    /// T = (e_T − v_T)/f_T with f_T = ∫dx/GJ.
    fn torsion(&self, graph: &mut Graph) -> NodeId {
        let shear = self.shear.unwrap_or_else(|| graph.constant(f64::NAN));
        self.rod_force(graph, Way::Torque, self.deformations[5], shear, "J")
    }

    /// The constant part S of a force that is S + S_p along the length, from the deformation it makes: (deformation − ∫S_p/(k·P)dx) over
    /// ∫dx/(k·P), P a property of the section.
    fn rod_force(&self, graph: &mut Graph, way: Way, deformation: NodeId, modulus: NodeId, property: &str) -> NodeId {
        let terms: Vec<Term<NodeId>> = self.terms(graph).into_iter().filter(|term| term.way == way).collect();
        let points = self.quadrature(&terms, None);
        if self.section.is_prismatic() {
            // k·P/L·deformation − mean of S_p: a member whose area vanishes carries nothing.
            let value = self.section.property(graph, 0.0, property);
            let stiffness = graph.multiply(modulus, value);
            let stiffness = graph.divide(stiffness, self.length);
            let force = graph.multiply(stiffness, deformation);
            let mut means = vec![force];
            for term in &terms {
                let mean: f64 = points.iter().map(|&(x, weight)| weight * term.spread.axial(x)).sum();
                means.push(graph.scale(-mean, term.value));
            }
            return graph.sum(&means);
        }
        let (mut flexibility, mut free) = (Vec::new(), Vec::new());
        for (x, weight) in points {
            let (value, weight) = (self.section.property(graph, x, property), graph.constant(weight));
            let share = graph.divide(weight, value);
            flexibility.push(share);
            for term in &terms {
                let force = Algebra::scale(graph, term.spread.axial(x), term.value);
                free.push(Algebra::multiply(graph, force, share));
            }
        }
        // Both integrals times L/k.
        let (flexibility, free) = (graph.sum(&flexibility), graph.sum(&free));
        let per_length = graph.multiply(deformation, modulus);
        let per_length = graph.divide(per_length, self.length);
        let rest = graph.subtract(per_length, free);
        graph.divide(rest, flexibility)
    }

    /// An internal force at the fraction x of the length.
    pub fn force(&self, graph: &mut Graph, which: Force, x: f64) -> NodeId {
        match which {
            Force::N => self.rod_force_at(graph, 0, Way::Axial, x),
            Force::T => self.rod_force_at(graph, 5, Way::Torque, x),
            Force::My => Bending::vertical(self).moment(graph, x),
            Force::Mz => Bending::lateral(self).moment(graph, x),
            Force::Vz => Bending::vertical(self).shear_force(graph, x),
            Force::Vy => Bending::lateral(self).shear_force(graph, x),
        }
    }

    fn rod_force_at(&self, graph: &mut Graph, component: usize, way: Way, x: f64) -> NodeId {
        let mut parts = vec![self.basic_force(graph, component)];
        for term in self.terms(graph).iter().filter(|term| term.way == way) {
            parts.push(Algebra::scale(graph, term.spread.axial(x), term.value));
        }
        graph.sum(&parts)
    }

    /// The forces its supports exert on the simply supported member: at the start along its x, y, z and about x, at the end along y and
    /// z; member axes.
    pub fn support_forces(&self, graph: &mut Graph) -> [NodeId; 6] {
        let terms = self.terms(graph);
        let mut sum = |way: Way, factor: &dyn Fn(Spread) -> f64, per_length: bool| {
            let parts: Vec<NodeId> =
                terms.iter().filter(|term| term.way == way).map(|term| graph.scale(factor(term.spread), term.value)).collect();
            let sum = graph.sum(&parts);
            if per_length { Algebra::divide(graph, sum, self.length) } else { sum }
        };
        [
            sum(Way::Axial, &|spread| -spread.axial(0.0), false),
            sum(Way::Lateral, &|spread| spread.shear(0.0), true),
            sum(Way::Vertical, &|spread| spread.shear(0.0), true),
            sum(Way::Torque, &|spread| -spread.axial(0.0), false),
            sum(Way::Lateral, &|spread| -spread.shear(1.0), true),
            sum(Way::Vertical, &|spread| -spread.shear(1.0), true),
        ]
    }
}

impl Beam<'_> {
    /// σ = N/A − My·Y/Ix − Mz·X/Iy at a point of the section.
    pub fn stress(&self, graph: &mut Graph, x: f64, point: &str) -> NodeId {
        let Some(fibre) = self.fibre(graph, x, point) else { return graph.constant(f64::NAN) };
        let mut parts = vec![self.axial_stress(graph, x)];
        let planes = [(Force::My, fibre.y, "Ix", [3, 4]), (Force::Mz, fibre.x, "Iy", [1, 2])];
        for (moment, distance, inertia, components) in planes {
            if components.iter().any(|&component| self.components[component]) && graph.as_constant(distance) != Some(0.0) {
                let (moment, inertia) = (self.force(graph, moment, x), self.section.property(graph, x, inertia));
                let share = Algebra::multiply(graph, moment, distance);
                let share = Algebra::divide(graph, share, inertia);
                parts.push(graph.scale(-1.0, share));
            }
        }
        graph.sum(&parts)
    }

    /// N/A. Of a prismatic member it is E·(e_N/L − strain) and what its loads add: the area cancels, and a bar's stress is linear in the
    /// displacements.
    fn axial_stress(&self, graph: &mut Graph, x: f64) -> NodeId {
        let area = self.section.property(graph, x, "A");
        if !self.section.is_prismatic() || !self.components[0] || self.forces.is_some() {
            let force = self.force(graph, Force::N, x);
            return Algebra::divide(graph, force, area);
        }
        let mut strain = graph.divide(self.deformations[0], self.length);
        if let Some(free) = self.loads.strain {
            strain = graph.subtract(strain, free);
        }
        let mut parts = vec![graph.multiply(self.young, strain)];
        let terms: Vec<Term<NodeId>> = self.terms(graph).into_iter().filter(|term| term.way == Way::Axial).collect();
        let points = self.quadrature(&terms, None);
        let mut loads: Vec<NodeId> = self.loads.pretension.into_iter().collect();
        for term in &terms {
            let mean: f64 = points.iter().map(|&(at, weight)| weight * term.spread.axial(at)).sum();
            loads.push(graph.scale(term.spread.axial(x) - mean, term.value));
        }
        if !loads.is_empty() {
            let loads = graph.sum(&loads);
            parts.push(Algebra::divide(graph, loads, area));
        }
        graph.sum(&parts)
    }

    /// τ at a point of the section: of the shear forces, and of torsion times `sign`.
    pub fn shear_stress(&self, graph: &mut Graph, x: f64, point: &str, sign: f64) -> NodeId {
        let Some(fibre) = self.fibre(graph, x, point) else { return graph.constant(f64::NAN) };
        let mut parts = Vec::new();
        for (which, per_force, factor) in
            [(Force::Vy, fibre.per_vy, 1.0), (Force::Vz, fibre.per_vz, 1.0), (Force::T, fibre.per_torque, sign)]
        {
            if let Some(per_force) = per_force {
                let force = self.force(graph, which, x);
                let stress = Algebra::multiply(graph, force, per_force);
                parts.push(graph.scale(factor, stress));
            }
        }
        graph.sum(&parts)
    }

    fn fibre(&self, graph: &mut Graph, x: f64, point: &str) -> Option<sections::Fibre> {
        let dimensions = self.section.dimensions(graph, x);
        let given = sections::Given { form: self.section.form, dimensions: &dimensions, outline: self.section.outline };
        sections::kind(self.section.form.kind)?.fibre(graph, &given, point)
    }
}
