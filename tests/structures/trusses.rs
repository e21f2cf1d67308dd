//! Trusses with more than the general method: bars that vanish, forces that equilibrium alone knows, bounds below every design.

use ribopt::certificate::Extent;
use ribopt::crosscheck::{Outcome, Status};
use ribopt::model::Class;
use ribopt::run::solve::outcome;

use super::*;

fn solved(name: &str, text: &str) -> (Subject, Outcome) {
    let subject = Subject::read(&file("trusses", name, text), &[]).unwrap_or_else(|error| panic!("{name}: {error}"));
    let found = outcome(&subject).unwrap();
    (subject, found)
}

/// A plane truss: nodes, supports, bars with an area of their own between these bounds, and the rest of the file.
fn truss(nodes: &str, supports: &str, bars: &[(&str, &str)], area: &str, rest: &str) -> String {
    let mut text = format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\njoints = \"pinned\"\n[materials.s]\nE = 2.1e8\ndensity = 77\n[nodes]\n{nodes}\n[supports]\n{supports}\n"
    );
    for (at, (start, end)) in bars.iter().enumerate() {
        text += &format!("[sections.s{at}]\nkind = \"general\"\nA = {area}\n");
        text += &format!("[[ribs]]\nname = \"r{at}\"\nstart = \"{start}\"\nend = \"{end}\"\nsection = \"s{at}\"\n");
    }
    text + rest
}

/// Three bars from the ceiling to one node.
fn three_bars(area: &str, rest: &str) -> String {
    let (nodes, supports) =
        ("a = [-1, 0]\nb = [0, 0]\nc = [1, 0]\nd = [0, -1]", "a = \"pinned\"\nb = \"pinned\"\nc = \"pinned\"");
    truss(nodes, supports, &[("a", "d"), ("b", "d"), ("c", "d")], area, rest)
}

const SIDEWAYS: &str = "[[loads]]\ncase = \"P\"\nnodes = [\"d\"]\nforce = [100, 0]\n";

/// A load across the middle bar: the outer two carry N = ±P/√2 each, and with σ̄ allowed the volume is 2·(P/(√2·σ̄))·√2 = 2P/σ̄. The middle bar goes, and
/// the lower-bound theorem says that nothing is lighter.
#[test]
fn a_bar_that_carries_nothing_vanishes_and_the_rest_is_proved_best() {
    let limit = "[[constraints]]\nname = \"stress\"\nfor = \"ribs\"\nrequire = \"-2e5 <= stress(P) <= 2e5\"\n";
    for area in ["{ lower = 0, start = 1e-3 }", "{ lower = 1e-12, upper = 1, start = 1e-3 }"] {
        let (_, found) = solved("vanishing", &three_bars(area, &format!("{SIDEWAYS}{limit}")));
        assert_eq!((found.status, found.scope), (Status::Certified, Extent::Global), "{area}: {}", found.message);
        let volume = found.objective.unwrap();
        assert!((volume / (2.0 * 100.0 / 2e5) - 1.0).abs() < 1e-8, "{area}: {volume}");
        assert!(found.message.contains("vanished: r1"), "{area}: {}", found.message);
        assert!(found.lower_bound.unwrap() <= volume && found.x[1] < 1e-9, "{area}: {:?}", found.x);
    }
}

/// Bars that nothing loads but that hold a loaded node are not left out.
#[test]
fn a_bar_that_is_needed_stays() {
    let limit = "[[constraints]]\nname = \"stress\"\nfor = \"ribs\"\nrequire = \"-2e5 <= stress(P) <= 2e5\"\n";
    let down = "[[loads]]\ncase = \"P\"\nnodes = [\"d\"]\nforce = [0, -100]\n";
    let (_, found) = solved("needed", &three_bars("{ lower = 1e-12, upper = 1, start = 1e-3 }", &format!("{down}{limit}")));
    // The middle bar carries the load; without any of the others it could swing.
    assert!((found.objective.unwrap() / (100.0 / 2e5) - 1.0).abs() < 1e-5, "{:?}", found.objective);
    assert!(!found.message.contains("r0, r2"), "{}", found.message);
}

/// Compliance is convex in areas: with free forces Σ N²L/(E·A) is jointly convex and attained at the elastic forces.
#[test]
fn a_limit_on_compliance_alone_is_proved_global() {
    let area = "{ lower = 1e-6, upper = 1, start = 1e-3 }";
    let rest = "[[loads]]\ncase = \"P\"\nnodes = [\"d\"]\nforce = [30, -100]\n[[constraints]]\nname = \"work\"\nrequire = \"compliance(P) <= 0.05\"\n";
    let (_, found) = solved("compliance", &three_bars(area, rest));
    assert_eq!((found.status, found.scope), (Status::Certified, Extent::Global), "{}", found.message);
}

