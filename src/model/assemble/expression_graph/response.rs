//! Graphs of what a structure does.

mod members;
mod modes;

use super::{Context, Item, Lowering, OwnNumber, end_section};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::Binary;
use crate::model::assemble::member::{Framework, MemberNodes};
use crate::problem::formula::{End, Response, Subject, What};
use crate::problem::statics::position;
use crate::sections;
use crate::structure::algebra::Algebra;
use crate::structure::axes::Frame;
use crate::structure::beam::{Bending, Force, Tapered};
use crate::structure::deformation::{BASIC, along as along_axis, support_rows};

impl Lowering<'_> {
    /// The graph of a response.
    pub(super) fn response(&mut self, response: &Response, context: Context) -> NodeId {
        let nothing = |lowering: &mut Self| lowering.graph.constant(f64::NAN);
        let Some(framework) = Framework::of(self.problem) else { return nothing(self) };
        let node = match (response.subject, context.item) {
            (Subject::Node(node), _) | (Subject::Own, Item::Node(node)) => Some(node),
            _ => None,
        };
        let rib = match (response.subject, context.item) {
            (Subject::Rib(rib), _) | (Subject::Own, Item::Rib(rib)) => Some(rib),
            _ => None,
        };
        if let (What::Length, Some(rib)) = (&response.what, rib) {
            return self.rib_length(rib, response.subject == Subject::Own);
        }
        match (&response.what, node, rib.and_then(|rib| framework.structure.member(rib))) {
            (What::Displacement(direction), Some(node), _) => {
                self.variable(framework.displacement(response.set, node, usize::from(*direction)))
            }
            (What::Reaction(direction), Some(node), _) => self.reaction(framework, response.set, node, usize::from(*direction)),
            (What::Buckling(_) | What::Frequency(_) | What::Cut(_), ..) => self.eigenvalue(framework, response),
            (What::Modal(energy, piece), _, Some(member)) => self.modal(framework, member, response.set, *energy, *piece),
            (What::Compliance, ..) => self.compliance(framework, response.set),
            (What::PerForce(force, point, opposite), _, Some(member)) => {
                self.per_force(framework, member, (*force, point), *opposite)
            }
            (What::Mass, _, Some(member)) => self.mass(framework, member, response.subject == Subject::Own),
            (what, _, Some(member)) => self.of_member(framework, member, response.set, what),
            _ => nothing(self),
        }
    }

    fn of_member(&mut self, framework: Framework, member: u32, set: u32, what: &What) -> NodeId {
        if let What::Sag(vertical, x, chord) = *what {
            return self.sag(framework, member, set, (vertical, x, chord));
        }
        if let What::End(direction) = what {
            return self.end_force(framework, member, set, usize::from(*direction));
        }
        self.with_beam(framework, member, set, |graph, beam| match what {
            What::Basic(component) => beam.basic_force(graph, usize::from(*component)),
            What::Support(component) => beam.support_forces(graph)[usize::from(*component)],
            What::Force(force, x) => beam.force(graph, *force, *x),
            What::Deflection(true, x) => Bending::vertical(beam).deflection(graph, *x),
            What::Deflection(false, x) => Bending::lateral(beam).deflection(graph, *x),
            What::Stress(x, point) => beam.stress(graph, *x, point),
            What::Shear(x, point, sign) => beam.shear_stress(graph, *x, point, *sign),
            _ => graph.constant(f64::NAN),
        })
    }

    /// The displacement along an axis of the member, of its point at x from the chord between two nodes at the start's coordinates:
    /// e·[(1 − x)·u_i + x·u_j − (1 − t)·u_S − t·u_E] and the deflection from its own chord.
    fn sag(&mut self, framework: Framework, member: u32, set: u32, (vertical, x, chord): (bool, f64, [u32; 2])) -> NodeId {
        let (declared, prepared) = framework.member(member);
        let place = |node: u32| position(self.problem, framework.structure, node);
        let [start, end, from, to] = [declared.start, declared.end, chord[0], chord[1]].map(place);
        let frame = match prepared.fixed {
            true => prepared.frame.axes[if vertical { 2 } else { 1 }].map(|value| self.graph.constant(value)),
            false => self.varying_frame(framework, member).axes[if vertical { 2 } else { 1 }],
        };
        let point: [f64; 3] = std::array::from_fn(|axis| (1.0 - x) * start[axis] + x * end[axis]);
        let (along, reach): (f64, f64) = (0..3).fold((0.0, 0.0), |(along, reach), axis| {
            let span = to[axis] - from[axis];
            (along + (point[axis] - from[axis]) * span, reach + span * span)
        });
        let t = if reach > 0.0 { along / reach } else { 0.0 };
        let mut parts = Vec::new();
        for (end, share) in [(0, 1.0 - x), (1, x)] {
            let node = if end == 0 { declared.start } else { declared.end };
            let row = along_axis(&mut self.graph, end, frame, declared.offset[end]);
            for (at, coefficient) in row.into_iter().enumerate().filter(|(at, _)| at / 6 == end) {
                if self.graph.as_constant(coefficient) != Some(0.0) {
                    let displacement = self.variable(framework.displacement(set, node, at % 6));
                    let moved = Algebra::multiply(&mut self.graph, coefficient, displacement);
                    parts.push(self.graph.scale(share, moved));
                }
            }
        }
        for (node, share) in [(chord[0], t - 1.0), (chord[1], -t)] {
            for (axis, &coefficient) in frame.iter().enumerate() {
                if self.graph.as_constant(coefficient) != Some(0.0) {
                    let displacement = self.variable(framework.displacement(set, node, axis));
                    let moved = Algebra::multiply(&mut self.graph, coefficient, displacement);
                    parts.push(self.graph.scale(share, moved));
                }
            }
        }
        let what = What::Deflection(vertical, x);
        parts.push(self.of_member(framework, member, set, &what));
        self.graph.sum(&parts)
    }

    /// abᵀq + (ΘO)ᵀg in one of the twelve directions of a member's ends.
    pub(super) fn end_force(&mut self, framework: Framework, member: u32, set: u32, direction: usize) -> NodeId {
        let (declared, prepared) = framework.member(member);
        let nodes = self.member(framework, member, set);
        let rows = nodes.rows.unwrap_or_else(|| prepared.rows.map(|row| row.map(|value| self.graph.constant(value))));
        let frame = nodes.frame.unwrap_or_else(|| Frame {
            length: nodes.length,
            axes: prepared.frame.axes.map(|axis| axis.map(|value| self.graph.constant(value))),
        });
        let column: [NodeId; BASIC] = std::array::from_fn(|component| rows[component][direction]);
        let supports = support_rows(&mut self.graph, &frame, declared.offset).map(|row| row[direction]);
        self.with_beam(framework, member, set, |graph, beam| {
            let mut parts = Vec::new();
            for (component, &coefficient) in column.iter().enumerate() {
                if beam.components[component] && graph.as_constant(coefficient) != Some(0.0) {
                    let force = beam.basic_force(graph, component);
                    parts.push(Algebra::multiply(graph, coefficient, force));
                }
            }
            for (coefficient, force) in supports.into_iter().zip(beam.support_forces(graph)) {
                parts.push(Algebra::multiply(graph, coefficient, force));
            }
            graph.sum(&parts)
        })
    }

    /// What the ground exerts on a node: everything its members exert on it there, less the loads; of a spring its force.
    fn reaction(&mut self, framework: Framework, set: u32, node: u32, direction: usize) -> NodeId {
        let stiffness = framework.structure.supports.iter().find(|support| support.node == node);
        let spring = stiffness.map_or(0.0, |support| support.springs[direction]);
        if spring != 0.0 {
            let displacement = self.variable(framework.displacement(set, node, direction));
            return self.graph.scale(-spring, displacement);
        }
        let mut parts = Vec::new();
        for &member in &framework.statics.members_at[node as usize] {
            let (declared, _) = framework.member(member);
            for (end, at) in [declared.start, declared.end].into_iter().enumerate() {
                if at == node {
                    parts.push(self.end_force(framework, member, set, 6 * end + direction));
                }
            }
        }
        let load = framework.statics.nodal_load(framework.structure, set, node, direction);
        parts.push(self.graph.constant(-load));
        self.graph.sum(&parts)
    }

    /// pᵀu over the free directions: of the nodes' loads, and of the members' as they act on their ends when these are held.
    fn compliance(&mut self, framework: Framework, set: u32) -> NodeId {
        let mut parts = Vec::new();
        for node in 0..framework.structure.nodes.names.len() as u32 {
            for direction in 0..6 {
                let load = framework.statics.nodal_load(framework.structure, set, node, direction);
                if load != 0.0 && framework.statics.is_free(node, direction) {
                    let displacement = self.variable(framework.displacement(set, node, direction));
                    parts.push(self.graph.scale(load, displacement));
                }
            }
        }
        for member in 0..framework.structure.members.len() as u32 {
            parts.push(self.held_work(framework, member, set));
        }
        self.graph.sum(&parts)
    }

    /// The work that the equivalent end forces of a member's loads do: less its end forces at zero deformation.
    fn held_work(&mut self, framework: Framework, member: u32, set: u32) -> NodeId {
        let (declared, prepared) = framework.member(member);
        if prepared.loads.is_empty() {
            return self.graph.constant(0.0);
        }
        let known = self.member(framework, member, set);
        let held = MemberNodes { deformations: [self.graph.constant(0.0); BASIC], forces: None, ..known.clone() };
        self.members.insert((member, set), held);
        let mut parts = Vec::new();
        for at in 0..12 {
            let node = if at < 6 { declared.start } else { declared.end };
            if framework.statics.is_free(node, at % 6) {
                let force = self.end_force(framework, member, set, at);
                let displacement = self.variable(framework.displacement(set, node, at % 6));
                let work = Algebra::multiply(&mut self.graph, force, displacement);
                parts.push(self.graph.scale(-1.0, work));
            }
        }
        self.members.insert((member, set), known);
        self.graph.sum(&parts)
    }

    /// The stress of a unit force at a point of a prismatic member's section, or its opposite: 1/A, −Y/Ix, −X/Iy, and what the kind says of shear.
    fn per_force(&mut self, framework: Framework, member: u32, (force, point): (Force, &str), opposite: bool) -> NodeId {
        let section = end_section(self.problem, framework.member(member).0.rib, End::From);
        let dimensions = self.named_section(section);
        let form = sections::form(self.problem.sections.form[section as usize]);
        let given = sections::Given { form, dimensions: &dimensions, outline: self.problem.outline(section) };
        let graph = &mut self.graph;
        let Some(kind) = sections::kind(form.kind) else { return graph.constant(f64::NAN) };
        let Some(fibre) = kind.fibre(graph, &given, point) else { return graph.constant(f64::NAN) };
        let over = |graph: &mut Graph, distance: NodeId, name: &str| match kind.property(graph, &given, name) {
            Some(value) => Algebra::divide(graph, distance, value),
            None => graph.constant(f64::NAN),
        };
        // σ = −My·Y/Ix − Mz·X/Iy
        let is_negative = matches!(force, Force::My | Force::Mz) != opposite;
        let distance = match force {
            Force::N => Some(graph.constant(1.0)),
            Force::My => Some(fibre.y),
            Force::Mz => Some(fibre.x),
            Force::Vy => fibre.per_vy,
            Force::Vz => fibre.per_vz,
            Force::T => fibre.per_torque,
        };
        let Some(distance) = distance else { return graph.constant(0.0) };
        let distance = if is_negative { negated(graph, distance) } else { distance };
        match force {
            Force::N => over(graph, distance, "A"),
            Force::My => over(graph, distance, "Ix"),
            Force::Mz => over(graph, distance, "Iy"),
            Force::Vy | Force::Vz | Force::T => distance,
        }
    }

    /// Density times ∫A dx.
    fn mass(&mut self, framework: Framework, member: u32, own: bool) -> NodeId {
        let (declared, _) = framework.member(member);
        let item = Item::Rib(declared.rib);
        let density = match own {
            true => self.own_number(item, OwnNumber::Material("density".into())),
            false => {
                let density = framework.structure.materials[declared.material as usize].density;
                self.graph.constant(density.unwrap_or(f64::NAN))
            }
        };
        let length = self.rib_length(declared.rib, own);
        let sections = [End::From, End::To].map(|end| end_section(self.problem, declared.rib, end));
        let [start, end] = sections.map(|section| if own { self.own_section(section) } else { self.named_section(section) });
        let form = sections::form(self.problem.sections.form[sections[0] as usize]);
        let tapered = Tapered { form, outline: self.problem.outline(sections[0]), start: &start, end: &end };
        let mean = tapered.mean_area(&mut self.graph);
        let volume = self.graph.multiply(length, mean);
        self.graph.multiply(density, volume)
    }
}

/// −node, as −c·x where it is c·x: so that its sign is seen.
fn negated(graph: &mut Graph, node: NodeId) -> NodeId {
    if let Node::Binary(Binary::Multiply, left, right) = graph.node(node) {
        for (factor, other) in [(left, right), (right, left)] {
            if let Some(value) = graph.as_constant(factor) {
                return Algebra::scale(graph, -value, other);
            }
        }
    }
    Algebra::scale(graph, -1.0, node)
}
