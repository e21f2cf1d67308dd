//! The structure: nodes, materials, members, supports, loads and cases, looked up and by number.
//!
//! Read in the order in which each needs the others: settings and materials, nodes, members (with the ribs), supports, loads,
//! combinations; in the end, when starts of variables are known, places and lengths.

mod cases;
mod coupled;
mod early;
mod lengths;
mod loads;
mod materials;
mod members;
mod nodes;
mod numbers;
mod settings;
mod supports;
pub(super) mod tables;
mod targets;

use std::collections::HashMap;
use std::sync::Arc;

use super::Assembly;
use super::data::DataColumns;
use crate::input::declaration::Declaration;
use crate::input::source::Place;
use crate::input::table::Tables;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::precheck::{self, About};
use crate::problem::structure::Structure;

/// A structure while it is read.
#[derive(Default)]
pub(super) struct Building {
    pub(super) structure: Structure,
    /// Where nodes are declared.
    node_places: Vec<Place>,
    pub(super) node_data: DataColumns,
    materials: HashMap<Box<str>, u32>,
    material_places: Vec<Place>,
    /// Ribs are bars where they do not say otherwise.
    pinned: bool,
    /// Where members say what may turn out wrong once places are known.
    said: HashMap<u32, Said>,
    /// Supports by node: the support, where it is given, and whether by a pattern.
    held: HashMap<u32, Held>,
    cases: HashMap<Box<str>, u32>,
    /// Where cases are met for the first time.
    case_places: Vec<Place>,
    /// Where combinations are declared.
    combination_places: Vec<Place>,
    /// Where loads are given.
    load_places: Vec<Place>,
    targets: targets::Targets,
    /// Ribs by their datum `line`, once they are asked for.
    lines: Option<std::collections::BTreeMap<Box<str>, Vec<u32>>>,
    /// Whether nodes are missing because a table could not be read.
    incomplete: bool,
    /// Whether `plane` is none: how many coordinates there are is not known.
    plane_unknown: bool,
    /// Whether supports are missing for that reason.
    unsupported: bool,
}

/// What a member says of itself.
#[derive(Default, Clone, Copy)]
struct Said {
    length: Option<(f64, Place)>,
    up: Option<Place>,
}

/// A node's support while supports are read.
#[derive(Clone, Copy)]
struct Held {
    support: u32,
    place: Place,
    by_pattern: bool,
}

impl Assembly<'_> {
    /// What members need: settings, materials, nodes.
    pub(super) fn structure_before_ribs(&mut self, declared: &Declaration, tables: &mut Tables<'_>) {
        self.early_definitions(declared);
        self.structure_settings(&declared.structure);
        self.materials(&declared.structure);
        self.nodes(declared, tables);
    }

    /// What speaks of nodes and ribs: supports, masses, loads, combinations.
    pub(super) fn structure_after_ribs(&mut self, declared: &Declaration, tables: &mut Tables<'_>) {
        self.supports(&declared.structure, tables);
        self.masses(&declared.structure);
        self.loads(&declared.structure, tables);
        self.combinations(&declared.structure);
    }

    /// Says what is wrong with the structure at first sight.
    fn first_sight(&mut self, whole: Option<Place>) {
        let sound = self.findings.clean() && !self.building.unsupported && !self.building.incomplete;
        if !sound {
            return; // half a structure has mistakes that the whole one has not
        }
        if self.problem.structure.as_ref().is_some_and(|structure| structure.members.is_empty()) {
            let place = whole.or(self.building.node_places.first().copied()).unwrap_or(Place::Whole);
            self.findings.mistake(
                MistakeCode::NoStructure,
                place,
                "no rib runs between nodes",
                "give ribs `start` and `end`, or leave the structure out",
            );
            return;
        }
        for finding in precheck::findings(&self.problem) {
            let place = self.place_of(finding.about).or(whole).unwrap_or(Place::Whole);
            match finding.code.is_warning() {
                false => self.findings.mistake(finding.code, place, finding.message, finding.help),
                true => self.findings.warning(finding.code, place, finding.message, finding.help),
            }
        }
    }

    fn place_of(&self, about: About) -> Option<Place> {
        let rib_of = |member: u32| self.problem.structure.as_ref()?.members.get(member as usize).map(|member| member.rib);
        match about {
            About::Node(node) => self.building.node_places.get(node as usize).copied(),
            About::Rib(rib) => self.rib_places.get(rib as usize).copied(),
            About::Member(member) => self.rib_places.get(rib_of(member)? as usize).copied(),
            About::Up(member) => self.building.said.get(&member).and_then(|said| said.up),
            About::Material(material) => self.building.material_places.get(material as usize).copied(),
            About::Load(load) => self.building.load_places.get(load as usize).copied(),
            About::Whole => None,
        }
    }

    /// Closes the structure, when the variables' starts are known. Without any of its tables and without members there is none.
    pub(super) fn finish_structure(&mut self, declared: &Declaration) {
        let nodes = self.building.structure.nodes.names.len();
        self.building.structure.nodes.data = std::mem::take(&mut self.building.node_data).finish(nodes);
        self.coordinate_columns();
        if declared.structure.place.is_none() && nodes == 0 && self.building.structure.members.is_empty() {
            return;
        }
        self.building.structure.member_of_rib.resize(self.problem.ribs.names.len(), None);
        self.lengths();
        self.problem.structure = Some(Arc::new(std::mem::take(&mut self.building.structure)));
        self.first_sight(declared.structure.place);
        if self.findings.clean() {
            self.coupled_sections();
        }
    }
}
