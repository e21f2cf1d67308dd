//! Expressions with every name resolved.

use std::sync::Arc;

use crate::expression::ast::Collection;
use crate::expression::operators::{Binary, Fold, Unary};
use crate::structure::beam::Force;

/// A property or dimension of a cross-section, by its canonical name: `A`, `Ix`, `Iy`, `Wx`, `Wy`, `width`, `height`, a dimension.
/// The index is into the list of the section kind's names, see [`crate::sections`]. One word can mean different things
/// for different kinds, so the name is kept and each kind resolves it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Property(pub Arc<str>);

/// Which end of a rib.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum End {
    From,
    To,
}

/// Which total.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Total {
    /// All ribs, each by its own law.
    Own,
    /// All ribs by the frustum law.
    Frustum,
    /// All ribs by the prismatoid law.
    Prismatoid,
}

/// The items a fold runs over.
#[derive(Debug, Clone, PartialEq)]
pub enum Members {
    /// Every item of the collection.
    All,
    /// The items of the row's own group (`by`), thinned by the list where there is one (sorted indices).
    Group(Option<Arc<Vec<u32>>>),
    /// These (sorted indices).
    Listed(Arc<Vec<u32>>),
}

/// What a response is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Subject {
    /// The structure.
    Whole,
    /// The row's own rib or node.
    Own,
    /// A rib.
    Rib(u32),
    /// A node.
    Node(u32),
}

/// What a structure does under a case or combination.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    /// A displacement or rotation of a node, 0 to 5.
    Displacement(u8),
    /// The ground's force or moment on a node.
    Reaction(u8),
    /// A rib's deflection from its chord along its z (true) or y, at a fraction of its length.
    Deflection(bool, f64),
    /// The displacement of a rib's point along its z (true) or y, at a fraction of its length, from the chord between two nodes: the ends
    /// of the line it belongs to ([`Formula::in_line`] says which).
    Sag(bool, f64, [u32; 2]),
    /// An internal force at a fraction of a rib's length.
    Force(Force, f64),
    /// Normal stress at a fraction and a point of the section.
    Stress(f64, Arc<str>),
    /// Shear stress there; torsion's share with this sign.
    Shear(f64, Arc<str>, f64),
    /// Stress at a point of a prismatic rib's section by a unit of an internal force (shear stress by shear forces and torque), or its opposite.
    PerForce(Force, Arc<str>, bool),
    /// Work of the loads: pᵀu over free directions.
    Compliance,
    /// A rib's mass by its density (∫A dx).
    Mass,
    /// The length of a rib whose nodes move with the design.
    Length,
    /// A basic force of a member: state equations are made of them.
    Basic(u8),
    /// What the supports of the simply supported member exert, see [`crate::structure::Beam::support_forces`].
    Support(u8),
    /// The force at an end in a global direction, of a member whose nodes move with the design: 0 to 11.
    End(u8),
    /// The buckling factor of this number under the case, counted from the lowest positive one.
    Buckling(u32),
    /// The natural frequency of this number, in cycles per time.
    Frequency(u32),
    /// What a [`super::modes::Cut`] of the problem says of limited eigenvalues, by its number.
    Cut(u32),
    /// An energy of a member's piece in a mode: the matrices of buckling and vibration are made of them.
    Modal(Energy, u32),
}

/// Which energy of a piece in a mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Energy {
    /// ½·wᵀKw: of strain.
    Strain,
    /// ½·wᵀGw: of the case's axial forces on the inclined axis.
    Prestress,
    /// ½·wᵀMw: of the piece's mass at unit velocity of the mode.
    Inertia,
}

/// A response of the structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// The case or combination (cases first).
    pub set: u32,
    /// What it is of.
    pub subject: Subject,
    /// Which one.
    pub what: What,
}

/// A resolved expression.
#[derive(Debug, Clone, PartialEq)]
pub enum Formula {
    /// A number; parameters are numbers by now.
    Constant(f64),
    /// A scalar variable.
    Variable(u32),
    /// A definition.
    Definition(u32),
    /// `support.Ix`.
    SectionProperty(u32, Property),
    /// `haunch.volume`.
    RibVolume(u32),
    /// `volume`, `volume_frustum`, `volume_prismatoid`.
    Volume(Total),
    /// In a section's scope: its own property or dimension.
    OwnProperty(Property),
    /// In a rib's scope: a property of the section at one end.
    EndProperty(End, Property),
    /// In a rib's scope: its length.
    OwnLength,
    /// In a rib's scope: its volume.
    OwnVolume,
    /// In a scope: the item's number in this data column.
    OwnData(u32),
    /// In a rib's scope: the number in a section data column at one end (`from.c`).
    EndData(End, u32),
    /// In a rib's scope: a dimension or property at a fraction of its length.
    AtProperty(f64, Property),
    /// In a rib's scope: a number of its material.
    OwnMaterial(Arc<str>),
    /// `profile(depth, s)` where s follows from the item's data: a profile's number and its parameter, free of variables.
    /// (With a constant s it is a [`Formula::Fold`] of control variables.)
    Profile(u32, Box<Formula>),
    /// What the structure does.
    Response(Arc<Response>),
    /// A function of one argument.
    Unary(Unary, Box<Formula>),
    /// An operator.
    Binary(Binary, Box<Formula>, Box<Formula>),
    /// Sum, minimum or maximum of a list.
    Fold(Fold, Vec<Formula>),
    /// Sum, minimum or maximum over items; inside `body` the item's own names hold.
    Over {
        /// How the values are joined.
        fold: Fold,
        /// Ribs or sections.
        collection: Collection,
        /// Which of them.
        members: Members,
        /// One item's value.
        body: Arc<Formula>,
    },
}

