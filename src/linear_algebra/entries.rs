//! Sparse symmetric matrices put together from entries.

use super::blocks::BlockSolver;
use super::bordered::Bordered;
use super::bunch_kaufman::{self, Pivot};
use super::congruence::CongruentSolver;
use super::{Effort, FactorizationError, Inertia, Pattern, SymmetricSolver};

/// A lower triangle whose positions are fixed and whose values change.
pub struct Symmetric {
    places: Vec<usize>,
    values: Vec<f64>,
    solver: Solver,
}

/// Matrices of this order and less are dense where they are many.
const SMALL: usize = 48;

/// From this order on a basis is looked for in which second derivatives are sparser.
const LARGE: usize = 2000;

/// Many small blocks by themselves, anything else as a whole.
enum Solver {
    Dense { factors: Vec<f64>, pivots: Vec<Pivot> },
    Blocks(BlockSolver),
    Bordered(Box<Bordered>),
    Sparse(SymmetricSolver),
    Congruent(CongruentSolver),
}

/// What factors are for.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    Solve,
    Inertia(Effort),
}

impl Symmetric {
    /// A matrix of this order with entries at these positions (either triangle, repeats are added up).
    pub fn new(order: usize, positions: &[(u32, u32)]) -> Result<Self, FactorizationError> {
        Symmetric::build(order, positions, |pattern| match pattern.rows() < LARGE {
            true => sparse(&pattern),
            false => {
                let bordered = Bordered::new(pattern).map(|bordered| Solver::Bordered(Box::new(bordered)));
                bordered.or_else(|pattern| sparse(&pattern))
            }
        })
    }

    /// The same by sparse factors, whatever the structure.
    pub fn sparse(order: usize, positions: &[(u32, u32)]) -> Result<Self, FactorizationError> {
        Symmetric::build(order, positions, |pattern| sparse(&pattern))
    }

    /// The same for a matrix of second derivatives.
    pub fn curved(order: usize, positions: &[(u32, u32)]) -> Result<Self, FactorizationError> {
        if order < LARGE {
            return Symmetric::new(order, positions);
        }
        let congruent = |pattern: Pattern| CongruentSolver::new(pattern.offsets, pattern.columns).map(Solver::Congruent);
        Symmetric::build(order, positions, congruent)
    }

    fn build(
        order: usize,
        positions: &[(u32, u32)],
        solver: impl FnOnce(Pattern) -> Result<Solver, FactorizationError>,
    ) -> Result<Self, FactorizationError> {
        let lower = |&(i, j): &(u32, u32)| (i.max(j), i.min(j));
        let mut sorted = positions.iter().map(lower).collect();
        let pattern = Pattern::from_positions(order, &mut sorted);
        let place = |(row, column): (u32, u32)| pattern.position(row as usize, column).unwrap_or_default();
        let places = positions.iter().map(lower).map(place).collect();
        let values = vec![0.0; pattern.len()];
        let solver = match BlockSolver::new(&pattern.offsets, &pattern.columns) {
            Some(blocks) => Solver::Blocks(blocks),
            None => solver(pattern)?,
        };
        Ok(Symmetric { places, values, solver })
    }

    /// The same for one of very many small matrices: nothing is analysed, all of it is stored.
    pub fn one_of_many(order: usize, positions: &[(u32, u32)]) -> Result<Self, FactorizationError> {
        if order > SMALL {
            return Symmetric::new(order, positions);
        }
        let place = |&(i, j): &(u32, u32)| i.max(j) as usize * order + i.min(j) as usize;
        let places = positions.iter().map(place).collect();
        let solver = Solver::Dense { factors: Vec::new(), pivots: vec![Pivot::default(); order] };
        Ok(Symmetric { places, values: vec![0.0; order * order], solver })
    }

    /// Factorises with these values, one per position given.
    pub fn factor(&mut self, entries: impl Iterator<Item = f64>) -> Result<(), FactorizationError> {
        self.sum(entries);
        self.factors(Use::Solve).map(|_| ())
    }

    /// The same, and the inertia where rounding has no part in it.
    ///
    /// # Errors
    /// [`FactorizationError::Uncertain`] where it may have changed it, with no more than this effort; there are no factors, or a value is no
    /// number.
    pub fn inertia(&mut self, entries: impl Iterator<Item = f64>, effort: Effort) -> Result<Inertia, FactorizationError> {
        self.sum(entries);
        self.factors(Use::Inertia(effort))
    }

    fn sum(&mut self, entries: impl Iterator<Item = f64>) {
        self.values.fill(0.0);
        for (&place, entry) in self.places.iter().zip(entries) {
            self.values[place] += entry;
        }
    }

    fn factors(&mut self, use_of: Use) -> Result<Inertia, FactorizationError> {
        match (&mut self.solver, use_of) {
            (Solver::Dense { factors, pivots }, _) => {
                if !self.values.iter().all(|value| value.is_finite()) {
                    return Err(FactorizationError::Library("a value is no number".into()));
                }
                factors.clone_from(&self.values);
                Ok(bunch_kaufman::factor(factors, pivots))
            }
            (Solver::Blocks(solver), _) => solver.factor(&self.values),
            (Solver::Bordered(solver), _) => {
                let found = solver.factor(&self.values);
                match found.filter(|_| use_of == Use::Solve || solver.is_certain(&self.values)) {
                    Some(inertia) => Ok(inertia),
                    None => {
                        self.solver = sparse(solver.pattern())?;
                        self.factors(use_of)
                    }
                }
            }
            (Solver::Sparse(solver), Use::Solve) => solver.factor(&self.values),
            (Solver::Sparse(solver), Use::Inertia(effort)) => solver.certain_inertia(&self.values, effort),
            (Solver::Congruent(solver), Use::Solve) => solver.factor(&self.values),
            (Solver::Congruent(solver), Use::Inertia(effort)) => solver.certain_inertia(&self.values, effort),
        }
    }

    /// Solves with the factors found last.
    pub fn solve(&self, right: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let mut x = vec![0.0; right.len()];
        match &self.solver {
            Solver::Dense { factors, pivots } => {
                bunch_kaufman::solve_refined(&self.values, factors, pivots, right, &mut x, &mut Vec::new());
                if !x.iter().all(|value| value.is_finite()) {
                    return Err(FactorizationError::Singular);
                }
            }
            Solver::Blocks(solver) => solver.solve(right, &mut x),
            Solver::Bordered(solver) => return solver.solve(&self.values, right).ok_or(FactorizationError::Singular),
            Solver::Sparse(solver) => solver.solve(right, &mut x)?,
            Solver::Congruent(solver) => solver.solve(right, &mut x)?,
        }
        Ok(x)
    }

    /// The same to the accuracy of the factors alone: for steps that are corrected by further ones.
    pub fn solve_once(&self, right: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let mut x = vec![0.0; right.len()];
        match &self.solver {
            Solver::Sparse(solver) => solver.solve_once(right, &mut x)?,
            Solver::Congruent(solver) => solver.solve_once(right, &mut x)?,
            _ => return self.solve(right),
        }
        Ok(x)
    }
}

fn sparse(pattern: &Pattern) -> Result<Solver, FactorizationError> {
    SymmetricSolver::for_few(&pattern.offsets, &pattern.columns).map(Solver::Sparse)
}
