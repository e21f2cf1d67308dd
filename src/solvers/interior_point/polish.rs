//! The last digits: Newton's method on the active set the barrier has found. Active bounds and rows then hold to
//! rounding, where the barrier leaves them off by μ. Nothing is taken that is not nearer to optimal.

use super::engine::Engine;
use super::form::Form;
use super::iterate::Iterate;
use super::kkt::{Blocks, Sides};
use super::parameters::PARAMETERS;
use super::vectors::norm_max;
use crate::model::EvaluationError;

/// Newton steps at the most; factorisations on trial.
const MOST_STEPS: usize = 10;
const TRIAL_FACTORS: usize = 5;
/// Optimality errors below this are rounding.
const ROUNDING: f64 = 1e-14;
/// At which optimality error a large problem is polished on trial first, and by which factor lower each time again: where a few
/// Newton steps succeed they save the barrier's last iterations.
pub(super) const FIRST_TRIAL: f64 = 1e-5;
const NEXT_TRIAL: f64 = 0.1;
/// Factors are used again while each step leaves less than this share of the error.
const WORTHWHILE: f64 = 0.1;
/// 1/Σ of the slack of a row that is left out.
const INACTIVE_WEIGHT: f64 = 1e30;
/// Regularisation where active rows are dependent or the reduced Hessian is singular.
const REGULARISATION: f64 = 1e-9;
/// Larger multipliers look like those of dependent rows.
const LARGE_MULTIPLIER: f64 = 1e5;
/// A slack and its multiplier that are both below this do not tell which of them is zero.
const AMBIGUOUS: f64 = 1e-4;

/// Where each component of w is held: at its lower or upper bound, or not at all.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Side {
    Free,
    Lower,
    Upper,
}

/// What to do with components whose slack and multiplier are both near zero.
#[derive(Clone, Copy, PartialEq)]
enum Doubt {
    /// The larger of the two decides.
    Compare,
    /// Hold them.
    Hold,
}

/// Whether the active set is a guess, whose system may well be singular.
#[derive(Clone, Copy, PartialEq)]
enum Certainty {
    Guess,
    Final,
}

