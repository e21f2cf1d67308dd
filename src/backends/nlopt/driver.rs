//! Runs the steps of a plan until the certificate passes, a budget ends, or the plan does.

use super::attempt::{End, SEED, run};
use super::form::Form;
use super::plan::{From, Plan, Step, Unit};
use super::watch::Watch;
use crate::math::split_mix::SplitMix;
use crate::model::scaled::{Scales, valid_start};
use crate::model::{EvaluationError, Evaluator, Meta, Model};

/// Runs inside a box about the best point, after a model gave no number further out.
const GUARDED_RUNS: u32 = 40;
/// Evaluations after which a plan that has proved nothing is given up, in all and for each variable.
const EFFORT: u64 = 60_000;
const EFFORT_EACH: u64 = 2_000;

/// What a plan came to.
pub(super) struct Outcome {
    /// The algorithm of the attempt that counts.
    pub algorithm: &'static str,
    /// How that attempt ended.
    pub end: End,
    /// Attempts made.
    pub attempts: u32,
}

/// Runs `plan`; the answer is in the watch.
pub(super) fn drive(plan: &Plan, evaluator: &Evaluator<'_>, watch: &mut Watch<'_, '_>) -> Option<Outcome> {
    let most = EFFORT + EFFORT_EACH * evaluator.meta().variables() as u64;
    let mut driver = Driver { evaluator, watch, attempts: 0, most };
    let mut counted: Option<(&'static str, End)> = None;
    for step in &plan.steps {
        let before = driver.watch.iterations();
        let end = driver.step(step);
        let is_final = driver.is_over(&end);
        let improved = driver.watch.iterations() > before;
        if is_final || counted.is_none() || (improved && !matches!(end, End::Invalid(_))) {
            counted = Some((step.algorithm.name, end));
        }
        if is_final {
            if driver.watch.proved().is_some() {
                driver.second_opinions(plan);
            }
            break;
        }
    }
    counted.map(|(algorithm, end)| Outcome { algorithm, end, attempts: driver.attempts })
}

struct Driver<'d, 'm, 'w, 'j> {
    evaluator: &'d Evaluator<'m>,
    watch: &'d mut Watch<'w, 'j>,
    attempts: u32,
    /// Evaluations after which a plan is given up.
    most: u64,
}

impl Driver<'_, '_, '_, '_> {
    /// Cheap looks for a better minimum than the one proved.
    fn second_opinions(&mut self, plan: &Plan) {
        for step in &plan.opinions {
            if let End::Stopped(_) = self.attempt(step, step.from, None) {
                break;
            }
        }
    }

    /// Whether nothing further should be tried.
    fn is_over(&self, end: &End) -> bool {
        if self.evaluator.evaluations() > self.most {
            return true;
        }
        let trusts_nlopt = self.watch.job().stop_test.is_none() && !self.watch.is_infeasible();
        match end {
            End::Stopped(_) => true,
            End::Invalid(_) => self.watch.proved().is_some(),
            End::Ended { code, .. } => {
                self.watch.proved().is_some()
                    || self.watch.is_unbounded()
                    || self.watch.iterations() >= self.watch.job().max_iterations
                    || (trusts_nlopt && (*code > 0 || *code == -4))
            }
        }
    }

    /// The step and its restarts, while they help.
    fn step(&mut self, step: &Step) -> End {
        let mut end = self.guarded(step, step.from);
        for _ in 0..step.restarts {
            let confirmed = self.watch.job().stop_test.is_none();
            if (self.is_over(&end) && !confirmed) || matches!(end, End::Stopped(_) | End::Invalid(_)) {
                break;
            }
            let before = self.watch.iterations();
            end = self.guarded(step, From::Best);
            if self.watch.iterations() == before {
                break;
            }
        }
        end
    }

    /// One run; where the model gave no number, more runs in a box about the best point that shrinks and grows.
    fn guarded(&mut self, step: &Step, from: From) -> End {
        let mut end = self.attempt(step, from, None);
        let mut share = 0.5;
        for _ in 0..GUARDED_RUNS {
            let escaped = matches!(end, End::Ended { .. }) && share > 1e3;
            if escaped
                || self.evaluator.evaluations() > self.most
                || self.watch.proved().is_some()
                || matches!(end, End::Stopped(_))
                || (share == 0.5 && !matches!(end, End::Invalid(_)))
            {
                break;
            }
            let next = self.attempt(step, From::Best, Some(share));
            share *= if matches!(next, End::Invalid(_)) { 0.3 } else { 4.0 };
            if share < 1e-9 {
                break;
            }
            end = next;
        }
        end
    }

    fn attempt(&mut self, step: &Step, from: From, trust: Option<f64>) -> End {
        self.attempts += 1;
        let (x, scales) = match self.starting_point(from, step.unit) {
            Ok(found) => found,
            Err(EvaluationError::Stopped(stop)) => return End::Stopped(stop),
            Err(error) => return End::Invalid(error.to_string()),
        };
        let form = Form::new(self.evaluator, scales, &x, trust);
        self.watch.begin();
        self.watch.measure(|x| form.violation_at(x));
        run(step.algorithm, &form, step.evaluations, self.evaluator, self.watch)
    }

    /// The point to start from, moved inside its bounds until the model has values there, and the scales at it.
    fn starting_point(&self, from: From, unit: Unit) -> Result<(Vec<f64>, Scales), EvaluationError> {
        let start = self.watch.job().start;
        let size = |(x, start): (&f64, &f64)| match unit {
            Unit::Magnitude => x.abs().max(start.abs()),
            Unit::One => 1.0,
        };
        valid_start(self.evaluator, &self.origin(from), |x| x.iter().zip(start).map(size).collect())
    }

    fn origin(&self, from: From) -> Vec<f64> {
        let meta = self.evaluator.meta();
        let start = || clamp(self.watch.job().start.to_vec(), meta);
        let best = || self.watch.best().map_or_else(start, |best| best.x.clone());
        match from {
            From::Start => start(),
            From::Best => best(),
            From::NearStart(share) => nudged(start(), share, meta),
            From::NearBest(share) => nudged(best(), share, meta),
        }
    }
}

fn clamp(mut x: Vec<f64>, meta: &Meta) -> Vec<f64> {
    for (j, value) in x.iter_mut().enumerate() {
        *value = value.max(meta.lower[j]).min(meta.upper[j]);
    }
    x
}

/// `x` moved by up to ±share of each variable's size, always in the same way.
fn nudged(mut x: Vec<f64>, share: f64, meta: &Meta) -> Vec<f64> {
    let mut random = SplitMix::new(u64::from(SEED));
    for (j, value) in x.iter_mut().enumerate() {
        let uniform = random.uniform();
        let room = meta.upper[j] - meta.lower[j];
        let size = if *value == 0.0 { room.min(1.0) } else { value.abs().min(room) };
        *value += share * size * (2.0 * uniform - 1.0);
    }
    clamp(x, meta)
}
