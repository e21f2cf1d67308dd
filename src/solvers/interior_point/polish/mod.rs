//! The last digits: Newton's method on the active set the barrier has found. Active bounds and rows then hold to
//! rounding, where the barrier leaves them off by μ. Nothing is taken that is not nearer to optimal.

mod active_set;

use super::iterate::Iterate;
use super::kkt::{Blocks, RightHandSide};
use super::parameters::PARAMETERS;
use super::state::{State, Workspace};
use super::vectors::norm_max;
use crate::math::within;
use crate::model::EvaluationError;
use crate::solvers::barrier::BoundState;
use active_set::{Doubt, active_set, hold, hold_firmly, restrict, revise, settle};

/// Whether the active set is a guess, whose system may well be singular.
#[derive(Clone, Copy, PartialEq)]
enum Certainty {
    Guess,
    Final,
}

/// When a large problem is polished on trial.
pub(super) struct TrialPolish {
    /// The optimality error at which it is tried next.
    at: f64,
}

impl TrialPolish {
    /// For a large problem, or not for any.
    pub fn new(is_large: bool) -> Self {
        TrialPolish { at: if is_large { PARAMETERS.polish.first_trial } else { 0.0 } }
    }

    /// Polishes on trial, the active set being revised from step to step. `true`: the iterate is optimal.
    pub fn succeeds(&mut self, state: &mut State<'_>) -> Result<bool, EvaluationError> {
        if state.errors.largest() > self.at {
            return Ok(false);
        }
        self.at = PARAMETERS.polish.next_trial * state.errors.largest();
        state.kkt.patient = false;
        let polished = state.newton_on_trial();
        state.kkt.patient = true;
        match polished {
            Ok(Some(polished)) => {
                state.iterate = polished;
                state.assess();
                Ok(true)
            }
            Ok(None) | Err(EvaluationError::Invalid { .. }) => Ok(false),
            Err(stopped) => Err(stopped),
        }
    }
}

