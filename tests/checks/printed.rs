//! What is printed of checks, and their derivatives.

use std::process::Command;

use ribopt::run::Subject;
use ribopt::run::check::check;

use super::{Bar, in_repository};

const EULER: &str = "code = \"Euler\"\nsafety = 2\nbuckling = { y = { length = \"2*length\" }, z = \"held\" }";

fn bar(check: &str) -> Bar<'_> {
    let dimensions = "b = 60\nh = { lower = 20, upper = 300, start = 100 }";
    Bar { length: 3e3, forces: [10e3, 0.0, 0.0], kind: "rectangle", dimensions, check, minimize: "volume" }
}

fn ribopt(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_ribopt")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn rows_are_printed_with_all_that_was_assumed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bar.toml");
    std::fs::write(&file, bar(EULER).text()).unwrap();
    let printed = ribopt(&["check", file.to_str().unwrap(), "--rows"]);
    let wanted = "
check k: Euler's critical force, N ≤ π²EI/L² about both axes: design aid, not certification
  ribs: bar
  cases = \"P\"
  safety = 2
  buckling = { y = { length = \"2*length\" }, z = \"held\" }
  Euler y (1 row; bar): 2*N <= N_cr_y
      N = -force('P', N, 0)
      N_cr_y = pi^2*material.E*from.Ix/(2*length)^2
derivatives:";
    assert!(printed.contains(wanted), "{printed}");
}

#[test]
fn every_report_names_the_edition_and_what_it_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let file = in_repository("problems/portal-ec3.toml");
    let out = folder.path().join("out");
    let summary = ribopt(&["solve", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    let title =
        "check columns: EN 1993-1-1:2005, 6.3.1, 6.3.2.2, 6.3.3 with Annex B, Table 5.2 class 2: design aid, not certification";
    assert!(summary.contains(title), "{summary}");
    let result: serde_json::Value = serde_json::from_slice(&std::fs::read(out.join("result.json")).unwrap()).unwrap();
    assert_eq!(result["status"], "certified");
    let check = &result["checks"][0];
    assert_eq!((&check["name"], &check["note"]), (&"columns".into(), &"design aid, not certification".into()));
    assert!(check["code"].as_str().unwrap().starts_with("EN 1993-1-1:2005"));
    let assumed = |wanted: &str| check["assumptions"].as_array().unwrap().iter().any(|one| one == wanted);
    assert!(assumed("gamma_M1 = 1.0"));
    assert!(assumed("left and 1 more: k_yy as for lambda_y above 1, k_zz as for lambda_z at most 1, as at the start"), "{check}");
}

#[test]
fn derivatives_are_exact_of_uniform_and_tapered_ribs() {
    let portal = std::fs::read_to_string(in_repository("problems/portal-ec3.toml")).unwrap();
    // Columns that taper, and loads along all ribs: every station counts.
    let tapered = portal.replacen("section = \"leg\"", "from = \"leg\"\nto = \"girder\"", 1);
    for text in [&portal, &tapered] {
        let subject = Subject::of_text("portal.toml", text).unwrap_or_else(|error| panic!("{error}"));
        let found = check(&subject).unwrap();
        assert!(found.disagreements == 0 && found.compared > 1000, "{found:?}");
    }
    let subject = Subject::of_text("portal.toml", &tapered).unwrap_or_else(|error| panic!("{error}"));
    assert!(subject.warnings.iter().any(|warning| warning.contains("is tapered, and 6.3.1 to 6.3.3 are for uniform members")));
}

/// A root radius of 0 is none, to the bit.
#[test]
fn a_root_radius_of_zero_changes_nothing() {
    let bar = |radius: &str| {
        let dimensions = format!("tw = 10\nhw = 200\nb = 200\ntf = {{ lower = 4, upper = 60, start = 20 }}\n{radius}");
        let en = "code = \"EN 1993-1-1\"\nfy = \"material.fy\"\ngamma_M1 = 1\nstress_unit = 1\nweb = \"bending\"\nclass = 3\n\
            buckling = { y = { length = 2000, curve = \"b\" }, z = { length = 4000, curve = \"c\" } }";
        let of =
            Bar { length: 4e3, forces: [1e6, 0.0, 0.0], kind: "h-beam", dimensions: &dimensions, check: en, minimize: "volume" };
        super::rows(&of.subject())
    };
    assert_eq!(bar(""), bar("r = 0"));
    assert_ne!(bar(""), bar("r = 10"));
}
