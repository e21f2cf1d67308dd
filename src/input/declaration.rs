//! The file as declared: shapes checked, names not yet looked up, places kept.

pub(super) mod checks;
pub(super) mod structure;

use std::collections::BTreeMap;

use super::fields::Scalar;
use super::source::{Place, Written};
use crate::expression::ast::Collection;
use crate::problem::{Sense, Settings, VolumeLaw};
use crate::units::{Dimension, Unit};

/// Everything the problem file says; tables are read later.
#[derive(Default)]
pub(super) struct Declaration {
    pub title: Option<String>,
    pub units: Vec<(String, Written)>,
    /// Units that reports are to show, with their names.
    pub show: Vec<(Unit, String)>,
    /// Dimensions of data that are given with units, by the places of their keys.
    pub measured: BTreeMap<Place, Dimension>,
    /// The sense and the expression; no expression where it is of a wrong type.
    pub objective: Option<(Sense, Option<Written>)>,
    pub parameters: Vec<(Name, Numbers)>,
    /// `[variables]`, then the control values of `[profiles]`.
    pub variables: Vec<VariableEntry>,
    pub profiles: Vec<ProfileEntry>,
    pub definitions: Vec<(Name, DefinitionEntry)>,
    pub catalogues: Vec<CatalogueEntry>,
    pub sections: Vec<SectionEntry>,
    pub ribs: Vec<RibEntry>,
    pub constraints: Vec<ConstraintEntry>,
    pub checks: Vec<checks::CheckEntry>,
    pub settings: Settings,
    pub structure: structure::StructureEntries,
    pub section_table: Option<Written>,
    pub rib_table: Option<Written>,
}

/// A name and where it is given.
#[derive(Debug, Clone)]
pub(super) struct Name {
    pub text: String,
    pub place: Place,
}

/// One number, or several.
pub(super) enum Numbers {
    One(Scalar),
    Many(Vec<Scalar>, Place),
}

/// Bounds and start.
pub(super) struct Range<T> {
    pub lower: Option<T>,
    pub upper: Option<T>,
    pub start: Option<T>,
}

impl<T> Default for Range<T> {
    fn default() -> Self {
        Range { lower: None, upper: None, start: None }
    }
}

/// An entry of `[variables]`.
pub(super) struct VariableEntry {
    pub name: Name,
    pub size: Option<Scalar>,
    pub range: Range<Numbers>,
    pub list: Option<ListEntry>,
    /// Above 0, which is no bound.
    pub positive: bool,
}

/// `step`, `values` or `integer` beside the bounds of a variable or dimension.
pub(super) struct ListEntry {
    pub place: Place,
    pub values: Listing,
}

/// How a list is given.
pub(super) enum Listing {
    /// From the lower bound in steps.
    Step(Scalar),
    Values(Vec<Scalar>),
    /// Whole numbers.
    Integer,
}

/// An entry of `[definitions]`.
pub(super) enum DefinitionEntry {
    One(Scalar),
    Sequence(SequenceEntry),
}

/// Elements that follow from those before them.
pub(super) struct SequenceEntry {
    /// `i in 1..N`
    pub range: Written,
    /// The first elements.
    pub first: Vec<Scalar>,
    /// The others, by the index and the elements before.
    pub value: Written,
}

impl DefinitionEntry {
    /// The texts it is made of.
    pub fn texts(&self) -> impl Iterator<Item = &Written> {
        let (one, first, value) = match self {
            DefinitionEntry::One(scalar) => (Some(scalar), &[][..], None),
            DefinitionEntry::Sequence(entry) => (None, &entry.first[..], Some(&entry.value)),
        };
        let scalars = one.into_iter().chain(first).filter_map(|scalar| match scalar {
            Scalar::Expression(written) => Some(written),
            Scalar::Number(..) => None,
        });
        scalars.chain(value)
    }
}

/// An entry of `[profiles]`.
pub(super) struct ProfileEntry {
    pub name: Name,
    /// Its control values among [`Declaration::variables`].
    pub variable: usize,
    pub degree: Degree,
    pub knots: Option<(Vec<Scalar>, Place)>,
}

/// A profile's degree.
pub(super) enum Degree {
    /// By its kind.
    Fixed(u32),
    /// As given.
    Given(Scalar),
}

/// `points = [[x, y], …]` and `holes = [[[x, y], …], …]`: numbers or constant expressions.
pub(super) struct PointsEntry {
    /// The points, then those of each hole; `None` after a mistake in one of them.
    pub rings: Option<Vec<Vec<[Scalar; 2]>>>,
    pub place: Place,
}

/// An entry of `[sections]`.
pub(super) struct SectionEntry {
    pub name: Name,
    /// `None` where it is missing (already a mistake).
    pub kind: Option<Written>,
    /// Which catalogue a section of kind `catalogue` is from.
    pub from: Option<Written>,
    pub points: Option<PointsEntry>,
    pub dimensions: Vec<(Name, DimensionEntry)>,
    pub data: Vec<(Name, Datum)>,
}

/// An entry of `[catalogues]`.
pub(super) struct CatalogueEntry {
    pub name: Name,
    pub file: Written,
    /// The kind of its sections; `general` where nothing is said.
    pub kind: Option<Written>,
    /// Properties by which its sections are known, instead of their dimensions.
    pub properties: Vec<Written>,
}

/// How a dimension is given.
pub(super) enum DimensionEntry {
    Given(Scalar),
    Own(Range<Scalar>, Option<ListEntry>),
}

/// A value of `data`.
#[derive(Debug, Clone)]
pub(super) enum Datum {
    Number(f64),
    Text(String),
    /// As many columns, `M[1]`, `M[2]`, ….
    Numbers(Vec<f64>),
}

/// An entry of `[[ribs]]`.
pub(super) struct RibEntry {
    pub name: Name,
    pub from: Option<Written>,
    pub to: Option<Written>,
    pub length: Option<Scalar>,
    pub law: VolumeLaw,
    pub data: Vec<(Name, Datum)>,
    /// What makes it a member of the structure.
    pub member: structure::MemberEntry,
}

/// An entry of `[[constraints]]`.
pub(super) struct ConstraintEntry {
    /// `None` where it has no name.
    pub name: Option<Name>,
    pub place: Place,
    pub repeated: Option<Collection>,
    /// `for = "i in 1..N"`
    pub index: Option<Written>,
    pub only: Vec<Written>,
    pub kind: Option<Written>,
    pub filter: Option<Written>,
    pub by: Option<Written>,
    /// Patterns of cases and combinations.
    pub cases: Vec<Written>,
    pub require: Option<Written>,
}

impl ConstraintEntry {
    /// A requirement that is stated once.
    pub fn once(name: Name, require: Written) -> ConstraintEntry {
        ConstraintEntry {
            place: name.place,
            name: Some(name),
            repeated: None,
            index: None,
            only: Vec::new(),
            kind: None,
            filter: None,
            by: None,
            cases: Vec::new(),
            require: Some(require),
        }
    }
}
