//! Points of sections drawn by points.

use std::sync::Arc;

use super::Assembly;
use crate::geometry::polygon::Ring;
use crate::input::declaration::{Name, PointsEntry};
use crate::input::fields::Scalar;
use crate::input::source::Place;
use crate::input::table::Row;
use crate::problem::mistake_code::MistakeCode;
use crate::sections::{self, Form};

/// Points of one section, ring by ring; `None` after a mistake in them.
pub(super) struct Points {
    pub rings: Option<Arc<Vec<Ring>>>,
    pub place: Place,
}

impl Assembly<'_> {
    /// The points of the problem file.
    pub(super) fn points(&mut self, entry: &PointsEntry) -> Points {
        let rings: Vec<Option<Ring>> = entry.rings.iter().flatten().map(|ring| self.ring(ring)).collect();
        let rings = rings.into_iter().collect::<Option<Vec<_>>>().filter(|_| entry.rings.is_some());
        Points { rings: rings.map(Arc::new), place: entry.place }
    }

    /// All mistakes of a ring's points are told.
    fn ring(&mut self, points: &[[Scalar; 2]]) -> Option<Ring> {
        let constants = points.iter().map(|pair| {
            let [x, y] = pair.each_ref().map(|scalar| self.constant(scalar));
            Some([x?, y?])
        });
        constants.collect::<Vec<_>>().into_iter().collect()
    }

    /// The points in a table's cell; equal texts share one outline.
    pub(super) fn points_cell(&mut self, row: &Row, at: usize) -> Option<Points> {
        let (text, place) = (row.field(at), row.place(at));
        if text.is_empty() {
            return None;
        }
        if let Some(known) = self.points.get(text) {
            return Some(Points { rings: known.clone(), place });
        }
        let read = crate::input::points(text);
        let rings = read
            .map_err(|message| self.findings.mistake(MistakeCode::Outline, place, message, "as in 0 0; 0.4 0; 0.4 0.3"))
            .ok()
            .map(Arc::new);
        self.points.insert(text.to_owned(), rings.clone());
        Some(Points { rings, place })
    }

    /// Enters a section's points. `form` is `None` after a mistake in the dimensions.
    pub(super) fn outline(&mut self, s: u32, name: &Name, kind: &str, form: Option<&Form>, points: Option<Points>) {
        let drawn = sections::kind(kind).is_some_and(|kind| kind.has_outline());
        match points {
            None if drawn => {
                let help = "add points = [[x, y], [x, y], …]; in a table a column points: x y; x y; …";
                self.findings.mistake(MistakeCode::Outline, name.place, format!("section `{}` lacks `points`", name.text), help);
            }
            Some(points) if !drawn => {
                let by_points = sections::KINDS.iter().filter(|kind| kind.has_outline()).map(|kind| kind.name());
                let help = format!("kinds drawn by points: {}", by_points.collect::<Vec<_>>().join(", "));
                self.findings.mistake(
                    MistakeCode::Outline,
                    points.place,
                    format!("a section of kind {kind} has no points"),
                    help,
                );
            }
            Some(Points { rings: Some(rings), place }) => {
                let kind = sections::kind(kind);
                if rings.len() > 1 && kind.is_some_and(|kind| !kind.takes_holes()) {
                    let message = format!("section `{}`: a {} takes no holes", name.text, kind.map_or("", |kind| kind.name()));
                    self.findings.mistake(
                        MistakeCode::Outline,
                        place,
                        message,
                        "a closed line of walls has its hole by itself; polygons take holes",
                    );
                }
                if let Some(reason) = form.and_then(|form| kind?.outline_defect(form, &rings)) {
                    let help = "list the corners in order, once round or along the line, without crossings";
                    self.findings.mistake(MistakeCode::Outline, place, format!("section `{}`: {reason}", name.text), help);
                }
                self.problem.sections.outlines.insert(s, rings);
            }
            _ => {}
        }
    }
}
