//! One design with its states: derivatives through the adjoint, or through the sensitivities where there are fewer of them.

use std::sync::Arc;

use super::patterns::{congruence, knows_no_state};
use super::{Analysed, Reduced};
use crate::model::evaluation::product_by_entries;
use crate::model::with_states::WithStates;
use crate::model::{Evaluation, EvaluationError};

/// A design, its analysis, and the lifted model there.
pub(super) struct AtPoint<'m, M> {
    pub view: &'m Reduced<M>,
    pub point: Arc<Analysed>,
    pub lifted: Box<dyn Evaluation + 'm>,
}

impl Analysed {
    /// The lifted Jacobian, once it is known.
    fn jacobian(&self) -> &[f64] {
        self.jacobian.get().map_or(&[], Vec::as_slice)
    }

    /// U, once it is known.
    fn sensitivities(&self) -> &[Vec<f64>] {
        self.sensitivities.get().map_or(&[], Vec::as_slice)
    }
}

impl<M: WithStates> AtPoint<'_, M> {
    /// Computes the lifted Jacobian.
    fn know_jacobian(&mut self) -> Result<(), EvaluationError> {
        if self.point.jacobian.get().is_none() {
            let mut jacobian = vec![0.0; self.view.lifted.meta().jacobian.len()];
            self.lifted.jacobian(&mut jacobian)?;
            self.point.jacobian.get_or_init(|| jacobian);
        }
        Ok(())
    }

    /// Computes U = −K⁻¹·R_x, one column per design variable.
    fn know_sensitivities(&mut self) -> Result<(), EvaluationError> {
        self.know_jacobian()?;
        if self.point.sensitivities.get().is_some() {
            return Ok(());
        }
        let states = self.view.states;
        let (n, m, number) = (states.first_variable, states.first_row, states.block * states.blocks);
        let (pattern, jacobian) = (&self.view.lifted.meta().jacobian, self.point.jacobian());
        let mut columns = vec![vec![0.0; number]; n];
        for equation in 0..number {
            for at in pattern.range(m + equation) {
                if let Some(column) = columns.get_mut(pattern.columns[at] as usize) {
                    column[equation] = -jacobian[at];
                }
            }
        }
        columns.iter_mut().try_for_each(|column| self.point.factors.solve(column))?;
        self.point.sensitivities.get_or_init(|| columns);
        Ok(())
    }

    /// The multipliers of the state equations that make the Lagrangian stationary in the states.
    fn adjoint(&mut self, weight: f64, y: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        self.know_jacobian()?;
        let meta = self.view.lifted.meta();
        let mut slope = vec![0.0; meta.variables()];
        if weight != 0.0 {
            self.lifted.gradient(&mut slope)?;
            slope.iter_mut().for_each(|slope| *slope *= weight);
        }
        let mut all = y.to_vec();
        all.resize(meta.rows(), 0.0);
        meta.jacobian.add_transposed(self.point.jacobian(), &all, &mut slope);
        let mut multipliers = slope.split_off(self.view.states.first_variable);
        self.point.factors.solve(&mut multipliers)?;
        multipliers.iter_mut().for_each(|value| *value = -*value);
        Ok(multipliers)
    }

    /// Adds what a row changes through the states, by the sensitivities `columns` where there are any, by an adjoint elsewhere.
    fn add_through_states(&self, row: usize, columns: &[Vec<f64>], dense: &mut [f64]) -> Result<(), EvaluationError> {
        let states = self.view.states;
        let (n, m) = (states.first_variable, states.first_row);
        let (pattern, jacobian) = (&self.view.lifted.meta().jacobian, self.point.jacobian());
        let by_state = pattern.range(row).filter_map(|at| Some(((pattern.columns[at] as usize).checked_sub(n)?, jacobian[at])));
        if !columns.is_empty() {
            let by_state: Vec<(usize, f64)> = by_state.collect();
            for (value, column) in dense.iter_mut().zip(columns) {
                *value += by_state.iter().map(|&(state, slope)| slope * column[state]).sum::<f64>();
            }
            return Ok(());
        }
        let mut adjoint = vec![0.0; states.block * states.blocks];
        by_state.for_each(|(state, slope)| adjoint[state] = -slope);
        self.point.factors.solve(&mut adjoint)?;
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

impl<M: WithStates> Evaluation for AtPoint<'_, M> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.lifted.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let n = gradient.len();
        let mut whole = vec![0.0; self.point.z.len()];
        let value = self.lifted.gradient(&mut whole)?;
        gradient.copy_from_slice(&whole[..n]);
        if whole[n..].iter().any(|&slope| slope != 0.0) {
            let multipliers = self.adjoint(1.0, &[])?;
            let (pattern, jacobian) = (&self.view.lifted.meta().jacobian, self.point.jacobian());
            for (equation, multiplier) in multipliers.iter().enumerate() {
                for at in pattern.range(self.view.states.first_row + equation) {
                    if let Some(slope) = gradient.get_mut(pattern.columns[at] as usize) {
                        *slope += multiplier * jacobian[at];
                    }
                }
            }
        }
        Ok(value)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut all = vec![0.0; self.view.lifted.meta().rows()];
        self.lifted.constraints(&mut all)?;
        values.copy_from_slice(&all[..values.len()]);
        Ok(())
    }

    /// Row by row: adjoints where rows with states are fewer than variables, sensitivities otherwise.
    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let (n, m) = (self.view.states.first_variable, self.view.states.first_row);
        let own = &self.view.meta.jacobian;
        let meta = self.view.lifted.meta();
        let stateful: Vec<bool> = (0..m).map(|row| !knows_no_state(meta, row, n)).collect();
        let by_columns = stateful.iter().filter(|&&stateful| stateful).count() >= n;
        if by_columns {
            self.know_sensitivities()?;
        }
        self.know_jacobian()?;
        let (pattern, jacobian) = (&meta.jacobian, self.point.jacobian());
        let columns = if by_columns { self.point.sensitivities() } else { &[] };
        let mut dense = vec![0.0; n];
        for (row, &through_states) in stateful.iter().enumerate() {
            dense.fill(0.0);
            for at in pattern.range(row) {
                if let Some(value) = dense.get_mut(pattern.columns[at] as usize) {
                    *value += jacobian[at];
                }
            }
            if through_states {
                self.add_through_states(row, columns, &mut dense)?;
            }
            for at in own.range(row) {
                values[at] = dense[own.columns[at] as usize];
            }
        }
        Ok(())
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let meta = self.view.lifted.meta();
        let multipliers = self.adjoint(weight, y)?;
        let all: Vec<f64> = y.iter().chain(&multipliers).copied().collect();
        let mut hessian = vec![0.0; meta.hessian.len()];
        self.lifted.hessian(weight, &all, &mut hessian)?;
        self.know_sensitivities()?;
        congruence(&meta.hessian, &hessian, self.point.sensitivities(), values);
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}
