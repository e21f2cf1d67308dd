//! Any model with states, seen in its design variables alone: states are solved for, derivatives go through the adjoint.
//!
//! With R(x, u) = 0 linear in u, K = ∂R/∂u symmetric and the same in every block: u = K⁻¹(…), U = du/dx = −K⁻¹·R_x,
//! λ = −K⁻¹·(w·f_u + c_uᵀy), and the Hessian of the Lagrangian is L_xx + L_xu·U + (L_xu·U)ᵀ + Uᵀ·L_uu·U at L = w·f + yᵀc + λᵀR
//! (Haftka and Gürdal, *Elements of Structural Optimization*, ch. 7).

mod solve;

use std::sync::Mutex;

use super::lifted::{States, WithStates};
use super::{EvaluationError, Meta, Model, Own, Pattern};
pub use solve::{Mechanism, Stiffness};

/// A model without its states.
pub struct Reduced<M> {
    lifted: M,
    meta: Meta,
    states: States,
    stiffness: Mutex<Stiffness>,
    latest: Mutex<Option<Latest>>,
}

/// A design with its states.
#[derive(Clone)]
struct Latest {
    x: Vec<f64>,
    /// Design and states.
    z: Vec<f64>,
}

impl<M: WithStates> Reduced<M> {
    /// The lifted model's design; `None` where it has no states.
    pub fn of(lifted: M) -> Option<Self> {
        let own = lifted.meta();
        let states = own.states?;
        let (n, m) = (states.first_variable, states.first_row);
        let meta = Meta {
            lower: own.lower[..n].to_vec(),
            upper: own.upper[..n].to_vec(),
            start: own.start[..n].to_vec(),
            typical: own.typical.get(..n).unwrap_or_default().to_vec(),
            row_lower: own.row_lower[..m].to_vec(),
            row_upper: own.row_upper[..m].to_vec(),
            row_is_linear: (0..m).map(|row| own.is_row_linear(row) && knows_no_state(own, row, n)).collect(),
            objective_is_linear: own.objective_is_linear,
            jacobian: jacobian_pattern(own, states),
            hessian: dense_lower(n),
            ..Meta::default()
        };
        let stiffness = Mutex::new(Stiffness::of(own, states));
        Some(Reduced { lifted, meta, states, stiffness, latest: Mutex::new(None) })
    }

    /// The model with its states.
    pub fn lifted(&self) -> &M {
        &self.lifted
    }

    /// Design and states at a design.
    ///
    /// # Errors
    /// Where the model has no value, or the structure is a mechanism.
    pub fn solved(&self, x: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let mut latest = self.latest.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(known) = latest.as_ref().filter(|known| known.x == x) {
            return Ok(known.z.clone());
        }
        let z = self.stiffness().solve_states(&self.lifted, x)?;
        *latest = Some(Latest { x: x.to_vec(), z: z.clone() });
        Ok(z)
    }

    /// The mechanism a design is, where it is one.
    ///
    /// # Errors
    /// Where the model has no value.
    pub fn mechanism(&self, x: &[f64]) -> Result<Option<Mechanism>, EvaluationError> {
        self.stiffness().mechanism(&self.lifted, x)
    }

    fn stiffness(&self) -> std::sync::MutexGuard<'_, Stiffness> {
        self.stiffness.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// The multipliers of the state equations that make the Lagrangian stationary in the states.
    fn adjoint(&self, z: &[f64], weight: f64, y: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let meta = self.lifted.meta();
        let mut slope = vec![0.0; meta.variables()];
        if weight != 0.0 {
            self.lifted.gradient(z, &mut slope)?;
            slope.iter_mut().for_each(|slope| *slope *= weight);
        }
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        self.lifted.jacobian(z, &mut jacobian)?;
        let mut all = y.to_vec();
        all.resize(meta.rows(), 0.0);
        meta.jacobian.add_transposed(&jacobian, &all, &mut slope);
        let mut multipliers = slope.split_off(self.states.first_variable);
        let stiffness = self.stiffness();
        stiffness.solve(&mut multipliers)?;
        multipliers.iter_mut().for_each(|value| *value = -*value);
        Ok(multipliers)
    }

    /// U = −K⁻¹·R_x, one column per design variable.
    fn sensitivities(&self, jacobian: &[f64]) -> Result<Vec<Vec<f64>>, EvaluationError> {
        let (n, m, number) = (self.states.first_variable, self.states.first_row, self.states.block * self.states.blocks);
        let pattern = &self.lifted.meta().jacobian;
        let mut columns = vec![vec![0.0; number]; n];
        for equation in 0..number {
            for at in pattern.range(m + equation) {
                if let Some(column) = columns.get_mut(pattern.columns[at] as usize) {
                    column[equation] = -jacobian[at];
                }
            }
        }
        let stiffness = self.stiffness();
        columns.iter_mut().try_for_each(|column| stiffness.solve(column))?;
        Ok(columns)
    }

    /// Row by row: adjoints where rows with states are fewer than variables, sensitivities otherwise.
    fn reduced_jacobian(&self, z: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (n, m) = (self.states.first_variable, self.states.first_row);
        let pattern = &self.lifted.meta().jacobian;
        let mut jacobian = vec![0.0; pattern.len()];
        self.lifted.jacobian(z, &mut jacobian)?;
        let stateful: Vec<bool> = (0..m).map(|row| !knows_no_state(self.lifted.meta(), row, n)).collect();
        let columns = match stateful.iter().filter(|&&stateful| stateful).count() {
            0 => Vec::new(),
            rows if rows >= n => self.sensitivities(&jacobian)?,
            _ => Vec::new(),
        };
        let mut dense = vec![0.0; n];
        for row in 0..m {
            dense.fill(0.0);
            for at in pattern.range(row) {
                if let Some(value) = dense.get_mut(pattern.columns[at] as usize) {
                    *value += jacobian[at];
                }
            }
            if stateful[row] {
                self.add_through_states(row, &jacobian, &columns, &mut dense)?;
            }
            for at in self.meta.jacobian.range(row) {
                values[at] = dense[self.meta.jacobian.columns[at] as usize];
            }
        }
        Ok(())
    }

