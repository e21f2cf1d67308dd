use super::*;
use crate::mesh::network::read_geometry;
use crate::mesh::solids::SizedRib;

fn source(path: &Path) -> Source {
    Source { path: path.into(), ..Source::default() }
}

#[test]
fn from_mesh_to_problem_to_solids() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["vault", "dome", "shell"] {
        let (mesh, ribs) = (at(&format!("{name}.obj")), at(name));
        let invariants = new_file(name, &mesh).unwrap();
        assert!(check(&source(&mesh)).unwrap().sound);
        let report = ribs_folder(&source(&mesh), 5.0, &ribs::Options::default(), &ribs).unwrap();
        assert_eq!((report.trace.edges, report.problem.lines), (invariants.rib_edges, report.trace.lines));
        assert!((report.problem.length / report.trace.length - 1.0).abs() < 1e-12);

        let geometry = read_geometry(std::fs::File::open(ribs.join("geometry.csv")).unwrap()).unwrap();
        let ring = |h: f64| vec![vec![[-0.05, -h / 2.0], [0.05, -h / 2.0], [0.05, h / 2.0], [-0.05, h / 2.0]]];
        let sized = geometry.into_iter().enumerate().map(|(k, geometry)| SizedRib {
            geometry,
            rings: [ring(0.2), ring(0.3)],
            tags: vec![0.1],
            utilisation: Some((k % 11) as f64 / 10.0),
            model_volume: None,
        });
        let sized: Vec<SizedRib> = sized.collect();
        for out in ["obj", "stl", "vtu"] {
            let report = solids(&sized, &["b".into()], &at(&format!("{name}_solids.{out}"))).unwrap();
            assert!((report.volume / report.prismatoid_volume - 1.0).abs() < 1e-12 && report.largest_difference < 1e-9);
            assert!(report.overlapping_joints > 0 && report.overlap_volume < report.volume);
        }
    }
}

#[test]
fn commands_are_deterministic() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    new_file("dome", &at("dome.obj")).unwrap();
    let run = |out: &str| {
        trace_file(&source(&at("dome.obj")), &at(&format!("{out}.csv"))).unwrap();
        slice_file(&source(&at("dome.obj")), 0.7, &at(&format!("{out}_stations.csv"))).unwrap();
        smooth_file(&source(&at("dome.obj")), smooth::Options::default(), Some(&at("dome.obj")), &at(&format!("{out}.obj")))
            .unwrap();
        [format!("{out}.csv"), format!("{out}_stations.csv"), format!("{out}.obj"), format!("{out}.json")]
            .map(|name| std::fs::read(at(&name)).unwrap())
    };
    assert_eq!(run("first"), run("second"));
}

#[test]
fn defects_stop_a_stage_and_are_what_check_finds() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("folded.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 2 1\n").unwrap();
    let report = check(&source(&path)).unwrap();
    assert!(!report.sound && report.message.contains("face 2"), "{}", report.message);
    assert_eq!((report.kind, report.invariants.triangles), ("polygon mesh", 2));
    let out = folder.path().join("lines.obj");
    assert!(trace_file(&source(&path), &out).is_err() && !out.exists());
    let missing = check(&source(&folder.path().join("no.obj"))).unwrap_err().to_string();
    assert!(missing.contains("no.obj"), "{missing}");
}
