//! The verdict without numerics: backends that bring what a script says, and what is made of it.

mod comparisons;

use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use num_dual::DualNum;

use super::*;
use crate::backends::argmin::Argmin;
use crate::backends::{Job, Solution};
use crate::model::sample::{Sample, Value};
use crate::model::{Class, Model, Substitution};
use crate::problem::Settings;

const INF: f64 = f64::INFINITY;

/// Brings the points of its script in turn, afterwards the start it is given; helper models always that.
struct Script {
    name: &'static str,
    variables: usize,
    /// Evaluations it claims for each run.
    evaluations: u64,
    cost: f64,
    points: Mutex<VecDeque<(Vec<f64>, Termination)>>,
    runs: Mutex<usize>,
}

impl Script {
    fn new(name: &'static str, points: &[&[f64]]) -> Self {
        let all: VecDeque<_> = points.iter().map(|point| (point.to_vec(), Termination::Converged)).collect();
        let variables = all.front().map_or(0, |(point, _)| point.len());
        Script { name, variables, evaluations: 10, cost: 1.0, points: Mutex::new(all), runs: Mutex::new(0) }
    }

    fn ending(self, termination: Termination) -> Self {
        self.points.lock().unwrap().iter_mut().for_each(|(_, ending)| *ending = termination);
        self
    }

    fn runs(&self) -> usize {
        *self.runs.lock().unwrap()
    }
}

impl Backend for Script {
    fn name(&self) -> &'static str {
        self.name
    }

    fn algorithms(&self) -> &'static [&'static str] {
        &[]
    }

    fn refusal(&self, _algorithm: &str, _model: &dyn Model) -> Option<String> {
        None
    }

    fn work_per_evaluation(&self, _model: &dyn Model) -> f64 {
        self.cost
    }

    fn solve(&self, model: &dyn Model, job: &mut Job<'_>) -> Solution {
        let own = model.meta().variables() == self.variables;
        *self.runs.lock().unwrap() += usize::from(own);
        let next = if own { self.points.lock().unwrap().pop_front() } else { None };
        let (x, termination) = next.unwrap_or_else(|| (job.start.to_vec(), Termination::Failed));
        Solution {
            algorithm: "script".into(),
            termination,
            message: "as the script says".into(),
            x,
            multipliers: None,
            iterations: Some(1),
            evaluations: self.evaluations,
            seconds: 0.0,
            invalid: None,
        }
    }
}

fn judged(
    model: &Sample,
    class: Class,
    settings: &Settings,
    backends: &[&dyn Backend],
    interrupt: Option<&AtomicBool>,
) -> Outcome {
    judged_with((model, None), class, settings, backends, interrupt)
}

fn judged_with(
    (model, substitution): (&Sample, Option<&dyn Substitution>),
    class: Class,
    settings: &Settings,
    backends: &[&dyn Backend],
    interrupt: Option<&AtomicBool>,
) -> Outcome {
    let task =
        Task { model, substitution, class, settings, start: &model.meta().start, start_multipliers: None, starts: 0, interrupt };
    let backends: Vec<(&dyn Backend, &str)> = backends.iter().map(|&backend| (backend, "auto")).collect();
    run(&task, &backends, &mut |_, _| Box::new(|_| {}))
}

fn outcome(model: &Sample, backends: &[&dyn Backend]) -> Outcome {
    let outcome = judged(model, Class::Nonlinear, &Settings::default(), backends, None);
    one_verdict(&outcome);
    outcome
}

/// Status, exit code, certificates and the point shown never contradict one another.
fn one_verdict(outcome: &Outcome) {
    let passed = outcome.answers.iter().any(|answer| answer.is_certified());
    match outcome.status {
        Status::Certified => {
            assert!(passed && outcome.exit_code() == 0, "{outcome:#?}");
            let best = &outcome.answers[outcome.best.unwrap()];
            assert!(best.is_certified() && best.solution.x == outcome.x && best.objective == outcome.objective);
        }
        Status::Uncertified => assert!(!passed && outcome.exit_code() == 1, "{outcome:#?}"),
        _ => {}
    }
}

