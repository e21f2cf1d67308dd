//! Networks that decompose: solved component by component they end where the whole does, whatever the number of threads.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use ribopt::backends::argmin::Argmin;
use ribopt::backends::{Backend, Iteration, Job, Solution};
use ribopt::certificate::{self, Tolerances};
use ribopt::model::derivative_check::derivative_check;
use ribopt::model::{Budget, Class, Model, RibModel, WithBounds, assemble};

const RECTANGLE: &str = "
[[constraints]]
name = 'stiffness'
for = 'sections'
kind = 'rectangle'
require = 'Ix >= I_req'

[[constraints]]
name = 'slender'
for = 'sections'
kind = 'rectangle'
require = 'h <= 8*b'
";
const H_BEAM: &str = "
[[constraints]]
name = 'area'
for = 'sections'
kind = 'h-beam'
require = 'A >= 0.02'
";

/// Ribs between two sections of their own, with numbers that differ: rectangles, every second one an H beam where wanted
/// (whose volume has local minima).
fn network(ribs: usize, with_h_beams: bool, folder: &Path) -> RibModel {
    let mut sections = String::from(
        "name,kind,b.lower,b.upper,b.start,h.lower,h.upper,h.start,b1,h1.lower,h1.upper,h1.start,b2.lower,b2.upper,b2.start,h2.lower,h2.upper,h2.start,I_req\n",
    );
    let mut list = String::from("name,from,to,length\n");
    for rib in 0..ribs {
        for end in ["i", "j"] {
            let vary = (rib * 7 + end.len() + usize::from(end == "j") * 3) % 11;
            let required = 1e-5 * (1.0 + vary as f64);
            let row = if rib % 2 == 0 || !with_h_beams {
                format!("r{rib}{end},rectangle,0.02,0.5,0.1,0.02,0.5,0.3,,,,,,,,,,,{required}")
            } else {
                format!("r{rib}{end},h-beam,,,,,,,0.0{}1,0.02,0.35,0.2,0.1,0.5,0.2,0.36,0.5,0.45,", vary % 9 + 1)
            };
            writeln!(sections, "{row}").unwrap();
        }
        writeln!(list, "rib{rib},r{rib}i,r{rib}j,{}", 1.0 + (rib % 5) as f64).unwrap();
    }
    let file = folder.join("problem.toml");
    fs::write(
        &file,
        format!("minimize = 'volume'\n{RECTANGLE}{H_BEAM}\n[tables]\nsections = 'sections.csv'\nribs = 'ribs.csv'\n"),
    )
    .unwrap();
    fs::write(folder.join("sections.csv"), sections).unwrap();
    fs::write(folder.join("ribs.csv"), list).unwrap();
    let input = ribopt::input::read(&file).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assemble(&Arc::new(input.problem)).unwrap()
}

fn solve(model: &dyn Model) -> Solution {
    solve_from(model, &model.meta().start, None)
}

fn solve_from(model: &dyn Model, start: &[f64], start_multipliers: Option<&[f64]>) -> Solution {
    let mut observer = |_: &Iteration<'_>| {};
    let mut job = Job {
        algorithm: "auto",
        start,
        start_multipliers,
        optimality_tolerance: 1e-6,
        step_tolerance: 1e-6,
        constraint_tolerance: 1e-8,
        max_iterations: 10_000,
        budget: Budget::default(),
        stop_test: None,
        part_test: None,
        observer: &mut observer,
    };
    Argmin.solve(model, &mut job)
}

#[test]
fn the_joined_solution_is_certified_and_equals_that_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let model = network(60, false, folder.path());
    // Between its own bounds it is the same model, but does not tell that it decomposes.
    let joined = WithBounds::new(&model, model.meta().lower.clone(), model.meta().upper.clone());
    let (apart, whole) = (solve(&model), solve(&joined));
    assert!(apart.message.contains("60 independent components"), "{}", apart.message);
    let judge = |solution: &Solution| {
        certificate::certify(&model, Class::default(), &solution.x, solution.multipliers.as_deref(), Tolerances::default())
            .unwrap()
    };
    let (apart_judged, whole_judged) = (judge(&apart), judge(&whole));
    assert!(apart_judged.certified, "{:?}", apart_judged.messages);
    let difference = (apart_judged.objective - whole_judged.objective) / whole_judged.sigma;
    assert!(difference.abs() < 1e-8, "{} {}", apart_judged.objective, whole_judged.objective);
}

