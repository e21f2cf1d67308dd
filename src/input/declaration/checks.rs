//! `[[checks]]` as declared.

use super::Name;
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};

/// An entry of `[[checks]]`.
pub(in crate::input) struct CheckEntry {
    pub name: Option<Name>,
    pub place: Place,
    pub code: Option<Written>,
    pub ribs: Vec<Written>,
    pub cases: Vec<Written>,
    pub fy: Option<Scalar>,
    pub gamma: Option<Scalar>,
    pub stress_unit: Option<Scalar>,
    pub class: Option<Scalar>,
    pub web: Option<Written>,
    pub safety: Option<Scalar>,
    pub phi: Option<Scalar>,
    pub made: Option<Written>,
    pub buckling: Option<BucklingEntry>,
    pub ltb: Option<LtbEntry>,
    pub cm: Option<CmEntry>,
}

/// `buckling`: about both axes.
pub(in crate::input) struct BucklingEntry {
    pub place: Place,
    pub y: Option<AxisEntry>,
    pub z: Option<AxisEntry>,
}

/// One axis of `buckling`.
pub(in crate::input) enum AxisEntry {
    /// `"held"`: the rib cannot buckle about it.
    Held,
    Given {
        place: Place,
        length: Option<LengthEntry>,
        curve: Option<Written>,
    },
    /// After a mistake.
    Wrong,
}

/// A buckling length.
pub(in crate::input) enum LengthEntry {
    /// `"system"`: by the structure's own buckling factor.
    System(Place),
    Length(Scalar),
}

/// `ltb`: lateral-torsional buckling.
pub(in crate::input) enum LtbEntry {
    /// `"held"`: the compressed flange cannot move sideways.
    Held(Place),
    Given(Box<LtbData>),
    /// After a mistake.
    Wrong,
}

/// A table `ltb`.
pub(in crate::input) struct LtbData {
    pub place: Place,
    pub length: Option<Scalar>,
    pub c1: Option<Scalar>,
    pub curve: Option<Written>,
    pub clause: Option<Written>,
    pub lambda0: Option<Scalar>,
    pub beta: Option<Scalar>,
}

/// `Cm`: the equivalent uniform moment factors.
pub(in crate::input) struct CmEntry {
    pub place: Place,
    pub y: Option<Scalar>,
    pub z: Option<Scalar>,
    pub lt: Option<Scalar>,
}
