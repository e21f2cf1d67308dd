//! Any model with states, seen in its design variables alone: states are solved for, derivatives go through the adjoint.
//!
//! With R(x, u) = 0 linear in u, K = ∂R/∂u symmetric and the same in every block: u = K⁻¹(…), U = du/dx = −K⁻¹·R_x,
//! λ = −K⁻¹·(w·f_u + c_uᵀy), and the Hessian of the Lagrangian is L_xx + L_xu·U + (L_xu·U)ᵀ + Uᵀ·L_uu·U at L = w·f + yᵀc + λᵀR
//! (Haftka and Gürdal, *Elements of Structural Optimization*, ch. 7).

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::model::states::States;
use crate::model::stiffness::Factors;
use crate::model::with_states::WithStates;
use crate::model::{EvaluationError, Meta, Model, Own, Pattern, auxiliaries};

/// A model without its states.
pub struct Reduced<M> {
    lifted: M,
    meta: Meta,
    states: States,
    latest: Mutex<Option<Arc<Analysed>>>,
}

/// A design with what follows from it; each part is computed once.
struct Analysed {
    x: Vec<f64>,
    /// Design and states.
    z: Vec<f64>,
    factors: Factors,
    jacobian: OnceLock<Vec<f64>>,
    /// U = −K⁻¹·R_x, one column per design variable.
    sensitivities: OnceLock<Vec<Vec<f64>>>,
}

