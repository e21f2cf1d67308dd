//! Expressions with every name resolved.

use std::sync::Arc;

use crate::expression::ast::Collection;
use crate::expression::operators::{Binary, Fold, Unary};

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
    /// `profile(depth, s)` where s follows from the item's data: a profile's number and its parameter, free of variables.
    /// (With a constant s it is a [`Formula::Fold`] of control variables.)
    Profile(u32, Box<Formula>),
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
