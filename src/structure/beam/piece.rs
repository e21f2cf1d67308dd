//! A piece of a member in a mode: the energies that the matrices of buckling and vibration are made of.
//!
//! A mode moves the ends of the piece by twelve small displacements along and about the member's axes. Between them the piece takes the
//! shape that these ends alone would bend it into: exact for tapered pieces, so that with the strain energy of the same shape every
//! factor and every frequency is an upper bound of that of the continuous member, whatever the taper (Rayleigh's quotient). Cubic shapes
//! beside a flexibility of the exact shape would be no bound.

use super::{Beam, Bending, Components, Force, Tapered};
use crate::expression::graph::{Graph, NodeId};
use crate::structure::algebra::Algebra;
use crate::structure::deformation::BASIC;
use crate::structure::loads::{MemberLoads, Way};
use crate::structure::quadrature;

/// A piece between two fractions of a member's length.
pub struct Piece<'b, 'a> {
    /// The member, with the loads and deformations of the case that its axial force comes from.
    pub whole: &'b Beam<'a>,
    /// Where it starts and ends.
    pub range: [f64; 2],
    /// What it carries.
    pub components: Components,
    /// u, v, w, rx, ry, rz of its start, then of its end.
    pub ends: [NodeId; 12],
}

/// A point of a piece: its fraction of the piece, and its weight in integrals over the piece from 0 to 1.
type Point = (f64, f64);

/// Slope and deflection over the piece's length, from the chord, in one plane.
struct Shape {
    slope: Vec<NodeId>,
    deflection: Vec<NodeId>,
}

impl Piece<'_, '_> {
    /// ½·Σ q·e.
    pub fn strain_energy(&self, graph: &mut Graph) -> NodeId {
        self.with_beam(graph, &[], |graph, beam| {
            let mut parts = Vec::new();
            for component in (0..BASIC).filter(|&at| self.components[at]) {
                let force = beam.basic_force(graph, component);
                parts.push(Algebra::multiply(graph, force, beam.deformations[component]));
            }
            half(graph, &parts)
        })
    }

    /// ½·∫N·(v'² + w'²)dx, and with torsion ½·∫N·(Ix + Iy)/A·rx'²dx: what axial forces of the case do as the axis inclines.
    pub fn prestress_energy(&self, graph: &mut Graph) -> NodeId {
        let terms = self.whole.terms(graph);
        let of_loads = terms.iter().filter(|term| term.way == Way::Axial).flat_map(|term| term.spread.breaks());
        let breaks: Vec<f64> = of_loads.collect();
        self.with_beam(graph, &breaks, |graph, beam| {
            let (points, segments) = stations(beam);
            let [start, width] = [self.range[0], self.range[1] - self.range[0]];
            let forces: Vec<NodeId> = points.iter().map(|(x, _)| self.whole.force(graph, Force::N, start + width * x)).collect();
            let mut squares = vec![Vec::new(); points.len()];
            for plane in self.planes() {
                let chord = self.chord(graph, plane, beam.length);
                let shape = self.shape(graph, beam, plane, &points, &segments);
                for (at, list) in squares.iter_mut().enumerate() {
                    let slope = shape.as_ref().map_or(chord, |shape| graph.add(chord, shape.slope[at]));
                    list.push(Algebra::multiply(graph, slope, slope));
                }
            }
            if self.components[5] {
                let torque = beam.basic_force(graph, 5);
                for (list, &(x, _)) in squares.iter_mut().zip(&points) {
                    list.push(self.twist(graph, beam, torque, x));
                }
            }
            let mut parts = Vec::new();
            for ((&(_, weight), force), squares) in points.iter().zip(forces).zip(squares) {
                let square = graph.sum(&squares);
                let product = Algebra::multiply(graph, force, square);
                parts.push(graph.scale(weight, product));
            }
            let sum = half(graph, &parts);
            Algebra::multiply(graph, sum, beam.length)
        })
    }

