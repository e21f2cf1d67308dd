//! Which of several certified points is shown, and which stand.

use super::*;

#[test]
fn of_minima_that_agree_the_most_exact_is_shown() {
    // x ≥ 1 violated by 4e-9, which is tolerated, is lower, and no better for it.
    let model = Sample::new(&[2.0], |x| x[0]).row(1.0, INF, |x| x[0] * x[0]);
    let found = outcome(&model, &[&Script::new("one", &[&[1.0 - 2e-9]]), &Script::new("two", &[&[1.0]])]);
    assert_eq!((found.status, found.best, found.objective), (Status::Certified, Some(1), Some(1.0)));
    assert!(found.agreement.unwrap().agree);
}

#[test]
fn of_two_minima_of_a_convex_problem_the_higher_is_none() {
    // At y = 1 a slope of 1e-7 over the size is accepted, and the parabola leaves no straight way to y = 1e6, 0.1 lower.
    let model = Sample::new(&[1.0, 1.0, 1.0], |x| x[0] + (x[0] - 1.0).powi(2) - x[1] * 1e-7);
    let model = model.bounds(&[1.0, 0.0, 0.0], &[2.0, 1e6, 1e9]).row(-INF, 0.0, |x| (x[1] - 1.0).powi(2) * 1e-6 - x[2]);
    let near = || Script::new("near", &[&[1.0, 1.0, 0.0]]);
    let alone = judged(&model, Class::Convex, &Settings::default(), &[&near()], None);
    assert_eq!((alone.status, alone.objective), (Status::Certified, Some(0.9999999)));
    let far = Script::new("far", &[&[1.0, 1e6, 2e6]]);
    let found = judged(&model, Class::Convex, &Settings::default(), &[&near(), &far], None);
    one_verdict(&found);
    assert_eq!((found.status, found.best), (Status::Certified, Some(1)));
    assert!(!found.answers[0].is_certified());
}

#[test]
fn a_point_far_out_is_no_global_minimum_above_a_nearer_one() {
    // Beside variables of 1e20 that cancel to 6e10, the slope of e^(−62) is nothing.
    let model = Sample::new(&[1.0, 1.0], |x| ((x[0] + x[1]) * 1e-9).exp());
    let far = Script::new("far", &[&[7.5e19, -7.5e19 - 6.2e10]]);
    let nearer = Script::new("nearer", &[&[0.0, -1.5e11]]);
    let found = judged(&model, Class::Convex, &Settings::default(), &[&far, &nearer], None);
    one_verdict(&found);
    assert!(!matches!(found.status, Status::Certified), "{found:#?}");
    let (own, beaten) = (&found.answers[1], &found.answers[0]);
    assert!(own.objective < beaten.objective && !beaten.is_certified());
}
