//! Parts of the structure that nothing holds, at all or in a direction.

use super::{About, Site};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::structure::DIRECTIONS;

impl Site<'_> {
    /// Every part that hangs together is held in every direction in which nodes can be displaced.
    pub(super) fn held(&mut self) {
        let parts = self.parts();
        let directions = self.structure.plane.directions();
        for part in &parts {
            let holds = |direction: usize| part.iter().any(|&node| self.held[node as usize][direction]);
            let lacking: Vec<&str> = (0..3).filter(|&at| directions[at] && !holds(at)).map(|at| DIRECTIONS[at]).collect();
            if lacking.is_empty() {
                continue;
            }
            let nothing = (0..6).all(|direction| !holds(direction));
            let whose = match parts.len() {
                1 => "the structure".to_owned(),
                _ => format!("the part with node `{}`", self.node_name(part[0])),
            };
            let about = if parts.len() == 1 { About::Whole } else { About::Node(part[0]) };
            if nothing {
                let help = match parts.len() {
                    1 => "add [supports]",
                    _ => "support it, or join it to the rest: ribs are joined where they share a node",
                };
                self.find(MistakeCode::Mechanism, about, format!("{whose} has no support"), help);
            } else {
                let list = lacking.join(" and ");
                let message = format!("nothing holds {whose} in {list}: it can slide");
                self.find(
                    MistakeCode::Mechanism,
                    about,
                    message,
                    format!("fix {list} of one of its nodes at least, or add a spring there"),
                );
            }
        }
    }

    /// Nodes by the part they belong to, each part in ascending order; nodes of no rib belong to none.
    fn parts(&self) -> Vec<Vec<u32>> {
        let mut seen = vec![false; self.members_at.len()];
        let mut parts = Vec::new();
        for first in 0..self.members_at.len() as u32 {
            if seen[first as usize] || self.members_at[first as usize].is_empty() {
                continue;
            }
            seen[first as usize] = true;
            let mut part = vec![first];
            let mut next = 0;
            while let Some(&node) = part.get(next) {
                next += 1;
                for &(member, end) in &self.members_at[node as usize] {
                    let member = &self.structure.members[member as usize];
                    let other = if end == 0 { member.end } else { member.start };
                    if !std::mem::replace(&mut seen[other as usize], true) {
                        part.push(other);
                    }
                }
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }
}
