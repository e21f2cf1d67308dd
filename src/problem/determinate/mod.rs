//! Statically determinate structures as formulas of their sections.
//!
//! Where there are as many basic forces as free directions and equilibrium Bᵀ·q = p is regular, the forces follow from it alone, whatever the sections
//! are: stresses of prismatic ribs are Σ N/A + M·Y/I, deflections numbers over E·I, and displacements Σ q̄·e by the forces q̄ of a unit load (unit load
//! theorem), e being numbers over E·A, E·I, G·J and G·A_s.

mod equilibrium;
mod numbers;
mod shares;
mod writer;

use super::Problem;
use super::rewritten::Rewriting;
use equilibrium::Equilibrium;
use writer::Writer;

impl Problem {
    /// The problem of a statically determinate structure as formulas of its sections; `None` where it is none, or where something is asked
    /// that is no such formula: of a tapered rib, of one whose own weight counts, a buckling factor.
    pub fn determinate(&self) -> Option<Problem> {
        if !self.analyses() {
            return None;
        }
        let equilibrium = Equilibrium::of(self)?;
        let writer = Writer { problem: self, equilibrium: &equilibrium };
        let objective = writer.formula(&self.objective)?;
        let definitions = self.definitions.iter().map(|(name, formula)| Some((name.clone(), writer.formula(formula)?)));
        let definitions = definitions.collect::<Option<_>>()?;
        let constraints = self.constraints.iter().map(|constraint| writer.rows(constraint)).collect::<Option<Vec<_>>>()?.concat();
        Some(Problem { objective, definitions, constraints, ..self.clone() })
    }
}