impl Engine<'_> {
    /// Replaces the iterate by a polished one where that lowers the optimality error.
    pub(super) fn polish(&mut self) -> Result<(), EvaluationError> {
        self.assess();
        let enough = if self.form.is_large() { PARAMETERS.epsilon_tol } else { ROUNDING };
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

    /// Polishes a large problem on trial, the active set being revised from step to step. `true`: the iterate is optimal.
    pub(super) fn polished_early(&mut self) -> Result<bool, EvaluationError> {
        if self.errors.largest() > self.polish_at {
            return Ok(false);
        }
        self.polish_at = NEXT_TRIAL * self.errors.largest();
        self.kkt.patient = false;
        let polished = self.newton_on_trial();
        self.kkt.patient = true;
        match polished {
            Ok(Some(polished)) => {
                self.iterate = polished;
                self.assess();
                Ok(true)
            }
            Ok(None) | Err(EvaluationError::Invalid { .. }) => Ok(false),
            Err(stopped) => Err(stopped),
        }
    }

    /// Newton steps on active sets that follow from one another, by few factorisations; the point, if it is optimal.
    fn newton_on_trial(&mut self) -> Result<Option<Iterate>, EvaluationError> {
        let mut sides = active_set(&self.form, &self.iterate, Doubt::Compare);
        let mut point = self.iterate.clone();
        let (mut factors, mut fresh, mut before) = (0, true, f64::INFINITY);
        while factors < TRIAL_FACTORS {
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
            let error = settle(&self.form, &sides, &mut point, &mut self.right);
            if error <= PARAMETERS.epsilon_tol {
                return Ok(Some(point));
            }
            // The factors serve again as long as the active set stays and they bring much.
            fresh = revise(&self.form, &mut sides, &point, &mut self.right) || error > WORTHWHILE * before;
            before = error;
        }
        Ok(None)
    }

    /// Newton steps on the active set; the best point, if it is better than the iterate.
    fn newton_on(&mut self, sides: &[Side]) -> Result<Option<Iterate>, EvaluationError> {
        let mut point = self.iterate.clone();
        let (mut best, mut least) = (None, self.errors.largest());
        hold(&self.form, sides, &mut point);
        point.evaluate(&mut self.form)?;
        for _ in 0..MOST_STEPS {
            if !self.factor_on(sides, &point, Certainty::Final)? || !self.step_on(sides, &mut point)? {
                break;
            }
            let error = settle(&self.form, sides, &mut point, &mut self.right);
            if error >= least {
                if best.is_some() {
                    break;
                }
                continue;
            }
            (least, best) = (error, Some(point.clone()));
        }
        if let Some(best) = best.as_mut().filter(|best| norm_max(&best.y) > LARGE_MULTIPLIER) {
            self.least_norm_multipliers(sides, best, least);
        }
        Ok(best)
    }

    /// Where active rows are dependent their multipliers are one choice of many and may drift: the smallest are taken,
    /// if they prove as much.
    fn least_norm_multipliers(&mut self, sides: &[Side], best: &mut Iterate, error: f64) {
        let Self { form, kkt, hessian, sigma, right, direction, .. } = self;
        let n = form.variables();
        let mut point = best.clone();
        point.y.fill(0.0);
        point.lagrangian_gradient(form, right);
        restrict(sides, n, right);
        hold_firmly(sides, n, (kkt.rigid(), 1.0), sigma);
        hessian.fill(0.0);
        let blocks = Blocks { hessian, jacobian: &point.jacobian, sigma };
        let zeros = vec![0.0; form.rows.len()];
        let sides_given = Sides { w: right, rows: &zeros };
        if kkt.factor(blocks, 0.0, REGULARISATION).is_err() || kkt.solve(sides_given, &mut direction.w, &mut direction.y).is_err()
        {
            return;
        }
        point.y.copy_from_slice(&direction.y);
        if settle(form, sides, &mut point, right) <= error.max(REGULARISATION) {
            *best = point;
        }
    }

    /// Factorises Newton's matrix on an active set, regularised where it has no factors without. `false`: there are none.
    fn factor_on(&mut self, sides: &[Side], point: &Iterate, certain: Certainty) -> Result<bool, EvaluationError> {
        let Self { form, kkt, hessian, sigma, .. } = self;
        form.hessian(&point.w, &point.y, hessian)?;
        hold_firmly(sides, form.variables(), (kkt.rigid(), 0.0), sigma);
        let blocks = Blocks { hessian, jacobian: &point.jacobian, sigma };
        let regular = certain == Certainty::Final && kkt.factor(blocks, 0.0, 0.0).is_ok_and(|inertia| inertia.zero == 0);
        Ok(regular || kkt.factor(blocks, REGULARISATION, REGULARISATION).is_ok())
    }

    /// One step of variables and multipliers with the factors found last. `false`: there is none.
    fn step_on(&mut self, sides: &[Side], point: &mut Iterate) -> Result<bool, EvaluationError> {
        let Self { form, kkt, right, direction, .. } = self;
        let n = form.variables();
        point.lagrangian_gradient(form, right);
        restrict(sides, n, right);
        let in_play = |i: usize| form.slack[i].is_none_or(|slack| sides[slack] != Side::Free);
        let rows: Vec<f64> = (0..form.rows.len()).map(|i| if in_play(i) { -point.residual[i] } else { 0.0 }).collect();
        if kkt.solve(Sides { w: right, rows: &rows }, &mut direction.w, &mut direction.y).is_err() {
            return Ok(false);
        }
        for j in (0..n).filter(|&j| sides[j] == Side::Free) {
            point.w[j] = (point.w[j] + direction.w[j]).max(form.lower[j]).min(form.upper[j]);
        }
        for i in 0..rows.len() {
            point.y[i] = if in_play(i) { point.y[i] + direction.y[i] } else { 0.0 };
        }
        point.evaluate(form)?;
        Ok(true)
    }
}