impl State<'_> {
    /// Replaces the iterate by a polished one where that lowers the optimality error.
    pub(super) fn polish(&mut self) -> Result<(), EvaluationError> {
        self.assess();
        let enough = if self.form.is_large() { PARAMETERS.epsilon_tol } else { PARAMETERS.polish.rounding };
        if self.errors.largest() <= enough {
            return Ok(());
        }
        for doubt in [Doubt::Compare, Doubt::Hold] {
            let sides = active_set(&self.form, &self.iterate, doubt);
            let polished = match self.newton_on(&sides) {
                Ok(polished) => polished,
                Err(EvaluationError::Invalid { .. }) => continue,
                Err(stopped) => return Err(stopped),
            };
            if let Some(polished) = polished {
                self.iterate = polished;
                self.assess();
                return Ok(());
            }
        }
        Ok(())
    }

    /// Newton steps on active sets that follow from one another, by few factorisations; the point, if it is optimal.
    fn newton_on_trial(&mut self) -> Result<Option<Iterate>, EvaluationError> {
        let mut sides = active_set(&self.form, &self.iterate, Doubt::Compare);
        let mut point = self.iterate.clone();
        let (mut factors, mut fresh, mut before) = (0, true, f64::INFINITY);
        while factors < PARAMETERS.polish.trial_factors {
            if fresh {
                factors += 1;
                hold(&self.form, &sides, &mut point);
                point.evaluate(&mut self.form)?;
                if !self.factor_on(&sides, &point, Certainty::Guess)? {
                    return Ok(None);
                }
            }
            if !self.step_on(&sides, &mut point)? {
                return Ok(None);
            }
            let error = settle(&self.form, &sides, &mut point, &mut self.work.right);
            if error <= PARAMETERS.epsilon_tol {
                return Ok(Some(point));
            }
            // As far from optimal as any point: the set has nothing to do with the optimum's.
            if error > 1.0 {
                return Ok(None);
            }
            // The factors serve again as long as the active set stays and they bring much.
            fresh = revise(&self.form, &mut sides, &point, &mut self.work.right) || error > PARAMETERS.polish.worthwhile * before;
            before = error;
        }
        Ok(None)
    }

    /// Newton steps on the active set; the best point, if it is better than the iterate.
    fn newton_on(&mut self, sides: &[BoundState]) -> Result<Option<Iterate>, EvaluationError> {
        let mut point = self.iterate.clone();
        let (mut best, mut least, mut before) = (None, self.errors.largest(), f64::INFINITY);
        hold(&self.form, sides, &mut point);
        point.evaluate(&mut self.form)?;
        for _ in 0..PARAMETERS.polish.most_steps {
            if !self.factor_on(sides, &point, Certainty::Final)? || !self.step_on(sides, &mut point)? {
                break;
            }
            let error = settle(&self.form, sides, &mut point, &mut self.work.right);
            if error >= least {
                // On the right active set Newton's steps contract.
                if best.is_some() || error >= before {
                    break;
                }
                before = error;
                continue;
            }
            (least, best) = (error, Some(point.clone()));
        }
        if let Some(best) = best.as_mut().filter(|best| norm_max(&best.y) > PARAMETERS.polish.large_multiplier) {
            self.least_norm_multipliers(sides, best, least);
        }
        Ok(best)
    }

    /// Where active rows are dependent their multipliers are one choice of many and may drift: the smallest are taken,
    /// if they prove as much.
    fn least_norm_multipliers(&mut self, sides: &[BoundState], best: &mut Iterate, error: f64) {
        let Self { form, kkt, work: Workspace { hessian, sigma, right, .. }, direction, .. } = self;
        let n = form.variables();
        let mut point = best.clone();
        point.y.fill(0.0);
        point.lagrangian_gradient(form, right);
        restrict(sides, n, right);
        hold_firmly(sides, n, (kkt.rigid(), 1.0), sigma);
        hessian.fill(0.0);
        let blocks = Blocks { hessian, jacobian: &point.jacobian, sigma };
        let zeros = vec![0.0; form.rows.len()];
        let sides_given = RightHandSide { w: right, rows: &zeros };
        if kkt.factor(blocks, 0.0, PARAMETERS.polish.regularisation).is_err()
            || kkt.solve(sides_given, &mut direction.w, &mut direction.y).is_err()
        {
            return;
        }
        point.y.copy_from_slice(&direction.y);
        if settle(form, sides, &mut point, right) <= error.max(PARAMETERS.polish.regularisation) {
            *best = point;
        }
    }

    /// Factorises Newton's matrix on an active set, regularised where it has no factors without. `false`: there are none.
    fn factor_on(&mut self, sides: &[BoundState], point: &Iterate, certain: Certainty) -> Result<bool, EvaluationError> {
        let Self { form, kkt, work: Workspace { hessian, sigma, .. }, .. } = self;
        form.hessian(&point.w, &point.y, hessian)?;
        hold_firmly(sides, form.variables(), (kkt.rigid(), 0.0), sigma);
        let blocks = Blocks { hessian, jacobian: &point.jacobian, sigma };
        let regular = certain == Certainty::Final && kkt.factor(blocks, 0.0, 0.0).is_ok_and(|inertia| inertia.zero == 0);
        Ok(regular || kkt.factor(blocks, PARAMETERS.polish.regularisation, PARAMETERS.polish.regularisation).is_ok())
    }

    /// One step of variables and multipliers with the factors found last. `false`: there is none.
    fn step_on(&mut self, sides: &[BoundState], point: &mut Iterate) -> Result<bool, EvaluationError> {
        let Self { form, kkt, work: Workspace { right, .. }, direction, .. } = self;
        let n = form.variables();
        point.lagrangian_gradient(form, right);
        restrict(sides, n, right);
        let in_play = |i: usize| form.slack[i].is_none_or(|slack| sides[slack] != BoundState::Free);
        let rows: Vec<f64> = (0..form.rows.len()).map(|i| if in_play(i) { -point.residual[i] } else { 0.0 }).collect();
        if kkt.solve(RightHandSide { w: right, rows: &rows }, &mut direction.w, &mut direction.y).is_err() {
            return Ok(false);
        }
        for j in (0..n).filter(|&j| sides[j] == BoundState::Free) {
            point.w[j] = within(point.w[j] + direction.w[j], form.lower[j], form.upper[j]);
        }
        for i in 0..rows.len() {
            point.y[i] = if in_play(i) { point.y[i] + direction.y[i] } else { 0.0 };
        }
        point.evaluate(form)?;
        Ok(true)
    }
}
