//! Says which sections cannot exist, or may cease to.

use std::collections::BTreeMap;

use super::Assembly;
use crate::problem::existence::doubts;
use crate::problem::sections_form;

impl Assembly<'_> {
    /// Mistakes for dimensions that are never positive, one warning per kind and dimension for those that may reach zero.
    pub(super) fn check_existence(&mut self) {
        if !self.findings.clean() {
            return; // bounds and dimensions are not to be trusted yet
        }
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
            self.findings.mistake(place, message, "widen the bounds of the dimensions it follows from");
        }
        for ((_, name), sections) in weak {
            let section = &self.problem.sections.names[sections[0] as usize];
            let more = if sections.len() > 1 { format!(" (and of {} more)", sections.len() - 1) } else { String::new() };
            let message = format!("`{name}` of section `{section}`{more} may reach zero inside its bounds");
            let place = self.section_places[sections[0] as usize];
            self.findings.warning(
                place,
                message,
                "give it a positive lower bound, or a linear constraint that keeps it positive",
            );
        }
    }
}
