//! The objective; and what can be said of a file whose tables could not be read.

use super::Assembly;
use crate::expression::ast::Requirement;
use crate::expression::operators::Comparison;
use crate::expression::parse::{parse, parse_requirement};
use crate::input::declaration::Declaration;
use crate::input::source::{Place, Written};
use crate::problem::Sense;
use crate::problem::mistake_code::MistakeCode;

impl Assembly<'_> {
    /// Mistakes of grammar, without looking up any name.
    pub(super) fn grammar(&mut self, declared: &Declaration) {
        for written in declared.definitions.iter().flat_map(|(_, entry)| entry.texts()) {
            self.parsed(written, parse);
        }
        if let Some((_, Some(written))) = &declared.objective {
            self.parsed(written, parse);
        }
        for written in declared.constraints.iter().filter_map(|entry| entry.require.as_ref()) {
            self.parsed(written, parse_requirement);
        }
    }

    /// The objective; the volume where there are ribs and nothing is said.
    pub(super) fn objective(&mut self, declared: &Declaration) {
        let (sense, written) = match &declared.objective {
            Some((sense, Some(written))) => (*sense, written.clone()),
            Some((_, None)) => return,
            None if self.problem.ribs.names.is_empty() => {
                if states_equations(declared) {
                    self.problem.objective_text = "none: a system of equations".into();
                } else if declared.ribs.is_empty() && declared.rib_table.is_none() {
                    let help = "add minimize = \"…\" or maximize = \"…\" at the top, or [[ribs]] whose volume is minimised; \
                        equations (==) alone need none";
                    self.findings.mistake(MistakeCode::Objective, Place::Whole, "there is no objective", help);
                }
                return;
            }
            None => (Sense::Minimize, Written { text: "volume".into(), place: Place::Whole, inside: None }),
        };
        self.problem.sense = sense;
        let formula = self.scalar(&written, None).unwrap_or_default();
        self.cells_filled(&formula, None, "the objective");
        self.problem.objective = formula;
        self.problem.objective_text = written.text;
    }
}

/// Whether some constraint is an equation: then a point that meets all of them is asked for.
fn states_equations(declared: &Declaration) -> bool {
    let is_equation = |written: &Written| {
        matches!(parse_requirement(&written.text), Ok(Requirement::Two { comparison: Comparison::Equal, .. }))
    };
    declared.constraints.iter().filter_map(|entry| entry.require.as_ref()).any(is_equation)
}
