//! Sections drawn by points: what is wrong with the points, and with the outline at the starting point.

use std::sync::Arc;

use super::Assembly;
use crate::input::source::Place;
use crate::problem::{Dimension, sections_form};
use crate::sections::{self, Kind};

impl Assembly<'_> {
    /// Takes the points of a section whose kind is drawn by them; a mistake where they are wrong, missing, or not wanted.
    pub(super) fn outline(&mut self, s: u32, kind: Option<&'static dyn Kind>, points: Option<&(Vec<[f64; 2]>, Place)>) {
        let Some(kind) = kind else { return };
        let name = kind.name();
        let (points, place) = match (kind.has_outline(), points) {
            (false, None) => return,
            (false, Some((_, place))) => {
                self.findings.mistake(*place, format!("a section of kind `{name}` has no points"), "leave `points` out");
                return;
            }
            (true, None) => {
                let message = format!("section `{}` of kind `{name}` needs `points`", self.problem.sections.names[s as usize]);
                self.findings.mistake(
                    self.section_places[s as usize],
                    message,
                    "add points = [[x, y], [x, y], …] in the problem file",
                );
                return;
            }
            (true, Some((points, place))) => (points, *place),
        };
        if let Some(defect) = sections_form(&self.problem, s as usize).and_then(|form| kind.outline_defect(form, points)) {
            self.findings.mistake(place, defect, "mend the points");
        }
        self.problem.sections.outlines.insert(s, Arc::new(points.clone()));
    }

    /// Outlines that meet themselves: a mistake where the dimensions are fixed, a warning where it is the start.
    pub(super) fn check_outlines(&mut self) {
        if !self.findings.clean() {
            return; // bounds and dimensions are not to be trusted yet
        }
        let mut drawn: Vec<u32> = self.problem.sections.outlines.keys().copied().collect();
        drawn.sort_unstable();
        for s in drawn {
            let dimensions = self.problem.dimensions(s as usize);
            let fixed = dimensions.iter().all(|dimension| matches!(dimension, Dimension::Constant(_)));
            let start = |dimension: &Dimension| match dimension {
                Dimension::Constant(value) => Some(*value),
                Dimension::Variable(j) => self.problem.variables.start.get(*j as usize).copied(),
                Dimension::Formula(_) => None,
            };
            let Some(given) = dimensions.iter().map(start).collect::<Option<Vec<f64>>>() else { continue };
            let Some(form) = sections_form(&self.problem, s as usize) else { continue };
            let kind = sections::kind_of(self.problem.sections.form[s as usize]);
            let Some(defect) = kind.defect(form, &given, self.problem.outline(s)) else { continue };
            let (name, place) = (&self.problem.sections.names[s as usize], self.section_places[s as usize]);
            if fixed {
                self.findings.mistake(place, format!("section `{name}`: {defect}"), "mend the points or the dimensions");
            } else {
                let help = "start from dimensions that make a section, and keep them so by bounds";
                self.findings.warning(place, format!("section `{name}` at its start: {defect}"), help);
            }
        }
    }
}
