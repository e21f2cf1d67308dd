//! The second-order tests beside one another: they prove the same in different ways.

use super::point::Point;
use super::second_order::{self, Active, SecondOrder};
use super::{Certifier, feasibility, first_order, multipliers, residuals};
use crate::model::EvaluationError;

impl Certifier<'_> {
    /// What the dense, the sparse and the component-wise second-order test say at `x`, whether it is stationary or not: the three
    /// prove the same in different ways.
    ///
    /// # Errors
    /// The model has no value or derivative at `x`.
    pub fn second_order_by_every_test(&self, x: &[f64]) -> Result<[SecondOrder; 3], EvaluationError> {
        let mut point = Point::new(&self.origin, x)?;
        let multipliers = multipliers::find(&point, None);
        let feasibility = feasibility::of(&point, self.tolerances.constraint);
        let first = first_order::of(&point, &multipliers, &feasibility, &self.tolerances);
        let (rows, bounds) = (&first.row_sides, &first.bound_sides);
        let nearly_weak = residuals::nearly_weak(&point, &multipliers, first.dual_infeasibility);
        let active = Active { rows, bounds, multipliers: &multipliers, nearly_weak };
        let hessian = self.hessian(&mut point, &multipliers)?;
        Ok(second_order::by_every_test(&point, &active, &hessian))
    }
}
