//! What the reports of one made-up run look like, and that they hold what they promise.

use super::*;
use crate::backends::{Solution, Termination};
use crate::certificate::{Certificate, Extent};
use crate::crosscheck::{Agreement, Answer, Conflict, LimitMove, Status};
use crate::model::Limit as AnyLimit;
use crate::model::sample::Sample;

fn model() -> Sample {
    Sample::new(&[1.0, 0.2], |x| x[0] + x[1] * 2.0)
        .bounds(&[0.5, 0.1], &[f64::INFINITY, 0.7])
        .row(0.35, f64::INFINITY, |x| x[0] * x[1])
}

fn about(sense: Sense) -> About {
    About {
        title: "Two numbers".into(),
        file: "two.toml".into(),
        sha256: "00".into(),
        sense,
        objective: "volume".into(),
        units: vec![("length".into(), "m".into())],
        has_sections: true,
        has_structure: false,
        checks: Vec::new(),
        warnings: Vec::new(),
        chosen: Vec::new(),
        changes: Vec::new(),
        ..About::default()
    }
}

fn certificate() -> Certificate {
    Certificate {
        certified: true,
        objective: 1.9,
        row_values: vec![0.35],
        primal_infeasibility: 1e-12,
        dual_infeasibility: 2e-9,
        row_multipliers: vec![-2.0],
        bound_multipliers: vec![0.0, 1.0],
        row_sides: vec![Side::Lower],
        bound_sides: vec![Side::Lower, Side::Upper],
        ..Certificate::default()
    }
}

fn outcome() -> Outcome {
    let solution = Solution {
        algorithm: "interior-point".into(),
        termination: Termination::Converged,
        message: "no further progress".into(),
        x: vec![0.5, 0.7],
        multipliers: None,
        iterations: Some(9),
        evaluations: 12,
        seconds: 0.25,
        invalid: None,
    };
    let answer = Answer {
        backend: "argmin",
        solution,
        objective: Some(1.9),
        certificate: Some(certificate()),
        feasible: true,
        attempt: 1,
        gave_way: false,
        remarks: Vec::new(),
    };
    Outcome {
        status: Status::Certified,
        scope: Extent::Global,
        message: "the answer is proved".into(),
        x: vec![0.5, 0.7],
        objective: Some(1.9),
        certificate: Some(certificate()),
        best: Some(0),
        answers: vec![answer],
        agreement: Some(Agreement { agree: true, objective_difference: 0.0, variable_difference: 1e-9 }),
        lower_bound: Some(1.9 - 1e-9),
        ..Outcome::default()
    }
}

/// The text a report writes about this outcome.
fn text(
    sense: Sense,
    outcome: &Outcome,
    write: impl Fn(&Findings<'_>, &mut dyn std::io::Write) -> std::io::Result<()>,
) -> String {
    let (about, model) = (about(sense), model());
    let volumes = Some(Volumes { total: 1.9, frustum: 1.9, prismatoid: 2.0 });
    let findings =
        Findings { about: &about, model: &model, class: Class::Linear, outcome, volumes, mass: None, utilisation: None };
    let mut out = Vec::new();
    write(&findings, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn tables_leave_open_bounds_empty() {
    let variables = text(Sense::Minimize, &outcome(), |findings, out| tables::variables(findings, out));
    assert_eq!(
        variables,
        "name,lower,start,upper,argmin,active,multiplier,sensitivity,value\n\
         x[1],0.5,1.0,,0.5,lower,0.0,0.0,0.5\nx[2],0.1,0.2,0.7,0.7,upper,1.0,-1.0,0.7\n"
    );
    let constraints = text(Sense::Minimize, &outcome(), |findings, out| tables::constraints(findings, out));
    assert_eq!(constraints, "name,value,lower,upper,active,multiplier,sensitivity\nc1,0.35,0.35,,lower,-2.0,2.0\n");
}

#[test]
fn maximising_flips_objective_and_multipliers() {
    let constraints = text(Sense::Maximize, &outcome(), |findings, out| tables::constraints(findings, out));
    assert!(constraints.ends_with("lower,2.0,-2.0\n"), "{constraints}");
    let json = text(Sense::Maximize, &outcome(), result::write);
    let value: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(value["objective"], -1.9);
    assert_eq!(value["solutions"][0]["objective"], -1.9);
}

#[test]
fn the_result_has_the_shape_of_the_format() {
    insta::assert_snapshot!(text(Sense::Minimize, &outcome(), result::write));
}

#[test]
fn an_outcome_without_values_is_still_json() {
    let nothing = Outcome { x: vec![f64::NAN, 0.2], ..Outcome::default() };
    let json = text(Sense::Minimize, &nothing, result::write);
    let value: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(value["objective"].is_null() && value["variables"]["x[1]"].is_null());
    assert!(value["constraints"][0]["multiplier"].is_null());
}

#[test]
fn the_summary_says_what_governs() {
    insta::assert_snapshot!(text(Sense::Minimize, &outcome(), summary::write));
}

#[test]
fn the_summary_of_an_infeasible_problem_names_the_conflict() {
    let conflict = Conflict {
        violated_rows: vec![(0, 0.25)],
        rows: vec![0],
        bounds: vec![(1, true)],
        alternatives: vec![LimitMove { limit: AnyLimit::Bound(1, true), from: 0.7, to: 0.95, least: true }],
        minimal: true,
    };
    let infeasible = Outcome {
        status: Status::Infeasible,
        message: "no point meets all rows".into(),
        remedy: Some("raise the upper bound of x[2]".into()),
        conflict: Some(conflict),
        x: vec![0.5, 0.7],
        ..Outcome::default()
    };
    insta::assert_snapshot!(text(Sense::Minimize, &infeasible, summary::write));
}