/// Which bounds are active: those whose multiplier outweighs their slack.
fn active_set(form: &Form<'_>, iterate: &Iterate, doubt: Doubt) -> Vec<Side> {
    let active = |slack: f64, z: f64| z > slack || (doubt == Doubt::Hold && slack < AMBIGUOUS && z < AMBIGUOUS);
    (0..form.size())
        .map(|j| {
            let (below, above) = (iterate.w[j] - form.lower[j], form.upper[j] - iterate.w[j]);
            match (active(below, iterate.z_lower[j]), active(above, iterate.z_upper[j])) {
                (true, false) => Side::Lower,
                (false, true) => Side::Upper,
                (true, true) if below < above => Side::Lower,
                (true, true) => Side::Upper,
                (false, false) => Side::Free,
            }
        })
        .collect()
}

/// Lets go what is held with a multiplier of the wrong sign, and holds what has run into a bound. Whether any did.
fn revise(form: &Form<'_>, sides: &mut [Side], point: &Iterate, scratch: &mut [f64]) -> bool {
    point.lagrangian_gradient(form, scratch);
    let mut changed = false;
    for (j, side) in sides.iter_mut().enumerate() {
        let revised = match *side {
            Side::Lower if scratch[j] < 0.0 => Side::Free,
            Side::Upper if scratch[j] > 0.0 => Side::Free,
            Side::Free if point.w[j] <= form.lower[j] => Side::Lower,
            Side::Free if point.w[j] >= form.upper[j] => Side::Upper,
            same => same,
        };
        changed |= revised != *side;
        *side = revised;
    }
    changed
}

/// Turns a gradient into the right-hand side of the free variables.
fn restrict(sides: &[Side], variables: usize, right: &mut [f64]) {
    for (j, side) in sides.iter().enumerate() {
        right[j] = if *side != Side::Free || j >= variables { 0.0 } else { -right[j] };
    }
}

/// Σ that holds what is not free: a held variable stays, a held slack makes its row an equality, a free one takes its row out.
/// Variables get `rigid` or `free`.
fn hold_firmly(sides: &[Side], variables: usize, (rigid, free): (f64, f64), sigma: &mut [f64]) {
    for (j, side) in sides.iter().enumerate() {
        sigma[j] = match (*side != Side::Free, j < variables) {
            (true, true) => rigid,
            (false, true) => free,
            (true, false) => f64::INFINITY,
            (false, false) => 1.0 / INACTIVE_WEIGHT,
        };
    }
}

/// Puts held components onto their bounds.
fn hold(form: &Form<'_>, sides: &[Side], point: &mut Iterate) {
    for (j, side) in sides.iter().enumerate() {
        match side {
            Side::Lower => point.w[j] = form.lower[j],
            Side::Upper => point.w[j] = form.upper[j],
            Side::Free => {}
        }
    }
}

/// Free slacks at their rows' values, bound multipliers from stationarity; the optimality error of the result.
fn settle(form: &Form<'_>, sides: &[Side], point: &mut Iterate, scratch: &mut [f64]) -> f64 {
    for (slack, row) in form.slack.iter().zip(&point.rows) {
        if let Some(slack) = slack.filter(|&slack| sides[slack] == Side::Free) {
            point.w[slack] = row.max(form.lower[slack]).min(form.upper[slack]);
        }
    }
    form.residual(&point.w, &point.rows, &mut point.residual);
    point.lagrangian_gradient(form, scratch);
    for (j, side) in sides.iter().enumerate() {
        point.z_lower[j] = if *side == Side::Lower { scratch[j].max(0.0) } else { 0.0 };
        point.z_upper[j] = if *side == Side::Upper { (-scratch[j]).max(0.0) } else { 0.0 };
    }
    point.errors(form, 0.0, scratch).largest()
}
