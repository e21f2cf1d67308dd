//! Structures against closed forms.

mod determinate;
mod forms;
mod models;
mod modes;
mod tasks;
mod trusses;
mod unchanged;

use std::collections::HashMap;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use ribopt::model::assemble_any;
use ribopt::problem::Problem;
use ribopt::run::Subject;
use ribopt::run::analyse::{Analysis, analyse};

/// A problem file in a folder of these tests.
fn file(folder: &str, name: &str, text: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(folder);
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join(format!("{name}.toml"));
    fs::write(&file, text).unwrap();
    file
}

/// The same, read.
fn subject(name: &str, text: &str) -> Subject {
    Subject::read(&file("structures", name, text), &[]).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The problem of one.
fn problem(folder: &str, name: &str, text: &str) -> Problem {
    ribopt::input::read(&file(folder, name, text)).unwrap_or_else(|mistakes| panic!("{mistakes}")).problem
}

/// The values of a determinate problem's rows by name, written out in forces and analysed.
fn both_ways(problem: Problem, x: &[f64]) -> [HashMap<String, f64>; 2] {
    let explicit = assemble_any(&Arc::new(problem.determinate().expect("determinate"))).unwrap();
    let analysed = assemble_any(&Arc::new(problem)).unwrap();
    assert!(explicit.analysis().is_none() && analysed.analysis().is_some());
    [explicit, analysed].map(|assembled| {
        let model = assembled.model();
        let mut values = vec![0.0; model.meta().rows()];
        model.constraints(x, &mut values).unwrap();
        values.into_iter().enumerate().map(|(i, value)| (model.meta().names.row(i), value)).collect()
    })
}

fn analysed(name: &str, text: &str) -> Analysis {
    analyse(&subject(name, text), None, false).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn definition(analysis: &Analysis, name: &str) -> f64 {
    analysis.definitions.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no definition {name}")).1
}

fn assert_near(found: f64, wanted: f64, what: &str) {
    assert!((found - wanted).abs() <= 1e-10 * wanted.abs().max(1e-12), "{what}: {found}, not {wanted}");
}

const MATERIAL: &str = "[materials.s]\nE = 2.1e8\nnu = 0.3\ndensity = 77.0\nalpha = 1.2e-5\n";

/// A member `m` from a clamped node a to a node b that carries 10 downwards; `ends` says which sections it runs between.
fn cantilever(length: f64, sections: &str, ends: &str, definitions: &str) -> String {
    format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\n{MATERIAL}
[nodes]
a = [0, 0]
b = [{length}, 0]
[supports]
a = \"fixed\"
{sections}
[[ribs]]
name = \"m\"
start = \"a\"
end = \"b\"
{ends}
[[loads]]
case = \"P\"
nodes = [\"b\"]
force = [0, -10]
[definitions]
{definitions}
"
    )
}

/// A rectangle 0.1 wide, its height a variable.
fn rectangle(name: &str, upper: f64, start: f64) -> String {
    format!("[sections.{name}]\nkind = \"rectangle\"\nb = 0.1\nh = {{ lower = 0.1, upper = {upper}, start = {start} }}\n")
}

/// PL³/3EI, PL²/2EI, PL and the stress PL/W.
#[test]
fn a_cantilever_bends_as_the_books_say() {
    let definitions = r#"tip = "disp(P, b, z)"
turn = "disp(P, b, ry)"
root = "force(P, m, My, 0)"
held = "reaction(P, a, z)"
upper = "stress(P, m, 0, top)"
middle = "deflection(P, m, z, 0.5)"
work = "compliance(P)"
heavy = "mass""#;
    let text = cantilever(3.0, &rectangle("r", 0.5, 0.2), "section = \"r\"", definitions);
    let analysis = analysed("cantilever", &text);
    let (force, length, inertia) = (10.0_f64, 3.0_f64, 0.1 * 0.2_f64.powi(3) / 12.0);
    let stiffness = 2.1e8 * inertia;
    let tip = force * length.powi(3) / (3.0 * stiffness);
    assert_near(definition(&analysis, "tip"), -tip, "tip");
    assert_near(
        definition(&analysis, "turn"),
        force * length * length / (2.0 * stiffness),
        "rotation: it sags, and ry turns z to x",
    );
    assert_near(definition(&analysis, "root"), -force * length, "moment, hogging");
    assert_near(definition(&analysis, "held"), force, "reaction");
    assert_near(definition(&analysis, "upper"), force * length * 0.1 / inertia, "tension on top");
    // The middle lies 5PL³/48EI below the root, half the tip's way is the chord.
    assert_near(definition(&analysis, "middle"), tip / 2.0 - 5.0 * force * length.powi(3) / (48.0 * stiffness), "from the chord");
    assert_near(definition(&analysis, "work"), force * tip, "work of the load");
    assert_near(definition(&analysis, "heavy"), 77.0 * 0.1 * 0.2 * 3.0, "mass");
    assert!(analysis.equilibrium_residual < 1e-13);
}

/// ∫x²/EI dx by a rule of its own, for a depth that varies from 0.6 to 0.15.
#[test]
fn a_steep_taper_is_integrated_exactly() {
    let sections = rectangle("root", 0.8, 0.6) + &rectangle("thin", 0.8, 0.15);
    let text = cantilever(4.0, &sections, "from = \"root\"\nto = \"thin\"", "tip = \"disp(P, b, z)\"");
    let found = definition(&analysed("taper", &text), "tip");
    // Simpson's rule with so many steps is exact to rounding.
    let steps = 20_000;
    let integrand = |x: f64| {
        let height: f64 = 0.6 + (0.15 - 0.6) * x / 4.0;
        10.0 * (4.0 - x).powi(2) / (2.1e8 * 0.1 * height.powi(3) / 12.0)
    };
    let width = 4.0 / f64::from(steps);
    let sum: f64 = (0..steps)
        .map(|at| {
            let x = f64::from(at) * width;
            width / 6.0 * (integrand(x) + 4.0 * integrand(x + width / 2.0) + integrand(x + width))
        })
        .sum();
    assert_near(found, -sum, "tip");
}
