use proptest::prelude::*;

use super::*;
use crate::mesh::{Vector, generate, invariants};

fn without(mesh: &PolygonMesh, gone: &[usize]) -> QuadMesh {
    let kept: Vec<[u32; 4]> =
        mesh.faces().enumerate().filter(|(f, _)| !gone.contains(f)).filter_map(|(_, face)| face.try_into().ok()).collect();
    QuadMesh::new(PolygonMesh::from_quads(mesh.vertices.clone(), &kept)).unwrap()
}

fn run(mesh: QuadMesh, original: &PolygonMesh) -> (QuadMesh, Report) {
    reconstruct(mesh, original, Options::default()).unwrap()
}

#[test]
fn a_missing_corner_cell_is_refilled() {
    let plate = generate::grid(4, 3, 1.0);
    let (mesh, report) = run(without(&plate, &[0]), &plate);
    assert_eq!((mesh.face_count(), report.faces_added, report.vertices_added), (12, 1, 1));
    assert_eq!(report.euler_characteristic, [1, 1]);
    assert!(report.hausdorff.distance < 1e-15);
}

#[test]
fn a_hole_of_two_by_one_takes_exactly_two_quads() {
    let plate = generate::grid(5, 4, 1.0);
    let (_, report) = run(without(&plate, &[6, 7]), &plate);
    assert_eq!((report.faces_added, report.vertices_added, report.euler_characteristic), (2, 0, [0, 1]));
    let rules: Vec<Rule> =
        report.actions.iter().filter_map(|a| if let Action::Filled { rule, .. } = a { Some(*rule) } else { None }).collect();
    assert_eq!(rules, [Rule::TwoConcave, Rule::LoopOfFour]);
}

#[test]
fn larger_holes_on_curved_surfaces_are_filled_and_snapped() {
    let dome = generate::dome(10, 6.0, 4.0);
    let (mesh, report) = run(without(&dome, &[33, 34, 35, 43, 44, 45, 53, 54, 55]), &dome);
    assert_eq!((report.faces_added, report.vertices_added, report.unfilled_loops), (9, 4, 0));
    assert_eq!(report.euler_characteristic, [0, 1]);
    assert_eq!(report.snapped_to_vertices, 0, "new vertices are placed on the original's: {:?}", report.actions);
    assert!(report.hausdorff.distance < 1e-12, "{:?}", report.hausdorff);
    assert!(invariants::measure(&mesh).valence_identity);
}

#[test]
fn an_l_shaped_plate_and_a_lone_quad_stay_as_they_are() {
    let l = without(&generate::grid(4, 4, 1.0), &[10, 11, 14, 15]);
    let original = l.to_polygons();
    assert_eq!(run(l, &original).1.faces_added, 0);
    let quad = generate::grid(1, 1, 1.0);
    assert_eq!(run(without(&quad, &[]), &quad).1.faces_added, 0);
}

#[test]
fn a_shell_with_branches_is_not_filled_between_its_arms() {
    let shell = generate::shell(4, 6);
    let (_, report) = run(without(&shell, &[]), &shell);
    assert_eq!((report.faces_added, report.actions.len()), (0, 0), "{:?}", report.actions);
}

#[test]
fn an_odd_hole_is_an_error_that_names_it() {
    // A ring of five quads around a pentagon.
    let ring = |r: f64| {
        (0..5)
            .map(move |k| (f64::from(k) * std::f64::consts::TAU / 5.0, r))
            .map(|(t, r)| Vector::new(r * t.cos(), r * t.sin(), 0.0))
    };
    let vertices: Vec<Vector> = ring(1.0).chain(ring(2.0)).collect();
    let quads: Vec<[u32; 4]> = (0..5u32).map(|k| [k, k + 5, (k + 1) % 5 + 5, (k + 1) % 5]).collect();
    let mesh = QuadMesh::new(PolygonMesh::from_quads(vertices, &quads)).unwrap();
    let mut disc = PolygonMesh::default();
    disc.vertices = ring(2.0).collect();
    disc.push_face(&[0, 1, 2, 3, 4]);
    let error = reconstruct(mesh.clone(), &disc, Options::default()).unwrap_err().to_string();
    assert!(error.contains("boundary loop") && error.contains("has 5 edges"), "{error}");
    // The same ring, where the original has that hole, is no error.
    assert!(reconstruct(mesh.clone(), &mesh.to_polygons(), Options::default()).is_ok());
}

#[test]
fn the_closer_of_two_wins_and_flips_are_undone() {
    let original = generate::grid(3, 1, 1.0);
    let mut mesh = generate::grid(3, 1, 1.0);
    mesh.vertices[1].x = 1.6;
    mesh.vertices[2].x = 1.9;
    let options = Options { tolerance: Some(0.45), ..Default::default() };
    let (mesh, report) = reconstruct(without(&mesh, &[]), &original, options).unwrap();
    assert_eq!((mesh.positions[1].x, mesh.positions[2].x), (1.6, 2.0));
    assert_eq!(report.snapped_to_vertices, 1);

    let mut mesh = generate::grid(3, 1, 1.0);
    (mesh.vertices[1].x, mesh.vertices[2].x) = (1.2, 1.4);
    let mut original = original;
    (original.vertices[1].x, original.vertices[2].x) = (1.5, 1.05);
    original.vertices[2].y = -0.2;
    let (mesh, report) = reconstruct(without(&mesh, &[]), &original, options).unwrap();
    let faces = 0..mesh.face_count() as u32;
    assert!(faces.into_iter().all(|f| mesh.vector_area(f).z > 0.0), "{report:?}");
}

proptest! {
    #[test]
    fn twice_equals_once(gone in prop::collection::btree_set(0usize..100, 0..12), noise in prop::collection::vec(-0.03f64..0.03, 363)) {
        let vault = generate::vault(10, 10, 8.0, 8.0, 2.0);
        let kept: Vec<[u32; 4]> = vault.faces().enumerate().filter(|(f, _)| !gone.contains(f)).filter_map(|(_, f)| f.try_into().ok()).collect();
        let mut mesh = PolygonMesh::from_quads(vault.vertices.clone(), &kept);
        for (k, p) in mesh.vertices.iter_mut().enumerate() {
            *p += Vector::new(noise[3 * k], noise[3 * k + 1], noise[3 * k + 2]);
        }
        let Ok(mesh) = QuadMesh::new(mesh) else { return Ok(()) };
        let Ok((once, _)) = reconstruct(mesh, &vault, Options::default()) else { return Ok(()) };
        let (twice, report) = reconstruct(once.clone(), &vault, Options::default()).unwrap();
        prop_assert_eq!(once.faces(), twice.faces());
        let moved = once.positions.iter().zip(&twice.positions).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        prop_assert!(moved == 0.0, "moved {} {:?}", moved, report.actions);
    }
}
