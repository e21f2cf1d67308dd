//! What is wrong with a structure at first sight, before any equation is solved: each finding names an exact cause.
//!
//! A structure that passes may still be a mechanism; the analysis finds those.

mod held;
mod joints;
mod members;
mod nodes;

use super::Problem;
use super::mistake_code::MistakeCode;
use super::statics::position;
use super::structure::Structure;

/// What a finding is about; whoever knows places shows it there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum About {
    /// A node, by number.
    Node(u32),
    /// A member, by number.
    Member(u32),
    /// A rib, by number.
    Rib(u32),
    /// The `up` of a member.
    Up(u32),
    /// A material.
    Material(u32),
    /// A load.
    Load(u32),
    /// The structure as a whole.
    Whole,
}

/// Something wrong, or to be looked at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// What it is about.
    pub about: About,
    /// What kind it is: a mistake where the structure cannot be analysed, a warning where it is to be looked at.
    pub code: MistakeCode,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
}

/// A structure, with what the checks ask for again and again.
struct Site<'a> {
    problem: &'a Problem,
    structure: &'a Structure,
    /// Coordinates where the variables start.
    positions: Vec<[f64; 3]>,
    /// Members at each node, with the end that is there.
    members_at: Vec<Vec<(u32, usize)>>,
    /// Directions of each node that a support or a spring holds.
    held: Vec<[bool; 6]>,
    found: Vec<Finding>,
}

/// All findings, in the order of their subjects.
pub fn findings(problem: &Problem) -> Vec<Finding> {
    let Some(structure) = problem.structure.as_deref() else { return Vec::new() };
    let nodes = structure.nodes.names.len();
    let mut members_at = vec![Vec::new(); nodes];
    for (number, member) in structure.members.iter().enumerate() {
        members_at[member.start as usize].push((number as u32, 0));
        members_at[member.end as usize].push((number as u32, 1));
    }
    let mut held = vec![[false; 6]; nodes];
    for support in &structure.supports {
        held[support.node as usize] = std::array::from_fn(|at| support.fixed[at] || support.springs[at] > 0.0);
    }
    let positions = (0..nodes as u32).map(|node| position(problem, structure, node)).collect();
    let mut site = Site { problem, structure, positions, members_at, held, found: Vec::new() };
    site.nodes();
    site.members();
    site.held();
    site.joints();
    site.found
}

impl Site<'_> {
    fn find(&mut self, code: MistakeCode, about: About, message: String, help: impl Into<String>) {
        self.found.push(Finding { about, code, message, help: help.into() });
    }

    fn node_name(&self, node: u32) -> &str {
        &self.structure.nodes.names[node as usize]
    }

    fn rib_name(&self, member: u32) -> &str {
        &self.problem.ribs.names[self.structure.members[member as usize].rib as usize]
    }

    /// From a member's start to its end, at the start.
    fn along(&self, member: u32) -> [f64; 3] {
        let member = &self.structure.members[member as usize];
        let (start, end) = (self.positions[member.start as usize], self.positions[member.end as usize]);
        std::array::from_fn(|axis| end[axis] - start[axis])
    }

    /// `r1, r2, r3 and 4 more`.
    fn ribs_in_words(&self, members: impl ExactSizeIterator<Item = u32>) -> String {
        let count = members.len();
        let named: Vec<&str> = members.take(NAMED).map(|member| self.rib_name(member)).collect();
        listed(&named, count)
    }

    fn nodes_in_words(&self, nodes: &[u32]) -> String {
        let named: Vec<&str> = nodes.iter().take(NAMED).map(|&node| self.node_name(node)).collect();
        listed(&named, nodes.len())
    }
}

/// Items named one by one in a message; further ones are counted.
const NAMED: usize = 5;

fn listed(named: &[&str], count: usize) -> String {
    let quoted: Vec<String> = named.iter().map(|name| format!("`{name}`")).collect();
    match count - named.len() {
        0 => quoted.join(", "),
        more => format!("{} and {more} more", quoted.join(", ")),
    }
}

/// `node` or `nodes`, `rib` or `ribs`.
fn plural(word: &str, count: usize) -> String {
    if count == 1 { word.to_owned() } else { format!("{word}s") }
}