    /// ½·∫ρ(A·(u² + v² + w²) + (Ix + Iy)·rx²)dx.
    pub fn inertia_energy(&self, graph: &mut Graph, density: NodeId) -> NodeId {
        self.with_beam(graph, &[], |graph, beam| {
            let (points, segments) = stations(beam);
            let mut squares = vec![Vec::new(); points.len()];
            for (direction, plane) in [(0, None), (1, Some(Plane::Lateral)), (2, Some(Plane::Vertical))] {
                let shape = plane.and_then(|plane| self.shape(graph, beam, plane, &points, &segments));
                for (at, list) in squares.iter_mut().enumerate() {
                    let mut moved = self.linear(graph, direction, points[at].0);
                    if let Some(shape) = &shape {
                        moved = graph.add(moved, shape.deflection[at]);
                    }
                    list.push(Algebra::multiply(graph, moved, moved));
                }
            }
            let mut parts = Vec::new();
            for (&(x, weight), squares) in points.iter().zip(squares) {
                let (square, area) = (graph.sum(&squares), beam.section.property(graph, x, "A"));
                let mut share = Algebra::multiply(graph, area, square);
                if self.components[5] {
                    let turned = self.linear(graph, 3, x);
                    let square = Algebra::multiply(graph, turned, turned);
                    let inertia = polar(graph, beam, x);
                    let turning = Algebra::multiply(graph, inertia, square);
                    share = graph.add(share, turning);
                }
                parts.push(graph.scale(weight, share));
            }
            let sum = half(graph, &parts);
            let mass = Algebra::multiply(graph, density, beam.length);
            Algebra::multiply(graph, mass, sum)
        })
    }

    /// The piece as a member of its own, without loads, cut also at `more` (fractions of the whole).
    fn with_beam(&self, graph: &mut Graph, more: &[f64], then: impl FnOnce(&mut Graph, &Beam) -> NodeId) -> NodeId {
        let [from, to] = self.range;
        let whole = self.whole;
        let [start, end] = self.range.map(|x| whole.section.dimensions(graph, x));
        let cuts = whole.grading.iter().chain(more).map(|x| (x - from) / (to - from));
        let mut grading: Vec<f64> = cuts.filter(|&x| x > 1e-12 && x < 1.0 - 1e-12).collect();
        grading.sort_by(f64::total_cmp);
        grading.dedup();
        let length = graph.scale(to - from, whole.length);
        let beam = Beam {
            section: Tapered { start: &start, end: &end, ..whole.section },
            length,
            young: whole.young,
            shear: whole.shear,
            components: self.components,
            deforms_in_shear: whole.deforms_in_shear,
            grading: &grading,
            points: if to - from > 0.5 { whole.points } else { quadrature::TAPERED_PIECE },
            loads: MemberLoads::default(),
            deformations: self.deformations(graph, length),
            forces: None,
        };
        then(graph, &beam)
    }

    /// e from the ends' displacements, see [`crate::structure::deformation`].
    fn deformations(&self, graph: &mut Graph, length: NodeId) -> [NodeId; BASIC] {
        let [u_i, _, _, rx_i, ry_i, rz_i, u_j, _, _, rx_j, ry_j, rz_j] = self.ends;
        let psi_y = self.chord(graph, Plane::Lateral, length);
        let psi_z = self.chord(graph, Plane::Vertical, length);
        let turned = graph.add(ry_j, psi_z);
        [
            graph.subtract(u_j, u_i),
            graph.subtract(psi_y, rz_i),
            graph.subtract(rz_j, psi_y),
            graph.add(psi_z, ry_i),
            graph.scale(-1.0, turned),
            graph.subtract(rx_j, rx_i),
        ]
    }

    /// Planes in which the axis inclines.
    fn planes(&self) -> [Plane; 2] {
        [Plane::Lateral, Plane::Vertical]
    }

    /// The slope of the chord.
    fn chord(&self, graph: &mut Graph, plane: Plane, length: NodeId) -> NodeId {
        let direction = plane.direction();
        let across = graph.subtract(self.ends[6 + direction], self.ends[direction]);
        Algebra::divide(graph, across, length)
    }

    fn linear(&self, graph: &mut Graph, direction: usize, x: f64) -> NodeId {
        let (start, end) = (graph.scale(1.0 - x, self.ends[direction]), graph.scale(x, self.ends[6 + direction]));
        graph.add(start, end)
    }

