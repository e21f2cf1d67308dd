//! `[[loads]]`: a case, targets, one kind.

mod effect;

use super::super::Assembly;
use super::targets::Target;
use crate::input::declaration::structure::{LoadEntry, StructureEntries, Targets};
use crate::input::source::{Place, Written};
use crate::input::table::Tables;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::structure::{Action, DIRECTIONS, Load};
pub(super) use effect::Effect;

impl Assembly<'_> {
    pub(super) fn loads(&mut self, entries: &StructureEntries, tables: &mut Tables<'_>) {
        for entry in &entries.loads {
            let case = entry.case.as_ref().map(|case| self.case(&case.text, case.place));
            let effect = self.effect(entry);
            let (Some(case), Some(effect)) = (case, effect) else { continue };
            let targets = match effect {
                Effect::Nodal { .. } | Effect::Displacement(_) => self.load_targets(entry, Target::Nodes),
                _ => self.load_targets(entry, Target::Ribs),
            };
            for target in targets {
                self.act(case, &effect, target, entry.place);
            }
        }
        if let Some(written) = &entries.load_table {
            self.load_table(written, tables);
        }
    }

    /// Nodes, or members, that a load acts on; self-weight without targets acts on all members.
    fn load_targets(&mut self, entry: &LoadEntry, target: Target) -> Vec<u32> {
        let (wanted, other, key, other_key) = match target {
            Target::Nodes => (&entry.nodes, &entry.ribs, "nodes", "ribs"),
            Target::Ribs => (&entry.ribs, &entry.nodes, "ribs", "nodes"),
        };
        if let Some(other) = other {
            let message = format!("this load acts on {key}, not on {other_key}");
            self.findings.mistake(MistakeCode::UnknownItem, other.place, message, format!("write {key} = [\"…\"]"));
            return Vec::new();
        }
        match wanted {
            Some(Targets { names, .. }) if target == Target::Nodes => self.all_targets(target, names),
            Some(Targets { names, .. }) => {
                let ribs = self.all_targets(target, names);
                self.members_of(&ribs, names)
            }
            None if entry.self_weight.is_some() => (0..self.building.structure.members.len() as u32).collect(),
            None => {
                let message = "this load acts on nothing";
                self.findings.mistake(MistakeCode::Load, entry.place, message, format!("add {key} = [\"…\"], names or patterns"));
                Vec::new()
            }
        }
    }

    /// The members among ribs; a rib named by itself must be one.
    pub(super) fn members_of(&mut self, ribs: &[u32], names: &[Written]) -> Vec<u32> {
        let of_rib = |rib: u32| self.building.structure.member_of_rib.get(rib as usize).copied().flatten();
        let members: Vec<u32> = ribs.iter().filter_map(|&rib| of_rib(rib)).collect();
        if members.is_empty()
            && let (Some(&rib), Some(written)) = (ribs.first(), names.first())
        {
            let message = format!("rib `{}` has no nodes and bears no load", &self.problem.ribs.names[rib as usize]);
            self.findings.mistake(MistakeCode::NoStructure, written.place, message, "give it `start` and `end`");
        }
        members
    }

    /// Enters a load with one target: a node, or a member.
    pub(in crate::input::check) fn act(&mut self, case: u32, effect: &Effect, target: u32, place: Place) {
        let (node, member) = (target, target);
        if let Some(what) = effect.bends()
            && self.building.structure.members[member as usize].pinned
        {
            self.on_a_bar(what, member, place);
            return;
        }
        let action = match effect.clone() {
            Effect::Nodal { force, moment } => Action::Nodal { node, force, moment },
            Effect::Displacement(list) => {
                for (direction, value) in list {
                    if self.is_fixed(node, direction, place) {
                        let action = Action::Displacement { node, direction, value };
                        self.enter(Load { case, action }, place);
                    }
                }
                return;
            }
            Effect::Distributed { axes, force, force_end, from, to } => {
                Action::Distributed { member, axes, force, force_end, from, to }
            }
            Effect::Point { axes, force, moment, at } => Action::Point { member, axes, force, moment, at },
            Effect::SelfWeight => Action::SelfWeight { member },
            Effect::Temperature(change) => Action::Temperature { member, change },
            Effect::Gradient(difference) => Action::Gradient { member, difference },
            Effect::Pretension(force) => Action::Pretension { member, force },
        };
        self.enter(Load { case, action }, place);
    }

    fn enter(&mut self, load: Load, place: Place) {
        self.building.structure.loads.push(load);
        self.building.load_places.push(place);
    }

    fn on_a_bar(&mut self, what: &str, member: u32, place: Place) {
        let rib = self.building.structure.members[member as usize].rib;
        let message = format!("{what}: rib `{}` has pinned joints", &self.problem.ribs.names[rib as usize]);
        self.findings.mistake(MistakeCode::Load, place, message, "load its nodes, or make its joints rigid");
    }

    fn is_fixed(&mut self, node: u32, direction: u8, place: Place) -> bool {
        let held = self.building.held.get(&node).map(|held| self.building.structure.supports[held.support as usize].fixed);
        let fixed = held.is_some_and(|fixed| fixed[direction as usize]);
        if !fixed {
            let (name, direction) = (&self.building.structure.nodes.names[node as usize], DIRECTIONS[direction as usize]);
            let message = format!("node `{name}` is displaced in {direction}, but not supported there");
            self.findings.mistake(
                MistakeCode::Support,
                place,
                message,
                format!("fix `{direction}` of this node under [supports]"),
            );
        }
        fixed
    }
}
