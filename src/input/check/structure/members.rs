//! Ribs between nodes.

use super::super::Assembly;
use super::Said;
use crate::input::declaration::structure::MemberEntry;
use crate::input::declaration::{Name, RibEntry};
use crate::input::source::Written;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::structure::{Hinges, Member, Plane};

impl Assembly<'_> {
    /// The members among the problem file's ribs.
    pub(in crate::input::check) fn file_members(&mut self, entries: &[RibEntry]) {
        for entry in entries {
            let Some(Entity::Rib(r)) = self.names.find(&self.problem, &entry.name.text) else { continue };
            if self.rib_places[r as usize] != entry.name.place {
                continue; // the second of two of this name
            }
            let length = entry.length.as_ref().filter(|_| entry.member.given());
            let length = length.map(|scalar| (self.problem.ribs.length[r as usize], scalar.place()));
            self.member(r, &entry.name, &entry.member, length);
        }
    }

    /// Makes a rib a member, if it has nodes.
    pub(in crate::input::check) fn member(
        &mut self,
        r: u32,
        name: &Name,
        entry: &MemberEntry,
        length: Option<(f64, crate::input::source::Place)>,
    ) {
        if !entry.given() {
            if let Some(place) = entry.key {
                let message = format!("rib `{}` has no nodes", name.text);
                self.findings.mistake(
                    MistakeCode::NoStructure,
                    place,
                    message,
                    "add start = \"NODE\" and end = \"NODE\", or leave this out",
                );
            }
            return;
        }
        let (start, end) = self.ends_of(name, entry);
        let material = self.material_of(entry.material.as_ref(), name);
        let pinned = entry.joints.as_ref().map_or(Some(self.building.pinned), |written| self.joints(written));
        let up = entry.up.as_ref().and_then(|up| self.along(up, "up"));
        let roll = entry.roll.as_ref().and_then(|roll| self.finite(roll)).unwrap_or(0.0);
        let hinges = self.hinges(entry);
        let offset =
            entry.offset.each_ref().map(|arm| arm.as_ref().and_then(|arm| self.along(arm, "offset")).unwrap_or_default());
        let (Some(start), Some(end), Some(material)) = (start, end, material) else { return };
        let pinned = pinned.unwrap_or(false);
        let member = Member { rib: r, start, end, material, up, roll, pinned, hinges, offset, shear: entry.shear, absent: false };
        let number = self.building.structure.members.len() as u32;
        self.building.structure.members.push(member);
        let of_rib = &mut self.building.structure.member_of_rib;
        of_rib.resize((r as usize + 1).max(of_rib.len()), None);
        of_rib[r as usize] = Some(number);
        let said = Said { length, up: entry.up.as_ref().map(|up| up.place) };
        if said.length.is_some() || said.up.is_some() {
            self.building.said.insert(number, said);
        }
    }

    fn ends_of(&mut self, name: &Name, entry: &MemberEntry) -> (Option<u32>, Option<u32>) {
        let (Some(start), Some(end)) = (&entry.start, &entry.end) else {
            let lacking = if entry.start.is_some() { "end" } else { "start" };
            let message = format!("rib `{}` lacks `{lacking}`", name.text);
            self.findings.mistake(MistakeCode::RibEnds, name.place, message, format!("add {lacking} = \"NODE\""));
            let given = entry.start.as_ref().or(entry.end.as_ref());
            given.and_then(|written| self.node_named(written));
            return (None, None);
        };
        if start.text == end.text {
            let message = format!("rib `{}` starts and ends at node `{}`", name.text, start.text);
            self.findings.mistake(MistakeCode::RibEnds, end.place, message, "a rib runs between two nodes");
            return (None, None);
        }
        (self.node_named(start), self.node_named(end))
    }

    fn hinges(&mut self, entry: &MemberEntry) -> [Hinges; 2] {
        if let Some(written) = &entry.hinged {
            let both = Hinges { my: true, mz: self.building.structure.plane == Plane::Space, torque: false };
            return match written.text.as_str() {
                "both" => [both, both],
                "start" => [both, Hinges::default()],
                "end" => [Hinges::default(), both],
                _ => {
                    let known = ["both", "start", "end"];
                    let _: Option<()> = self.unknown_word(written, "place of hinges", &known);
                    Default::default()
                }
            };
        }
        entry.hinges.each_ref().map(|released| self.released(released))
    }

    /// The forces released at one end.
    fn released(&mut self, list: &[Written]) -> Hinges {
        let mut hinges = Hinges::default();
        for written in list {
            match written.text.as_str() {
                "My" => hinges.my = true,
                "Mz" | "T" if self.building.structure.plane != Plane::Space => {
                    let message = format!("a plane structure has no {}", written.text);
                    self.findings.mistake(MistakeCode::UnknownChoice, written.place, message, "its only moment is My");
                }
                "Mz" => hinges.mz = true,
                "T" => hinges.torque = true,
                "N" | "Vy" | "Vz" => {
                    let message = format!("{} cannot be released", written.text);
                    self.findings.mistake(MistakeCode::UnknownChoice, written.place, message, "a hinge releases My, Mz or T");
                }
                _ => {
                    let _: Option<()> = self.unknown_word(written, "force", &["My", "Mz", "T"]);
                }
            }
        }
        hinges
    }
}
