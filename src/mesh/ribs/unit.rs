//! The unit of length of a mesh, its bounds and its loads.

/// Units of length. Forces are kilonewtons throughout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Unit {
    Millimetre,
    Centimetre,
    Metre,
    Inch,
}

impl Unit {
    /// All of them.
    pub const ALL: [Unit; 4] = [Unit::Millimetre, Unit::Centimetre, Unit::Metre, Unit::Inch];

    /// mm, cm, m or in.
    pub fn name(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Centimetre => "cm",
            Unit::Metre => "m",
            Unit::Inch => "in",
        }
    }

    /// The unit of this name.
    pub fn parse(name: &str) -> Option<Unit> {
        Unit::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// How long it is.
    pub fn metres(self) -> f64 {
        match self {
            Unit::Millimetre => 1e-3,
            Unit::Centimetre => 1e-2,
            Unit::Metre => 1.0,
            Unit::Inch => 0.0254,
        }
    }
}
