//! The matrix ∂R/∂u of one block: factorised, solved with, and looked at for mechanisms.
//!
//! Everything here looks at the state equations alone, as the last rows of a model over design and states: other rows may have no value
//! or no derivative where the search for the states begins, at u = 0 (the size of a displacement, √(u_x² + u_y²), has none there).

use super::{EvaluationError, Meta, Model, States};
use crate::linear_algebra::{Pattern, SymmetricSolver};
use crate::math::split_mix::SplitMix;

/// A structure is a mechanism where the smallest eigenvalue of its stiffness, scaled to a unit diagonal, is below this: rounding leaves about
/// 1e−16 of a zero; a chain of a thousand members in bending has 1e−12.
const SINGULAR: f64 = 1e-14;

/// What is added to the scaled diagonal so that a singular matrix can be factorised for inverse iteration.
const SHIFT: f64 = 1e-11;

/// Where the block of the states stands: lower triangle by rows, and each value's place in the Jacobian of the equations.
pub struct Stiffness {
    states: States,
    pattern: Pattern,
    places: Vec<usize>,
}

/// The block's factors at one design.
pub struct Factors {
    solver: SymmetricSolver,
    /// D = diag(K)^(−1/2).
    scales: Vec<f64>,
}

/// A motion without resistance, by state of a block; its largest component is 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    /// The motion.
    pub motion: Vec<f64>,
}

fn failed(cause: impl ToString) -> EvaluationError {
    EvaluationError::Invalid { term: "analysis of the structure".into(), cause: cause.to_string() }
}

impl Stiffness {
    /// Where the block stands in the model of these equations, whose last rows they are; nothing is evaluated.
    pub fn of(meta: &Meta, states: States) -> Self {
        let states = States { first_row: meta.rows() - states.block * states.blocks, ..states };
        let (n, m) = (states.first_variable, states.first_row);
        let (mut positions, mut places) = (Vec::new(), Vec::new());
        if states.blocks > 0 {
            for equation in 0..states.block {
                for at in meta.jacobian.range(m + equation) {
                    if let Some(state) = (meta.jacobian.columns[at] as usize).checked_sub(n).filter(|&state| state <= equation) {
                        positions.push((equation as u32, state as u32));
                        places.push(at);
                    }
                }
            }
        }
        Stiffness { states, pattern: Pattern::from_positions(states.block, &mut positions), places }
    }

    fn values(&self, equations: &impl Model, z: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let mut jacobian = vec![0.0; equations.meta().jacobian.len()];
        equations.jacobian(z, &mut jacobian)?;
        Ok(self.places.iter().map(|&at| jacobian[at]).collect())
    }

    /// The values scaled to a unit diagonal, and the scales; directions without stiffness keep their zeros.
    fn scaled(&self, mut values: Vec<f64>) -> (Vec<f64>, Vec<f64>) {
        let scales: Vec<f64> = (0..self.states.block)
            .map(|row| match self.pattern.position(row, row as u32).map(|at| values[at]) {
                Some(diagonal) if diagonal > 0.0 => 1.0 / diagonal.sqrt(),
                _ => 1.0,
            })
            .collect();
        for (at, (row, column)) in self.pattern.iter().enumerate() {
            values[at] *= scales[row] * scales[column];
        }
        (values, scales)
    }

    /// A solver for the block; `earlier`, of another design, keeps its analysis of the pattern.
    fn solver(&self, earlier: Option<Factors>) -> Result<SymmetricSolver, EvaluationError> {
        match earlier {
            Some(factors) => Ok(factors.solver),
            None => SymmetricSolver::for_quasi_definite(&self.pattern.offsets, &self.pattern.columns).map_err(failed),
        }
    }

    /// Design and states, and the factors they were found with.
    ///
    /// # Errors
    /// Where the equations have no value, or the structure is a mechanism.
    pub fn solve_states(
        &self,
        equations: &impl Model,
        x: &[f64],
        earlier: Option<Factors>,
    ) -> Result<(Vec<f64>, Factors), EvaluationError> {
        let mut z = x.to_vec();
        z.resize(x.len() + self.states.block * self.states.blocks, 0.0);
        let (scaled, scales) = self.scaled(self.values(equations, &z)?);
        let mut solver = self.solver(earlier)?;
        let inertia = solver.factor(&scaled).map_err(failed)?;
        if inertia.positive != self.states.block {
            return Err(failed("the structure is a mechanism: a motion meets no resistance"));
        }
        let factors = Factors { solver, scales };
        // R is linear in u: one step is exact but for rounding, which two more take away.
        for _ in 0..3 {
            let mut rows = vec![0.0; equations.meta().rows()];
            equations.constraints(&z, &mut rows)?;
            let first = self.states.first_row;
            let mut step: Vec<f64> =
                rows[first..].iter().zip(&equations.meta().row_upper[first..]).map(|(row, load)| load - row).collect();
            factors.solve(&mut step)?;
            z[x.len()..].iter_mut().zip(&step).for_each(|(state, step)| *state += step);
        }
        if z.iter().all(|value| value.is_finite()) { Ok((z, factors)) } else { Err(failed("displacements overflow")) }
    }

