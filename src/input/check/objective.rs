//! The objective; and what can be said of a file whose tables could not be read.

use super::Assembly;
use crate::expression::parse::{parse, parse_requirement};
use crate::input::declaration::Declaration;
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::Sense;

impl Assembly<'_> {
    /// Mistakes of grammar, without looking up any name.
    pub(super) fn grammar(&mut self, declared: &Declaration) {
        for (_, scalar) in &declared.definitions {
            if let Scalar::Expression(written) = scalar {
                self.parsed(written, parse);
            }
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
                if declared.ribs.is_empty() && declared.rib_table.is_none() {
                    let help = "add minimize = \"…\" or maximize = \"…\" at the top, or [[ribs]] whose volume is minimised";
                    self.findings.mistake(Place::Whole, "there is no objective", help);
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
