use proptest::prelude::*;

use super::*;
use crate::mesh::network::RibGeometry;
use crate::mesh::solids::{Ring, SizedRib, loft, prismatoid_volume};
use crate::mesh::stations::Frame;
use crate::mesh::{Vector, generate};

fn solid(rings: [Vec<Ring>; 2], length: f64) -> PolygonMesh {
    let ends = [Vector::zeros(), Vector::z() * length];
    let frame = Frame { x: Vector::z(), y: Vector::x(), z: Vector::y() };
    let geometry = RibGeometry { name: "a".into(), line: "L1".into(), ends, frame, joints: [0, 1] };
    loft(&SizedRib { geometry, rings, tags: Vec::new(), utilisation: None, model_volume: None }).unwrap()
}

fn at(z: f64) -> Plane {
    Plane::facing(Vector::new(0.0, 0.0, z), Vector::z()).unwrap()
}

fn total_area(solid: &PolygonMesh, z: f64) -> f64 {
    cut(solid, &at(z)).unwrap().iter().map(|piece| piece.properties.area).sum()
}

fn tapered_h() -> [Vec<Ring>; 2] {
    let h = |tw: f64, hw: f64, b: f64, h: f64| {
        let (w, y, x, top) = (tw / 2., hw / 2., b / 2., h / 2.);
        let right = [[x, -top], [x, -y], [w, -y], [w, y], [x, y], [x, top]];
        vec![right.into_iter().chain(right.iter().rev().map(|p| [-p[0], p[1]])).collect()]
    };
    [h(8., 180., 100., 200.), h(6., 100., 60., 130.)]
}

#[test]
fn the_tapered_h_has_one_volume_by_mesh_prismatoid_and_simpson() {
    let rings = tapered_h();
    let solid_mesh = solid(rings.clone(), 1000.0);
    // Ten Simpson panels, ends approached from inside: the planes of the caps are coplanar faces.
    let inside = |k: u32| (f64::from(k) * 50.0).clamp(1e-9, 1000.0 - 1e-9);
    let weight = |k: u32| if k == 0 || k == 20 { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    let simpson: f64 = (0..=20).map(|k| weight(k) * total_area(&solid_mesh, inside(k))).sum::<f64>() * 50.0 / 3.0;
    for volume in [solid_mesh.volume(), prismatoid_volume(&rings, 1000.0), simpson] {
        assert!((volume / 2_960_000.0 - 1.0).abs() < 1e-12, "{volume}");
    }
    let root = |p: f64, q: f64| 1000.0 / 3.0 * (p + q + (p * q).sqrt());
    let frustum = root(8. * 180., 6. * 100.) + root(100. * 20., 60. * 30.);
    assert!((frustum - 2_888_960.87).abs() < 0.005);
}

#[test]
fn the_section_of_the_h_has_its_moments() {
    let piece = &cut(&solid(tapered_h(), 1000.0), &at(1e-7)).unwrap()[0];
    let ix = (100.0 * 200f64.powi(3) - 92.0 * 180f64.powi(3)) / 12.0;
    assert!((piece.properties.ix / ix - 1.0).abs() < 1e-8 && piece.properties.centroid[1].abs() < 1e-9);
}

#[test]
fn holes_are_taken_off() {
    let square = |s: f64| vec![[-s, -s], [s, -s], [s, s], [-s, s]];
    let tube = vec![square(2.0), square(1.0).into_iter().rev().collect()];
    let pieces = cut(&solid([tube.clone(), tube], 3.0), &at(1.0)).unwrap();
    assert_eq!((pieces.len(), pieces[0].properties.holes, pieces[0].properties.area), (1, 1, 12.0));
}

#[test]
fn coplanar_faces_open_chains_and_inside_out_solids_are_errors() {
    let cube = generate::cube(2);
    assert_eq!(cut(&cube, &at(0.0)).unwrap_err(), SectionError::Coplanar(17));
    let mut open = PolygonMesh::default();
    let mut inverted = PolygonMesh::default();
    (open.vertices, inverted.vertices) = (cube.vertices.clone(), cube.vertices.clone());
    cube.faces().skip(1).for_each(|face| open.push_face(face));
    cube.faces().for_each(|face| inverted.push_face(&face.iter().rev().copied().collect::<Vec<_>>()));
    assert!(matches!(cut(&open, &at(0.25)).unwrap_err(), SectionError::OpenChain(_)));
    assert_eq!(cut(&inverted, &at(0.25)).unwrap_err(), SectionError::InsideOut);
}

#[test]
fn a_plane_through_vertices_and_one_that_misses() {
    // z = 0.5 runs through vertices and edges of the cube of 2 × 2.
    let cube = generate::cube(2);
    assert_eq!(total_area(&cube, 0.5), 1.0);
    assert!(cut(&cube, &at(1.5)).unwrap().is_empty());
    let corner = Plane::facing(Vector::new(1.0, 1.0, 1.0), Vector::new(1.0, 1.0, 1.0)).unwrap();
    assert!(cut(&cube, &corner).unwrap().is_empty());
    let diagonal = Plane::facing(Vector::zeros(), Vector::new(1.0, -1.0, 0.0)).unwrap();
    let area: f64 = cut(&cube, &diagonal).unwrap().iter().map(|piece| piece.properties.area).sum();
    assert!((area - 2f64.sqrt()).abs() < 1e-12);
}

proptest! {
    #[test]
    fn any_plane_cuts_a_closed_solid_cleanly_or_says_why(origin in prop::array::uniform3(-0.2f64..1.2), normal in prop::array::uniform3(-1i8..2)) {
        let cube = generate::cube(3);
        let Some(plane) = Plane::facing(Vector::from(origin), Vector::from(normal.map(f64::from))) else { return Ok(()) };
        match cut(&cube, &plane) {
            Ok(pieces) => prop_assert!(pieces.iter().map(|p| p.properties.area).sum::<f64>() < 2.0),
            Err(error) => prop_assert!(matches!(error, SectionError::Coplanar(_)), "{}", error),
        }
    }
}