#[test]
fn an_answer_with_its_multipliers_is_known_again() {
    let folder = tempfile::tempdir().unwrap();
    let model = network(60, false, folder.path());
    let first = solve(&model);
    let again = solve_from(&model, &first.x, first.multipliers.as_deref());
    assert!(again.message.contains("at most 0 Newton steps"), "{}", again.message);
    let far = first.x.iter().zip(&again.x).map(|(a, b)| (a - b).abs() / a.abs()).fold(0.0, f64::max);
    assert!(far < 1e-12, "{far}");
}

#[test]
fn the_bytes_do_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let model = network(300, true, folder.path());
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| solve(&model)).x
    };
    let bits = |x: Vec<f64>| x.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(with(1)), bits(with(2)));
}

#[test]
fn a_component_is_a_model_with_exact_derivatives_and_its_dense_twin_agrees() {
    let folder = tempfile::tempdir().unwrap();
    let model = network(4, true, folder.path());
    let components = model.components().expect("ribs without shared sections");
    assert_eq!(components.partition().len(), 4);
    let mut local = components.local();
    for k in 0..4 {
        let part = components.model(k);
        let (meta, x) = (part.meta(), &part.meta().start);
        assert!(derivative_check(part.as_ref(), x).unwrap().disagreements == 0, "component {k}");
        let (n, m) = (meta.variables(), meta.rows());
        local.select(k);
        let (mut rows, mut gradient, mut jacobian) = (vec![0.0; m], vec![0.0; n], vec![0.0; m * n]);
        let objective = local.first_order(x, &mut rows, &mut gradient, &mut jacobian);
        let (mut own_rows, mut own_gradient, mut own_jacobian) = (vec![0.0; m], vec![0.0; n], vec![0.0; meta.jacobian.len()]);
        let own_objective = part.gradient(x, &mut own_gradient).unwrap();
        part.constraints(x, &mut own_rows).unwrap();
        part.jacobian(x, &mut own_jacobian).unwrap();
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * (1.0 + a.abs());
        assert!(close(objective, own_objective), "{objective} {own_objective}");
        assert!(gradient.iter().zip(&own_gradient).chain(rows.iter().zip(&own_rows)).all(|(a, b)| close(*a, *b)));
        assert!(meta.jacobian.iter().zip(&own_jacobian).all(|((i, j), value)| close(jacobian[i * n + j], *value)));
        let (y, mut dense, mut sparse) = (vec![0.7; m], vec![0.0; n * n], vec![0.0; meta.hessian.len()]);
        local.hessian(x, 1.3, &y, &mut dense);
        part.hessian(x, 1.3, &y, &mut sparse).unwrap();
        assert!(meta.hessian.iter().zip(&sparse).all(|((i, j), value)| close(dense[i * n + j], *value)));
    }
}

#[test]
fn what_rounding_leaves_of_a_zero_hides_no_curvature_of_a_small_piece() {
    let folder = tempfile::tempdir().unwrap();
    // Pairs by themselves; along x + y = 1 the objective bends by −1 times `sign` each.
    let certified = |sign: &str| {
        let mut text = format!("minimize = 'sum({sign}(0.5*x^2 - 2*x - y^2))'\n");
        text += "[variables]\nx = { size = 101, start = 0, lower = -1, upper = 2 }\ny = { size = 101, start = 1, lower = -1, upper = 2 }\n";
        for k in 1..=101 {
            write!(text, "[[constraints]]\nname = 'r{k}'\nrequire = 'x[{k}] + y[{k}] == 1'\n").unwrap();
        }
        let file = folder.path().join("pairs.toml");
        fs::write(&file, text).unwrap();
        let input = ribopt::input::read(&file).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let model = assemble(&Arc::new(input.problem)).unwrap();
        let x: Vec<f64> = model.meta().start.iter().map(|&start| if start == 0.0 { 1e-15 } else { start }).collect();
        certificate::certify(&model, Class::default(), &x, None, Tolerances::default()).unwrap()
    };
    assert!(certified("-").certified);
    let maximum = certified("");
    assert!(!maximum.certified && maximum.negative_curvature, "{maximum:?}");
}
