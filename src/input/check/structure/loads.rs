//! `[[loads]]`: a case, targets, one kind.

use super::super::Assembly;
use super::targets::Target;
use crate::input::declaration::Name;
use crate::input::declaration::structure::{LoadEntry, StructureEntries, Targets};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::input::table::Tables;
use crate::problem::structure::{Action, Axes, DIRECTIONS, Load};
use crate::problem::words::brief;

/// What a load does, before its targets are known.
#[derive(Clone)]
pub(in crate::input::check) enum Effect {
    /// Force and moment at nodes.
    Nodal {
        force: [f64; 3],
        moment: [f64; 3],
    },
    /// Displacements of supported directions.
    Displacement(Vec<(u8, f64)>),
    Distributed {
        axes: Axes,
        force: [f64; 3],
        force_end: [f64; 3],
        from: f64,
        to: f64,
    },
    Point {
        axes: Axes,
        force: [f64; 3],
        moment: [f64; 3],
        at: f64,
    },
    SelfWeight,
    Temperature(f64),
    Gradient(f64),
    Pretension(f64),
}

impl Effect {
    /// Whether it bends a member between its ends, which a bar cannot bear.
    fn bends(&self) -> Option<&'static str> {
        match self {
            Effect::Distributed { .. } => Some("a load along a bar"),
            Effect::Point { .. } => Some("a load within a bar"),
            Effect::Gradient(_) => Some("a gradient of temperature in a bar"),
            _ => None,
        }
    }
}

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
            self.findings.mistake(other.place, message, format!("write {key} = [\"…\"]"));
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
                self.findings.mistake(entry.place, message, format!("add {key} = [\"…\"], names or patterns"));
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
            self.findings.mistake(written.place, message, "give it `start` and `end`");
        }
        members
    }

    /// What a load does; `None` after a mistake.
    fn effect(&mut self, entry: &LoadEntry) -> Option<Effect> {
        self.one_kind(entry)?;
        if entry.self_weight.is_some() {
            return Some(Effect::SelfWeight);
        }
        if let Some(scalar) = &entry.temperature {
            return self.finite(scalar).map(Effect::Temperature);
        }
        if let Some(scalar) = &entry.gradient {
            return self.finite(scalar).map(Effect::Gradient);
        }
        if let Some(scalar) = &entry.pretension {
            return self.finite(scalar).map(Effect::Pretension);
        }
        if let Some(list) = &entry.displacement {
            return self.displacements(list).map(Effect::Displacement);
        }
        match &entry.nodes {
            Some(_) => self.nodal(entry),
            None => self.spanning(entry),
        }
    }

    /// A load is of exactly one kind.
    fn one_kind(&mut self, entry: &LoadEntry) -> Option<()> {
        let force = entry.force.as_ref().or(entry.moment.as_ref()).map(|vector| ("`force`", vector.place));
        let scalar = |scalar: &Option<Scalar>, word| scalar.as_ref().map(|scalar| (word, scalar.place()));
        let displacement = entry.displacement.as_ref().map(|list| list.first().map_or(entry.place, |(name, _)| name.place));
        let kinds: Vec<(&str, Place)> = [
            entry.self_weight.map(|place| ("`self_weight`", place)),
            force,
            scalar(&entry.temperature, "`temperature`"),
            scalar(&entry.gradient, "`gradient`"),
            scalar(&entry.pretension, "`pretension`"),
            displacement.map(|place| ("`displacement`", place)),
        ]
        .into_iter()
        .flatten()
        .collect();
        match kinds.as_slice() {
            [_] => Some(()),
            [] if entry.acts => None,
            [] => {
                let help = "known: force, moment, self_weight, temperature, gradient, pretension, displacement";
                self.findings.mistake(entry.place, "this load says nothing that acts", help);
                None
            }
            [(first, _), (second, place), ..] => {
                let message = format!("{first} and {second} in one load");
                self.findings.mistake(*place, message, "write a [[loads]] of its own for each");
                None
            }
        }
    }

    fn nodal(&mut self, entry: &LoadEntry) -> Option<Effect> {
        let along = [&entry.from, &entry.to, &entry.at].into_iter().flatten().map(Scalar::place);
        let along = along.chain(entry.force_end.as_ref().map(|vector| vector.place));
        for place in along.chain(entry.axes.as_ref().map(|axes| axes.place)) {
            self.findings.mistake(place, "this belongs to a load on ribs", "leave it out: forces at nodes have global axes");
        }
        let force = entry.force.as_ref().map_or(Some([0.0; 3]), |force| self.along(force, "force"));
        let moment = entry.moment.as_ref().map_or(Some([0.0; 3]), |moment| self.about(moment, false));
        Some(Effect::Nodal { force: force?, moment: moment? })
    }

    fn spanning(&mut self, entry: &LoadEntry) -> Option<Effect> {
        let axes = entry.axes.as_ref().map_or(Some(Axes::Global), |written| self.axes(written));
        let local = axes == Some(Axes::Local);
        let mut along = |vector: &Option<_>, what: &str| match vector {
            Some(vector) if local => self.along_member(vector, what).map(Some),
            Some(vector) => self.along(vector, what).map(Some),
            None => Some(None),
        };
        let (force, force_end) = (along(&entry.force, "force"), along(&entry.force_end, "force_end"));
        let moment = entry.moment.as_ref().map_or(Some(None), |moment| self.about(moment, local).map(Some));
        let (axes, force, force_end, moment) = (axes?, force?, force_end?, moment?);
        if let Some(at) = &entry.at {
            return self.point(entry, axes, at, force, moment);
        }
        if let Some(moment) = &entry.moment {
            self.findings.mistake(moment.place, "a moment on a rib needs `at`", "add at = …, a fraction of the rib's length");
            return None;
        }
        let force = force?;
        let from = entry.from.as_ref().map_or(Some(0.0), |from| self.fraction(from, "from"));
        let to = entry.to.as_ref().map_or(Some(1.0), |to| self.fraction(to, "to"));
        let (from, to) = (from?, to?);
        if from >= to {
            let place = entry.to.as_ref().or(entry.from.as_ref()).map_or(entry.place, Scalar::place);
            self.findings.mistake(place, format!("a load from {from} to {to}"), "`from` comes before `to`");
            return None;
        }
        Some(Effect::Distributed { axes, force, force_end: force_end.unwrap_or(force), from, to })
    }

    fn point(
        &mut self,
        entry: &LoadEntry,
        axes: Axes,
        at: &Scalar,
        force: Option<[f64; 3]>,
        moment: Option<[f64; 3]>,
    ) -> Option<Effect> {
        let along = [&entry.from, &entry.to].into_iter().flatten().map(Scalar::place);
        for place in along.chain(entry.force_end.as_ref().map(|vector| vector.place)) {
            self.findings.mistake(place, "a force at a point has no extent", "keep either `at` or `from`, `to`, `force_end`");
        }
        let at = self.fraction(at, "at")?;
        Some(Effect::Point { axes, force: force.unwrap_or_default(), moment: moment.unwrap_or_default(), at })
    }

    pub(in crate::input::check) fn axes(&mut self, written: &Written) -> Option<Axes> {
        match written.text.as_str() {
            "global" => Some(Axes::Global),
            "local" => Some(Axes::Local),
            "projected" => Some(Axes::Projected),
            _ => self.unknown_word(written, "axes", &["global", "local", "projected"]),
        }
    }

    /// A fraction of a rib's length.
    pub(in crate::input::check) fn fraction(&mut self, scalar: &Scalar, key: &str) -> Option<f64> {
        let value = self.finite(scalar)?;
        if (0.0..=1.0).contains(&value) {
            return Some(value);
        }
        let message = format!("`{key}` cannot be {}", brief(value));
        self.findings.mistake(scalar.place(), message, "expected a fraction of the rib's length, from 0 to 1");
        None
    }

    fn displacements(&mut self, list: &[(Name, Scalar)]) -> Option<Vec<(u8, f64)>> {
        let each = list.iter().map(|(name, scalar)| {
            let (direction, value) = (self.direction(&name.text, name.place), self.finite(scalar));
            Some((direction? as u8, value?))
        });
        each.collect::<Vec<_>>().into_iter().collect()
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
        self.findings.mistake(place, message, "load its nodes, or make its joints rigid");
    }

    fn is_fixed(&mut self, node: u32, direction: u8, place: Place) -> bool {
        let held = self.building.held.get(&node).map(|held| self.building.structure.supports[held.support as usize].fixed);
        let fixed = held.is_some_and(|fixed| fixed[direction as usize]);
        if !fixed {
            let (name, direction) = (&self.building.structure.nodes.names[node as usize], DIRECTIONS[direction as usize]);
            let message = format!("node `{name}` is displaced in {direction}, but not supported there");
            self.findings.mistake(place, message, format!("fix `{direction}` of this node under [supports]"));
        }
        fixed
    }
}
