//! `[supports]`, their table, and `[masses]`.

use super::super::Assembly;
use super::Held;
use super::targets::{Target, is_pattern};
use crate::input::declaration::Name;
use crate::input::declaration::structure::{Fix, StructureEntries};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::input::table::Tables;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::{DIRECTIONS, Support};

impl Assembly<'_> {
    pub(super) fn supports(&mut self, entries: &StructureEntries, tables: &mut Tables<'_>) {
        for entry in &entries.supports {
            let fixed = entry.fix.as_ref().map_or([false; 6], |fix| self.fixed(fix));
            let springs = self.springs(&entry.springs, fixed);
            let target = Written { text: entry.node.text.clone(), place: entry.node.place, inside: None };
            self.support(&target, fixed, springs);
        }
        if let Some(written) = &entries.support_table {
            self.support_table(written, tables);
        }
    }

    /// Enters a support for every node it is for. A node's own entry comes before a pattern's.
    pub(in crate::input::check) fn support(&mut self, target: &Written, fixed: [bool; 6], springs: [f64; 6]) {
        let exact = self.names.nodes.find(&self.building.structure.nodes.names, &target.text).is_some();
        let by_pattern = !exact && is_pattern(&target.text);
        let mut twice = Vec::new();
        for &node in self.targets(Target::Nodes, target).iter() {
            let support = Support { node, fixed, springs };
            match self.building.held.get(&node).copied() {
                None => {
                    let number = self.building.structure.supports.len() as u32;
                    self.building.structure.supports.push(support);
                    self.building.held.insert(node, Held { support: number, place: target.place, by_pattern });
                }
                Some(held) if held.by_pattern && !by_pattern => {
                    self.building.structure.supports[held.support as usize] = support;
                    self.building.held.insert(node, Held { support: held.support, place: target.place, by_pattern });
                }
                Some(held) if !held.by_pattern && by_pattern => {}
                Some(held) => twice.push((node, held.place)),
            }
        }
        if let Some(&(node, first)) = twice.first() {
            self.twice_supported(node, twice.len() - 1, target.place, first);
        }
    }

    fn twice_supported(&mut self, node: u32, more: usize, place: Place, first: Place) {
        let name = &self.building.structure.nodes.names[node as usize];
        let more = if more > 0 { format!(" (and {more} more)") } else { String::new() };
        let message = format!("node `{name}`{more} is supported twice");
        let help = format!("its support is given at {} already; say all it holds in one place", self.spoken(first));
        self.findings.mistake(MistakeCode::BothGiven, place, message, help);
    }

    pub(super) fn fixed(&mut self, fix: &Fix) -> [bool; 6] {
        match fix {
            Fix::Word(written) => match self.word_of_support(&written.text) {
                Some(fixed) => fixed,
                None => {
                    let help = did_you_mean(&written.text, ["fixed", "pinned"].into_iter());
                    let known = "known: \"fixed\", \"pinned\", or a list of directions such as [\"x\", \"z\"]";
                    let message = format!("unknown support `{}`", written.text);
                    self.findings.mistake(
                        MistakeCode::UnknownChoice,
                        written.place,
                        message,
                        help.unwrap_or_else(|| known.into()),
                    );
                    [false; 6]
                }
            },
            Fix::Directions(list) => self.directions(list),
        }
    }

    /// What a word holds: all displacements, or everything the plane has.
    pub(in crate::input::check) fn word_of_support(&self, word: &str) -> Option<[bool; 6]> {
        let has = self.building.structure.plane.directions();
        match word {
            "fixed" => Some(has),
            "pinned" => Some([has[0], has[1], has[2], false, false, false]),
            _ => None,
        }
    }

    pub(in crate::input::check) fn directions(&mut self, list: &[Written]) -> [bool; 6] {
        let mut fixed = [false; 6];
        for written in list {
            if let Some(direction) = self.direction(&written.text, written.place) {
                fixed[direction] = true;
            }
        }
        fixed
    }

    /// The number of a direction the plane has.
    pub(super) fn direction(&mut self, name: &str, place: Place) -> Option<usize> {
        let plane = self.building.structure.plane;
        let has = plane.directions();
        let known = || (0..6).filter(|&at| has[at]).map(|at| DIRECTIONS[at]);
        let found = DIRECTIONS.iter().position(|direction| *direction == name);
        if let Some(at) = found.filter(|&at| has[at]) {
            return Some(at);
        }
        let list = known().collect::<Vec<_>>().join(", ");
        let message = match (found, plane.name()) {
            (Some(_), Some(plane)) => format!("the plane \"{plane}\" has no direction `{name}`"),
            _ => format!("there is no direction `{name}`"),
        };
        let near = did_you_mean(name, known());
        self.findings.mistake(MistakeCode::Coordinates, place, message, near.unwrap_or_else(|| format!("known here: {list}")));
        None
    }

    fn springs(&mut self, list: &[(Name, Scalar)], fixed: [bool; 6]) -> [f64; 6] {
        let mut springs = [0.0; 6];
        for (name, scalar) in list {
            let Some(direction) = self.direction(&name.text, name.place) else { continue };
            let Some(stiffness) = self.finite(scalar).filter(|value| self.not_negative(*value, name)) else { continue };
            self.spring(&mut springs, fixed, direction, stiffness, name.place);
        }
        springs
    }

    /// Enters a spring, which makes no sense where the node is fixed.
    pub(in crate::input::check) fn spring(
        &mut self,
        springs: &mut [f64; 6],
        fixed: [bool; 6],
        direction: usize,
        stiffness: f64,
        place: Place,
    ) {
        if fixed[direction] {
            let message = format!("`{}` is fixed and has a spring", DIRECTIONS[direction]);
            self.findings.mistake(MistakeCode::BothGiven, place, message, "keep one of the two");
        }
        springs[direction] = stiffness;
    }

    pub(super) fn masses(&mut self, entries: &StructureEntries) {
        for (name, scalar) in &entries.masses {
            let Some(mass) = self.finite(scalar).filter(|value| self.not_negative(*value, name)) else { continue };
            let target = Written { text: name.text.clone(), place: name.place, inside: None };
            let nodes = self.targets(Target::Nodes, &target);
            self.building.structure.masses.extend(nodes.iter().map(|&node| (node, mass)));
        }
    }
}