    /// How the ends bend the piece, at the points; `None` where they do not.
    fn shape(&self, graph: &mut Graph, beam: &Beam, plane: Plane, points: &[Point], segments: &[f64]) -> Option<Shape> {
        let first = plane.first_component();
        if !self.components[first] && !self.components[first + 1] {
            return None;
        }
        let bending = match plane {
            Plane::Lateral => Bending::lateral(beam),
            Plane::Vertical => Bending::vertical(beam),
        };
        let curvature: Vec<NodeId> = points.iter().map(|&(x, _)| bending.curvature(graph, x)).collect();
        // The slope at the start, for which the end comes to lie on the chord: −∫(1 − ξ)κ·L dξ.
        let weighted: Vec<NodeId> =
            points.iter().zip(&curvature).map(|(&(x, weight), &value)| graph.scale((x - 1.0) * weight, value)).collect();
        let start = graph.sum(&weighted);
        let turned = running(graph, &curvature, segments);
        let relative: Vec<NodeId> = turned.into_iter().map(|slope| graph.add(start, slope)).collect();
        let slope: Vec<NodeId> = relative.iter().map(|&slope| Algebra::multiply(graph, slope, beam.length)).collect();
        let deflection = running(graph, &slope, segments);
        let deflection = deflection.into_iter().map(|value| Algebra::multiply(graph, value, beam.length)).collect();
        Some(Shape { slope, deflection })
    }

    /// (Ix + Iy)/A·rx'² with rx' = T/GJ.
    fn twist(&self, graph: &mut Graph, beam: &Beam, torque: NodeId, x: f64) -> NodeId {
        let [constant, area] = ["J", "A"].map(|name| beam.section.property(graph, x, name));
        let shear = beam.shear.unwrap_or_else(|| graph.constant(f64::NAN));
        let stiffness = Algebra::multiply(graph, shear, constant);
        let rate = Algebra::divide(graph, torque, stiffness);
        let square = Algebra::multiply(graph, rate, rate);
        let inertia = polar(graph, beam, x);
        let radius = Algebra::divide(graph, inertia, area);
        Algebra::multiply(graph, radius, square)
    }
}

/// A plane of bending.
#[derive(Debug, Clone, Copy)]
enum Plane {
    Lateral,
    Vertical,
}

impl Plane {
    /// Of u, v, w.
    fn direction(self) -> usize {
        match self {
            Plane::Lateral => 1,
            Plane::Vertical => 2,
        }
    }

    /// Of the basic forces.
    fn first_component(self) -> usize {
        match self {
            Plane::Lateral => 1,
            Plane::Vertical => 3,
        }
    }
}

/// Ix + Iy.
fn polar(graph: &mut Graph, beam: &Beam, x: f64) -> NodeId {
    let [vertical, lateral] = ["Ix", "Iy"].map(|name| beam.section.property(graph, x, name));
    graph.add(vertical, lateral)
}

fn half(graph: &mut Graph, parts: &[NodeId]) -> NodeId {
    let sum = graph.sum(parts);
    graph.scale(0.5, sum)
}

/// The points of a piece, and the widths of the segments they lie in, each with as many points as the others.
fn stations(beam: &Beam) -> (Vec<Point>, Vec<f64>) {
    let ends: Vec<f64> = std::iter::once(0.0).chain(beam.grading.iter().copied()).chain([1.0]).collect();
    let widths = ends.windows(2).map(|ends| ends[1] - ends[0]).collect();
    (quadrature::pieces(beam.grading, beam.points()), widths)
}

/// ∫₀^x of what has these values at the points: exact for polynomials of a degree below the number of points in a segment.
fn running(graph: &mut Graph, values: &[NodeId], widths: &[f64]) -> Vec<NodeId> {
    let count = values.len() / widths.len().max(1);
    let rule = quadrature::gauss(count);
    let weights = quadrature::cumulative(&rule);
    let (mut before, mut all) = (graph.constant(0.0), Vec::new());
    for (segment, &width) in values.chunks(count.max(1)).zip(widths) {
        for row in &weights {
            let mut parts = vec![before];
            parts.extend(segment.iter().zip(row).map(|(&value, weight)| graph.scale(width * weight, value)));
            all.push(graph.sum(&parts));
        }
        let mut parts = vec![before];
        parts.extend(segment.iter().zip(&rule).map(|(&value, (_, weight))| graph.scale(width * weight, value)));
        before = graph.sum(&parts);
    }
    all
}
