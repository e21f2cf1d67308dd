//! What reconstruction promises (docs/meshes.md), over generated meshes: cells removed at random, holes of every shape, warped, in
//! millimetres and in kilometres.

use proptest::prelude::*;
use ribopt::mesh::reconstruct::{Options, Report, reconstruct};
use ribopt::mesh::{PolygonMesh, QuadMesh, Vector, generate, invariants};

/// A surface, its size in units, cells the original leaves open, further cells the mesh is missing.
#[derive(Debug, Clone)]
struct Case {
    surface: usize,
    scale: f64,
    holes: Vec<usize>,
    missing: Vec<usize>,
}

fn surface(kind: usize) -> PolygonMesh {
    let mut mesh = match kind {
        0 => generate::grid(7, 6, 1.0),
        1 => generate::vault(8, 7, 8.0, 7.0, 2.0),
        2 => generate::dome(6, 5.0, 3.0),
        3 => generate::shell(3, 4),
        4 => generate::cube(4),
        _ => generate::grid(7, 6, 1.0),
    };
    if kind == 5 {
        // Warped and skewed.
        for p in &mut mesh.vertices {
            let (x, y) = (p.x, p.y);
            *p = Vector::new(x + 0.3 * (1.3 * y).sin(), y + 0.25 * (1.7 * x).cos(), 0.15 * x * y + 0.3 * (x - y).sin());
        }
    }
    mesh
}

/// Single cells, and blocks that make holes and notches of many shapes.
fn cells() -> impl Strategy<Value = Vec<usize>> {
    let block = (0usize..60, 1usize..4, 1usize..4)
        .prop_map(|(at, w, h)| (0..w).flat_map(move |i| (0..h).map(move |j| at + i + 7 * j)).collect::<Vec<_>>());
    prop::collection::vec(block, 0..4).prop_map(|blocks| blocks.concat())
}

fn case() -> impl Strategy<Value = Case> {
    (0usize..6, prop::sample::select(vec![1.0, 1e3, 1e-3]), cells(), cells()).prop_map(|(surface, scale, holes, missing)| Case {
        surface,
        scale,
        holes,
        missing,
    })
}

impl Case {
    fn mesh(&self, gone: &[&[usize]]) -> PolygonMesh {
        let whole = surface(self.surface);
        let is_gone = |f: usize| gone.iter().any(|cells| cells.contains(&f));
        let kept: Vec<[u32; 4]> =
            whole.faces().enumerate().filter(|(f, _)| !is_gone(*f)).filter_map(|(_, face)| face.try_into().ok()).collect();
        PolygonMesh::from_quads(whole.vertices.iter().map(|p| p * self.scale).collect(), &kept)
    }

    /// The mesh and the original, where both are clean.
    fn pair(&self) -> Option<(QuadMesh, PolygonMesh)> {
        let original = self.mesh(&[&self.holes]);
        QuadMesh::new(original.clone()).ok()?;
        Some((QuadMesh::new(self.mesh(&[&self.holes, &self.missing])).ok()?, original))
    }
}

fn area(mesh: &QuadMesh) -> f64 {
    invariants::measure(mesh).area
}

fn same(a: &QuadMesh, b: &QuadMesh) -> bool {
    a.faces() == b.faces() && a.positions == b.positions
}

/// No vertex goes farther than the tolerance; what comes out is a clean mesh; again changes nothing.
fn keeps_its_promises(
    began: &QuadMesh,
    ended: &QuadMesh,
    original: &PolygonMesh,
    report: &Report,
    options: Options,
) -> Result<(), TestCaseError> {
    for (a, b) in began.positions.iter().zip(&ended.positions) {
        prop_assert!((a - b).norm() <= report.tolerance * (1.0 + 1e-12), "moved {} of {}", (a - b).norm(), report.tolerance);
        let stays = original.vertices.contains(a);
        prop_assert!(!stays || a == b, "a vertex left the original's");
    }
    prop_assert!(QuadMesh::new(ended.to_polygons()).is_ok());
    let (again, second) = reconstruct(ended.clone(), original, options).unwrap();
    prop_assert!(same(ended, &again), "{:?}", second.actions);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, ..ProptestConfig::default() })]

    /// A mesh held against itself stays as it is, whatever holes it has.
    #[test]
    fn against_itself_nothing_changes(case in case(), coarse in 0.01f64..3.0) {
        let Ok(mesh) = QuadMesh::new(case.mesh(&[&case.holes])) else { return Ok(()) };
        for tolerance in [None, Some(coarse * case.scale)] {
            let (same_mesh, report) = reconstruct(mesh.clone(), &mesh.to_polygons(), Options { tolerance, ..Options::default() }).unwrap();
            prop_assert!(same(&mesh, &same_mesh), "{:?}", report.actions);
            prop_assert!(report.open.is_empty(), "{:?}", report.open);
        }
    }

    /// Cells that are missing come back or are told, and nothing else is added.
    #[test]
    fn missing_cells_come_back_or_are_told(case in case()) {
        let Some((mesh, original)) = case.pair() else { return Ok(()) };
        let whole = area(&QuadMesh::new(original.clone()).unwrap());
        let Ok((ended, report)) = reconstruct(mesh.clone(), &original, Options::default()) else { return Ok(()) };
        keeps_its_promises(&mesh, &ended, &original, &report, Options::default())?;
        let found = area(&ended);
        prop_assert!(found <= whole * (1.0 + 1e-2), "{found} of {whole}");
        prop_assert!(found >= area(&mesh) * (1.0 - 1e-12));
        if report.open.is_empty() && report.faces_added + mesh.face_count() == original.face_count() {
            prop_assert!((found / whole - 1.0).abs() < 1e-2, "{found} of {whole}");
        }
    }

    /// The same with vertices off the original.
    #[test]
    fn noisy_meshes_keep_the_promises_too(case in case(), seed in any::<u32>(), tolerance in 0.02f64..0.6) {
        let Some((mut mesh, original)) = case.pair() else { return Ok(()) };
        let mut state = u64::from(seed);
        let mut noise = || {
            // Knuth's MMIX generator; its upper bits as a number in ±0.05.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as f64 / f64::from(1u32 << 24) - 0.5) * 0.1
        };
        for p in &mut mesh.positions {
            *p += Vector::new(noise(), noise(), noise()) * case.scale;
        }
        let Ok(mesh) = QuadMesh::new(mesh.to_polygons()) else { return Ok(()) };
        let options = Options { tolerance: Some(tolerance * case.scale), ..Options::default() };
        let Ok((ended, report)) = reconstruct(mesh.clone(), &original, options) else { return Ok(()) };
        keeps_its_promises(&mesh, &ended, &original, &report, options)?;
    }

    /// Units do not matter.
    #[test]
    fn scaled_by_powers_of_two_the_same_is_done(case in case()) {
        let at = |scale: f64| Case { scale, ..case.clone() }.pair();
        let (Some((small, first)), Some((large, second))) = (at(1.0), at(1024.0)) else { return Ok(()) };
        let run = |mesh, original: &PolygonMesh| reconstruct(mesh, original, Options::default()).ok().map(|done| done.0.faces().to_vec());
        prop_assert_eq!(run(small, &first), run(large, &second));
    }
}
