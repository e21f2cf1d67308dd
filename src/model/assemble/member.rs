//! What one member of a structure brings to a formula: its numbers, its loads in one case or combination, its inputs.

use crate::expression::graph::NodeId;
use crate::problem::statics::{Prepared, Statics};
use crate::problem::structure::{Action, Axes, Member, Shear, Structure};
use crate::problem::{Dimension, Problem};
use crate::structure::algebra::{Algebra, Numbers};
use crate::structure::axes::Frame;
use crate::structure::deformation::BASIC;
use crate::structure::loads::{MemberLoads, Spread, Way};

/// The structure of a problem with what was prepared of it.
#[derive(Clone, Copy)]
pub(super) struct Framework<'a> {
    pub structure: &'a Structure,
    pub statics: &'a Statics,
    /// The input that the first of them is in the assembled model.
    pub first_input: u32,
}

impl<'a> Framework<'a> {
    pub fn of(problem: &'a Problem) -> Option<Self> {
        let (structure, statics) = (problem.structure.as_deref()?, problem.statics.as_deref()?);
        Some(Framework { structure, statics, first_input: problem.first_input })
    }

    pub fn member(self, member: u32) -> (&'a Member, &'a Prepared) {
        (&self.structure.members[member as usize], &self.statics.members[member as usize])
    }

    /// Whether items alike in shape may share what is compiled: no coordinate and no modulus of it varies.
    pub fn is_plain(self, member: u32) -> bool {
        let (declared, prepared) = self.member(member);
        let material = &self.structure.materials[declared.material as usize];
        let constant = |dimension: &Dimension| matches!(dimension, Dimension::Constant(_));
        let shear = match &material.shear {
            Some(Shear::Modulus(modulus)) => constant(modulus),
            _ => true,
        };
        prepared.fixed && constant(&material.young) && shear
    }

    /// Length, E, G (NaN without) and the loads' values of a plain member, in the order a lowering asks for them.
    pub fn numbers(self, member: u32, set: u32) -> (Vec<f64>, MemberLoads<f64>) {
        let (declared, prepared) = self.member(member);
        let material = &self.structure.materials[declared.material as usize];
        let number = |dimension: Dimension| if let Dimension::Constant(value) = dimension { value } else { f64::NAN };
        let young = number(material.young);
        let shear = match material.shear {
            Some(Shear::Modulus(modulus)) => number(modulus),
            Some(Shear::Poisson(ratio)) => young / (2.0 * (1.0 + ratio)),
            None => f64::NAN,
        };
        let loads = loads(&mut Numbers, self, member, set, &prepared.frame);
        let mut numbers = vec![prepared.frame.length, young, shear];
        let _ = loads.map(|value| numbers.push(value));
        (numbers, loads)
    }

    /// What decides, besides the sections, whether two members may share a template.
    pub fn shape(self, member: u32, loads: &MemberLoads<f64>, shape: &mut Vec<u32>) {
        let (declared, prepared) = self.member(member);
        let bits = prepared.components.iter().fold(0, |bits, &kept| 2 * bits + u32::from(kept));
        let has = |some: bool, bit: u32| if some { 1 << bit } else { 0 };
        let flags = [loads.weight.is_some(), loads.strain.is_some(), loads.gradient.is_some(), loads.pretension.is_some()];
        let flags = flags.into_iter().zip(6..).fold(bits, |bits, (some, bit)| bits | has(some, bit));
        shape.push(flags | has(declared.shear, 10));
        let mut wide = |value: u64| shape.extend([value as u32, (value >> 32) as u32]);
        prepared.grading.iter().for_each(|at| wide(at.to_bits()));
        wide(loads.terms.len() as u64);
        for term in &loads.terms {
            wide(term.way as u64);
            term.spread.key().into_iter().for_each(&mut wide);
        }
    }

    /// The inputs a plain member deforms by, in the order of its basic forces; `None` where one is released.
    pub fn inputs(self, member: u32, set: u32) -> [Option<u32>; BASIC] {
        std::array::from_fn(|component| self.statics.deformation(set, member, component).map(|input| self.first_input + input))
    }

    /// The inputs of a piece in a mode: displacements of its ends along and about the member's axes; global ones at the ends of a
    /// member whose nodes move with the design.
    pub fn modal(self, member: u32, piece: u32) -> [u32; 12] {
        let number = self.statics.members[member as usize].first_piece + piece;
        std::array::from_fn(|at| self.first_input + self.statics.modal(self.structure, number, at))
    }

    /// The input of a node's displacement.
    pub fn displacement(self, set: u32, node: u32, direction: usize) -> u32 {
        self.first_input + self.statics.displacement(set, node, direction)
    }
}

