//! Cross-sections: their dimensions, and area, moments and moduli as expression graphs (so that every derivative is exact).
//!
//! A new kind is a new file with a [`Kind`] and a line in [`KINDS`]: its defaults, example and explanations are its own, and `mesh ribs`,
//! `new`, `bounds`, the schema and the reader ask the table. `toy` is such a file, for tests.
//! Conventions: x = width, y = height, origin at the centroid; `Ix = ∫y² dA` (Eurocode's Iy), `Iy = ∫x² dA`.

mod angle;
mod box_beam;
mod build;
mod channel;
mod circle;
pub mod defaults;
mod fibre;
mod general;
mod h_beam;
mod i_section;
mod length;
mod outline;
mod pieces;
mod polygon;
mod polyline;
mod properties;
mod rectangle;
mod rectangles;
mod superellipse;
mod tee;
#[cfg(test)]
mod toy;
mod tube;

use std::sync::LazyLock;

use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;
pub use defaults::Defaults;
pub use fibre::{Fibre, Points};
pub use length::Length;
use properties::not_positive;
pub use properties::{evaluate, offers, values};

/// What a kind's formulas start from: the given dimensions of one section as nodes, and its points where it is drawn by points.
pub struct Given<'a> {
    /// The form the dimensions are given in.
    pub form: &'static Form,
    /// One node per dimension of the form.
    pub dimensions: &'a [NodeId],
    /// Points, for kinds drawn by points: of the polygon or the line, then of each hole.
    pub outline: &'a [Ring],
}

/// One way to give a kind's dimensions: which ones, by which names.
#[derive(Debug, PartialEq, Eq)]
pub struct Form {
    /// The kind's name in files.
    pub kind: &'static str,
    /// Names of the given dimensions, in order.
    pub dimensions: &'static [&'static str],
}

/// A kind of cross-section.
pub trait Kind: Sync {
    /// Its name in files: `h-beam`.
    fn name(&self) -> &'static str;

    /// The ways to give its dimensions. A file's section must match exactly one.
    fn forms(&self) -> &'static [Form];

    /// A commented problem file with sections of this kind, to start from.
    fn example(&self) -> &'static str;

    /// Bounds, starts and proportions for those who ask for no others; `None` where it needs points.
    fn defaults(&self) -> Option<&'static Defaults> {
        None
    }

    /// Why, with bounds alone, the volume is least at the upper bound of a dimension of `section`; `None` where nothing explains it.
    fn explain_upper_bound(&self, _form: &Form, _dimension: &str, _section: &str) -> Option<String> {
        None
    }

    /// Every name it offers in expressions: dimensions given or derived, aliases, properties.
    fn properties(&self) -> &'static [&'static str];

    /// The node of a property or dimension; `None` for a name it does not offer.
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId>;

    /// The points at which stresses are looked at where none is named.
    fn points(&self, _form: &Form) -> Points {
        Points { normal: fibre::CORNERS, upright: fibre::UPRIGHT, shear: &[] }
    }

    /// A point by its name, without shear stresses unless the kind knows them; `None` for a name it does not know.
    fn fibre(&self, graph: &mut Graph, given: &Given, point: &str) -> Option<Fibre> {
        fibre::extreme(self, graph, given, point)
    }

    /// The areas of the parts whose frusta make up a rib's volume: the whole area, or web and flanges.
    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId>;

    /// The same parts as products of two lengths, in the form's dimensions, where they are that: ribs between such sections
    /// have their volume in closed form. Empty where they are not.
    fn part_factors(&self, form: &Form) -> &'static [[Length; 2]] {
        let _ = form;
        &[]
    }

    /// Dimensions (by property name) that must stay positive for the section to exist, besides the given ones: `tf` of an H beam.
    fn positive(&self) -> &'static [&'static str] {
        &[]
    }

    /// May this dimension be given as 0, which is as good as leaving it out: the root radius of an H beam?
    fn absent(&self, _dimension: &str) -> bool {
        false
    }

    /// Is a rib's frustum volume a posynomial of the dimensions given in this form (for `superellipse`: with one fixed r)?
    fn posynomial_volume(&self, _form: &Form) -> bool {
        false
    }

    /// Is it drawn by points ([`Given::outline`])?
    fn has_outline(&self) -> bool {
        false
    }

    /// May its outline have holes?
    fn takes_holes(&self) -> bool {
        false
    }

    /// What is wrong with these points, whatever the dimensions.
    fn outline_defect(&self, _form: &Form, _outline: &[Ring]) -> Option<String> {
        None
    }

    /// What is wrong with the section at numeric dimensions, in the form's order: one that is not positive, an outline that meets itself.
    fn defect(&self, form: &Form, given: &[f64], outline: &[Ring]) -> Option<String> {
        not_positive(self.name(), form, given, outline)
    }

    /// Has it a boundary at all? Without one there are no pictures and no solids of it.
    fn has_rings(&self) -> bool {
        true
    }

    /// The boundary at numeric dimensions: the outer ring counter-clockwise, holes clockwise; curves to `tolerance`.
    /// `given` are numbers in the form's order.
    fn rings(&self, form: &Form, given: &[f64], outline: &[Ring], tolerance: f64) -> Vec<Ring>;

    /// The boundary with as many points for any dimensions, so that two sections can be joined point by point. Curves become
    /// polygons of 64 points and of the curve's own area.
    fn matching_rings(&self, form: &Form, given: &[f64], outline: &[Ring]) -> Vec<Ring> {
        // Kinds with straight sides look at no tolerance.
        self.rings(form, given, outline, f64::INFINITY)
    }
}

