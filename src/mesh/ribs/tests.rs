use super::*;
use crate::mesh::{QuadMesh, generate, stations, trace};

fn network(mesh: crate::mesh::PolygonMesh) -> (QuadMesh, Network) {
    let mesh = QuadMesh::new(mesh).unwrap();
    let lines = stations::slice(&mesh, &trace::trace(&mesh), 0.8).unwrap();
    let network = Network::new(&lines).unwrap();
    (mesh, network)
}

#[test]
fn the_folder_holds_every_rib_once() {
    let (mesh, network) = network(generate::vault(6, 8, 10.0, 12.0, 3.0));
    let folder = tempfile::tempdir().unwrap();
    let report = write_problem(&network, &PolygonMesh::default(), &Options::default(), folder.path()).unwrap();
    let edges: f64 = (0..mesh.edge_count() as u32).map(|e| mesh.edge_length(e)).sum();
    assert!((report.length / edges - 1.0).abs() < 1e-13);
    let ribs = std::fs::read_to_string(folder.path().join("ribs.csv")).unwrap();
    assert_eq!(ribs.lines().count(), report.ribs + 1);
    let sections = std::fs::read_to_string(folder.path().join("sections.csv")).unwrap();
    assert!(sections.starts_with("name,kind,b.lower,b.upper,b.start,h.lower"));
    assert!(toml::from_str::<toml::Table>(&std::fs::read_to_string(folder.path().join("problem.toml")).unwrap()).is_ok());
}

#[test]
fn sag_coefficients_of_a_line_sum_to_that_of_the_beam() {
    // Simply supported, uniform load: ∫ M·m ds = 5 S⁴/384.
    let (_, network) = network(generate::grid(5, 1, 1.3));
    let line: Vec<&Rib> = network.ribs.iter().filter(|rib| (span(rib) - 6.5).abs() < 1e-12).collect();
    let sum: f64 = line.iter().filter(|rib| rib.geometry.line == line[0].geometry.line).map(|rib| sag(rib)).sum();
    assert!((sum / (5.0 * 6.5f64.powi(4) / 384.0) - 1.0).abs() < 1e-3, "{sum}");
}

#[test]
fn senseless_options_are_errors() {
    let (_, network) = network(generate::grid(1, 1, 1.0));
    let folder = tempfile::tempdir().unwrap();
    let error =
        |options: Options| write_problem(&network, &PolygonMesh::default(), &options, folder.path()).unwrap_err().to_string();
    assert_eq!(
        error(Options { load: -1.0, ..Default::default() }),
        "the load must be a positive number, not -1; choose another one"
    );
    let bounds = vec![Bounds { dimension: "tf".into(), lower: 1.0, upper: 2.0, start: 1.0 }];
    assert_eq!(error(Options { bounds, ..Default::default() }), "rectangle has no dimension 'tf'; it has b, h");
}

#[test]
fn a_ring_has_the_sag_of_one_half_wherever_it_begins() {
    let (_, network) = network(generate::cube(3));
    let rings: Vec<&Rib> = network.ribs.iter().filter(|rib| rib.closed).collect();
    for line in ["L13", "L18"] {
        let own = rings.iter().filter(|rib| rib.geometry.line == line);
        let (sum, span) = own.fold((0.0, 0.0), |(sum, _), rib| (sum + sag(rib), span(rib)));
        assert!((sum / (5.0 * span.powi(4) / 384.0) - 1.0).abs() < 1e-12, "{line}: {sum}");
    }
    let is_same = |pair: &[&Rib]| (sag(pair[0]) / sag(pair[1]) - 1.0).abs() < 1e-14;
    assert!(rings.windows(2).all(is_same), "every part of a ring has the same weight, but for the rounding of its length");
}

#[test]
fn units_leave_the_same_bounds_and_loads() {
    for unit in Unit::ALL {
        let (own, metres) = (Options::with_unit(SectionKind::parse("tube").unwrap(), Some(unit)), unit.metres());
        let same = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
        same(own.thickness * metres, 0.004);
        same(own.load / metres, 5.0);
        same(own.elastic_modulus / (metres * metres), 210e6);
        assert_eq!(Unit::parse(unit.name()), Some(unit));
        let superellipse = SectionKind::parse("superellipse").unwrap().dimensions(unit);
        same(superellipse[0].lower * metres, 0.01);
        assert_eq!(superellipse[2].lower, 2.5);
    }
}
