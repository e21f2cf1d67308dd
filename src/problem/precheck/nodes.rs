//! Nodes that no rib uses, and nodes at one place.

use std::collections::HashMap;

use super::{About, Site, plural};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::structure::Action;

/// Nodes closer than this share of the structure's extent are at one place.
const SAME_PLACE: f64 = 1e-9;

impl Site<'_> {
    pub(super) fn nodes(&mut self) {
        self.idle_nodes();
        self.twins();
    }

    /// A node of no rib is a mistake where something acts on it or holds it.
    fn idle_nodes(&mut self) {
        let idle: Vec<u32> =
            (0..self.members_at.len() as u32).filter(|&node| self.members_at[node as usize].is_empty()).collect();
        if idle.is_empty() {
            return;
        }
        let mut loaded = vec![false; self.members_at.len()];
        for load in &self.structure.loads {
            if let Action::Nodal { node, .. } | Action::Displacement { node, .. } = load.action {
                loaded[node as usize] = true;
            }
        }
        for (what, help, code) in [
            ("is loaded, but no rib ends there", "let a rib start or end there, or load another node", MistakeCode::Load),
            (
                "is supported, but no rib ends there",
                "let a rib start or end there, or support another node",
                MistakeCode::Support,
            ),
            ("is used by no rib", "leave it out, or let a rib start or end there", MistakeCode::Unused),
        ] {
            let concerned = |node: &u32| match (loaded[*node as usize], self.held[*node as usize].contains(&true)) {
                (true, _) => what.starts_with("is loaded"),
                (false, true) => what.starts_with("is supported"),
                (false, false) => code == MistakeCode::Unused,
            };
            let nodes: Vec<u32> = idle.iter().copied().filter(concerned).collect();
            let Some(&first) = nodes.first() else { continue };
            let what = if nodes.len() == 1 { what.to_owned() } else { what.replacen("is ", "are ", 1) };
            let message = format!("{} {} {what}", plural("node", nodes.len()), self.nodes_in_words(&nodes));
            self.find(code, About::Node(first), message, help);
        }
    }

    /// Pairs of nodes at one place: perhaps they were meant to be one.
    fn twins(&mut self) {
        let pairs = self.pairs_at_one_place();
        let Some(&[first, second]) = pairs.first() else { return };
        let more = if pairs.len() > 1 { format!(" (and {} more)", plural_count(pairs.len() - 1)) } else { String::new() };
        let message = format!("nodes `{}` and `{}` are at one place{more}", self.node_name(first), self.node_name(second));
        let help = "ribs that end at different nodes are not joined: use one node, unless this is meant";
        self.find(MistakeCode::TwinNodes, About::Node(second), message, help);
    }

    /// Points go into boxes of twice the tolerance; what is within the tolerance lies in one of the boxes its corners touch.
    fn pairs_at_one_place(&self) -> Vec<[u32; 2]> {
        let size = |axis: usize| {
            let all = || self.positions.iter().map(|position| position[axis]).filter(|value| value.is_finite());
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        let extent = (0..3).map(size).fold(0.0, f64::max);
        let tolerance = SAME_PLACE * extent;
        if tolerance <= 0.0 {
            return Vec::new();
        }
        let key = |position: [f64; 3]| position.map(|value| (value / (2.0 * tolerance)).floor() as i64);
        let mut boxes: HashMap<[i64; 3], u32> = HashMap::new();
        let mut pairs = Vec::new();
        for (node, position) in self.positions.iter().enumerate() {
            if position.iter().any(|value| !value.is_finite()) {
                continue;
            }
            let corner = |at: usize| {
                key(std::array::from_fn(|axis| {
                    let side = if at >> axis & 1 == 1 { tolerance } else { -tolerance };
                    position[axis] + side
                }))
            };
            let near = |other: u32| {
                let there = self.positions[other as usize];
                (0..3).all(|axis| (there[axis] - position[axis]).abs() <= tolerance)
            };
            match (0..8).filter_map(|at| boxes.get(&corner(at)).copied()).find(|&other| near(other)) {
                Some(other) => pairs.push([other, node as u32]),
                None => {
                    boxes.entry(key(*position)).or_insert(node as u32);
                }
            }
        }
        pairs
    }
}

fn plural_count(count: usize) -> String {
    if count == 1 { "1 such pair".to_owned() } else { format!("{count} such pairs") }
}
