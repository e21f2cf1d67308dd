//! Loads on members in member axes.

use super::Statics;
use crate::problem::structure::{Action, Axes, Structure};
use crate::structure::algebra::Algebra;
use crate::structure::axes::Frame;
use crate::structure::loads::{MemberLoads, Spread, Way};

impl Statics {
    /// What loads a member in a case or combination, in its own axes.
    pub fn member_loads<A: Algebra>(
        &self,
        algebra: &mut A,
        structure: &Structure,
        (member, set): (u32, u32),
        frame: &Frame<A::Number>,
    ) -> MemberLoads<A::Number> {
        let (declared, prepared) = (&structure.members[member as usize], &self.members[member as usize]);
        let material = &structure.materials[declared.material as usize];
        let mut loads = MemberLoads::default();
        for (case, factor) in structure.factors(set) {
            for &number in &prepared.loads {
                let load = &structure.loads[number as usize];
                if load.case != case {
                    continue;
                }
                match &load.action {
                    Action::Distributed { axes, force, force_end, from, to, .. } => {
                        let ends =
                            [*force, *force_end].map(|force| local(algebra, frame, *axes, force.map(|value| factor * value)));
                        distributed(algebra, &mut loads, frame.length, ends, *from, *to, force == force_end);
                    }
                    Action::Point { axes, force, moment, at, .. } => {
                        let force = local(algebra, frame, *axes, force.map(|value| factor * value));
                        let moment = local(algebra, frame, *axes, moment.map(|value| factor * value));
                        point(algebra, &mut loads, frame.length, force, moment, *at);
                    }
                    Action::SelfWeight { .. } => {
                        let density = factor * material.density.unwrap_or(f64::NAN);
                        let weight = local(algebra, frame, Axes::Global, structure.gravity.map(|g| density * g));
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