impl<M: WithStates> Reduced<M> {
    /// The lifted model's design; `None` where it has no states. Without derivatives its patterns are empty: values alone are asked for
    /// where designs are so large that dense derivatives do not fit.
    pub fn of(lifted: M, derivatives: bool) -> Option<Self> {
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
            names: own.names.clone(),
            extra_work: ((states.block * states.blocks) as f64).powf(1.5),
            jacobian: if derivatives { jacobian_pattern(own, states) } else { Pattern::from_positions(m, &mut Vec::new()) },
            hessian: if derivatives { dense_lower(n) } else { Pattern::from_positions(n, &mut Vec::new()) },
            ..Meta::default()
        };
        Some(Reduced { lifted, meta, states, latest: Mutex::new(None) })
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
        Ok(self.at(x)?.z.clone())
    }

    fn at(&self, x: &[f64]) -> Result<Arc<Analysed>, EvaluationError> {
        let earlier = {
            let mut latest = self.latest.lock().unwrap_or_else(PoisonError::into_inner);
            match latest.as_ref() {
                Some(known) if known.x == x => return Ok(Arc::clone(known)),
                // Nobody else looks at it any more: its analysis of the pattern serves again.
                _ => latest.take().and_then(Arc::into_inner).map(|earlier| earlier.factors),
            }
        };
        let (z, factors) = self.lifted.solve_states(x, earlier)?;
        let (jacobian, sensitivities) = (OnceLock::new(), OnceLock::new());
        let analysed = Arc::new(Analysed { x: x.to_vec(), z, factors, jacobian, sensitivities });
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&analysed));
        Ok(analysed)
    }

    /// The lifted Jacobian at an analysed design.
    fn lifted_jacobian<'p>(&self, point: &'p Analysed) -> Result<&'p [f64], EvaluationError> {
        if let Some(known) = point.jacobian.get() {
            return Ok(known);
        }
        let mut jacobian = vec![0.0; self.lifted.meta().jacobian.len()];
        self.lifted.jacobian(&point.z, &mut jacobian)?;
        Ok(point.jacobian.get_or_init(|| jacobian))
    }

    /// The multipliers of the state equations that make the Lagrangian stationary in the states.
    fn adjoint(&self, point: &Analysed, weight: f64, y: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let meta = self.lifted.meta();
        let mut slope = vec![0.0; meta.variables()];
        if weight != 0.0 {
            self.lifted.gradient(&point.z, &mut slope)?;
            slope.iter_mut().for_each(|slope| *slope *= weight);
        }
        let mut all = y.to_vec();
        all.resize(meta.rows(), 0.0);
        meta.jacobian.add_transposed(self.lifted_jacobian(point)?, &all, &mut slope);
        let mut multipliers = slope.split_off(self.states.first_variable);
        point.factors.solve(&mut multipliers)?;
        multipliers.iter_mut().for_each(|value| *value = -*value);
        Ok(multipliers)
    }

    /// U = −K⁻¹·R_x, one column per design variable.
    fn sensitivities<'p>(&self, point: &'p Analysed) -> Result<&'p [Vec<f64>], EvaluationError> {
        if let Some(known) = point.sensitivities.get() {
            return Ok(known);
        }
        let (n, m, number) = (self.states.first_variable, self.states.first_row, self.states.block * self.states.blocks);
        let (pattern, jacobian) = (&self.lifted.meta().jacobian, self.lifted_jacobian(point)?);
        let mut columns = vec![vec![0.0; number]; n];
        for equation in 0..number {
            for at in pattern.range(m + equation) {
                if let Some(column) = columns.get_mut(pattern.columns[at] as usize) {
                    column[equation] = -jacobian[at];
                }
            }
        }
        columns.iter_mut().try_for_each(|column| point.factors.solve(column))?;
        Ok(point.sensitivities.get_or_init(|| columns))
    }

    /// Row by row: adjoints where rows with states are fewer than variables, sensitivities otherwise.
    fn reduced_jacobian(&self, point: &Analysed, values: &mut [f64]) -> Result<(), EvaluationError> {
        let (n, m) = (self.states.first_variable, self.states.first_row);
        let (pattern, jacobian) = (&self.lifted.meta().jacobian, self.lifted_jacobian(point)?);
        let stateful: Vec<bool> = (0..m).map(|row| !knows_no_state(self.lifted.meta(), row, n)).collect();
        let rows = stateful.iter().filter(|&&stateful| stateful).count();
        let columns = if rows >= n { self.sensitivities(point)? } else { &[] };
        let mut dense = vec![0.0; n];
        for (row, &through_states) in stateful.iter().enumerate() {
            dense.fill(0.0);
            for at in pattern.range(row) {
                if let Some(value) = dense.get_mut(pattern.columns[at] as usize) {
                    *value += jacobian[at];
                }
            }
            if through_states {
                self.add_through_states(point, (row, jacobian), columns, &mut dense)?;
            }
            for at in self.meta.jacobian.range(row) {
                values[at] = dense[self.meta.jacobian.columns[at] as usize];
            }
        }
        Ok(())
    }

    fn add_through_states(
        &self,
        point: &Analysed,
        (row, jacobian): (usize, &[f64]),
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
        point.factors.solve(&mut adjoint)?;
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

/// [I U]ᵀ·H·[I; U] for the lower triangle of H over design and states, as a dense lower triangle by rows.
fn congruence(pattern: &Pattern, hessian: &[f64], columns: &[Vec<f64>], values: &mut [f64]) {
    let n = columns.len();
    values.fill(0.0);
    let triangle = |row: usize, column: usize| row.max(column) * (row.max(column) + 1) / 2 + row.min(column);
    // H·[I; U]: products of every state row, then of the mixed ones.
    let states = pattern.rows() - n;
    let mut through = vec![vec![0.0; states]; n];
    for (at, (row, column)) in pattern.iter().enumerate() {
        let value = hessian[at];
        match (row.checked_sub(n), column.checked_sub(n)) {
            (None, _) => values[triangle(row, column)] += value,
            (Some(state), None) => through[column][state] += value,
            (Some(left), Some(right)) => {
                for (j, column) in columns.iter().enumerate() {
                    // Half of Uᵀ·L_uu·U: the other half comes with the transposed product below.
                    through[j][left] += 0.5 * value * column[right];
                    if left != right {
                        through[j][right] += 0.5 * value * column[left];
                    }
                }
            }
        }
    }
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for i in 0..n {
        for j in 0..=i {
            values[triangle(i, j)] += dot(&through[i], &columns[j]) + dot(&through[j], &columns[i]);
        }
    }
}

impl<M: WithStates> Model for Reduced<M> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.lifted.objective(&self.at(x)?.z)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let point = self.at(x)?;
        let mut whole = vec![0.0; point.z.len()];
        let value = self.lifted.gradient(&point.z, &mut whole)?;
        gradient.copy_from_slice(&whole[..x.len()]);
        if whole[x.len()..].iter().any(|&slope| slope != 0.0) {
            let multipliers = self.adjoint(&point, 1.0, &[])?;
            let (pattern, jacobian) = (&self.lifted.meta().jacobian, self.lifted_jacobian(&point)?);
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
        self.lifted.constraints(&self.at(x)?.z, &mut all)?;
        values.copy_from_slice(&all[..values.len()]);
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.reduced_jacobian(&*self.at(x)?, values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (point, meta) = (self.at(x)?, self.lifted.meta());
        let multipliers = self.adjoint(&point, weight, y)?;
        let all: Vec<f64> = y.iter().chain(&multipliers).copied().collect();
        let mut hessian = vec![0.0; meta.hessian.len()];
        self.lifted.hessian(&point.z, weight, &all, &mut hessian)?;
        congruence(&meta.hessian, &hessian, self.sensitivities(&point)?, values);
        Ok(())
    }

    fn own(&self) -> Own {
        self.lifted.own()
    }

    fn complete(&self, x: &mut [f64]) {
        if let Some((list, first)) = self.lifted.auxiliaries() {
            auxiliaries::complete(self, list, first, x.len(), x);
        }
    }
}
