//! Kinds of sections that ribs of a mesh can be given: those with defaults. What each brings along is its own
//! ([`crate::sections::Kind::defaults`]).

use super::{Bounds, Unit};
use crate::sections::{Defaults, KINDS};

/// A kind of section with defaults.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionKind {
    name: &'static str,
    defaults: &'static Defaults,
}

impl SectionKind {
    /// All of them.
    pub fn all() -> impl Iterator<Item = SectionKind> {
        KINDS.iter().filter_map(|kind| Some(SectionKind { name: kind.name(), defaults: kind.defaults()? }))
    }

    /// The kind's name in files.
    pub fn name(self) -> &'static str {
        self.name
    }

    /// The kind of this name.
    pub fn parse(name: &str) -> Option<SectionKind> {
        SectionKind::all().find(|kind| kind.name == name)
    }

    /// Its dimensions with default bounds and starts, in this unit.
    pub(super) fn dimensions(self, unit: Unit) -> Vec<Bounds> {
        let bounds = |own: &crate::sections::defaults::Default| {
            let metres = if own.is_length { unit.metres() } else { 1.0 };
            Bounds {
                dimension: own.dimension.into(),
                lower: own.lower / metres,
                upper: own.upper / metres,
                start: own.start / metres,
            }
        };
        self.defaults.dimensions.iter().map(bounds).collect()
    }

    /// Whether a dimension is a length.
    pub(super) fn is_length(self, dimension: &str) -> bool {
        self.defaults.dimensions.iter().any(|own| own.dimension == dimension && own.is_length)
    }

    /// The dimension that is its height, and how often.
    pub(super) fn height(self) -> (&'static str, f64) {
        self.defaults.height
    }

    /// Names and requirements of the limits on a section's proportions, in `slenderness` and `thickness`.
    pub(super) fn limits(self) -> &'static [(&'static str, &'static str)] {
        self.defaults.proportions
    }

    /// The default for the least thickness.
    pub(super) fn thickness(self) -> f64 {
        self.defaults.thickness
    }
}

/// The first kind of the table.
impl Default for SectionKind {
    fn default() -> Self {
        // The table begins with a kind that has defaults; `all_kinds_have_one_form_of_their_defaults` sees to that.
        SectionKind::all().next().expect("some kind of section has defaults")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_kinds_have_one_form_of_their_defaults() {
        assert_eq!(SectionKind::default().name(), "rectangle");
        for kind in SectionKind::all() {
            let names: Vec<&str> = kind.defaults.dimensions.iter().map(|own| own.dimension).collect();
            let forms = crate::sections::kind(kind.name).unwrap().forms();
            assert!(forms.iter().any(|form| form.dimensions == names), "{}: {names:?}", kind.name);
            assert!(names.contains(&kind.height().0));
            assert!(kind.defaults.dimensions.iter().all(|own| own.lower <= own.start && own.start <= own.upper));
        }
    }
}
