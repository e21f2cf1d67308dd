//! Structures whose forces equilibrium alone knows: formulas of their sections, which may be geometric programs.

use ribopt::certificate::Extent;
use ribopt::crosscheck::{Outcome, Status};
use ribopt::model::Class;
use ribopt::run::solve::outcome;

use super::*;

/// Every row that is written out is the row of the analysis. Returns how many there are.
fn compared(name: &str, text: &str, x: &[f64]) -> usize {
    let [explicit, analysed] = both_ways(problem("determinate", name, text), x);
    for (row, value) in &explicit {
        let size = value.abs() + 1e-6 * analysed.values().fold(0.0, |most: f64, value| most.max(value.abs()));
        assert!((value - analysed[row]).abs() <= 1e-9 * size, "{name}: {row}: {value}, analysed {}", analysed[row]);
    }
    explicit.len()
}

/// A bent cantilever in space with a rigid arm, a strut from a hinge, loads of every kind, and every response.
#[test]
fn formulas_in_sections_are_the_analysis() {
    let text = format!(
        "minimize = \"volume\"\n[structure]\nstations = 5\n{MATERIAL}
[nodes]
a = [0, 0, 0]
b = [3, 0.5, 1]
c = [6, 1, 0.2]
d = [7, 3, 0.5]
[supports]
a = \"fixed\"
[sections.p]
kind = \"rectangle\"
b = {{ lower = 0.05, upper = 0.3, start = 0.2 }}
h = {{ lower = 0.05, upper = 0.5, start = 0.3 }}
[sections.q]
kind = \"tube\"
d = {{ lower = 0.05, upper = 0.5, start = 0.2 }}
t = 0.01
[[ribs]]
name = \"r1\"
start = \"a\"
end = \"b\"
section = \"p\"
offset = {{ end = [0, 0.1, -0.2] }}
shear = true
[[ribs]]
name = \"r2\"
start = \"b\"
end = \"c\"
section = \"p\"
roll = 20
[[ribs]]
name = \"r3\"
start = \"c\"
end = \"d\"
section = \"q\"
[[loads]]
case = \"g\"
ribs = [\"r1\", \"r2\"]
force = [1, -2, -7]
[[loads]]
case = \"g\"
nodes = [\"d\"]
force = [3, -2, -7]
moment = [1, 2, -3]
[[loads]]
case = \"t\"
ribs = [\"r2\"]
force = [0, 2, -9]
at = 0.4
[combinations]
U = {{ g = 1.35, t = -1.5 }}
[[constraints]]
name = \"stress\"
for = \"ribs\"
cases = [\"g\", \"U\"]
require = \"stress(case) <= 1e9\"
[[constraints]]
name = \"shear\"
for = \"ribs\"
require = \"vonmises(U) <= 1e9\"
[[constraints]]
name = \"moment\"
for = \"ribs\"
require = \"force(U, My)/from.h + force(U, N)/from.b + force(U, Vz)/from.b + force(U, Mz)/from.b + force(U, T)/from.b <= 1e9\"
only = [\"r1\", \"r2\"]
[[constraints]]
name = \"deflection\"
for = \"ribs\"
cases = [\"t\", \"U\"]
require = \"deflection(case, z, 0.3) + 2*deflection(case, y, 0.6) <= 1e9\"
[[constraints]]
name = \"moves\"
for = \"nodes\"
only = [\"b\", \"c\", \"d\"]
require = \"disp(U, x) + 2*disp(U, y) + 3*disp(U, z) + 4*disp(U, rx) + 5*disp(U, ry) + 6*disp(U, rz) <= 1e9\"
[[constraints]]
name = \"held\"
require = \"(reaction(U, a, z) + 2*reaction(U, a, rx) + 3*reaction(U, a, ry))/p.b <= 1e9\"
"
    );
    let rows = compared("space", &text, &[0.17, 0.23, 0.31]);
    assert!(rows > 100, "{rows}");
}

/// A beam on three supports with a hinge, in two ribs of one line, and the work of its loads.
#[test]
fn hinges_make_beams_determinate() {
    let text = format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\n{MATERIAL}
[nodes]
a = [0, 0]
b = [4, 0]
c = [5, 0]
d = [9, 0]
[supports]
a = \"pinned\"
b = [\"z\"]
d = [\"z\"]
[sections.p]
kind = \"rectangle\"
b = 0.2
h = {{ lower = 0.05, upper = 0.5, start = 0.3 }}
[sections.q]
kind = \"rectangle\"
b = 0.2
h = {{ lower = 0.05, upper = 0.5, start = 0.2 }}
[[ribs]]
name = \"r1\"
start = \"a\"
end = \"b\"
section = \"p\"
data = {{ line = \"L\" }}
[[ribs]]
name = \"r2\"
start = \"b\"
end = \"c\"
section = \"p\"
hinges = {{ end = [\"My\"] }}
data = {{ line = \"L\" }}
[[ribs]]
name = \"r3\"
start = \"c\"
end = \"d\"
section = \"q\"
data = {{ line = \"L\" }}
[[loads]]
case = \"g\"
ribs = [\"*\"]
force = [0, -10]
[[constraints]]
name = \"sag\"
for = \"ribs\"
by = \"line\"
require = \"sag(g, z, 0.5) <= 1\"
[[constraints]]
name = \"work\"
require = \"compliance(g) <= 1e9\"
[[constraints]]
name = \"stress\"
for = \"ribs\"
require = \"abs(stress(g)) <= 1e9\"
"
    );
    assert!(compared("hinged", &text, &[0.21, 0.13]) > 20);
}

fn solved(name: &str, text: &str) -> (Class, Outcome) {
    let subject = subject(name, text);
    let found = outcome(&subject).unwrap();
    (subject.class(), found)
}

/// b·h² = 6PL/σ̄ where stress governs and b·h³ = 4PL³/(E·u) where the tip's displacement does: both at the lower of heights they allow together.
#[test]
fn a_cantilever_is_a_geometric_program() {
    let section = "[sections.r]\nkind = \"rectangle\"\nb = { lower = 0.01, upper = 1, start = 0.1 }\nh = { lower = 0.01, upper = 0.4, start = 0.2 }\n";
    let limits = "[[constraints]]\nname = \"stress\"\nfor = \"ribs\"\nrequire = \"-2e4 <= stress(P) <= 2e4\"\n";
    let text = cantilever(3.0, section, "section = \"r\"", "depth = \"r.h\"") + limits;
    let (class, found) = solved("strength", &text);
    assert_eq!(
        (class, found.status, found.scope),
        (Class::GeometricProgram, Status::Certified, Extent::Global),
        "{}",
        found.message
    );
    // V = b·h·L = 6PL²/(σ̄·h) with the greatest height.
    assert!((found.objective.unwrap() / (6.0 * 10.0 * 9.0 / (2e4 * 0.4)) - 1.0).abs() < 1e-8, "{:?}", found.objective);
    let sag = "[[constraints]]\nname = \"tip\"\nrequire = \"disp(P, b, z) >= -0.001\"\n";
    let (class, found) = solved("stiffness", &(text + sag));
    assert_eq!(
        (class, found.status, found.scope),
        (Class::GeometricProgram, Status::Certified, Extent::Global),
        "{}",
        found.message
    );
    let width = 4.0 * 10.0 * 27.0 / (2.1e8 * 0.001 * 0.4_f64.powi(3));
    assert!((found.objective.unwrap() / (3.0 * 0.4 * width) - 1.0).abs() < 1e-8, "{:?}", found.objective);
}

/// What depends on more than equilibrium is analysed as before.
#[test]
fn others_are_no_such_formulas() {
    let sections = rectangle("r", 0.5, 0.2) + &rectangle("s", 0.5, 0.15);
    let limits = "[[constraints]]\nname = \"stress\"\nfor = \"ribs\"\nrequire = \"stress(P) <= 2e4\"\n";
    let uniform = cantilever(3.0, &sections, "section = \"r\"", "depth = \"r.h\"") + limits;
    assert!(problem("determinate", "uniform", &uniform).determinate().is_some());
    let tapered = cantilever(3.0, &sections, "from = \"r\"\nto = \"s\"", "depth = \"r.h\"") + limits;
    assert!(problem("determinate", "tapered", &tapered).determinate().is_none());
    let propped = uniform.replace("a = \"fixed\"", "a = \"fixed\"\nb = [\"z\"]");
    assert!(problem("determinate", "propped", &propped).determinate().is_none());
    let heavy = uniform.replace("plane =", "gravity = [0, -1]\nplane =") + "[[loads]]\ncase = \"P\"\nself_weight = true\n";
    assert!(problem("determinate", "heavy", &heavy).determinate().is_none());
    let buckling = uniform + "[[constraints]]\nname = \"stable\"\nrequire = \"buckling(P) >= 2\"\n";
    assert!(problem("determinate", "buckling", &buckling).determinate().is_none());
}
