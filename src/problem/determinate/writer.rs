//! Formulas of responses, written in sections.

use std::sync::Arc;

use super::equilibrium::Equilibrium;
use super::numbers::Stiffness;
use super::shares::Sum;
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};
use crate::problem::evaluate::Evaluation;
use crate::problem::formula::{Response, Subject, What};
use crate::problem::rewritten::{Rewriting, over, scaled, total};
use crate::problem::statics::position;
use crate::problem::{Formula, Problem, Property};
use crate::sections::{self, Fibre, Given};
use crate::structure::algebra::Numbers;
use crate::structure::beam::Force;
use crate::structure::deformation::along;

/// Writes formulas in sections.
pub(super) struct Writer<'a> {
    pub problem: &'a Problem,
    pub equilibrium: &'a Equilibrium<'a>,
}

impl Rewriting for Writer<'_> {
    fn problem(&self) -> &Problem {
        self.problem
    }

    fn response(&self, response: &Response) -> Option<Formula> {
        let set = response.set;
        let member = match response.subject {
            Subject::Rib(rib) => self.equilibrium.structure.member(rib),
            _ => None,
        };
        match (&response.what, response.subject) {
            (What::Mass | What::Length, _) => Some(Formula::Response(Arc::new(response.clone()))),
            (What::Compliance, _) => self.written(&self.compliance(set)?),
            (What::Displacement(direction), Subject::Node(node)) => {
                let mut sum = Sum::default();
                self.add_displacement(&mut sum, 1.0, (set, node, usize::from(*direction)))?;
                self.written(&sum)
            }
            (What::Reaction(direction), Subject::Node(node)) => {
                Some(Formula::Constant(self.equilibrium.reaction(set, node, usize::from(*direction))))
            }
            (What::Force(which, x), _) => Some(Formula::Constant(self.equilibrium.member(set, member?).force(*which, *x))),
            (What::Stress(x, point), _) => self.stress((set, member?), *x, point),
            (What::Shear(x, point, sign), _) => self.shear_stress((set, member?), *x, point, *sign),
            (What::Deflection(vertical, x), _) => {
                let mut sum = Sum::default();
                self.add_deflection(&mut sum, (set, member?), *vertical, *x)?;
                self.written(&sum)
            }
            (What::Sag(vertical, x, chord), _) => self.sag((set, member?), (*vertical, *x, *chord)),
            _ => None,
        }
    }
}

