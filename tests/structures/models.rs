//! Derivatives, mechanisms, and limits that have no value everywhere.

use ribopt::crosscheck::Status;
use ribopt::model::derivative_check::derivative_check;
use ribopt::model::{Model, States};
use ribopt::run::analyse::AnalysisError;

use super::*;

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

/// Displacements are bounded with the design where no member can lose its stiffness or its place.
#[test]
fn displacements_are_bounded_where_the_design_is() {
    let are_bounded = |area: &str, height: &str, beam: &str| {
        let text = format!(
            "minimize = \"volume\"\n[structure]\nplane = \"xz\"\n{MATERIAL}
[variables]
height = {{ lower = 1, upper = 2, start = 1.5 }}
[nodes]
a = [0, 0]
b = [0, 2]
c = [2, {height}]
[supports]
a = \"fixed\"
b = \"pinned\"
[sections.bar]
kind = \"general\"
A = {area}
[sections.low]
kind = \"rectangle\"
b = 0.1
h = {{ lower = 0.1, upper = 0.5 }}
[sections.high]
kind = \"rectangle\"
b = 0.1
h = {{ lower = 0.1, upper = 0.5 }}
[[ribs]]
name = \"beam\"
start = \"a\"
end = \"c\"
{beam}
[[ribs]]
name = \"tie\"
start = \"b\"
end = \"c\"
section = \"bar\"
joints = \"pinned\"
[[loads]]
case = \"g\"
nodes = [\"c\"]
force = [0, -10]
[[constraints]]
name = \"sway\"
require = \"disp(g, c, z) >= -0.01\"
"
        );
        let subject = subject("bounded", &text);
        subject.analysis().expect("the problem asks for responses").lifted().states().are_bounded
    };
    let prismatic = "section = \"low\"";
    let tapered = "from = \"low\"\nto = \"high\"";
    let area = "{ lower = 1e-4, upper = 1e-2 }";
    assert!(are_bounded(area, "0", prismatic));
    assert!(!are_bounded("{ lower = 0, upper = 1e-2, start = 1e-3 }", "0", prismatic), "a bar may vanish");
    assert!(!are_bounded("{ lower = 1e-4, start = 1e-3 }", "0", prismatic), "an area has no upper bound");
    assert!(!are_bounded(area, "\"height\"", prismatic), "a node may move");
    assert!(!are_bounded(area, "0", tapered), "what lies between two sections is not looked at");
}
