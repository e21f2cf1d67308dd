//! Structures against closed forms, and under changes that must not change anything: cuts, turns, reversals.

use std::fs;
use std::path::PathBuf;

use ribopt::crosscheck::Status;
use ribopt::model::derivative_check::derivative_check;
use ribopt::model::{Model, States};
use ribopt::run::Subject;
use ribopt::run::analyse::{Analysis, AnalysisError, analyse};

/// A problem file of its own folder, read.
fn subject(name: &str, text: &str) -> Subject {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("structures");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join(format!("{name}.toml"));
    fs::write(&file, text).unwrap();
    Subject::read(&file, &[]).unwrap_or_else(|error| panic!("{name}: {error}"))
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

/// PL³/3EI, PL²/2EI, PL and the stress PL/W.
#[test]
fn a_cantilever_bends_as_the_books_say() {
    let text = format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\n{MATERIAL}
[nodes]
a = [0, 0]
b = [3, 0]
[supports]
a = \"fixed\"
[sections.r]
kind = \"rectangle\"
b = 0.1
h = {{ lower = 0.1, upper = 0.5, start = 0.2 }}
[[ribs]]
name = \"m\"
start = \"a\"
end = \"b\"
section = \"r\"
[[loads]]
case = \"P\"
nodes = [\"b\"]
force = [0, -10]
[definitions]
tip = \"disp(P, b, z)\"
turn = \"disp(P, b, ry)\"
root = \"force(P, m, My, 0)\"
held = \"reaction(P, a, z)\"
upper = \"stress(P, m, 0, top)\"
middle = \"deflection(P, m, z, 0.5)\"
work = \"compliance(P)\"
heavy = \"mass\"
"
    );
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
    let text = format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\n{MATERIAL}
[nodes]
a = [0, 0]
b = [4, 0]
[supports]
a = \"fixed\"
[sections.root]
kind = \"rectangle\"
b = 0.1
h = {{ lower = 0.1, upper = 0.8, start = 0.6 }}
[sections.thin]
kind = \"rectangle\"
b = 0.1
h = {{ lower = 0.1, upper = 0.8, start = 0.15 }}
[[ribs]]
name = \"m\"
start = \"a\"
end = \"b\"
from = \"root\"
to = \"thin\"
[[loads]]
case = \"P\"
nodes = [\"b\"]
force = [0, -10]
[definitions]
tip = \"disp(P, b, z)\"
"
    );
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

/// A frame in space with taper, loads on spans, temperature and self-weight; `cut` splits a rib, `turn` turns everything, `back` reverses it.
fn frame(cut: Option<f64>, turn: bool, back: bool) -> String {
    // A rotation with nothing special about it: columns of a product of three.
    let (a, b, c) = (0.4_f64, -0.7_f64, 1.1_f64);
    let rotate = |v: [f64; 3]| -> [f64; 3] {
        if !turn {
            return v;
        }
        let [x, y, z] = v;
        let [x, y] = [x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos()];
        let [y, z] = [y * b.cos() - z * b.sin(), y * b.sin() + z * b.cos()];
        let [x, z] = [x * c.cos() + z * c.sin(), -x * c.sin() + z * c.cos()];
        [x, y, z]
    };
    let list = |v: [f64; 3]| format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2]);
    let place = |v: [f64; 3]| list(rotate(v));
    let up = place([0.0, 0.0, 1.0]);
    let side = place([1.0, 0.0, 0.0]);
    let mut text = format!("minimize = \"volume\"\n[structure]\ngravity = {}\n{MATERIAL}", place([0.0, 0.0, -1.0]));
    text += &format!(
        "[nodes]\nfoot = {}\ncorner = {}\nend = {}\nfar = {}\n",
        place([0.0, 0.0, 0.0]),
        place([0.0, 0.0, 3.0]),
        place([4.0, 1.0, 3.5]),
        place([4.0, 5.0, 3.5])
    );
    if let Some(at) = cut {
        text += &format!("middle = {}\n", place([4.0 * at, at, 3.0 + 0.5 * at]));
    }
    text += "[supports]\nfoot = \"fixed\"\nfar = \"pinned\"\n";
    let between = |at: f64| (0.2 - 0.08 * at, 0.5 - 0.25 * at);
    for (name, (b, h)) in [("thick", between(0.0)), ("thin", between(1.0)), ("cut", between(cut.unwrap_or(0.5)))] {
        text +=
            &format!("[sections.{name}]\nkind = \"rectangle\"\nb = {b:?}\nh = {{ lower = 0.05, upper = 0.9, start = {h:?} }}\n");
    }
    let mut rib = |name: &str, start: &str, end: &str, from: &str, to: &str, up: &str| {
        text += &format!(
            "[[ribs]]\nname = \"{name}\"\nstart = \"{start}\"\nend = \"{end}\"\nfrom = \"{from}\"\nto = \"{to}\"\nup = {up}\n"
        );
    };
    rib("column", "foot", "corner", "thick", "thick", &side);
    match (cut, back) {
        (Some(_), _) => {
            rib("beam", "corner", "middle", "thick", "cut", &up);
            rib("beam2", "middle", "end", "cut", "thin", &up);
        }
        (None, false) => rib("beam", "corner", "end", "thick", "thin", &up),
        (None, true) => rib("beam", "end", "corner", "thin", "thick", &up),
    }
    rib("tie", "end", "far", "thin", "thin", &up);
    let beams = if cut.is_some() { "[\"beam\", \"beam2\"]" } else { "[\"beam\"]" };
    text += &format!("[[loads]]\ncase = \"q\"\nribs = {beams}\nforce = {}\n", place([1.0, 2.0, -9.0]));
    text += "[[loads]]\ncase = \"q\"\nself_weight = true\n";
    text += &format!("[[loads]]\ncase = \"q\"\nribs = {beams}\ntemperature = 25\n");
    text += &format!("[[loads]]\ncase = \"q\"\nnodes = [\"end\"]\nforce = {}\n", place([3.0, -4.0, 5.0]));
    let half = if cut.is_some() { "force(q, beam2, N, 1)" } else { "force(q, beam, N, 1)" };
    let half = if back { "force(q, beam, N, 0)" } else { half };
    let start = if back { 1 } else { 0 };
    text += &format!(
        "[definitions]\nwork = \"compliance(q)\"\ncolumn_my = \"force(q, column, My, 1)\"\ncolumn_t = \"force(q, column, T, 0.3)\"\nbeam_my = \"force(q, beam, My, {start})\"
beam_mz = \"force(q, beam, Mz, {start})\"\nbeam_n = \"{half}\"\ncorner_stress = \"stress(q, tie, 0.5, top-right)\"
"
    );
    text
}

