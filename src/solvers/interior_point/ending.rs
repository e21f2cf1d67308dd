//! Why the iterations end, and the tests that say so.

use super::parameters::PARAMETERS;
use super::state::State;

/// Why the iterations ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ending {
    /// The optimality error is down to rounding.
    Optimal,
    /// No more progress, but close.
    Acceptable,
    /// A local minimum of the violation, not zero.
    Infeasible,
    /// Objective or variables go to infinity.
    Diverging(String),
    /// No way on was found.
    Stuck(String),
    /// Second derivatives are no numbers at an iterate.
    Invalid(String),
}

impl Ending {
    /// Whether the run ended at a minimum.
    pub fn is_solved(&self) -> bool {
        matches!(self, Ending::Optimal | Ending::Acceptable)
    }

    /// The ending called for at the current iterate, if any is.
    pub fn called_for(state: &State<'_>) -> Option<Ending> {
        let State { form, iterate, errors, best, .. } = state;
        let idle = state.idle_iterations();
        if errors.largest() <= PARAMETERS.epsilon_tol || Ending::is_rounding(state) {
            return Some(Ending::Optimal);
        }
        if best.error <= PARAMETERS.epsilon_acceptable && idle > PARAMETERS.patience_near {
            return Some(Ending::Acceptable);
        }
        if iterate.objective < -PARAMETERS.diverging && errors.primal < PARAMETERS.diverging_feasible {
            let value = iterate.objective / form.objective_scale;
            return Some(Ending::Diverging(format!("the objective falls below {value:.1e} and on; it diverges")));
        }
        if let Some(j) = (0..form.variables()).find(|&j| iterate.w[j].abs() > PARAMETERS.diverging) {
            let name = form.model.variable_name(form.free[j]);
            return Some(Ending::Diverging(format!("{name} grows beyond all bounds; the iterates diverge")));
        }
        (idle > PARAMETERS.patience_far).then(|| Ending::Stuck(format!("no progress in {} iterations", PARAMETERS.patience_far)))
    }

    /// Whether all that is left of the optimality error is rounding of the dual one.
    fn is_rounding(State { form, iterate, errors, .. }: &State<'_>) -> bool {
        let is_near =
            errors.primal.max(errors.complementarity) <= PARAMETERS.epsilon_tol && errors.dual <= PARAMETERS.epsilon_acceptable;
        is_near && errors.dual <= iterate.dual_rounding(form)
    }

    /// The ending where nothing moves any more.
    pub fn of_progress(state: &State<'_>, why: &str) -> Ending {
        if state.best.error <= PARAMETERS.epsilon_acceptable { Ending::Acceptable } else { Ending::Stuck(why.into()) }
    }
}
