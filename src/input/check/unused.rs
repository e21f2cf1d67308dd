//! Data nobody uses.

use std::collections::BTreeSet;

use super::Assembly;
use crate::expression::ast::Collection;
use crate::input::source::Place;
use crate::problem::formula::What;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::{Constraint, Formula};

impl Assembly<'_> {
    /// Warns of load cases in no combination and no response and of combinations in no response, where there are responses at all.
    pub(super) fn say_unused_cases(&mut self) {
        let Some(structure) = self.problem.structure.clone() else { return };
        let mut mentioned = BTreeSet::new();
        let definitions = self.problem.definitions.iter().map(|(_, formula)| formula);
        let rows = self.problem.constraints.iter();
        let rows = rows.flat_map(Constraint::formulas);
        let all = definitions.chain(rows).chain([&self.problem.objective]);
        all.for_each(|formula| load_sets(formula, &mut mentioned));
        if mentioned.is_empty() {
            return;
        }
        let combined = structure.combinations.iter().flat_map(|combination| &combination.factors).map(|(case, _)| *case);
        let combined: BTreeSet<u32> = combined.collect();
        for (case, name) in (0u32..).zip(&structure.cases) {
            if !mentioned.contains(&case) && !combined.contains(&case) {
                let message = format!("load case `{name}` is in no combination and no response");
                self.findings.warning(
                    MistakeCode::Unused,
                    self.case_place(case),
                    message,
                    "add it to a combination, or leave its loads out",
                );
            }
        }
        for (at, combination) in structure.combinations.iter().enumerate() {
            if !mentioned.contains(&((structure.cases.len() + at) as u32)) {
                let message = format!("combination `{}` is in no response: nothing is limited under it", combination.name);
                self.findings.warning(
                    MistakeCode::Unused,
                    self.combination_place(at),
                    message,
                    "name it in a requirement or under `cases`, or leave it out",
                );
            }
        }
    }

    /// Warns of data columns that occur in no expression, filter or grouping. `density` and `line` are used by reports.
    pub(super) fn say_unused(&mut self) {
        for (collection, word) in [(Collection::Sections, "sections"), (Collection::Ribs, "ribs"), (Collection::Nodes, "nodes")] {
            let columns = self.problem.columns(collection).iter().enumerate();
            let idle = columns.filter(|(at, column)| {
                let always = ["density", "line"].contains(&&*column.name)
                    || (collection == Collection::Nodes && ["x", "y", "z"].contains(&&*column.name));
                !always && !self.used.contains(&(collection, *at as u32))
            });
            let names: Vec<String> = idle.map(|(_, column)| format!("`{}`", column.name)).collect();
            if !names.is_empty() {
                let message = format!("data of {word} nobody uses: {}", names.join(", "));
                self.findings.warning(MistakeCode::Unused, Place::Whole, message, None);
            }
        }
    }
}

/// The cases and combinations of the responses in a formula.
fn load_sets(formula: &Formula, found: &mut BTreeSet<u32>) {
    match formula {
        Formula::Response(response) if !matches!(response.what, What::Mass | What::Length | What::Frequency(_)) => {
            _ = found.insert(response.set)
        }
        Formula::Unary(_, operand) | Formula::Profile(_, operand) => load_sets(operand, found),
        Formula::Binary(_, left, right) => {
            load_sets(left, found);
            load_sets(right, found);
        }
        Formula::Fold(_, list) => list.iter().for_each(|part| load_sets(part, found)),
        Formula::Over { body, .. } => load_sets(body, found),
        _ => {}
    }
}