impl Writer<'_> {
    /// The section of a prismatic rib.
    fn section(&self, member: u32) -> Option<u32> {
        let ribs = &self.problem.ribs;
        let rib = self.equilibrium.structure.members[member as usize].rib as usize;
        (ribs.from[rib] == ribs.to[rib]).then_some(ribs.from[rib])
    }

    /// A sum of numbers over stiffnesses; `None` where a rib is tapered or its material has no shear modulus.
    fn written(&self, sum: &Sum) -> Option<Formula> {
        sum.formula(|member, stiffness| {
            let (modulus, name) = match stiffness {
                Stiffness::Axial => ("E", "A"),
                Stiffness::Lateral => ("E", "Iy"),
                Stiffness::Vertical => ("E", "Ix"),
                Stiffness::LateralShear => ("G", "Asx"),
                Stiffness::VerticalShear => ("G", "Asy"),
                Stiffness::Torsion => ("G", "J"),
            };
            let structure = self.equilibrium.structure;
            let modulus = structure.material_number(structure.members[member as usize].material, modulus)?;
            Some((modulus, property(self.section(member)?, name)))
        })
    }

    /// N/A − My·Y/Ix − Mz·X/Iy.
    fn stress(&self, (set, member): (u32, u32), x: f64, point: &Arc<str>) -> Option<Formula> {
        let section = self.section(member)?;
        let numbered = self.equilibrium.member(set, member);
        let axial = over(Formula::Constant(numbered.force(Force::N, x)), property(section, "A"));
        let mut terms = vec![axial];
        for which in [Force::My, Force::Mz] {
            terms.push(self.by_force(member, which, numbered.force(which, x), point)?);
        }
        Some(total(terms))
    }

    fn shear_stress(&self, (set, member): (u32, u32), x: f64, point: &Arc<str>, sign: f64) -> Option<Formula> {
        self.section(member)?;
        let numbered = self.equilibrium.member(set, member);
        let mut terms = Vec::new();
        for (which, factor) in [(Force::Vy, 1.0), (Force::Vz, 1.0), (Force::T, sign)] {
            terms.push(self.by_force(member, which, factor * numbered.force(which, x), point)?);
        }
        Some(total(terms))
    }

    /// A force times the stress of a unit force at a point, the latter written so that it is positive at the start.
    fn by_force(&self, member: u32, which: Force, force: f64, point: &Arc<str>) -> Option<Formula> {
        if force == 0.0 {
            return Some(Formula::Constant(0.0));
        }
        let per_force = self.sign_of_unit(member, which, point)?;
        if per_force == 0.0 {
            return Some(Formula::Constant(0.0));
        }
        let rib = self.equilibrium.structure.members[member as usize].rib;
        let what = What::PerForce(which, Arc::clone(point), per_force < 0.0);
        Some(scaled(force * per_force, Formula::Response(Arc::new(Response { set: 0, subject: Subject::Rib(rib), what }))))
    }

    /// 1, −1 or, whatever the dimensions are, 0: the sign of the stress of a unit force at a point of the section at the start.
    fn sign_of_unit(&self, member: u32, which: Force, point: &str) -> Option<f64> {
        let section = self.section(member)?;
        let evaluation = Evaluation::at_start(self.problem);
        let mut graph = Graph::new();
        let dimensions = self.problem.dimensions(section as usize).iter();
        let dimensions: Vec<f64> =
            dimensions.map(|&dimension| evaluation.dimension(section, dimension)).collect::<Option<_>>()?;
        let inputs: Vec<u32> = (0..dimensions.len() as u32).map(|slot| graph.input(slot)).collect();
        let form = sections::form(self.problem.sections.form[section as usize]);
        let given = Given { form, dimensions: &inputs, outline: self.problem.outline(section) };
        let Fibre { x, y, per_vy, per_vz, per_torque } = sections::kind(form.kind)?.fibre(&mut graph, &given, point)?;
        let (node, sign) = match which {
            Force::N => return Some(1.0),
            Force::My => (Some(y), -1.0),
            Force::Mz => (Some(x), -1.0),
            Force::Vy => (per_vy, 1.0),
            Force::Vz => (per_vz, 1.0),
            Force::T => (per_torque, 1.0),
        };
        let Some(node) = node.filter(|&node| !is_zero(&graph, node)) else { return Some(0.0) };
        let value = sign * graph.evaluate(node, &dimensions, &[]);
        (value != 0.0 && value.is_finite()).then(|| value.signum())
    }

    /// Σ q̄·e by the forces q̄ of a unit load.
    fn add_displacement(&self, sum: &mut Sum, factor: f64, (set, node, direction): (u32, u32, usize)) -> Option<()> {
        let structure = self.equilibrium.structure;
        if structure.is_strained(set) {
            return None;
        }
        let Some(equation) = self.equilibrium.equation(node, direction) else { return Some(()) };
        for member in 0..structure.members.len() as u32 {
            let units = self.equilibrium.unit_forces(equation, member);
            if units == [0.0; 6] {
                continue;
            }
            for (unit, shares) in units.into_iter().zip(self.equilibrium.deformations(set, member).iter()) {
                shares.iter().for_each(|&(stiffness, value)| sum.add(member, stiffness, factor * unit * value));
            }
        }
        Some(())
    }

    fn add_deflection(&self, sum: &mut Sum, (set, member): (u32, u32), vertical: bool, x: f64) -> Option<()> {
        if self.equilibrium.structure.is_strained(set) {
            return None;
        }
        let shares = self.equilibrium.member(set, member).deflection(vertical, x);
        shares.into_iter().for_each(|(stiffness, value)| sum.add(member, stiffness, value));
        Some(())
    }

    /// The displacement of a rib's point from the chord between two nodes, along an axis of the rib.
    fn sag(&self, (set, member): (u32, u32), (vertical, x, chord): (bool, f64, [u32; 2])) -> Option<Formula> {
        let Equilibrium { structure, statics, .. } = self.equilibrium;
        let (declared, prepared) = (&structure.members[member as usize], &statics.members[member as usize]);
        let place = |node: u32| position(self.problem, structure, node);
        let [start, end, from, to] = [declared.start, declared.end, chord[0], chord[1]].map(place);
        let axis = prepared.frame.axes[if vertical { 2 } else { 1 }];
        let point: [f64; 3] = std::array::from_fn(|at| (1.0 - x) * start[at] + x * end[at]);
        let dot = |a: [f64; 3], b: [f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let less = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|at| a[at] - b[at]) };
        let span = less(to, from);
        let reach = dot(span, span);
        let t = if reach > 0.0 { dot(less(point, from), span) / reach } else { 0.0 };
        let mut sum = Sum::default();
        for (end, node, share) in [(0, declared.start, 1.0 - x), (1, declared.end, x)] {
            let row = along(&mut Numbers, end, axis, declared.offset[end]);
            for direction in 0..6 {
                let coefficient = share * row[6 * end + direction];
                if coefficient != 0.0 {
                    self.add_displacement(&mut sum, coefficient, (set, node, direction))?;
                }
            }
        }
        for (node, share) in [(chord[0], t - 1.0), (chord[1], -t)] {
            for (direction, component) in axis.into_iter().enumerate() {
                if share * component != 0.0 {
                    self.add_displacement(&mut sum, share * component, (set, node, direction))?;
                }
            }
        }
        self.add_deflection(&mut sum, (set, member), vertical, x)?;
        self.written(&sum)
    }

    /// Σ (q − q₀)·e: the work of the loads, q₀ being what they make between held ends.
    fn compliance(&self, set: u32) -> Option<Sum> {
        let structure = self.equilibrium.structure;
        if structure.is_strained(set) {
            return None;
        }
        let mut sum = Sum::default();
        for member in 0..structure.members.len() as u32 {
            let numbered = self.equilibrium.member(set, member);
            // What loads make between held ends then depends on the section.
            if numbered.deforms_in_shear() && !numbered.is_unloaded() {
                return None;
            }
            for (force, shares) in numbered.beyond_held().into_iter().zip(self.equilibrium.deformations(set, member).iter()) {
                shares.iter().for_each(|&(stiffness, value)| sum.add(member, stiffness, force * value));
            }
        }
        Some(sum)
    }
}

/// Whether a node is 0 whatever its inputs are, as it is written.
fn is_zero(graph: &Graph, node: NodeId) -> bool {
    match graph.node(node) {
        Node::Constant(value) => value == 0.0,
        Node::Binary(Binary::Multiply, left, right) => is_zero(graph, left) || is_zero(graph, right),
        Node::Binary(Binary::Divide, left, _) => is_zero(graph, left),
        Node::Unary(Unary::Negate, inner) => is_zero(graph, inner),
        _ => false,
    }
}

/// A property of a section.
fn property(section: u32, name: &str) -> Formula {
    Formula::SectionProperty(section, Property(Arc::from(name)))
}