/// Forces follow from equilibrium: N = −P/(2·sin α) in each of two bars, and the sag is Σ N²L/(P·E·A).
#[test]
fn a_determinate_truss_is_a_geometric_program() {
    let (nodes, supports) = ("a = [0, 0]\nb = [2, 0]\nc = [1, 1]", "a = \"pinned\"\nb = \"pinned\"");
    let area = "{ lower = 1e-6, start = 1e-3 }";
    let load = "[[loads]]\ncase = \"P\"\nnodes = [\"c\"]\nforce = [0, -100]\n[combinations]\nU = { P = 1.5 }\n";
    let stress = "[[constraints]]\nname = \"stress\"\nfor = \"ribs\"\nrequire = \"-2e5 <= stress(U) <= 2e5\"\n";
    let (subject, found) =
        solved("two-bars", &truss(nodes, supports, &[("a", "c"), ("b", "c")], area, &format!("{load}{stress}")));
    assert_eq!(subject.class(), Class::GeometricProgram);
    assert_eq!((found.status, found.scope), (Status::Certified, Extent::Global));
    // A = 1.5·P/(√2·σ̄), two bars of length √2.
    assert!((found.objective.unwrap() / (2.0 * 150.0 / 2e5) - 1.0).abs() < 1e-9, "{:?}", found.objective);
    let sag = "[[constraints]]\nname = \"sag\"\nrequire = \"disp(P, c, z) >= -1e-3\"\n";
    let (subject, found) =
        solved("two-bars-sag", &truss(nodes, supports, &[("a", "c"), ("b", "c")], area, &format!("{load}{sag}")));
    assert_eq!((subject.class(), found.scope), (Class::GeometricProgram, Extent::Global));
    // u = P·√2/(E·A) for equal areas.
    assert!((found.objective.unwrap() / (2.0 * 2.0 * 100.0 / (2.1e8 * 1e-3)) - 1.0).abs() < 1e-8, "{:?}", found.objective);
}

/// Written out in forces, a determinate truss has the rows it has when it is analysed.
#[test]
fn formulas_in_forces_are_the_analysis() {
    let nodes = "a = [0, 0]\nb = [4, 0]\nc = [2, 2]\nd = [4.5, 4]";
    let bars = [("a", "b"), ("a", "c"), ("b", "c"), ("c", "d"), ("b", "d")];
    let rest = "[[loads]]\ncase = \"P\"\nnodes = [\"d\"]\nforce = [10, -100]\n[[loads]]\ncase = \"Q\"\nnodes = [\"c\"]\nforce = [7, -50]\n[combinations]
U = { P = 1.35, Q = 1.5 }
[definitions]
sway = \"disp(U, c, x)\"
[[constraints]]
name = \"stress\"
for = \"ribs\"
cases = [\"P\", \"U\"]
require = \"stress(case) <= 1e5\"
[[constraints]]
name = \"force\"
for = \"ribs\"
require = \"abs(force(Q, N, 0.5)) <= 500\"
[[constraints]]
name = \"sway\"
for = \"nodes\"
only = [\"c\", \"d\"]
require = \"disp(U, z) >= -1\"
[[constraints]]
name = \"work\"
require = \"compliance(P) + 0.1*compliance(U) + sway <= 100\"
";
    let text = truss(nodes, "a = \"pinned\"\nb = [\"z\"]", &bars, "{ lower = 1e-6, start = 1e-3 }", rest);
    let x = [1.1e-3, 0.7e-3, 2.3e-3, 0.9e-3, 1.7e-3];
    let [explicit, analysed] = both_ways(problem("trusses", "formulas", &text), &x);
    assert!(explicit.len() > 90, "{}", explicit.len());
    for (name, value) in &explicit {
        assert!((value - analysed[name]).abs() <= 1e-10 * value.abs() + 1e-12, "{name}: {value}, analysed {}", analysed[name]);
    }
}

#[test]
fn an_infeasible_structure_is_explained_by_its_strongest_form() {
    let area = "{ lower = 1e-6, upper = 1e-4, start = 5e-5 }";
    let rest = format!("{SIDEWAYS}[[constraints]]\nname = \"sway\"\nrequire = \"disp(P, d, x) <= 1e-3\"\n");
    let (_, found) = solved("infeasible", &three_bars(area, &rest));
    assert_eq!(found.status, Status::Infeasible);
    assert!(found.message.contains("Even with every variable at its upper bound sway is"), "{}", found.message);
}
