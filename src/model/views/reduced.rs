//! Any model with states, seen in its design variables alone: states are solved for, derivatives go through the adjoint.
//!
//! With R(x, u) = 0 linear in u, K = ∂R/∂u symmetric and the same in every block: u = K⁻¹(…), U = du/dx = −K⁻¹·R_x,
//! λ = −K⁻¹·(w·f_u + c_uᵀy), and the Hessian of the Lagrangian is L_xx + L_xu·U + (L_xu·U)ᵀ + Uᵀ·L_uu·U at L = w·f + yᵀc + λᵀR
//! (Haftka and Gürdal, *Elements of Structural Optimization*, ch. 7).

mod at_point;
mod patterns;

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::model::states::States;
use crate::model::stiffness::Factors;
use crate::model::with_states::WithStates;
use crate::model::{Evaluation, EvaluationError, Meta, Model, Own, Pattern, auxiliaries};
use at_point::AtPoint;
use patterns::{dense_lower, jacobian_pattern, knows_no_state};

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
        Ok(self.analysed(x)?.z.clone())
    }

    /// States are solved for once per design, whichever way it is asked about: drivers that ask for values and slopes one by one find the
    /// last analysis again.
    fn analysed(&self, x: &[f64]) -> Result<Arc<Analysed>, EvaluationError> {
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
}

impl<M: WithStates> Model for Reduced<M> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        let point = self.analysed(x)?;
        let lifted = self.lifted.at(&point.z)?;
        Ok(Box::new(AtPoint { view: self, point, lifted }))
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
