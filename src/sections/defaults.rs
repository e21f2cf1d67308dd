//! What a kind brings along for those who need no more than a section of it: bounds, starts, and limits on its proportions.

/// A dimension with default bounds and start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Default {
    /// Its name.
    pub dimension: &'static str,
    /// Lower bound: in metres, where it is a length.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
    /// Start.
    pub start: f64,
    /// Whether it is a length; an exponent has no unit.
    pub is_length: bool,
}

/// A length in metres.
pub(super) const fn length(dimension: &'static str, lower: f64, upper: f64, start: f64) -> Default {
    Default { dimension, lower, upper, start, is_length: true }
}

/// A fixed number without a unit.
pub(super) const fn fixed_number(dimension: &'static str, value: f64) -> Default {
    Default { dimension, lower: value, upper: value, start: value, is_length: false }
}

/// A limit on a section's proportions: name and requirement, in the parameters `slenderness` and `thickness`.
pub type Proportion = (&'static str, &'static str);

/// A kind's defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Defaults {
    /// Every dimension of one form, in its order.
    pub dimensions: &'static [Default],
    /// Limits on its proportions.
    pub proportions: &'static [Proportion],
    /// The least thickness, in metres.
    pub thickness: f64,
    /// The dimension that is its height, and how often: a semi-axis is half of it.
    pub height: (&'static str, f64),
}

/// Web and flanges, as rolled sections have them.
pub(super) const WEB_AND_FLANGE: &[Default] = &[
    length("tw", 0.004, 0.05, 0.01),
    length("hw", 0.04, 1.5, 0.3),
    length("b", 0.03, 0.5, 0.15),
    length("tf", 0.004, 0.05, 0.015),
];
pub(super) const FLANGE: Proportion = ("flange-slenderness", "b <= 4*slenderness*tf");
/// Against lateral buckling.
pub(super) const PROPORTION: Proportion = ("proportion", "h <= 0.5*slenderness*b");
pub(super) const WEB_THICKNESS: Proportion = ("web-thickness", "tw >= thickness");
pub(super) const FLANGE_THICKNESS: Proportion = ("flange-thickness", "tw <= tf");
