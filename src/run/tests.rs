//! Whole runs on a problem built by hand: one tapered rib of rectangles between two depths.

use std::fs;
use std::path::Path;

use super::bounds::bounds;
use super::check::check;
use super::choice::choose;
use super::compare::compare;
use super::solve::{Request, solve, solve_in_memory};
use super::verify::verify;
use super::*;
use crate::crosscheck::Status;
use crate::problem::formula::Total;
use crate::problem::{
    Constraint, Dimension, Formula, Limit, Origin, Problem, Property, Ribs, Scope, Sections, Variables, VolumeLaw,
};
use crate::report::answer::EarlierAnswer;
use crate::sections;

/// Two rectangles b × h, one rib of length 3 between them; Ix of the first at least 1e-4.
fn rib() -> Problem {
    let form = sections::forms().position(|(_, form)| form.kind == "rectangle").unwrap() as u16;
    let dimension = |section, position| Origin::Dimension(section, position);
    let stiff = Constraint {
        detail: Box::default(),
        name: "stiff".into(),
        place: "rib.toml:9".into(),
        text: "left.Ix >= 1e-4".into(),
        scope: Scope::Once,
        left: Formula::SectionProperty(0, Property("Ix".into())),
        right: Limit::AtLeast(Formula::Constant(1e-4)),
        asked: Vec::new(),
    };
    Problem {
        title: "One rib".into(),
        objective: Formula::Volume(Total::Own),
        objective_text: "volume".into(),
        variables: Variables {
            origin: vec![dimension(0, 0), dimension(0, 1), dimension(1, 0), dimension(1, 1)],
            declared: Vec::new(),
            lower: vec![0.05, 0.1, 0.05, 0.1],
            positive: Vec::new(),
            upper: vec![0.4, 0.6, 0.4, 0.6],
            start: vec![0.2, 0.3, 0.2, 0.3],
            typical: Vec::new(),
        },
        sections: Sections {
            names: ["left", "right"].into_iter().collect(),
            form: vec![form, form],
            first_dimension: vec![0, 2, 4],
            dimensions: (0..4).map(Dimension::Variable).collect(),
            ..Sections::default()
        },
        ribs: Ribs {
            names: ["only"].into_iter().collect(),
            from: vec![0],
            to: vec![1],
            length: vec![3.0],
            law: vec![VolumeLaw::Frustum],
            data: Vec::new(),
        },
        constraints: vec![stiff],
        ..Problem::default()
    }
}

fn subject() -> Subject {
    Subject::assemble(rib(), Path::new("rib.toml"), "00".into()).unwrap()
}

fn request<'a>(subject: &'a Subject, out: &'a Path) -> Request<'a> {
    let choices = choose(&[], None, &subject.settings).unwrap();
    Request { choices, out: Some(out), start: None, inputs: &subject.inputs, starts: 1, plot: false, interrupt: None }
}

#[test]
fn a_run_leaves_its_files_and_its_answer_verifies() {
    let (subject, folder) = (subject(), tempfile::tempdir().unwrap());
    let solved = solve(&subject, &request(&subject, folder.path()), &mut ()).unwrap();
    assert_eq!(solved.outcome.status, Status::Certified, "{}", solved.outcome.message);
    let volumes = solved.volumes.unwrap();
    assert!((volumes.total - solved.outcome.objective.unwrap()).abs() < 1e-12 && volumes.prismatoid > volumes.frustum);
    for name in ["variables.csv", "constraints.csv", "result.json", "log-argmin.csv"] {
        assert!(fs::metadata(folder.path().join(name)).unwrap().len() > 0, "{name}");
    }
    let verified = verify(&subject, &folder.path().join("result.json")).unwrap();
    assert_eq!(verified.outcome.status, Status::Certified);
    assert_eq!(verified.outcome.objective, solved.outcome.objective);
}

#[test]
fn a_run_in_memory_finds_the_same_and_leaves_nothing() {
    let (subject, folder) = (subject(), tempfile::tempdir().unwrap());
    let out = folder.path().join("out");
    let request = Request { plot: true, ..request(&subject, &out) };
    let text = |solved: &super::solve::Solved| {
        let mut text = Vec::new();
        crate::report::result::write(&solved.findings(&subject), &mut text).unwrap();
        let lines = String::from_utf8(text).unwrap();
        lines.lines().filter(|line| !line.contains("\"seconds\"")).map(str::to_owned).collect::<Vec<_>>()
    };
    let in_memory = text(&solve_in_memory(&subject, &request, &mut ()).unwrap());
    assert!(!out.exists());
    assert_eq!(text(&solve(&subject, &request, &mut ()).unwrap()), in_memory);
    assert!(out.join("result.json").exists());
}

#[test]
fn an_earlier_answer_is_a_start() {
    let (subject, folder) = (subject(), tempfile::tempdir().unwrap());
    drop(solve(&subject, &request(&subject, folder.path()), &mut ()).unwrap());
    let (earlier, again) = (folder.path().join("result.json"), folder.path().join("again"));
    let earlier = EarlierAnswer::read(&earlier).unwrap();
    let request = Request { start: Some(&earlier), ..request(&subject, &again) };
    assert_eq!(solve(&subject, &request, &mut ()).unwrap().outcome.status, Status::Certified);
}

#[test]
fn rectangles_end_at_their_lower_bounds() {
    let subject = subject();
    let test = bounds(&subject, &choose(&[], None, &subject.settings).unwrap(), None);
    let ends = test.ends.as_ref().unwrap();
    assert!(ends.iter().all(|end| end.proved && end.at == crate::report::bounds::Where::Lower), "{ends:?}");
    assert_eq!((test.exit_code(false), test.exit_code(true)), (0, 0));
}

#[test]
fn derivatives_of_the_rib_agree() {
    let check = check(&subject()).unwrap();
    assert!(check.compared > 10 && check.disagreements == 0, "{check:?}");
}

#[test]
fn every_solver_is_compared_or_says_why_not() {
    let trials = compare(&subject(), None);
    assert_eq!(trials.len(), choice::all().len());
    assert!(trials.iter().any(|trial| trial.solved));
    assert!(trials.iter().all(|trial| trial.ran() || !trial.message.is_empty()));
}