    /// The smallest eigenvalue's motion by inverse iteration, where it is none but for rounding.
    ///
    /// # Errors
    /// Where the equations have no value.
    pub fn mechanism(&self, equations: &impl Model, x: &[f64]) -> Result<Option<Mechanism>, EvaluationError> {
        let order = self.states.block;
        let mut z = x.to_vec();
        z.resize(x.len() + order * self.states.blocks, 0.0);
        if order == 0 || self.states.blocks == 0 {
            return Ok(None);
        }
        let (scaled, scales) = self.scaled(self.values(equations, &z)?);
        let mut shifted = scaled.clone();
        for (at, (row, column)) in self.pattern.iter().enumerate() {
            shifted[at] += if row == column { SHIFT } else { 0.0 };
        }
        let mut solver = self.solver(None)?;
        solver.factor(&shifted).map_err(failed)?;
        let mut random = SplitMix::new(1);
        let mut motion: Vec<f64> = (0..order).map(|_| random.uniform() - 0.5).collect();
        let mut next = vec![0.0; order];
        for _ in 0..6 {
            solver.solve_once(&motion, &mut next).map_err(failed)?;
            let size = next.iter().map(|value| value * value).sum::<f64>().sqrt();
            motion.iter_mut().zip(&next).for_each(|(value, next)| *value = next / size);
        }
        let energy = quadratic(&self.pattern, &scaled, &motion);
        if energy > SINGULAR || energy.is_nan() {
            return Ok(None);
        }
        motion.iter_mut().zip(&scales).for_each(|(value, scale)| *value *= scale);
        let largest = motion.iter().fold(0.0, |most: f64, value| if value.abs() > most.abs() { *value } else { most });
        motion.iter_mut().for_each(|value| *value /= largest);
        Ok(Some(Mechanism { motion }))
    }

    /// The largest residual of an equation at design and states, over the largest sum of the sizes of one's terms.
    ///
    /// # Errors
    /// Where the equations have no value.
    pub fn residual(&self, equations: &impl Model, z: &[f64]) -> Result<f64, EvaluationError> {
        let meta = equations.meta();
        let (mut rows, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
        equations.constraints(z, &mut rows)?;
        equations.jacobian(z, &mut jacobian)?;
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for (row, &value) in rows.iter().enumerate().skip(self.states.first_row) {
            let of_state = |at: &usize| meta.jacobian.columns[*at] as usize >= self.states.first_variable;
            let terms =
                meta.jacobian.range(row).filter(of_state).map(|at| (jacobian[at] * z[meta.jacobian.columns[at] as usize]).abs());
            worst = worst.max((value - meta.row_upper[row]).abs());
            largest = largest.max(terms.sum::<f64>() + meta.row_upper[row].abs());
        }
        Ok(if largest > 0.0 { worst / largest } else { 0.0 })
    }
}

impl Factors {
    /// K⁻¹·right, block by block, in place.
    ///
    /// # Errors
    /// Where the solver fails.
    pub fn solve(&self, right: &mut [f64]) -> Result<(), EvaluationError> {
        let mut solution = vec![0.0; self.scales.len()];
        for block in right.chunks_mut(self.scales.len().max(1)) {
            block.iter_mut().zip(&self.scales).for_each(|(value, scale)| *value *= scale);
            self.solver.solve_once(block, &mut solution).map_err(failed)?;
            block.iter_mut().zip(&solution).zip(&self.scales).for_each(|((value, solution), scale)| *value = solution * scale);
        }
        Ok(())
    }
}

/// vᵀAv from the lower triangle of A.
fn quadratic(pattern: &Pattern, values: &[f64], v: &[f64]) -> f64 {
    let term = |(at, (row, column)): (usize, (usize, usize))| {
        let factor = if row == column { 1.0 } else { 2.0 };
        factor * values[at] * v[row] * v[column]
    };
    pattern.iter().enumerate().map(term).sum()
}
