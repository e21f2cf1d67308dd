//! Buckling lengths by the structure's own factor.

use ribopt::run::Subject;
use ribopt::run::check::check;

use super::{Bar, in_repository, largest};

/// A cantilever buckles like a rib of twice its length about its weaker axis; four pieces overestimate its critical force by 5.1e-4 at most.
#[test]
fn a_cantilever_has_twice_its_length() {
    let resistance = |length: &str| {
        let check = format!(
            "code = \"EN 1993-1-1\"\nfy = \"material.fy\"\ngamma_M1 = 1\nstress_unit = 1\nweb = \"compression\"\nclass = 3\n\
             buckling = {{ y = \"held\", z = {{ length = \"{length}\", curve = \"c\" }} }}"
        );
        let bar = Bar {
            length: 2e3,
            forces: [500e3, 0.0, 0.0],
            kind: "h-beam",
            dimensions: "tw = 10\nhw = 200\nb = 200\ntf = { lower = 4, upper = 60, start = 20 }",
            check: &check,
            minimize: "volume",
        };
        500e3 - largest(&bar.subject(), "6.3.1 z")
    };
    let (system, twice) = (resistance("system"), resistance("2*length"));
    assert!(system >= twice && system <= twice * (1.0 + 6e-4), "{system} {twice}");
}

#[test]
fn derivatives_go_through_the_factor() {
    let portal = std::fs::read_to_string(in_repository("problems/portal-ec3.toml")).unwrap();
    let portal = portal.replacen("length = \"2.6*length\"", "length = \"system\"", 1);
    let subject = Subject::of_text("portal.toml", &portal).unwrap_or_else(|error| panic!("{error}"));
    let found = check(&subject).unwrap();
    assert!(found.disagreements == 0 && found.compared > 1000, "{found:?}");
}
