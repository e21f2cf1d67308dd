//! What members need of their sections, materials and orientation.

use std::collections::BTreeMap;

use super::{About, Site, plural};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::statics::{components, rule_of};
use crate::problem::structure::{Action, Member, Plane};
use crate::sections;
use crate::structure::algebra::Numbers;
use crate::structure::axes::{Rule, frame};
use crate::structure::deformation::rows;

/// A member is nearly vertical where its horizontal part is below this share of its length: 3°.
const NEARLY_VERTICAL: f64 = 0.052_335_956_242_943_83;

impl Site<'_> {
    pub(super) fn members(&mut self) {
        self.parallel_ups();
        self.vertical();
        self.sections();
        self.materials();
        self.ribs_without_nodes();
    }

    /// A member's unit vectors.
    pub(super) fn axes(&self, member: u32) -> [[f64; 3]; 3] {
        let (along, member) = (self.along(member), &self.structure.members[member as usize]);
        frame(&mut Numbers, along, rule_of(self.structure.plane, member, along), member.roll).axes
    }

    fn parallel_ups(&mut self) {
        for at in 0..self.structure.members.len() as u32 {
            let member = &self.structure.members[at as usize];
            let Some(up) = member.up else { continue };
            if Rule::Towards(up).is_parallel(self.along(at)) || up == [0.0; 3] {
                let message = format!("`up` of rib `{}` points along the rib", self.rib_name(at));
                self.find(
                    MistakeCode::Coordinates,
                    About::Up(at),
                    message,
                    "give a direction across it: where the section's height points",
                );
            }
        }
    }

    /// Members whose orientation hangs on a rule that changes nearby.
    fn vertical(&mut self) {
        if self.structure.plane != Plane::Space {
            return;
        }
        let mut by_rule: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
        for at in 0..self.structure.members.len() as u32 {
            let (member, along) = (&self.structure.members[at as usize], self.along(at));
            let steep = along[0].hypot(along[1]) < NEARLY_VERTICAL * along.iter().map(|part| part * part).sum::<f64>().sqrt();
            if steep && member.up.is_none() && !member.pinned && !self.is_round(member) {
                let axis = if Rule::in_space(along) == Rule::Towards([1.0, 0.0, 0.0]) { "x" } else { "z" };
                by_rule.entry(axis).or_default().push(at);
            }
        }
        for (axis, members) in by_rule {
            let (count, words) = (members.len(), self.ribs_in_words(members.iter().copied()));
            let (is, whose) = if count == 1 { ("is", "its") } else { ("are", "their") };
            let rule = match axis {
                "x" => "along x, as vertical ribs have it",
                _ => "towards z as nearly as it can, as other ribs have it",
            };
            let message = format!(
                "{} {words} {is} within 3° of vertical without `up`: {whose} section's height points {rule}",
                plural("rib", count)
            );
            self.find(MistakeCode::DefaultHeight, About::Member(members[0]), message, "say where it points: up = [1, 0, 0]");
        }
    }

    /// Whether a turn about its axis changes nothing.
    fn is_round(&self, member: &Member) -> bool {
        let section = self.problem.ribs.from[member.rib as usize];
        let form = self.problem.sections.form.get(section as usize);
        form.is_some_and(|&form| ["circle", "tube"].contains(&sections::kind_of(form).name()))
    }

    /// Properties that the forces a member carries ask for.
    fn sections(&mut self) {
        let mut lacking: BTreeMap<(u16, Vec<&'static str>), Vec<u32>> = BTreeMap::new();
        let mut warped = vec![false; self.structure.members.len()];
        for load in &self.structure.loads {
            if let Action::Gradient { member, .. } = load.action {
                warped[member as usize] = true;
            }
        }
        for at in 0..self.structure.members.len() as u32 {
            let needs = self.needs(at, warped[at as usize]);
            for form in self.forms(at) {
                let known = sections::form(form);
                let absent: Vec<&'static str> = needs.iter().copied().filter(|name| !sections::offers(known, name)).collect();
                if !absent.is_empty() {
                    lacking.entry((form, absent)).or_default().push(at);
                    break;
                }
            }
        }
        for ((form, absent), members) in lacking {
            self.say_lacking(sections::kind_of(form).name(), &absent, &members);
        }
    }

    fn say_lacking(&mut self, kind: &str, absent: &[&str], members: &[u32]) {
        let (count, words) = (members.len(), self.ribs_in_words(members.iter().copied()));
        let list = absent.join(", ");
        let bend = if count == 1 { "bends or twists" } else { "bend or twist" };
        let whose = if kind == "general" { "the section".to_owned() } else { format!("a section of kind {kind}") };
        let message = format!("{} {words} {bend}, but {whose} has no {list}", plural("rib", count));
        let help = match (kind, absent) {
            (_, [.., "height"]) => "a gradient of temperature needs a section with a height: choose another kind".to_owned(),
            ("general", _) => format!("give {list}, or joints = \"pinned\" to bars, which have an axial force only"),
            (_, ["J"]) => "release the torque at one end, hinges = { end = [\"T\"] }, or choose another kind".to_owned(),
            _ => "choose another kind".to_owned(),
        };
        self.find(MistakeCode::Material, About::Member(members[0]), message, help);
    }

    /// Forms of the sections at a member's ends, by number.
    fn forms(&self, at: u32) -> Vec<u16> {
        let rib = self.structure.members[at as usize].rib as usize;
        let ends = [self.problem.ribs.from[rib], self.problem.ribs.to[rib]];
        let mut forms: Vec<u16> = ends.iter().filter_map(|&s| self.problem.sections.form.get(s as usize).copied()).collect();
        forms.dedup();
        forms
    }

    /// Properties by which a member deforms; `warped`: its temperature differs between top and bottom.
    fn needs(&self, at: u32, warped: bool) -> Vec<&'static str> {
        let member = &self.structure.members[at as usize];
        let carried = self.carried(at);
        let gradient = (warped && (carried[3] || carried[4])).then_some("height");
        member.deforms_by(&carried).chain(gradient).collect()
    }

    /// Which basic forces a member carries: N, Mz and My at both ends, T.
    fn carried(&self, at: u32) -> crate::structure::Components {
        let (along, member) = (self.along(at), &self.structure.members[at as usize]);
        let frame = frame(&mut Numbers, along, rule_of(self.structure.plane, member, along), member.roll);
        components(self.structure.plane, member, &rows(&mut Numbers, &frame, member.offset))
    }

    /// What materials lack of what is asked of them.
    fn materials(&mut self) {
        let count = self.structure.materials.len();
        let mut twisted = vec![None; count];
        for at in 0..self.structure.members.len() as u32 {
            let member = &self.structure.members[at as usize];
            if member.needs_shear_modulus(&self.carried(at)) {
                twisted[member.material as usize].get_or_insert(at);
            }
        }
        let (mut heavy, mut warm) = (vec![None; count], vec![None; count]);
        for (number, load) in self.structure.loads.iter().enumerate() {
            let (list, member) = match load.action {
                Action::SelfWeight { member } => (&mut heavy, member),
                Action::Temperature { member, .. } | Action::Gradient { member, .. } => (&mut warm, member),
                _ => continue,
            };
            list[self.structure.members[member as usize].material as usize].get_or_insert(number as u32);
        }
        for number in 0..count {
            let (name, material) = (&self.structure.materials[number].name, &self.structure.materials[number]);
            let (no_shear, no_weight, no_warmth) =
                (material.shear.is_none(), material.density.is_none(), material.expansion.is_none());
            let lacks = |what: &str| format!("material `{name}` lacks {what}");
            let said = [
                (
                    no_shear,
                    twisted[number].map(|_| About::Material(number as u32)),
                    lacks("`G` or `nu`, which torsion and shear go by"),
                ),
                (no_weight, heavy[number].map(About::Load), lacks("the `density` that self-weight goes by")),
                (no_warmth, warm[number].map(About::Load), lacks("`alpha`, by which warmth lengthens it")),
            ];
            let helps = ["add G = …, or nu = …", "add density = …", "add alpha = …, such as 1.2e-5"];
            for ((absent, about, message), help) in said.into_iter().zip(helps) {
                if let (true, Some(about)) = (absent, about) {
                    self.find(MistakeCode::Material, about, message, help);
                }
            }
        }
        if let Some(first) = heavy.iter().flatten().min()
            && self.structure.gravity == [0.0; 3]
        {
            let help =
                "add gravity = [0, 0, -9.81] to [structure], or [0, 0, -1] where `density` is a weight; in a plane two numbers";
            self.find(MistakeCode::Load, About::Load(*first), "self-weight without `gravity`".to_owned(), help);
        }
    }

    /// Ribs beside the structure, which carry nothing.
    fn ribs_without_nodes(&mut self) {
        let outside: Vec<u32> =
            (0..self.problem.ribs.names.len() as u32).filter(|&rib| self.structure.member(rib).is_none()).collect();
        if outside.is_empty() || self.structure.members.is_empty() {
            return;
        }
        let named: Vec<&str> = outside.iter().take(super::NAMED).map(|&rib| &self.problem.ribs.names[rib as usize]).collect();
        let (is, has) = if outside.len() == 1 { ("is", "has") } else { ("are", "have") };
        let words = super::listed(&named, outside.len());
        let message = format!("{} {words} {has} no nodes and {is} no part of the structure", plural("rib", outside.len()));
        self.find(MistakeCode::Unused, About::Rib(outside[0]), message, "give `start` and `end`, unless this is meant");
    }
}