/// Points of a quarter of a curve in [`Kind::matching_rings`].
const QUARTER: usize = 16;

/// All kinds.
pub static KINDS: &[&dyn Kind] = &[
    &rectangle::Rectangle,
    &h_beam::HBeam,
    &superellipse::Superellipse,
    &tee::Tee,
    &box_beam::BoxBeam,
    &circle::Circle,
    &tube::Tube,
    &polygon::Polygon,
    &polyline::Polyline,
    &i_section::ISection,
    &channel::Channel,
    &angle::Angle,
    &general::General,
    #[cfg(test)]
    &toy::Diamond,
];

/// Every form of every kind, in the order [`form`] counts them.
pub fn forms() -> impl Iterator<Item = (&'static dyn Kind, &'static Form)> {
    KINDS.iter().flat_map(|&kind| kind.forms().iter().map(move |form| (kind, form)))
}

/// The form with this number.
///
/// # Panics
/// On a number no form has; numbers come from [`form_number`].
pub fn form(number: u16) -> &'static Form {
    lookup(number).1
}

/// The kind of the form with this number.
pub fn kind_of(number: u16) -> &'static dyn Kind {
    lookup(number).0
}

/// The kind of this name.
pub fn kind(name: &str) -> Option<&'static dyn Kind> {
    KINDS.iter().copied().find(|kind| kind.name() == name)
}

/// Is this a dimension of some form of some kind?
pub fn is_dimension(name: &str) -> bool {
    forms().any(|(_, form)| form.dimensions.contains(&name))
}

/// Whether torsion and a shear force both make shear stress at a point of sections given in this form.
pub fn twists(number: u16, point: &str) -> bool {
    let form = form(number);
    let mut graph = Graph::new();
    let dimensions: Vec<NodeId> = (0..form.dimensions.len() as u32).map(|slot| graph.input(slot)).collect();
    let given = Given { form, dimensions: &dimensions, outline: &[] };
    let fibre = kind_of(number).fibre(&mut graph, &given, point);
    fibre.is_some_and(|fibre| fibre.per_torque.is_some() && (fibre.per_vy.is_some() || fibre.per_vz.is_some()))
}

/// The number of a form.
pub fn form_number(form: &Form) -> Option<u16> {
    forms().position(|(_, candidate)| candidate == form).and_then(|at| u16::try_from(at).ok())
}

fn lookup(number: u16) -> (&'static dyn Kind, &'static Form) {
    static TABLE: LazyLock<Vec<(&'static dyn Kind, &'static Form)>> = LazyLock::new(|| forms().collect());
    *TABLE.get(usize::from(number)).expect("form numbers come from form_number")
}

#[cfg(test)]
mod tests;
