//! Meshes made by formula, for examples and tests; the same arguments give the same bits.

use std::f64::consts::{FRAC_PI_4, PI};

use super::weld::weld;
use super::{PolygonMesh, Vector};

/// A flat grid of `columns` × `rows` squares in the x–y plane, normals upwards.
pub fn grid(columns: u32, rows: u32, size: f64) -> PolygonMesh {
    patch(columns, rows, |u, v| Vector::new(u * f64::from(columns) * size, v * f64::from(rows) * size, 0.0))
}

/// The unit cube with every side divided into n × n squares, normals outwards.
pub fn cube(n: u32) -> PolygonMesh {
    let sides = (0..6).map(|side| patch(n, n, move |u, v| on_cube(side, 2.0 * u - 1.0, 2.0 * v - 1.0)));
    let mut mesh = stitch(sides);
    mesh.vertices.iter_mut().for_each(|p| *p = p.map(|c| (c + 1.0) / 2.0));
    mesh
}

/// A barrel vault: a circular arch of this span and rise (0 < rise ≤ span/2), `across` quads along the arc, extruded along y.
pub fn vault(across: u32, along: u32, span: f64, length: f64, rise: f64) -> PolygonMesh {
    let radius = (span * span / 4.0 + rise * rise) / (2.0 * rise);
    let half = (span / 2.0).atan2(radius - rise);
    patch(across, along, |u, v| {
        let angle = (2.0 * u - 1.0) * half;
        Vector::new(radius * angle.sin(), v * length, radius * angle.cos() - radius + rise)
    })
}

/// A dome over a circle: the upper half of a cube blown up to a sphere, n quads along each side of its lid and n/2 down to
/// the rim, stretched to this height. The lid's four corners are vertices of valence 3.
pub fn dome(n: u32, radius: f64, height: f64) -> PolygonMesh {
    let lid = patch(n, n, |u, v| on_cube(5, tangent(u), tangent(v)));
    let walls = (0..4).map(|side| patch(n, (n / 2).max(1), move |u, v| on_cube(side, tangent(u), tangent(0.5 + v / 2.0))));
    let mut mesh = stitch(std::iter::once(lid).chain(walls));
    for p in &mut mesh.vertices {
        *p = (*p / p.norm()).component_mul(&Vector::new(radius, radius, height));
    }
    mesh
}

/// A branching free-form shell: three arms of n × m quads leave a hexagon of three n × n patches, over a rolling height.
/// 3n² + 3nm quads; `shell(16, 26)` has 2016. One interior vertex of valence 3, three boundary vertices of valence 4.
pub fn shell(n: u32, m: u32) -> PolygonMesh {
    let corner = |k: u32| {
        let angle = f64::from(k % 6) * PI / 3.0;
        Vector::new(5.0 * angle.cos(), 5.0 * angle.sin(), 0.0)
    };
    let lozenges = (0..3).map(|k| bilinear(n, n, [Vector::zeros(), corner(2 * k), corner(2 * k + 1), corner(2 * k + 2)]));
    let arms = (0..3).map(|k| {
        let (from, to) = (corner(2 * k), corner(2 * k + 1));
        let out = (from + to).normalize() * (8.0 + f64::from(k));
        bilinear(m, n, [from, from + out, to + out, to])
    });
    let mut mesh = stitch(lozenges.chain(arms));
    mesh.vertices.iter_mut().for_each(|p| *p = roll(*p));
    mesh
}

/// Bends the arms in plan and lifts the plan to a smooth surface.
fn roll(p: Vector) -> Vector {
    let r = p.xy().norm();
    let turn = 0.02 * r;
    let (x, y) = (p.x * turn.cos() - p.y * turn.sin(), p.x * turn.sin() + p.y * turn.cos());
    Vector::new(x, y, 4.0 * (-(r / 9.0).powi(2)).exp() + 0.4 * (0.5 * x).sin() * (0.35 * y).cos())
}

/// A point of side 0–3 (around, z upwards), 4 (bottom) or 5 (top) of the cube [−1, 1]³; u × v points outwards.
fn on_cube(side: u32, u: f64, v: f64) -> Vector {
    match side {
        0 => Vector::new(1.0, u, v),
        1 => Vector::new(-u, 1.0, v),
        2 => Vector::new(-1.0, -u, v),
        3 => Vector::new(u, -1.0, v),
        4 => Vector::new(v, u, -1.0),
        _ => Vector::new(u, v, 1.0),
    }
}

/// Spreads the quads of a blown-up cube evenly: equal angles instead of equal lengths.
fn tangent(u: f64) -> f64 {
    ((2.0 * u - 1.0) * FRAC_PI_4).tan()
}

fn bilinear(columns: u32, rows: u32, [a, b, c, d]: [Vector; 4]) -> PolygonMesh {
    patch(columns, rows, |u, v| (a * (1.0 - u) + b * u) * (1.0 - v) + (d * (1.0 - u) + c * u) * v)
}

/// The surface over the unit square as `columns` × `rows` quads (at least one each way).
fn patch(columns: u32, rows: u32, surface: impl Fn(f64, f64) -> Vector) -> PolygonMesh {
    let (columns, rows) = (columns.max(1), rows.max(1));
    let at = |i: u32, j: u32| surface(f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows));
    let mut mesh = PolygonMesh::default();
    mesh.vertices = (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j))).map(|(i, j)| at(i, j)).collect();
    for j in 0..rows {
        for i in 0..columns {
            let v = j * (columns + 1) + i;
            mesh.push_face(&[v, v + 1, v + columns + 2, v + columns + 1]);
        }
    }
    mesh
}

/// Joins patches along their common sides.
fn stitch(patches: impl Iterator<Item = PolygonMesh>) -> PolygonMesh {
    let mut all = PolygonMesh::default();
    for patch in patches {
        let first = all.vertices.len() as u32;
        all.vertices.extend_from_slice(&patch.vertices);
        for face in patch.faces() {
            let face: Vec<u32> = face.iter().map(|v| v + first).collect();
            all.push_face(&face);
        }
    }
    weld(all, 1e-9).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{QuadMesh, invariants};

    #[test]
    fn the_shell_branches_and_has_about_two_thousand_quads() {
        let report = invariants::measure(&QuadMesh::new(shell(16, 26)).unwrap());
        assert_eq!((report.faces, report.euler_characteristic, report.boundary_loops.len()), (2016, 1, 1));
        assert_eq!(report.irregular_interior.iter().map(|i| i[1]).collect::<Vec<_>>(), [3]);
        assert!(report.angles.least > 30.0 && report.angles.most < 150.0, "{:?}", report.angles);
    }

    #[test]
    fn the_dome_has_four_irregular_vertices() {
        let report = invariants::measure(&QuadMesh::new(dome(8, 6.0, 4.0)).unwrap());
        assert_eq!((report.faces, report.euler_characteristic), (8 * 8 + 4 * 8 * 4, 1));
        assert_eq!(report.irregular_interior.iter().map(|i| i[1]).collect::<Vec<_>>(), [3; 4]);
    }

    #[test]
    fn cubes_are_closed_and_outward() {
        assert!((cube(3).volume() - 1.0).abs() < 1e-14);
    }
}