fn values(name: &str, text: &str) -> Vec<(String, f64)> {
    analysed(name, text).definitions
}

#[test]
fn a_cut_changes_nothing() {
    let whole = values("whole", &frame(None, false, false));
    for at in [0.3, 0.5, 0.81] {
        for ((name, one), (_, other)) in whole.iter().zip(values("cut", &frame(Some(at), false, false))) {
            // Compliance counts the work of the equivalent end forces, which depend on where ribs end.
            if name != "work" {
                assert!((one - other).abs() < 1e-9 * one.abs().max(1.0), "{name}, cut at {at}: {one} and {other}");
            }
        }
    }
}

#[test]
fn a_turn_in_space_changes_nothing() {
    let turned = values("turned", &frame(None, true, false));
    for ((name, one), (_, other)) in values("straight", &frame(None, false, false)).iter().zip(turned) {
        assert!((one - other).abs() < 1e-10 * one.abs().max(1.0), "{name}: {one} and {other}");
    }
}

/// A reversed member keeps N, T and My, and turns Mz.
#[test]
fn a_reversed_member_carries_the_same() {
    let back = values("back", &frame(None, false, true));
    for ((name, one), (_, other)) in values("forth", &frame(None, false, false)).iter().zip(back) {
        let other = if name == "beam_mz" { -other } else { other };
        assert!((one - other).abs() < 1e-9 * one.abs().max(1.0), "{name}: {one} and {other}");
    }
}