/// (x² − 1)² + x/4 on [−3, 3]: minima near ±1, the left one lower.
fn two_wells() -> Sample {
    Sample::new(&[0.5], |x| (x[0] * x[0] - 1.0).powi(2) + x[0] * 0.25).bound(0, -3.0, 3.0)
}

/// Newton's method from x on the derivative of `two_wells`.
fn bottom(mut x: f64) -> f64 {
    for _ in 0..60 {
        x -= (4.0 * x * (x * x - 1.0) + 0.25) / (12.0 * x * x - 4.0);
    }
    x
}

#[test]
fn equal_minima_agree() {
    let right = bottom(1.0);
    let found = outcome(&two_wells(), &[&Script::new("one", &[&[right]]), &Script::new("two", &[&[right]])]);
    assert_eq!((found.status, found.exit_code()), (Status::Certified, 0));
    assert!(found.agreement.unwrap().agree);
}

#[test]
fn the_lower_of_two_minima_is_shown_and_they_do_not_agree() {
    let (left, right) = (bottom(-1.0), bottom(1.0));
    let found = outcome(&two_wells(), &[&Script::new("one", &[&[right]]), &Script::new("two", &[&[left]])]);
    assert_eq!((found.status, found.best), (Status::Certified, Some(1)));
    assert!(!found.agreement.unwrap().agree);
}

#[test]
fn a_minimum_above_a_feasible_point_is_not_the_answer() {
    let (one, two) = (Script::new("one", &[&[bottom(1.0)], &[bottom(1.0)]]), Script::new("two", &[&[-0.9]]));
    let found = outcome(&two_wells(), &[&one, &two]);
    assert_eq!((found.status, found.x.as_slice()), (Status::Uncertified, [-0.9].as_slice()));
    assert!(found.answers[0].remarks.iter().any(|remark| remark.contains("above a feasible point of two")), "{found:#?}");
}

#[test]
fn where_the_run_from_the_better_point_ends_in_a_minimum_that_is_the_answer() {
    let (left, right) = (bottom(-1.0), bottom(1.0));
    // Three runs of the probe come between.
    let one = Script::new("one", &[&[right], &[right], &[right], &[right], &[left]]);
    let found = outcome(&two_wells(), &[&one, &Script::new("two", &[&[-0.9]])]);
    assert_eq!((found.status, found.best), (Status::Certified, Some(0)));
    assert!((found.x[0] - left).abs() < 1e-12 && found.answers[0].attempt == 5, "{found:#?}");
}

#[test]
fn a_difference_of_rounding_is_none() {
    // The uncertified point is lower by less than rounding.
    let model = Sample::new(&[2.0], |x| (x[0] - 1.0).powi(2) + 3.0);
    let found = outcome(&model, &[&Script::new("one", &[&[1.0 + 1e-9]]), &Script::new("two", &[&[1.0 + 3e-6]])]);
    assert_eq!(found.status, Status::Certified);
}

#[test]
fn an_objective_bought_by_a_violation_is_not_lower() {
    // 1000 + x ≥ 1000.5: 5e-6 below is within the tolerance of the row, and beyond the agreement of the objective.
    let model =
        Sample::new(&[0.7], |x| x[0]).bound(0, -9.0, 9.0).row(1000.5, INF, |x| x[0] + 1000.0).row(-INF, 1.0, |x| x[0] * x[0]);
    let bought = Script::new("two", &[&[0.5 - 5e-6]]);
    let found = outcome(&model, &[&Script::new("one", &[&[0.5]]), &bought]);
    assert!(found.status == Status::Certified && !found.better_point_elsewhere, "{found:#?}");
}

#[test]
fn the_best_point_is_shown_where_it_has_no_derivative() {
    let model = Sample::new(&[3.0, 4.0], |x: &[Value]| (x[0] * x[0] + x[1] * x[1]).sqrt());
    let found = outcome(&model, &[&Script::new("one", &[&[0.03, 0.04]]), &Script::new("two", &[&[0.0, 0.0]])]);
    assert_eq!((found.status, found.x.as_slice(), found.objective), (Status::Uncertified, [0.0, 0.0].as_slice(), Some(0.0)));
    assert_eq!(found.best, Some(1));
}

