//! Trusses as problems in the axial forces of their bars.
//!
//! Equilibrium of the free directions is Bᵀ·N = p, whatever the areas are. Where B is square and regular (a statically *determinate* truss) the forces are numbers, and
//! every response is an explicit formula of the areas: σ = N/A, u = Σ n·N·L/(E·A) by the unit load theorem. Otherwise the forces of the elastic
//! truss are one solution among many: with them as free variables, and without the rows that ask for more than forces, the minimum is a
//! *lower bound* of that of the elastic truss (the lower-bound theorem of limit analysis; Dorn, Gomory and Greenberg, *Automatic design of optimal structures*,
//! Journal de Mécanique 3, 1964).

mod terms;
mod truss;
mod writer;

use nalgebra::DMatrix;

use super::{Constraint, Formula, Origin, Problem};
use truss::Truss;
use writer::{Forces, Writer};

/// Forces and displacements by unit loads below this share of the largest are rounding.
const ROUNDING: f64 = 1e-12;

impl Problem {
    /// The problem of a statically determinate truss as formulas of its areas; `None` where it is none, or where something is asked that is
    /// no such formula.
    pub fn determinate(&self) -> Option<Problem> {
        let truss = Truss::of(self)?;
        if !self.analyses() || truss.free.len() != truss.bars.len() {
            return None;
        }
        let equilibrium = truss.equilibrium();
        let inverse = equilibrium.clone().try_inverse()?;
        let loads = DMatrix::from_fn(truss.free.len(), truss.structure.cases.len(), |row, case| truss.load(case, row));
        let cleaned = |matrix: DMatrix<f64>| {
            let largest = matrix.amax();
            matrix.map(|value| if value.abs() <= ROUNDING * largest { 0.0 } else { value })
        };
        let forces = Forces::Known { of_cases: cleaned(&inverse * loads), of_units: cleaned(inverse) };
        let writer = Writer { truss: &truss, forces };
        let objective = writer.formula(&self.objective)?;
        let definitions = self.definitions.iter().map(|(name, formula)| Some((name.clone(), writer.formula(formula)?)));
        let definitions = definitions.collect::<Option<_>>()?;
        let constraints = self.constraints.iter().map(|constraint| writer.rows(constraint)).collect::<Option<Vec<_>>>()?.concat();
        Some(Problem { objective, definitions, constraints, ..self.clone() })
    }

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
        let writer = Writer { truss: &truss, forces: Forces::Open(first) };
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
