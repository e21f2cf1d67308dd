use super::*;
use crate::mesh::generate;

/// A closed torus of 12 × 12 quads.
fn torus() -> QuadMesh {
    let n = 12u32;
    let point = |i: u32, j: u32| {
        let (u, v) = (f64::from(i) * std::f64::consts::TAU / 12.0, f64::from(j) * std::f64::consts::TAU / 12.0);
        Vector::new((3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin())
    };
    let at = |i: u32, j: u32| (i % n) + n * (j % n);
    let quad = |k: u32| (k % n, k / n);
    let quads: Vec<[u32; 4]> =
        (0..n * n).map(quad).map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]).collect();
    let vertices = (0..n * n).map(quad).map(|(i, j)| point(i, j)).collect();
    QuadMesh::new(PolygonMesh::from_quads(vertices, &quads)).unwrap()
}

/// The height in the middle of a grid whose heights began as a checkerboard of ±1. The boundary is fixed, but what it does
/// needs eight steps to reach the middle.
fn middle_height(method: Method, relaxation: f64) -> f64 {
    let mut grid = generate::grid(16, 16, 1.0);
    for (k, p) in grid.vertices.iter_mut().enumerate() {
        p.z = if (k % 17 + k / 17).is_multiple_of(2) { 1.0 } else { -1.0 };
    }
    let mut mesh = QuadMesh::new(grid).unwrap();
    smooth(&mut mesh, Options { method, relaxation, iterations: 7, ..Default::default() }, None).unwrap();
    mesh.positions[8 * 17 + 8].z
}

#[test]
fn the_notes_full_step_keeps_the_checkerboard_and_the_others_do_not() {
    assert_eq!(middle_height(Method::Laplacian, 1.0), -1.0, "seven steps with the eigenvalue −1");
    assert_eq!(middle_height(Method::Laplacian, Options::default().relaxation), 0.0);
    assert!(middle_height(Method::Laplacian, 0.8).abs() < 0.03);
    assert!(middle_height(Method::GaussSeidel, 1.0).abs() < 0.1);
    assert!(middle_height(Method::Taubin { mu: -0.53 }, 0.5).abs() < 1e-4);
}

#[test]
fn taubin_shrinks_far_less_than_the_laplacian() {
    let shrinkage = |method| {
        let mut mesh = torus();
        let report = smooth(&mut mesh, Options { method, iterations: 10, ..Default::default() }, None).unwrap();
        let [before, after] = report.volume.unwrap();
        1.0 - after / before
    };
    let (laplacian, taubin) = (shrinkage(Method::Laplacian), shrinkage(Method::Taubin { mu: -0.53 }));
    assert!(laplacian > 0.4 && taubin.abs() < 0.1, "{laplacian} {taubin}");
}

#[test]
fn boundaries_stay_or_slide_along_themselves_and_corners_stay() {
    let mut grid = generate::grid(6, 6, 1.0);
    grid.vertices[2].x = 2.7;
    grid.vertices[24] += Vector::new(0.3, 0.2, 0.4);
    let mut kept = QuadMesh::new(grid.clone()).unwrap();
    let report = smooth(&mut kept, Options::default(), None).unwrap();
    assert_eq!((report.free, report.sliding, report.fixed), (25, 0, 24));
    assert_eq!(kept.positions[2], grid.vertices[2]);

    let mut slid = QuadMesh::new(grid.clone()).unwrap();
    let options = Options { curves: Curves::Slide, iterations: 200, ..Default::default() };
    let report = smooth(&mut slid, options, None).unwrap();
    assert_eq!((report.free, report.sliding, report.fixed), (25, 20, 4));
    assert_eq!(slid.positions[2].y, 0.0);
    assert!((slid.positions[2].x - 2.0).abs() < 1e-3, "{}", slid.positions[2]);
    assert_eq!(slid.positions[6], grid.vertices[6]);
}

#[test]
fn creases_are_kept_and_projection_holds_the_surface() {
    let cube = generate::cube(4);
    let features = FeatureOptions { crease: Some(0.7), ..Default::default() };
    let mut mesh = QuadMesh::new(cube.clone()).unwrap();
    let report = smooth(&mut mesh, Options { features, ..Default::default() }, None).unwrap();
    assert!(report.largest_move < 1e-15 && report.fixed == 8 + 12 * 3);

    let dome = generate::dome(8, 6.0, 4.0);
    let mut mesh = QuadMesh::new(dome.clone()).unwrap();
    let surface = Surface::of_faces(&dome);
    smooth(&mut mesh, Options::default(), Some(&surface)).unwrap();
    assert!(mesh.positions.iter().all(|p| surface.distance(p) < 1e-12));
}

#[test]
fn impossible_options_are_errors() {
    let mut mesh = QuadMesh::new(generate::grid(2, 2, 1.0)).unwrap();
    let with = |relaxation, method| Options { relaxation, method, ..Default::default() };
    for options in [with(0.0, Method::Laplacian), with(1.5, Method::Laplacian), with(f64::NAN, Method::GaussSeidel)] {
        assert!(matches!(smooth(&mut mesh, options, None), Err(SmoothError::Relaxation(_))));
    }
    assert!(matches!(smooth(&mut mesh, with(0.5, Method::Taubin { mu: -0.4 }), None), Err(SmoothError::Mu { .. })));
}