#[test]
fn reactions_carry_the_loads() {
    let analysis = analysed("balance", &frame(None, false, false));
    let sum = |axis: usize| -> f64 {
        analysis.cases[0].reactions.iter().filter(|(_, direction, _)| *direction == axis).map(|(_, _, value)| value).sum()
    };
    let length = (16.0_f64 + 1.0 + 0.25).sqrt();
    let volume = 3.0 * 0.2 * 0.5 + 4.0 * 0.12 * 0.25 + length * (0.2 * 0.5 + 0.12 * 0.25 + 4.0 * 0.16 * 0.375) / 6.0;
    assert_near(sum(0), -(length + 3.0), "x");
    assert_near(sum(1), -(2.0 * length - 4.0), "y");
    assert_near(sum(2), 9.0 * length - 5.0 + 77.0 * volume, "z");
}

/// Hinges, rigid arms, springs, temperature gradient, pretension, shear, and nodes that move with the design: every derivative of the lifted
/// and of the reduced model against differences.
#[test]
fn derivatives_agree_with_differences() {
    let text = format!(
        "minimize = \"volume\"\n[structure]\nstations = 3\ngravity = [0, 0, -1]\n{MATERIAL}
[variables]
rise = {{ lower = 1, upper = 4, start = 2.2 }}
[nodes]
a = [0, 0, 0]
b = [3, 0.5, \"rise\"]
c = [6, 0, 0.2]
d = [3, 4, 0.5]
[supports]
a = \"fixed\"
c = {{ fix = [\"x\", \"y\", \"z\", \"rx\"], springs = {{ ry = 2000 }} }}
d = \"pinned\"
[sections.p]
kind = \"h-beam\"
tw = 0.01
b = {{ lower = 0.1, upper = 0.3, start = 0.2 }}
hw = {{ lower = 0.1, upper = 0.5, start = 0.3 }}
tf = 0.015
[sections.q]
kind = \"h-beam\"
tw = 0.01
b = \"p.b\"
hw = {{ lower = 0.1, upper = 0.5, start = 0.2 }}
tf = 0.012
[sections.bar]
kind = \"general\"
A = {{ lower = 1e-4, upper = 1e-2, start = 2e-3 }}
[[ribs]]
name = \"r1\"
start = \"a\"
end = \"b\"
from = \"p\"
to = \"q\"
offset = {{ start = [0, 0.1, -0.2] }}
shear = true
[[ribs]]
name = \"r2\"
start = \"b\"
end = \"c\"
from = \"q\"
to = \"p\"
hinges = {{ end = [\"Mz\"] }}
roll = 20
[[ribs]]
name = \"r3\"
start = \"b\"
end = \"d\"
section = \"bar\"
joints = \"pinned\"
[[loads]]
case = \"g\"
ribs = [\"r1\", \"r2\"]
force = [1, -2, -7]
[[loads]]
case = \"g\"
ribs = [\"r1\", \"r2\"]
self_weight = true
[[loads]]
case = \"t\"
ribs = [\"r2\"]
gradient = 15
[[loads]]
case = \"t\"
ribs = [\"r3\"]
pretension = 20
[[loads]]
case = \"t\"
ribs = [\"r1\"]
force = [0, 0, -3]
at = 0.4
[[loads]]
case = \"t\"
nodes = [\"d\"]
displacement = {{ z = -0.01 }}
[combinations]
ULS = {{ g = 1.35, t = 1.5 }}
[[constraints]]
name = \"strength\"
for = \"ribs\"
only = [\"r1\", \"r2\"]
require = \"abs(stress(ULS)) <= 3e5\"
[[constraints]]
name = \"equivalent\"
require = \"vonmises(ULS, r1, 0.5, web-centre) <= 3e5\"
[[constraints]]
name = \"bar\"
require = \"stress(ULS, r3, 0.5, centre) <= 2e5\"
[[constraints]]
name = \"sag\"
require = \"disp(ULS, b, z)^2 + deflection(ULS, r2, z, 0.5)^2 <= 0.01\"
[[constraints]]
name = \"foot\"
require = \"abs(reaction(ULS, a, x)) <= 1000\"
[[constraints]]
name = \"work\"
require = \"compliance(g) <= 100\"
[[constraints]]
name = \"long\"
require = \"r1.length <= 9\"
"
    );
    let subject = subject("everything", &text);
    let reduced = subject.analysis().expect("the problem asks for responses");
    let x = reduced.meta().start.clone();
    let check = derivative_check(reduced, &x).unwrap();
    assert!(check.compared > 100 && check.disagreements == 0, "reduced: {:?}", check.worst);
    let z = reduced.solved(&x).unwrap();
    let check = derivative_check(reduced.lifted(), &z).unwrap();
    assert!(check.disagreements == 0, "lifted: {:?}", check.worst);
    let States { blocks, block, .. } = reduced.lifted().states();
    assert_eq!(
        (blocks, block),
        (2, 6 + 2),
        "two cases; b moves in six directions, c turns about y and z, a bar turns nothing at d"
    );
}

/// Motions without resistance are named.
#[test]
fn mechanisms_are_told_in_words() {
    let text = format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\njoints = \"pinned\"\n{MATERIAL}
[nodes]
a = [0, 0]
b = [3, 0]
c = [3, 3]
d = [0, 3]
[supports]
a = \"pinned\"
b = \"pinned\"
[sections.r]
kind = \"general\"
A = {{ lower = 0.01, upper = 1, start = 0.1 }}
[[ribs]]
name = \"bc\"
start = \"b\"
end = \"c\"
section = \"r\"
[[ribs]]
name = \"cd\"
start = \"c\"
end = \"d\"
section = \"r\"
[[ribs]]
name = \"da\"
start = \"d\"
end = \"a\"
section = \"r\"
[[loads]]
case = \"P\"
nodes = [\"c\"]
force = [1, 0]
[definitions]
sway = \"disp(P, c, x)\"
"
    );
    let error = analyse(&subject("square", &text), None, false).unwrap_err();
    assert!(matches!(error, AnalysisError::Mechanism(_)), "{error}");
    let message = error.to_string();
    assert!(message.contains("node c can move in x") && message.contains("node d can move in x"), "{message}");
}

/// Two bars of one area from the ground to an apex: a load P on it moves it by P·√2/(E·A) downwards, one of (P, −P) by 2P/(E·A) along one bar.
/// The size of a displacement has no derivative at zero, where the analysis begins.
#[test]
fn the_size_of_a_displacement_may_be_limited() {
    let (stiffness, load, limit) = (2.1e8_f64, 100.0_f64, 1e-3_f64);
    for (name, force, along) in [("down", "[0, -100]", 2.0_f64.sqrt()), ("aside", "[100, -100]", 2.0)] {
        let text = format!(
            "minimize = \"volume\"\n[structure]\nplane = \"xz\"\njoints = \"pinned\"\n{MATERIAL}
[nodes]
a = [0, 0]
b = [2, 0]
c = [1, 1]
[supports]
a = \"pinned\"
b = \"pinned\"
[sections.s]
kind = \"general\"
A = {{ lower = 1e-5, upper = 1.0, start = 1e-3 }}
[[ribs]]
name = \"left\"
start = \"a\"
end = \"c\"
section = \"s\"
[[ribs]]
name = \"right\"
start = \"b\"
end = \"c\"
section = \"s\"
[[loads]]
case = \"P\"
nodes = [\"c\"]
force = {force}
[[constraints]]
name = \"size\"
require = \"sqrt(disp(P, c, x)^2 + disp(P, c, z)^2) <= {limit}\"
"
        );
        let subject = subject(&format!("size-{name}"), &text);
        let found = ribopt::run::solve::outcome(&subject).unwrap();
        assert_eq!(found.status, Status::Certified, "{name}");
        let (area, volume) = (load * along / (stiffness * limit), found.objective.unwrap());
        assert!((volume / (2.0 * 2.0_f64.sqrt() * area) - 1.0).abs() < 1e-8, "{name}: {volume}");
    }
}

/// No definition of the ten-bar truss asks for a response: its equilibrium is looked at all the same.
#[test]
fn the_residual_is_measured_without_definitions() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("problems/ten-bar-truss.toml");
    let subject = Subject::read(&file, &[]).unwrap();
    let residual = analyse(&subject, None, false).unwrap().equilibrium_residual;
    assert!(residual > 0.0 && residual < 1e-13, "{residual}");
}
