//! Trusses as problems in the axial forces of their bars.
//!
//! Equilibrium of the free directions is Bᵀ·N = p, whatever the areas are. The forces of the elastic truss are one solution among many: with them as free
//! variables, and without the rows that ask for more than forces, the minimum is a
//! *lower bound* of that of the elastic truss (the lower-bound theorem of limit analysis; Dorn, Gomory and Greenberg, *Automatic design of optimal structures*,
//! Journal de Mécanique 3, 1964).

mod truss;
mod writer;

use super::rewritten::Rewriting;
use super::{Constraint, Formula, Origin, Problem};
use truss::Truss;
use writer::Writer;

impl Problem {
    /// The problem with the forces of a truss's bars as variables that equilibrium alone holds: no design that meets the limits is below its
    /// minimum. `None` for other structures.
    pub fn with_free_forces(&self) -> Option<Problem> {
        if !self.analyses() || Truss::of(self).is_none() {
            return None;
        }
        self.clone().with_force_limits_of_all_bars().in_free_forces()
    }

    fn in_free_forces(&self) -> Option<Problem> {
        let truss = Truss::of(self)?;
        let first = self.variables.lower.len() as u32;
        let writer = Writer { truss: &truss, first };
        let objective = writer.formula(&self.objective)?;
        // What cannot be said in forces is left out, with every row that uses it.
        let definitions = self
            .definitions
            .iter()
            .map(|(name, formula)| (name.clone(), writer.formula(formula).unwrap_or(Formula::Constant(f64::NAN))));
        let said = |constraint: &&Constraint| !self.uses_unsaid(constraint, &writer);
        let rows = self.constraints.iter().filter(said).filter_map(|constraint| writer.rows(constraint)).flatten();
        let mut relaxed = Problem {
            objective,
            definitions: definitions.collect(),
            constraints: rows.chain(truss.equations(first)).collect(),
            ..self.clone()
        };
        let count = truss.bars.len() * truss.structure.cases.len();
        let variables = &mut relaxed.variables;
        variables.typical.resize(first as usize, 0.0);
        for at in 0..count as u32 {
            variables.origin.push(Origin::Input(at));
            variables.lower.push(f64::NEG_INFINITY);
            variables.upper.push(f64::INFINITY);
            variables.start.push(0.0);
            variables.typical.push(0.0);
        }
        Some(relaxed)
    }

    fn uses_unsaid(&self, constraint: &Constraint, writer: &Writer<'_>) -> bool {
        let unsaid = |&d: &u32| self.definitions.get(d as usize).is_some_and(|(_, formula)| writer.formula(formula).is_none());
        let mut used = Vec::new();
        [&constraint.left].into_iter().chain(constraint.right.formulas()).for_each(|formula| definitions_in(formula, &mut used));
        used.iter().any(unsaid)
    }
}

/// Definitions that a formula names.
fn definitions_in(formula: &Formula, used: &mut Vec<u32>) {
    match formula {
        Formula::Definition(d) => used.push(*d),
        Formula::Unary(_, inner) | Formula::Profile(_, inner) => definitions_in(inner, used),
        Formula::Binary(_, left, right) => {
            definitions_in(left, used);
            definitions_in(right, used);
        }
        Formula::Fold(_, list) => list.iter().for_each(|part| definitions_in(part, used)),
        Formula::Over { body, .. } => definitions_in(body, used),
        _ => {}
    }
}
