//! Data nobody uses.

use super::Assembly;
use crate::expression::ast::Collection;
use crate::input::source::Place;

impl Assembly<'_> {
    /// Warns of data columns that occur in no expression, filter or grouping. `density` and `line` are used by reports.
    pub(super) fn say_unused(&mut self) {
        for (collection, word) in [(Collection::Sections, "sections"), (Collection::Ribs, "ribs")] {
            let columns = self.problem.columns(collection).iter().enumerate();
            let idle = columns.filter(|(at, column)| {
                column.name != "density" && column.name != "line" && !self.used.contains(&(collection, *at as u32))
            });
            let names: Vec<String> = idle.map(|(_, column)| format!("`{}`", column.name)).collect();
            if !names.is_empty() {
                let message = format!("data of {word} nobody uses: {}", names.join(", "));
                self.findings.warning(Place::Whole, message, None);
            }
        }
    }
}
