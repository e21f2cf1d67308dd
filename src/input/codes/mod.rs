//! What design codes ask of a rib, as texts of the expression language over its responses and the properties of its sections.
//!
//! A code's page turns data (buckling lengths, curves, factors) into [`Row`]s; names, units and values are looked up where any
//! other constraint's are. Every row says that a force effect is at most a resistance. Where a code has a corner, a row stands for
//! each side of it wherever both must hold; docs/checks.md says where that is exact and what is done where it is not.

mod aisc360;
mod bending;
mod classes;
mod en1993;
mod euler;
mod lets;
mod places;

pub(super) use aisc360::{Aisc, JOIN, Made};
pub(super) use bending::{Bending, Known, Ltb};
pub(super) use classes::{Web, nonslender, table_5_2};
pub(super) use en1993::{CURVES, En};
pub(super) use euler::Euler;
pub(super) use lets::Lets;
pub(super) use places::Places;

/// One row, before names are looked up.
pub(super) struct Row {
    /// What of the code it states: `6.3.1 y`.
    pub clause: String,
    /// What tells it from others of the clause: `ULS, 0.5, +My, N at 0`.
    pub detail: String,
    /// The requirement in short names.
    pub short: String,
    /// The same with every short name written out.
    pub require: String,
    /// The station of properties at a station.
    pub station: Option<f64>,
    /// What the short names stand for.
    pub names: Vec<String>,
}

/// Where along the rib a row's resistance is taken.
#[derive(Clone, Copy)]
pub(super) struct Where {
    /// Prefix of A and W: `from`, or `at` a station of a tapered rib.
    pub section: &'static str,
    /// Prefix of the moments of inertia, of which the critical forces are made: one end.
    pub critical: &'static str,
}

/// About one axis of the section.
pub(super) enum Axis {
    /// It cannot buckle about it.
    Held,
    /// As a rib of this buckling length, an expression in the rib's names; with an imperfection factor where the code has one.
    Length { length: String, alpha: f64 },
    /// By the structure's own factor under the case.
    System { alpha: f64 },
}

/// The axes' letters in codes, and the moments of inertia that resist bending about them.
pub(super) const AXES: [(&str, &str); 2] = [("y", "Ix"), ("z", "Iy")];

/// The rib and the case that rows are about.
pub(super) struct Effects {
    /// The case's name in details.
    pub case: String,
    /// The rib, where it has to be named: one of them is called like a force.
    pub rib: Option<String>,
}

impl Effects {
    /// The case as an argument.
    fn of(&self) -> String {
        quoted(&self.case)
    }

    /// The text of an internal force, turned round where `sign` is negative.
    fn force(&self, name: &str, station: f64, sign: f64) -> String {
        let minus = if sign < 0.0 { "-" } else { "" };
        let rib = self.rib.as_deref().map_or(String::new(), |rib| format!("{}, ", quoted(rib)));
        format!("{minus}force({}, {rib}{name}, {station})", self.of())
    }
}

/// A name as an argument, whatever its letters are.
fn quoted(name: &str) -> String {
    if name.contains('\'') { format!("\"{name}\"") } else { format!("'{name}'") }
}

impl Row {
    fn new(lets: &Lets, clause: impl Into<String>, detail: String, short: &str, station: Option<f64>) -> Row {
        let plain = lets::plain(short);
        Row { clause: clause.into(), detail, require: lets.whole(short), names: lets.needed(&plain), short: plain, station }
    }
}
