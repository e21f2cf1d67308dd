//! One rib as a solid: rings at both ends, joined point by point.

use super::caps::triangulate;
use super::{Ring, SizedRib, SolidError};
use crate::mesh::{PolygonMesh, Vector};

/// The closed solid of a rib. Sides are quads (bilinear where the section twists its proportions), caps are triangles, or a
/// quad for a lone ring of four points.
///
/// # Errors
/// Ends whose rings differ in number of points; rings that cross themselves.
pub fn loft(rib: &SizedRib) -> Result<PolygonMesh, SolidError> {
    let name = &rib.geometry.name;
    let counts = |rings: &[Ring]| rings.iter().map(Vec::len).collect::<Vec<_>>();
    let (from, to) = (counts(&rib.rings[0]), counts(&rib.rings[1]));
    if from != to || from.is_empty() {
        let spelled = |counts: &[usize]| counts.iter().map(usize::to_string).collect::<Vec<_>>().join("+");
        return Err(SolidError::Outlines { rib: name.clone(), from: spelled(&from), to: spelled(&to) });
    }
    let caps = [cap(name, &rib.rings[0])?, cap(name, &rib.rings[1])?];
    let count = from.iter().sum::<usize>() as u32;
    let mut solid = PolygonMesh::default();
    for (end, rings) in rib.rings.iter().enumerate() {
        let (origin, frame) = (rib.geometry.ends[end], rib.geometry.frame);
        solid.vertices.extend(rings.iter().flatten().map(|p| -> Vector { origin + frame.y * p[0] + frame.z * p[1] }));
    }
    // The rings turn counter-clockwise about +x, so the cap at the far end keeps its sense and the near one is reversed.
    for face in &caps[0] {
        solid.push_face(&face.iter().rev().copied().collect::<Vec<_>>());
    }
    sides(&mut solid, &from, count);
    for face in &caps[1] {
        solid.push_face(&face.iter().map(|v| v + count).collect::<Vec<_>>());
    }
    Ok(solid)
}

fn sides(solid: &mut PolygonMesh, ring_sizes: &[usize], count: u32) {
    let mut first = 0;
    for &size in ring_sizes {
        let size = size as u32;
        for k in 0..size {
            let (a, b) = (first + k, first + (k + 1) % size);
            solid.push_face(&[a, b, b + count, a + count]);
        }
        first += size;
    }
}

/// The faces of a cap, counter-clockwise, over the rings' points in sequence.
fn cap(rib: &str, rings: &[Ring]) -> Result<Vec<Vec<u32>>, SolidError> {
    match rings {
        [ring] if ring.len() == 4 && is_convex(ring) => Ok(vec![vec![0, 1, 2, 3]]),
        _ => triangulate(rings).ok_or_else(|| SolidError::Ring { rib: rib.into() }),
    }
}

fn is_convex(ring: &Ring) -> bool {
    let turn = |k: usize| {
        let [a, b, c] = [0, 1, 2].map(|by| ring[(k + by) % ring.len()]);
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
    };
    (0..ring.len()).all(|k| turn(k) > 0.0)
}

/// The area of rings, holes (clockwise) taken off.
pub fn area(rings: &[Ring]) -> f64 {
    let twice = |ring: &Ring| {
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        pairs.map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f64>()
    };
    rings.iter().map(twice).sum::<f64>() / 2.0
}

/// l/6·(A₀ + 4·A_m + A₁) with A_m of the mean rings: the volume between two rings joined by straight lines.
pub fn prismatoid_volume(rings: &[Vec<Ring>; 2], length: f64) -> f64 {
    let mean = |p: &[f64; 2], q: &[f64; 2]| [(p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0];
    let pairs = rings[0].iter().zip(&rings[1]);
    let middle: Vec<Ring> = pairs.map(|(r, s)| r.iter().zip(s).map(|(p, q)| mean(p, q)).collect()).collect();
    length / 6.0 * (area(&rings[0]) + 4.0 * area(&middle) + area(&rings[1]))
}
