//! Nodes that can turn or move because of how ribs end there, and members that can turn about themselves.

use super::{About, Site, plural};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::structure::{Action, DIRECTIONS, Member, Plane};

/// Directions whose normal part is below this share of them lie in one plane or line.
const FLAT: f64 = 1e-9;

impl Site<'_> {
    pub(super) fn joints(&mut self) {
        self.twisting();
        self.moments_on_bars();
        let mut flat: Vec<(u32, [f64; 3])> = Vec::new();
        for node in 0..self.members_at.len() as u32 {
            if self.members_at[node as usize].is_empty() {
                continue;
            }
            match self.only_axial(node) {
                true => flat.extend(self.free_direction(node).map(|direction| (node, direction))),
                false => self.turning(node),
            }
        }
        self.say_flat(&flat);
    }

    /// The torque released at both ends.
    fn twisting(&mut self) {
        let both = |member: &Member| !member.pinned && member.hinges.iter().all(|hinges| hinges.torque);
        let members = (0..self.structure.members.len() as u32).filter(|&at| both(&self.structure.members[at as usize]));
        let members: Vec<u32> = members.collect();
        let Some(&first) = members.first() else { return };
        let verb = if members.len() == 1 { "releases its torque" } else { "release their torque" };
        let words = self.ribs_in_words(members.iter().copied());
        let message = format!("{} {words} {verb} at both ends: it can turn about itself", plural("rib", members.len()));
        self.find(
            MistakeCode::Mechanism,
            About::Member(first),
            message.replace("it can", pronoun(members.len())),
            "keep T at one end",
        );
    }

    /// A moment acts where only bars end, which take none.
    fn moments_on_bars(&mut self) {
        for at in 0..self.structure.loads.len() {
            let Action::Nodal { node, moment, .. } = self.structure.loads[at].action else { continue };
            if moment == [0.0; 3] || self.members_at[node as usize].is_empty() {
                continue;
            }
            let bar = |&(member, _): &(u32, usize)| self.structure.members[member as usize].pinned;
            let held = (0..3).all(|axis| moment[axis] == 0.0 || self.held[node as usize][3 + axis]);
            if !held && self.members_at[node as usize].iter().all(bar) {
                let message = format!("a moment on node `{}`, where only bars end", self.node_name(node));
                self.find(
                    MistakeCode::Load,
                    About::Load(at as u32),
                    message,
                    "bars take no moment: apply forces, or make joints rigid",
                );
            }
        }
    }

    /// Whether all that ends at a node resists along its own axis only.
    fn only_axial(&self, node: u32) -> bool {
        self.members_at[node as usize].iter().all(|&(member, _)| {
            let member = &self.structure.members[member as usize];
            let space = self.structure.plane == Plane::Space;
            let hinged = member.hinges.iter().all(|hinges| hinges.my && (hinges.mz || !space));
            (member.pinned || hinged) && member.offset == [[0.0; 3]; 2]
        })
    }

    /// A direction in which bars leave a node free: normal to their plane or line, and not supported.
    fn free_direction(&self, node: u32) -> Option<[f64; 3]> {
        let mut basis = Basis::default();
        let held = self.held[node as usize];
        let directions = self.structure.plane.directions();
        for axis in 0..3 {
            if held[axis] || !directions[axis] {
                basis.add(unit(axis));
            }
        }
        for &(member, _) in &self.members_at[node as usize] {
            basis.add(self.along(member));
        }
        basis.normal()
    }

    fn say_flat(&mut self, flat: &[(u32, [f64; 3])]) {
        let mut rest: Vec<&(u32, [f64; 3])> = flat.iter().collect();
        while let Some(&&(first, direction)) = rest.first() {
            let (alike, others): (Vec<_>, Vec<_>) = rest.into_iter().partition(|(_, other)| parallel(*other, direction));
            rest = others;
            let nodes: Vec<u32> = alike.iter().map(|(node, _)| *node).collect();
            let (word, way) = (plural("node", nodes.len()), in_words(direction));
            let lie = match (self.structure.plane, self.members_at[first as usize].len()) {
                (_, 1) => "one bar alone ends there".to_owned(),
                (Plane::Space, _) => format!("the bars there lie in one plane, normal to {way}"),
                _ => "the bars there lie in one line".to_owned(),
            };
            let message = format!("{word} {} can move in {way}: {lie}", self.nodes_in_words(&nodes));
            self.find(
                MistakeCode::Mechanism,
                About::Node(first),
                message,
                "add a bar out of it, support the node, or make joints rigid",
            );
        }
    }

    /// A node that can turn because every rib there is hinged.
    fn turning(&mut self, node: u32) {
        let mut basis = Basis::default();
        let held = self.held[node as usize];
        for axis in 0..3 {
            if held[3 + axis] || !self.structure.plane.directions()[3 + axis] {
                basis.add(unit(axis));
            }
        }
        for &(member, end) in &self.members_at[node as usize] {
            if !self.resists_turning(member, end, &mut basis) {
                return; // an arm turns with the node: the analysis knows more
            }
        }
        let Some(axis) = basis.normal() else { return };
        let ribs = self.members_at[node as usize].iter().map(|(member, _)| *member);
        let (ribs, count) = (self.ribs_in_words(ribs), self.members_at[node as usize].len());
        let are = if count == 1 { "is" } else { "are" };
        let message = format!(
            "node `{}` can turn about {}: {} {ribs} {are} hinged there",
            self.node_name(node),
            in_words(axis),
            plural("rib", count)
        );
        self.find(MistakeCode::Mechanism, About::Node(node), message, "join one of them rigidly, or hold the node's rotation");
    }

    /// Adds the axes about which a member's end resists turning; false where an arm carries it.
    fn resists_turning(&self, member: u32, end: usize, basis: &mut Basis) -> bool {
        let (number, member) = (member, &self.structure.members[member as usize]);
        if member.offset[end] != [0.0; 3] {
            return false;
        }
        if member.pinned {
            return true;
        }
        let [e1, e2, e3] = self.axes(number);
        let hinges = member.hinges[end];
        let kept = [(!hinges.torque, e1), (!hinges.my, e2), (!hinges.mz, e3)];
        kept.into_iter().filter(|(kept, _)| *kept).for_each(|(_, axis)| basis.add(axis));
        true
    }
}

