//! `[structure]`, `[materials]`, `[nodes]`, `[supports]`, `[masses]`, `[[loads]]`, `[combinations]` and the ribs' part of it, as declared.

use super::{Datum, Name};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};

/// All of it.
#[derive(Default)]
pub(in crate::input) struct StructureEntries {
    /// Where `[structure]` stands, if it does.
    pub place: Option<Place>,
    pub plane: Option<Written>,
    pub joints: Option<Written>,
    pub gravity: Option<Vector>,
    pub stations: Option<Stations>,
    pub buckling_pieces: Option<Scalar>,
    pub materials: Vec<MaterialEntry>,
    pub nodes: Vec<NodeEntry>,
    pub supports: Vec<SupportEntry>,
    pub masses: Vec<(Name, Scalar)>,
    pub loads: Vec<LoadEntry>,
    pub combinations: Vec<CombinationEntry>,
    pub node_table: Option<Written>,
    pub support_table: Option<Written>,
    pub load_table: Option<Written>,
}

/// Numbers along axes, or about them.
#[derive(Debug, Clone)]
pub(in crate::input) struct Vector {
    pub parts: Vec<Scalar>,
    pub place: Place,
}

/// `stations`: how many, or where.
pub(in crate::input) enum Stations {
    Count(Scalar),
    At(Vector),
}

/// An entry of `[materials]`.
pub(in crate::input) struct MaterialEntry {
    pub name: Name,
    /// Every number under its key: E, G, nu, density, alpha and further ones.
    pub numbers: Vec<(Name, Scalar)>,
}

/// An entry of `[nodes]`.
pub(in crate::input) struct NodeEntry {
    pub name: Name,
    /// `None` after a mistake.
    pub at: Option<Vector>,
    pub data: Vec<(Name, Datum)>,
}

/// An entry of `[supports]`: a node or a pattern.
pub(in crate::input) struct SupportEntry {
    pub node: Name,
    pub fix: Option<Fix>,
    pub springs: Vec<(Name, Scalar)>,
}

/// What a support holds.
pub(in crate::input) enum Fix {
    /// `fixed` or `pinned`.
    Word(Written),
    Directions(Vec<Written>),
}

/// What makes a rib a member.
#[derive(Default)]
pub(in crate::input) struct MemberEntry {
    pub start: Option<Written>,
    pub end: Option<Written>,
    pub material: Option<Written>,
    pub up: Option<Vector>,
    pub roll: Option<Scalar>,
    pub joints: Option<Written>,
    /// Forces released at the start and at the end.
    pub hinges: [Vec<Written>; 2],
    /// `hinges = "both"`, `"start"` or `"end"`: both moments there.
    pub hinged: Option<Written>,
    pub offset: [Option<Vector>; 2],
    pub shear: bool,
    /// The first key that only a member has.
    pub key: Option<Place>,
}

/// An entry of `[[loads]]`.
pub(in crate::input) struct LoadEntry {
    pub place: Place,
    pub case: Option<Written>,
    /// Whether some key says what acts, be it rightly or wrongly.
    pub acts: bool,
    pub nodes: Option<Targets>,
    pub ribs: Option<Targets>,
    pub axes: Option<Written>,
    pub force: Option<Vector>,
    pub force_end: Option<Vector>,
    pub moment: Option<Vector>,
    pub from: Option<Scalar>,
    pub to: Option<Scalar>,
    pub at: Option<Scalar>,
    pub self_weight: Option<Place>,
    pub temperature: Option<Scalar>,
    pub gradient: Option<Scalar>,
    pub pretension: Option<Scalar>,
    pub displacement: Option<Vec<(Name, Scalar)>>,
}

/// Names or patterns.
pub(in crate::input) struct Targets {
    pub names: Vec<Written>,
    pub place: Place,
}

/// An entry of `[combinations]`.
pub(in crate::input) struct CombinationEntry {
    pub name: Name,
    pub factors: Vec<(Name, Scalar)>,
}

impl MemberEntry {
    /// Whether the rib belongs to the structure.
    pub fn given(&self) -> bool {
        self.start.is_some() || self.end.is_some()
    }
}