    fn add_through_states(
        &self,
        row: usize,
        jacobian: &[f64],
        columns: &[Vec<f64>],
        dense: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let (n, m) = (self.states.first_variable, self.states.first_row);
        let pattern = &self.lifted.meta().jacobian;
        let by_state = pattern.range(row).filter_map(|at| Some(((pattern.columns[at] as usize).checked_sub(n)?, jacobian[at])));
        if !columns.is_empty() {
            let by_state: Vec<(usize, f64)> = by_state.collect();
            for (value, column) in dense.iter_mut().zip(columns) {
                *value += by_state.iter().map(|&(state, slope)| slope * column[state]).sum::<f64>();
            }
            return Ok(());
        }
        let mut adjoint = vec![0.0; self.states.block * self.states.blocks];
        by_state.for_each(|(state, slope)| adjoint[state] = -slope);
        self.stiffness().solve(&mut adjoint)?;
        for (equation, multiplier) in adjoint.iter().enumerate().filter(|(_, multiplier)| **multiplier != 0.0) {
            for at in pattern.range(m + equation) {
                if let Some(value) = dense.get_mut(pattern.columns[at] as usize) {
                    *value += multiplier * jacobian[at];
                }
            }
        }
        Ok(())
    }
}

/// Whether no state occurs in a row.
fn knows_no_state(meta: &Meta, row: usize, first_state: usize) -> bool {
    meta.jacobian.row(row).last().is_none_or(|&last| (last as usize) < first_state)
}

/// Rows with states depend on every design variable that some state equation knows.
fn jacobian_pattern(own: &Meta, states: States) -> Pattern {
    let n = states.first_variable;
    let mut through = vec![false; n];
    for row in states.first_row..own.rows() {
        own.jacobian.row(row).iter().filter(|&&j| (j as usize) < n).for_each(|&j| through[j as usize] = true);
    }
    let mut positions = Vec::new();
    for row in 0..states.first_row {
        let own_columns = own.jacobian.row(row).iter().copied().filter(|&j| (j as usize) < n);
        positions.extend(own_columns.map(|j| (row as u32, j)));
        if !knows_no_state(own, row, n) {
            positions.extend((0..n as u32).filter(|&j| through[j as usize]).map(|j| (row as u32, j)));
        }
    }
    Pattern::from_positions(states.first_row, &mut positions)
}

fn dense_lower(n: usize) -> Pattern {
    let mut positions = (0..n as u32).flat_map(|row| (0..=row).map(move |column| (row, column))).collect();
    Pattern::from_positions(n, &mut positions)
}

impl<M: WithStates> Model for Reduced<M> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.lifted.objective(&self.solved(x)?)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let z = self.solved(x)?;
        let mut whole = vec![0.0; z.len()];
        let value = self.lifted.gradient(&z, &mut whole)?;
        gradient.copy_from_slice(&whole[..x.len()]);
        if whole[x.len()..].iter().any(|&slope| slope != 0.0) {
            let multipliers = self.adjoint(&z, 1.0, &[])?;
            let pattern = &self.lifted.meta().jacobian;
            let mut jacobian = vec![0.0; pattern.len()];
            self.lifted.jacobian(&z, &mut jacobian)?;
            for (equation, multiplier) in multipliers.iter().enumerate() {
                for at in pattern.range(self.states.first_row + equation) {
                    if let Some(slope) = gradient.get_mut(pattern.columns[at] as usize) {
                        *slope += multiplier * jacobian[at];
                    }
                }
            }
        }
        Ok(value)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut all = vec![0.0; self.lifted.meta().rows()];
        self.lifted.constraints(&self.solved(x)?, &mut all)?;
        values.copy_from_slice(&all[..values.len()]);
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.reduced_jacobian(&self.solved(x)?, values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let z = self.solved(x)?;
        let meta = self.lifted.meta();
        let multipliers = self.adjoint(&z, weight, y)?;
        let all: Vec<f64> = y.iter().chain(&multipliers).copied().collect();
        let (mut hessian, mut jacobian) = (vec![0.0; meta.hessian.len()], vec![0.0; meta.jacobian.len()]);
        self.lifted.hessian(&z, weight, &all, &mut hessian)?;
        self.lifted.jacobian(&z, &mut jacobian)?;
        let columns = self.sensitivities(&jacobian)?;
        solve::congruence(&meta.hessian, &hessian, &columns, values);
        Ok(())
    }

    fn own(&self) -> Own {
        self.lifted.own()
    }

    fn complete(&self, x: &mut [f64]) {
        if let Some((auxiliaries, first)) = self.lifted.auxiliaries() {
            super::auxiliaries::complete(self, auxiliaries, first, x);
        }
    }

    fn variable_name(&self, j: usize) -> String {
        self.lifted.variable_name(j)
    }

    fn row_name(&self, i: usize) -> String {
        self.lifted.row_name(i)
    }

    fn row_place(&self, i: usize) -> Option<String> {
        self.lifted.row_place(i)
    }
}
