//! Limits on single displacements as bounds.
//!
//! A row that is linear in one state and holds nothing else limits that state alone: a solver that keeps bounds by themselves needs neither
//! a slack nor an equation for it.

use crate::model::{Evaluation, EvaluationError, Meta, Model};

/// A model whose states have bounds in place of the rows that limit one of them each. Rows keep their numbers, those without their limits.
pub struct BoundedStates<'a> {
    model: &'a dyn Model,
    meta: Meta,
    moved: Vec<SingleState>,
}

/// c_row = slope·x_state + constant
#[derive(Debug, Clone, Copy)]
struct SingleState {
    row: usize,
    state: usize,
    slope: f64,
    constant: f64,
}

impl SingleState {
    /// The bounds of the state that are the row's limits.
    fn bounds(self, meta: &Meta) -> [f64; 2] {
        let [a, b] = [meta.row_lower[self.row], meta.row_upper[self.row]].map(|limit| (limit - self.constant) / self.slope);
        if self.slope > 0.0 { [a, b] } else { [b, a] }
    }
}

impl<'a> BoundedStates<'a> {
    /// The view of a model that is solved from x. `None` where no row is of that kind, and where x does not meet the limits: what keeps bounds
    /// would begin elsewhere, at states that no design has (the ten-bar truss, far too slender at its start, came to another minimum so).
    pub fn of(model: &'a dyn Model, x: &[f64]) -> Option<Self> {
        let moved = rows_of_single_states(model, x);
        // Most models have none, and patterns are large.
        if moved.is_empty() {
            return None;
        }
        let mut meta = model.meta().clone();
        for single in &moved {
            let ([lower, upper], j) = (single.bounds(&meta), single.state);
            (meta.lower[j], meta.upper[j]) = (meta.lower[j].max(lower), meta.upper[j].min(upper));
        }
        for single in &moved {
            (meta.row_lower[single.row], meta.row_upper[single.row]) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        let is_inside =
            |single: &SingleState| meta.lower[single.state] < x[single.state] && x[single.state] < meta.upper[single.state];
        moved.iter().all(is_inside).then_some(BoundedStates { model, meta, moved })
    }

    /// The model's row multipliers at x from those of this view: what ∇f + Jᵀy leaves of a state's bound is its row's.
    pub fn multipliers(&self, x: &[f64], mut y: Vec<f64>) -> Vec<f64> {
        let meta = self.model.meta();
        let (mut left, mut jacobian) = (vec![0.0; meta.variables()], vec![0.0; meta.jacobian.len()]);
        if self.gradient(x, &mut left).and_then(|_| self.jacobian(x, &mut jacobian)).is_err() {
            return y;
        }
        meta.jacobian.add_transposed(&jacobian, &y, &mut left);
        for single in &self.moved {
            let ([lower, upper], j) = (single.bounds(meta), single.state);
            // Of several rows, the one the bound is from.
            let is_pushed = if left[j] < 0.0 { upper == self.meta.upper[j] } else { lower == self.meta.lower[j] };
            if is_pushed {
                y[single.row] = -left[j] / single.slope;
                left[j] = 0.0;
            }
        }
        y
    }
}

/// Empty where the model has no states, or no values at x.
fn rows_of_single_states(model: &dyn Model, x: &[f64]) -> Vec<SingleState> {
    let meta = model.meta();
    let Some(states) = meta.states else { return Vec::new() };
    let only = |row: usize| meta.jacobian.range(row).len() == 1 && meta.is_row_linear(row);
    let candidates: Vec<usize> =
        (0..states.first_row).filter(|&row| only(row) && states.has(meta.jacobian.row(row)[0] as usize)).collect();
    let (mut rows, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
    if candidates.is_empty() || model.constraints(x, &mut rows).and_then(|()| model.jacobian(x, &mut jacobian)).is_err() {
        return Vec::new();
    }
    let single = |row: usize| {
        let (at, state) = (meta.jacobian.range(row).start, meta.jacobian.row(row)[0] as usize);
        let slope = jacobian[at];
        SingleState { row, state, slope, constant: rows[row] - slope * x[state] }
    };
    candidates.into_iter().map(single).filter(|single| single.slope != 0.0).collect()
}

impl Model for BoundedStates<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        self.model.at(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::closures::{Closures, Function};
    use crate::model::states::States;

    /// Minimises x where x + u = 1 states u.
    struct Lifted {
        model: Closures,
        meta: Meta,
    }

    impl Lifted {
        /// With rows lower ≤ 1 − 2u ≤ upper.
        fn limited(limits: &[[f64; 2]]) -> Lifted {
            let model =
                Closures::new(&["x", "u"], &[1.0, 0.0], &[-9.0; 2], &[9.0; 2]).minimise(Function::affine(0.0, &[(0, 1.0)]));
            let add = |model: Closures, [lower, upper]: &[f64; 2]| {
                model.row("limit", *lower, *upper, Function::affine(1.0, &[(1, -2.0)]))
            };
            let model = limits.iter().fold(model, add).row("state", 1.0, 1.0, Function::affine(0.0, &[(0, 1.0), (1, 1.0)]));
            let states = States { first_variable: 1, first_row: limits.len(), block: 1, blocks: 1, are_bounded: true };
            Lifted { meta: Meta { states: Some(states), ..model.meta().clone() }, model }
        }
    }

    impl Model for Lifted {
        fn meta(&self) -> &Meta {
            &self.meta
        }

        fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
            self.model.at(x)
        }
    }

    #[test]
    fn limits_of_one_state_are_its_bounds_and_their_multipliers_are_found_again() {
        let model = Lifted::limited(&[[-5.0, 9.0], [-3.0, 2.0]]);
        let view = BoundedStates::of(&model, &[1.0, 0.0]).unwrap();
        assert_eq!((view.meta().lower[1], view.meta().upper[1]), (-0.5, 2.0));
        assert_eq!((view.meta().row_lower[1], view.meta().row_upper[0]), (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!(view.meta().row_upper[2], 1.0, "the state's own equation stays");
        // x falls until u = 2, where the second row is at its lower limit: ∇f + Jᵀy = 0 there.
        assert_eq!(view.multipliers(&[-1.0, 2.0], vec![0.0, 0.0, -1.0]), [0.0, -0.5, -1.0]);
        // Within the bounds nothing pushes.
        assert_eq!(view.multipliers(&[0.0, 1.0], vec![0.0; 3]), [0.0; 3]);
    }

    #[test]
    fn nothing_is_changed_where_the_start_is_beyond_a_limit_or_no_row_is_of_a_state() {
        assert!(BoundedStates::of(&Lifted::limited(&[[-3.0, 2.0], [2.0, 9.0]]), &[1.0, 0.0]).is_none(), "u ≤ −½ ≤ u");
        assert!(BoundedStates::of(&Lifted::limited(&[[-3.0, 2.0]]), &[-2.0, 3.0]).is_none(), "u = 3 > 2");
        assert!(BoundedStates::of(&Lifted::limited(&[]), &[1.0, 0.0]).is_none());
        let design_alone = Lifted::limited(&[[-3.0, 2.0]]).model;
        assert!(BoundedStates::of(&design_alone, &[1.0, 0.0]).is_none());
    }
}
