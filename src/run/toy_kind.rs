//! A kind that only one file and its line in the table know is used everywhere: new, check, solve, bounds, section, the schema, mesh ribs.

use super::bounds::bounds;
use super::choice::choose;
use super::network::Network as Placed;
use super::section::by_kind;
use super::{Subject, solve};
use crate::crosscheck::Status;
use crate::mesh::network::Network;
use crate::mesh::ribs::{Options, SectionKind, write_problem};
use crate::mesh::{QuadMesh, generate, stations, trace};
use crate::{input, sections};

const KIND: &str = "diamond";

#[test]
fn its_example_is_read_solved_and_certified() {
    let example = input::example(Some(KIND)).unwrap();
    let subject = Subject::of_text("diamond.toml", &example).unwrap_or_else(|error| panic!("{error}"));
    let outcome = solve::outcome(&subject).unwrap();
    assert_eq!(outcome.status, Status::Certified, "{}", outcome.message);
    // Ix = p·q³/48 with q = 5p at the limit of slenderness.
    let p = (48e-5 / 125.0_f64).powf(0.25);
    assert!((outcome.x[0] / p - 1.0).abs() < 1e-6 && (outcome.x[1] / (5.0 * p) - 1.0).abs() < 1e-6, "{:?}", outcome.x);
}

#[test]
fn the_schema_and_the_section_command_know_it() {
    assert!(input::schema().to_string().contains(KIND));
    let section = by_kind(KIND, "p=0.2, q=0.3", None).unwrap();
    assert!((section.value("A").unwrap() - 0.03).abs() < 1e-15);
    let error = by_kind(KIND, "p=0.2", None).unwrap_err().to_string();
    assert!(error.contains("p, q"), "{error}");
}

#[test]
fn bounds_asks_it_why() {
    let maximised = input::example(Some(KIND)).unwrap().replacen("[sections.s]", "maximize = \"volume\"\n[sections.s]", 1);
    let subject = Subject::of_text("diamond.toml", &maximised).unwrap_or_else(|error| panic!("{error}"));
    let choices = choose(&[], None, &subject.settings).unwrap();
    let ends = bounds(&subject, &choices, None).ends.unwrap();
    assert!(
        ends.iter().all(|end| end.reason.as_deref().is_some_and(|reason| reason.ends_with("cuts like a diamond"))),
        "{ends:?}"
    );
}

#[test]
fn ribs_of_a_mesh_can_be_made_of_it() {
    let kind = SectionKind::parse(KIND).unwrap();
    let mesh = QuadMesh::new(generate::grid(2, 1, 2.0)).unwrap();
    let network = Network::new(&stations::slice(&mesh, &trace::trace(&mesh), 3.0).unwrap()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    write_problem(&network, &crate::mesh::PolygonMesh::default(), &Options::of(kind), folder.path()).unwrap();
    let file = folder.path().join("problem.toml");
    let subject = Subject::read(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    let outcome = solve::outcome(&subject).unwrap();
    assert_eq!(outcome.status, Status::Certified, "{}", outcome.message);
    let placed = Placed::beside(&file, subject.problem()).unwrap();
    let solids = placed.sized(&subject, &outcome.x).unwrap().write_solids(&folder.path().join("solids.obj")).unwrap();
    assert!(solids.largest_difference < 1e-12, "{solids:?}");
}

#[test]
fn every_kind_has_properties_that_every_section_has() {
    // Sections of kind `general` have the numbers they are given.
    for kind in sections::KINDS.iter().filter(|kind| kind.has_rings()) {
        for name in ["A", "Ix", "Iy", "Wx", "Wy", "width", "height"] {
            assert!(kind.properties().contains(&name), "{} lacks {name}", kind.name());
        }
    }
}