/// Orthonormal vectors that span what was added.
#[derive(Default)]
struct Basis {
    vectors: Vec<[f64; 3]>,
}

impl Basis {
    fn add(&mut self, vector: [f64; 3]) {
        let size = norm(vector);
        if self.vectors.len() == 3 || size <= 0.0 || !size.is_finite() {
            return;
        }
        let rest = self.rest(vector.map(|part| part / size));
        let left = norm(rest);
        if left > FLAT {
            self.vectors.push(rest.map(|part| part / left));
        }
    }

    /// What of a vector none of them spans; twice, against rounding.
    fn rest(&self, mut vector: [f64; 3]) -> [f64; 3] {
        for known in self.vectors.iter().chain(&self.vectors) {
            let share = dot(*known, vector);
            vector = std::array::from_fn(|axis| vector[axis] - share * known[axis]);
        }
        vector
    }

    /// A unit vector normal to all of them; `None` where they span space.
    fn normal(&self) -> Option<[f64; 3]> {
        if self.vectors.len() == 3 {
            return None;
        }
        let rests = (0..3).map(|axis| self.rest(unit(axis)));
        let longest = rests.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
        let size = norm(longest);
        Some(longest.map(|part| part / size))
    }
}

fn unit(axis: usize) -> [f64; 3] {
    std::array::from_fn(|at| if at == axis { 1.0 } else { 0.0 })
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

fn parallel(a: [f64; 3], b: [f64; 3]) -> bool {
    dot(a, b).abs() > 1.0 - 1e-9
}

/// `y`, or `(0.71, 0, 0.71)`.
fn in_words(direction: [f64; 3]) -> String {
    if let Some(axis) = (0..3).find(|&axis| direction[axis].abs() > 1.0 - 1e-9) {
        return DIRECTIONS[axis].to_owned();
    }
    let part = |value: f64| format!("{}", (100.0 * value).round() / 100.0 + 0.0);
    format!("({})", direction.map(part).join(", "))
}

fn pronoun(count: usize) -> &'static str {
    if count == 1 { "it can" } else { "they can" }
}