/// What loads a member in a case or combination, in its own axes.
pub(super) fn loads<A: Algebra>(
    algebra: &mut A,
    framework: Framework,
    member: u32,
    set: u32,
    frame: &Frame<A::Number>,
) -> MemberLoads<A::Number> {
    let (declared, prepared) = framework.member(member);
    let material = &framework.structure.materials[declared.material as usize];
    let mut loads = MemberLoads::default();
    for (case, factor) in framework.structure.factors(set) {
        for &number in &prepared.loads {
            let load = &framework.structure.loads[number as usize];
            if load.case != case {
                continue;
            }
            match &load.action {
                Action::Distributed { axes, force, force_end, from, to, .. } => {
                    let ends = [*force, *force_end].map(|force| local(algebra, frame, *axes, force.map(|value| factor * value)));
                    distributed(algebra, &mut loads, frame.length, ends, *from, *to, force == force_end);
                }
                Action::Point { axes, force, moment, at, .. } => {
                    let force = local(algebra, frame, *axes, force.map(|value| factor * value));
                    let moment = local(algebra, frame, *axes, moment.map(|value| factor * value));
                    point(algebra, &mut loads, frame.length, force, moment, *at);
                }
                Action::SelfWeight { .. } => {
                    let density = factor * material.density.unwrap_or(f64::NAN);
                    let weight = local(algebra, frame, Axes::Global, framework.structure.gravity.map(|g| density * g));
                    loads.weight = Some(match loads.weight {
                        Some(known) => [0, 1, 2].map(|axis| algebra.add(known[axis], weight[axis])),
                        None => weight,
                    });
                }
                Action::Temperature { change, .. } => {
                    add(algebra, &mut loads.strain, factor * change * material.expansion.unwrap_or(f64::NAN));
                }
                Action::Gradient { difference, .. } => {
                    add(algebra, &mut loads.gradient, factor * difference * material.expansion.unwrap_or(f64::NAN));
                }
                Action::Pretension { force, .. } => add(algebra, &mut loads.pretension, factor * force),
                Action::Nodal { .. } | Action::Displacement { .. } => {}
            }
        }
    }
    loads
}

fn add<A: Algebra>(algebra: &mut A, sum: &mut Option<A::Number>, value: f64) {
    let value = algebra.constant(value);
    *sum = Some(match *sum {
        Some(known) => algebra.add(known, value),
        None => value,
    });
}

/// Components in member axes.
fn local<A: Algebra>(algebra: &mut A, frame: &Frame<A::Number>, axes: Axes, components: [f64; 3]) -> [A::Number; 3] {
    let components = components.map(|value| algebra.constant(value));
    let global = match axes {
        Axes::Local => return components,
        Axes::Global => components,
        // Per length of the projection: √(1 − e1_k²) of the member's own.
        Axes::Projected => [0, 1, 2].map(|axis| {
            let (one, cosine) = (algebra.constant(1.0), frame.axes[0][axis]);
            let square = algebra.multiply(cosine, cosine);
            let rest = algebra.subtract(one, square);
            let share = algebra.sqrt(rest);
            algebra.multiply(components[axis], share)
        }),
    };
    frame.axes.map(|axis| algebra.dot(axis, global))
}

fn distributed<A: Algebra>(
    algebra: &mut A,
    loads: &mut MemberLoads<A::Number>,
    length: A::Number,
    [start, end]: [[A::Number; 3]; 2],
    from: f64,
    to: f64,
    uniform: bool,
) {
    let square = algebra.multiply(length, length);
    for (axis, way, factor) in [(0, Way::Axial, length), (1, Way::Lateral, square), (2, Way::Vertical, square)] {
        let [first, last] = [start[axis], end[axis]].map(|force| algebra.multiply(factor, force));
        let whole = from <= 0.0 && to >= 1.0;
        match (whole, uniform) {
            (true, true) => loads.add(algebra, way, Spread::Power(0), first),
            (true, false) => {
                let difference = algebra.subtract(last, first);
                loads.add(algebra, way, Spread::Power(0), first);
                loads.add(algebra, way, Spread::Power(1), difference);
            }
            (false, _) => {
                loads.add(algebra, way, Spread::Falling(from, to), first);
                loads.add(algebra, way, Spread::Rising(from, to), last);
            }
        }
    }
}

fn point<A: Algebra>(
    algebra: &mut A,
    loads: &mut MemberLoads<A::Number>,
    length: A::Number,
    force: [A::Number; 3],
    moment: [A::Number; 3],
    at: f64,
) {
    loads.add(algebra, Way::Axial, Spread::Force(at), force[0]);
    for (axis, way) in [(1, Way::Lateral), (2, Way::Vertical)] {
        let value = algebra.multiply(length, force[axis]);
        loads.add(algebra, way, Spread::Force(at), value);
    }
    loads.add(algebra, Way::Torque, Spread::Moment(at), moment[0]);
    loads.add(algebra, Way::Lateral, Spread::Moment(at), moment[2]);
    let turned = algebra.scale(-1.0, moment[1]);
    loads.add(algebra, Way::Vertical, Spread::Moment(at), turned);
}

/// The nodes a member's formulas start from.
#[derive(Clone)]
pub(super) struct MemberNodes {
    pub length: NodeId,
    pub young: NodeId,
    pub shear: Option<NodeId>,
    pub loads: MemberLoads<NodeId>,
    pub deformations: [NodeId; BASIC],
    /// The basic forces, where these are the inputs.
    pub forces: Option<[NodeId; BASIC]>,
    /// The deformations by its ends' displacements, where its nodes move with the design.
    pub rows: Option<crate::structure::deformation::Rows<NodeId>>,
    /// Member axes likewise.
    pub frame: Option<Frame<NodeId>>,
}