#[test]
fn a_share_that_ended_is_no_limit_of_the_users() {
    let cut = |name| Script::new(name, &[&[0.3]]).ending(Termination::LimitReached);
    let found = outcome(&two_wells(), &[&cut("one"), &cut("two")]);
    assert_eq!(found.status, Status::Uncertified);
    assert!(!found.message.contains("limit"), "{}", found.message);
    let settings = Settings { max_evaluations: 10, ..Settings::default() };
    let found = judged(&two_wells(), Class::Nonlinear, &settings, &[&cut("one"), &cut("two")], None);
    assert_eq!((found.status, found.exit_code()), (Status::LimitReached, 5));
}

#[test]
fn an_interrupted_run_says_so() {
    let flag = AtomicBool::new(true);
    let one = Script::new("one", &[&[bottom(1.0)]]);
    let found = judged(&two_wells(), Class::Nonlinear, &Settings::default(), &[&one], Some(&flag));
    assert_eq!((found.status, found.exit_code()), (Status::Interrupted, 5));
}

#[test]
fn no_values_anywhere_are_an_invalid_value() {
    let model = Sample::new(&[2.0], |x: &[Value]| x[0].ln());
    let one = Script::new("one", &[&[-1.0]]);
    let found = judged(&model.bound(0, -2.0, 5.0), Class::Nonlinear, &Settings::default(), &[&one], None);
    assert_ne!(found.status, Status::Certified);
    one_verdict(&found);
}

#[test]
fn after_a_global_proof_a_dear_backend_is_not_run() {
    let model = Sample::new(&[2.0], |x| (x[0] - 1.0).powi(2));
    let (dear, cheap) = (Script { cost: 1e9, ..Script::new("dear", &[&[0.0]]) }, Script::new("cheap", &[&[1.0]]));
    let found = judged(&model, Class::Convex, &Settings::default(), &[&dear, &cheap], None);
    assert_eq!((found.status, found.best, dear.runs(), cheap.runs()), (Status::Certified, Some(1), 0, 1));
    assert!(found.answers[0].solution.message.contains("not run"));
}

#[test]
fn a_backend_that_stays_where_it_is_is_not_started_for_ever() {
    // Never certified, always the same point.
    let points: Vec<&[f64]> = vec![&[0.3]; 40];
    let one = Script::new("one", &points);
    let found = outcome(&two_wells(), &[&one]);
    assert_eq!(found.status, Status::Uncertified);
    assert!(one.runs() <= 6, "{}", one.runs());
}

#[test]
fn a_proof_of_infeasibility_stands_against_a_point_far_away() {
    let model =
        Sample::new(&[1.0, 1.0], |x| x[0] * x[0] + x[1] * x[1])
            .row(4.0, 4.0, |x| x[0] * 2.0 + x[1] * 2.0)
            .row(9.0, 9.0, |x| x[0] * 2.0 + x[1] * 2.0);
    let away = Script { variables: 2, ..Script::new("away", &[&[1e16, -1e16]]) };
    let found = judged(&model, Class::Convex, &Settings::default(), &[&away, &Argmin], None);
    assert_eq!((found.status, found.scope, found.exit_code()), (Status::Infeasible, crate::certificate::Extent::Global, 3));
    assert_eq!(found.conflict.unwrap().rows, [0, 1]);
}

/// The same variables: rows that have values where those of the judged model have none.
struct Valued(Sample);

impl Substitution for Valued {
    fn model(&self) -> &dyn Model {
        &self.0
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        x.to_vec()
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        z.to_vec()
    }
}

#[test]
fn limits_without_a_value_are_not_called_infeasible() {
    let nowhere = Sample::new(&[2.0], |x| x[0] * x[0]).row(-INF, 1.0, |x| x[0] * f64::NAN);
    let valued = Valued(Sample::new(&[2.0], |x| x[0] * x[0]).row(-INF, 1.0, |x| x[0] * 1.0));
    let found = judged_with((&nowhere, Some(&valued)), Class::Nonlinear, &Settings::default(), &[&Argmin], None);
    assert!(!matches!(found.status, Status::Infeasible | Status::Certified), "{found:#?}");
}