impl Formula {
    /// The formulas it is made of, those behind names of definitions and sections not counted. Every walk goes through these, so that no
    /// variant is forgotten.
    pub fn children(&self) -> impl Iterator<Item = &Formula> {
        let (first, second, list): (Option<&Formula>, Option<&Formula>, &[Formula]) = match self {
            Formula::Unary(_, inner) | Formula::Profile(_, inner) => (Some(inner), None, &[]),
            Formula::Over { body, .. } => (Some(body), None, &[]),
            Formula::Binary(_, left, right) => (Some(left), Some(right), &[]),
            Formula::Fold(_, list) => (None, None, list),
            Formula::Constant(_)
            | Formula::Variable(_)
            | Formula::Definition(_)
            | Formula::SectionProperty(..)
            | Formula::RibVolume(_)
            | Formula::Volume(_)
            | Formula::OwnProperty(_)
            | Formula::EndProperty(..)
            | Formula::OwnLength
            | Formula::OwnVolume
            | Formula::OwnData(_)
            | Formula::EndData(..)
            | Formula::AtProperty(..)
            | Formula::OwnMaterial(_)
            | Formula::Response(_) => (None, None, &[]),
        };
        first.into_iter().chain(second).chain(list)
    }

    /// The same with others in the place of the formulas it is made of.
    pub fn with_children(&self, mut other: impl FnMut(&Formula) -> Formula) -> Formula {
        match self {
            Formula::Unary(op, inner) => Formula::Unary(*op, Box::new(other(inner))),
            Formula::Profile(profile, inner) => Formula::Profile(*profile, Box::new(other(inner))),
            Formula::Binary(op, left, right) => Formula::Binary(*op, Box::new(other(left)), Box::new(other(right))),
            Formula::Fold(fold, list) => Formula::Fold(*fold, list.iter().map(other).collect()),
            Formula::Over { fold, collection, members, body } => {
                let body = Arc::new(other(body));
                Formula::Over { fold: *fold, collection: *collection, members: members.clone(), body }
            }
            leaf => leaf.clone(),
        }
    }

    /// Whether a response that needs an analysis stands inside, seen through definitions; `known` keeps what was found of these.
    pub(super) fn analyses(&self, problem: &super::Problem, known: &mut [Option<bool>]) -> bool {
        match self {
            Formula::Response(response) => !matches!(response.what, What::Mass | What::Length | What::PerForce(..)),
            Formula::Definition(definition) => {
                let at = *definition as usize;
                if let Some(known) = known[at] {
                    return known;
                }
                let found = problem.definitions[at].1.analyses(problem, known);
                known[at] = Some(found);
                found
            }
            other => other.children().any(|one| one.analyses(problem, known)),
        }
    }

    /// Whether a sag stands inside, outside of folds over items: those have lines of their own.
    pub fn is_of_line(&self) -> bool {
        match self {
            Formula::Response(response) => matches!(response.what, What::Sag(..)),
            Formula::Over { .. } => false,
            other => other.children().any(Formula::is_of_line),
        }
    }

    /// The formula of one rib of a line: folds over the group run over the line's ribs, and sags are taken from the chord of its ends.
    pub fn in_line(&self, ribs: &Arc<Vec<u32>>, chord: [u32; 2]) -> Formula {
        let go = |inner: &Formula| inner.in_line(ribs, chord);
        match self {
            Formula::Response(response) => match response.what {
                What::Sag(vertical, x, _) => {
                    Formula::Response(Arc::new(Response { what: What::Sag(vertical, x, chord), ..Response::clone(response) }))
                }
                _ => self.clone(),
            },
            Formula::Over { fold, collection: Collection::Ribs, members: Members::Group(thinned), body } => {
                let chosen = |index: &&u32| thinned.as_ref().is_none_or(|list| list.binary_search(index).is_ok());
                let members = Members::Listed(Arc::new(ribs.iter().filter(chosen).copied().collect()));
                Formula::Over { fold: *fold, collection: Collection::Ribs, members, body: Arc::clone(body) }
            }
            Formula::Over { .. } => self.clone(),
            other => other.with_children(go),
        }
    }

    /// The number, where it is one.
    pub fn as_constant(&self) -> Option<f64> {
        match self {
            Formula::Constant(value) => Some(*value),
            _ => None,
        }
    }
}

impl Default for Formula {
    fn default() -> Self {
        Formula::Constant(0.0)
    }
}
