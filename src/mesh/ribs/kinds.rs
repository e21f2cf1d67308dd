//! What each kind of section brings along: dimensions with default bounds, and limits on its proportions.

use super::{Bounds, Unit};

/// Kinds of sections ribs can be given: those that need no points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionKind {
    /// b × h.
    Rectangle,
    /// tw, hw, b, tf.
    HBeam,
    /// tw, hw, b, tf; the flange on top.
    Tee,
    /// b × h with webs tw and flanges tf.
    Box,
    /// d.
    Circle,
    /// d with wall t.
    Tube,
    /// Semi-axes a, b, with exponent r = 2.5.
    Superellipse,
}

/// A dimension's name, default lower and upper bound and start, in metres.
type Dimension = (&'static str, f64, f64, f64);

/// A limit's name and requirement.
type Limit = (&'static str, &'static str);

/// A row of the table of kinds.
struct Row {
    name: &'static str,
    dimensions: &'static [Dimension],
    limits: &'static [Limit],
    thickness: f64,
}

impl SectionKind {
    /// All of them.
    pub const ALL: [SectionKind; 7] = [
        SectionKind::Rectangle,
        SectionKind::HBeam,
        SectionKind::Tee,
        SectionKind::Box,
        SectionKind::Circle,
        SectionKind::Tube,
        SectionKind::Superellipse,
    ];

    /// The kind's name in files.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The kind of this name.
    pub fn parse(name: &str) -> Option<SectionKind> {
        SectionKind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Its dimensions with default bounds and starts, in this unit.
    pub(super) fn dimensions(self, unit: Unit) -> Vec<Bounds> {
        let bounds = |&(name, lower, upper, start): &Dimension| {
            // An exponent has no unit.
            let metres = if name == EXPONENT { 1.0 } else { unit.metres() };
            Bounds { dimension: name.into(), lower: lower / metres, upper: upper / metres, start: start / metres }
        };
        self.row().dimensions.iter().map(bounds).collect()
    }

    /// The dimension that is its height, and how often: `b` of a superellipse is half of it.
    pub(super) fn height(self) -> (&'static str, f64) {
        match self {
            SectionKind::Rectangle | SectionKind::Box => ("h", 1.0),
            SectionKind::HBeam | SectionKind::Tee => ("hw", 1.0),
            SectionKind::Circle | SectionKind::Tube => ("d", 1.0),
            SectionKind::Superellipse => ("b", 2.0),
        }
    }

    /// Names and requirements of the limits on a section's proportions, in `slenderness` and `thickness`.
    pub(super) fn limits(self) -> &'static [Limit] {
        self.row().limits
    }

    /// The default for the least thickness.
    pub(super) fn thickness(self) -> f64 {
        self.row().thickness
    }

    fn row(self) -> Row {
        match self {
            SectionKind::Rectangle => Row {
                name: "rectangle",
                dimensions: &[("b", 0.02, 0.5, 0.1), ("h", 0.04, 1.5, 0.3)],
                limits: &[("slenderness", "h <= slenderness*b"), ("thickness", "b >= thickness")],
                thickness: 0.03,
            },
            SectionKind::HBeam => Row {
                name: "h-beam",
                dimensions: FLANGED,
                limits: &[("web-slenderness", "hw <= 5*slenderness*tw"), FLANGE, PROPORTION, WEB_THICKNESS, FLANGE_THICKNESS],
                thickness: 0.006,
            },
            SectionKind::Tee => Row {
                name: "tee",
                dimensions: FLANGED,
                limits: &[("web-slenderness", "hw <= 2*slenderness*tw"), FLANGE, PROPORTION, WEB_THICKNESS, FLANGE_THICKNESS],
                thickness: 0.006,
            },
            SectionKind::Box => Row {
                name: "box",
                dimensions: &[
                    ("b", 0.05, 0.5, 0.15),
                    ("h", 0.06, 1.5, 0.3),
                    ("tw", 0.004, 0.02, 0.008),
                    ("tf", 0.004, 0.02, 0.008),
                ],
                limits: &[
                    ("web-slenderness", "h <= 5*slenderness*tw"),
                    ("flange-slenderness", "b <= 5*slenderness*tf"),
                    PROPORTION,
                    WEB_THICKNESS,
                    ("flange-thickness", "tf >= thickness"),
                ],
                thickness: 0.005,
            },
            SectionKind::Circle => Row {
                name: "circle",
                dimensions: &[("d", 0.02, 1.5, 0.2)],
                limits: &[("thickness", "d >= thickness")],
                thickness: 0.03,
            },
            SectionKind::Tube => Row {
                name: "tube",
                dimensions: &[("d", 0.05, 1.5, 0.2), ("t", 0.003, 0.02, 0.008)],
                limits: &[("slenderness", "d <= 10*slenderness*t"), ("thickness", "t >= thickness")],
                thickness: 0.004,
            },
            SectionKind::Superellipse => Row {
                name: "superellipse",
                dimensions: &[("a", 0.01, 0.25, 0.05), ("b", 0.02, 0.75, 0.15), ("r", 2.5, 2.5, 2.5)],
                limits: &[("slenderness", "b <= slenderness*a"), ("thickness", "2*a >= thickness")],
                thickness: 0.03,
            },
        }
    }
}

/// The superellipse's.
pub(super) const EXPONENT: &str = "r";

const FLANGED: &[Dimension] =
    &[("tw", 0.004, 0.05, 0.01), ("hw", 0.04, 1.5, 0.3), ("b", 0.03, 0.5, 0.15), ("tf", 0.004, 0.05, 0.015)];
const FLANGE: Limit = ("flange-slenderness", "b <= 4*slenderness*tf");
/// Against lateral buckling.
const PROPORTION: Limit = ("proportion", "h <= 0.5*slenderness*b");
const WEB_THICKNESS: Limit = ("web-thickness", "tw >= thickness");
const FLANGE_THICKNESS: Limit = ("flange-thickness", "tw <= tf");
