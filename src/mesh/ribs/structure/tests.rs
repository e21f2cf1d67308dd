use super::*;
use crate::mesh::network::Network;
use crate::mesh::ribs::SectionKind;
use crate::mesh::{QuadMesh, generate, quality, stations, trace};

fn network(mesh: &PolygonMesh) -> Network {
    let mesh = QuadMesh::new(mesh.clone()).unwrap();
    Network::new(&stations::slice(&mesh, &trace::trace(&mesh), f64::INFINITY).unwrap()).unwrap()
}

fn written(mesh: &PolygonMesh, structure: &Structure) -> Result<(Files, StructureReport, usize), RibsError> {
    let options = Options::default();
    files(&network(mesh), mesh, &options, structure, &SectionKind::default().dimensions(Unit::Metre))
}

fn file(files: &Files, name: &str) -> String {
    String::from_utf8(files.iter().find(|(own, _)| *own == name).unwrap().1.clone()).unwrap()
}

#[test]
fn loads_add_up_to_area_times_pressure() {
    for mesh in [generate::vault(6, 8, 10.0, 12.0, 3.0), generate::dome(4, 6.0, 4.0), generate::shell(6, 8)] {
        let structure = Structure { dead: 0.7, snow: 1.3, ..Structure::with_unit(None) };
        let (files, report, _) = written(&mesh, &structure).unwrap();
        let area = quality::area(&QuadMesh::new(mesh.clone()).unwrap());
        assert!((report.area / area - 1.0).abs() < 1e-13);
        let loads = file(&files, "loads.csv");
        for (case, expected) in [("dead", 0.7 * area), ("snow", 1.3 * report.plan_area)] {
            let own = loads.lines().filter(|line| line.starts_with(case)).map(|line| line.rsplit(',').next().unwrap());
            let sum: f64 = own.map(|number| number.parse::<f64>().unwrap()).sum();
            assert!((sum / -expected - 1.0).abs() < 1e-12, "{case}: {sum} {expected}");
        }
    }
}

#[test]
fn supports_are_the_boundary_the_lowest_or_those_named() {
    let mesh = generate::vault(6, 8, 10.0, 12.0, 3.0);
    let count = |held: Held| {
        let (files, report, _) = written(&mesh, &Structure { held, ..Structure::with_unit(None) }).unwrap();
        assert_eq!(file(&files, "supports.csv").lines().count(), report.supports + 1);
        report.supports
    };
    assert_eq!(count(Held::Boundary), 2 * (6 + 8));
    // Both springings.
    assert_eq!(count(Held::Lowest), 2 * 9);
    assert_eq!(count(Held::Named(vec!["v1".into(), "v6*".into()])), 2);
}

#[test]
fn what_makes_no_sense_is_told_with_what_to_do() {
    let mesh = generate::vault(2, 2, 4.0, 4.0, 1.0);
    let error = |structure: Structure| written(&mesh, &structure).unwrap_err().to_string();
    let base = || Structure::with_unit(None);
    let unknown = error(Structure { held: Held::Named(vec!["w1".into()]), ..base() });
    assert!(unknown.contains("w1") && unknown.contains("v1"), "{unknown}");
    assert!(error(Structure { snow: -1.0, ..base() }).contains("the snow load"));
    assert!(error(Structure { poisson: 0.7, ..base() }).contains("0.7"));
    let cube = written(&generate::cube(2), &base()).unwrap_err().to_string();
    assert!(cube.contains("--supports"), "{cube}");
}

#[test]
fn units_leave_the_same_structure() {
    let (metres, millimetres) = (Structure::with_unit(None), Structure::with_unit(Some(Unit::Millimetre)));
    let same = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
    same(millimetres.dead * 1e6, metres.dead);
    same(millimetres.density * 1e9, metres.density);
    same(millimetres.strength * 1e6, metres.strength);
}
