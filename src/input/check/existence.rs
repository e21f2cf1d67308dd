//! Says which sections cannot exist, or may cease to.

use std::collections::BTreeMap;

use super::Assembly;
use crate::problem::affine::Affine;
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::existence::doubts;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::{Dimension, sections_form};
use crate::sections;

impl Assembly<'_> {
    /// Mistakes for dimensions that are never positive, one warning per kind and dimension for those that may reach zero.
    pub(super) fn check_existence(&mut self) {
        if !self.findings.clean() {
            return; // bounds and dimensions are not to be trusted yet
        }
        self.outlines_whole();
        let mut weak: BTreeMap<(&str, &str), Vec<u32>> = BTreeMap::new();
        for doubt in doubts(&self.problem) {
            let Some(form) = sections_form(&self.problem, doubt.section as usize) else { continue };
            if !doubt.never {
                weak.entry((form.kind, doubt.name)).or_default().push(doubt.section);
                continue;
            }
            let section = &self.problem.sections.names[doubt.section as usize];
            let message = format!("`{}` of section `{section}` cannot be positive within its bounds", doubt.name);
            let place = self.section_places[doubt.section as usize];
            self.findings.mistake(
                MistakeCode::ImpossibleSection,
                place,
                message,
                "widen the bounds of the dimensions it follows from",
            );
        }
        for ((_, name), sections) in weak {
            let section = &self.problem.sections.names[sections[0] as usize];
            let more = if sections.len() > 1 { format!(" (and of {} more)", sections.len() - 1) } else { String::new() };
            let message = format!("`{name}` of section `{section}`{more} may reach zero inside its bounds");
            let place = self.section_places[sections[0] as usize];
            self.findings.warning(
                MistakeCode::MayVanish,
                place,
                message,
                "give it a positive lower bound, or a linear constraint that keeps it positive",
            );
        }
    }

    /// Outlines that meet themselves: a mistake where they always do, a warning where they do at the start or at the largest dimensions.
    fn outlines_whole(&mut self) {
        let mut drawn: Vec<u32> = self.problem.sections.outlines.keys().copied().collect();
        drawn.sort_unstable();
        for s in drawn {
            let at_start = Evaluation::at_start(&self.problem);
            let start = self.dimensions_by(s, |dimension| at_start.dimension(s, dimension));
            let fixed = self.dimensions_by(s, |dimension| Evaluation::constants(&self.problem).dimension(s, dimension));
            let largest = self.dimensions_by(s, |dimension| self.largest(s, dimension));
            let found =
                [fixed, start, largest].into_iter().enumerate().find_map(|(at, values)| Some((at, self.fold(s, &values?)?)));
            let Some((at, reason)) = found else { continue };
            let (section, place) = (&self.problem.sections.names[s as usize], self.section_places[s as usize]);
            let help = "draw it without crossings, or give thinner walls: `clear` must stay positive";
            match at {
                0 => self.findings.mistake(MistakeCode::ImpossibleSection, place, format!("section `{section}`: {reason}"), help),
                1 => self.findings.warning(
                    MistakeCode::MayCross,
                    place,
                    format!("section `{section}` at its start: {reason}"),
                    help,
                ),
                _ => self.findings.warning(
                    MistakeCode::MayCross,
                    place,
                    format!("section `{section}` at its upper bounds: {reason}"),
                    help,
                ),
            }
        }
    }

    fn dimensions_by(&self, s: u32, value: impl Fn(Dimension) -> Option<f64>) -> Option<Vec<f64>> {
        self.problem.dimensions(s as usize).iter().map(|&dimension| value(dimension)).collect()
    }

    fn largest(&self, s: u32, dimension: Dimension) -> Option<f64> {
        let affine = match dimension {
            Dimension::Constant(value) => return Some(value),
            Dimension::Variable(j) => Affine { constant: 0.0, terms: vec![(j, 1.0)] },
            Dimension::Formula(f) => {
                Affine::of(&self.problem, self.problem.dimension_formulas.get(f as usize)?, Item::Section(s))?
            }
        };
        Some(affine.range(&self.problem.variables).1).filter(|value| value.is_finite())
    }

    fn fold(&self, s: u32, values: &[f64]) -> Option<String> {
        let number = *self.problem.sections.form.get(s as usize)?;
        sections::kind_of(number).defect(sections::form(number), values, self.problem.outline(s))
    }
}
