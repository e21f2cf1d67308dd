//! Segments of faces, chained to rings.

use std::collections::BTreeMap;

use super::{Plane, SectionError};
use crate::mesh::{PolygonMesh, Vector};

/// An edge the plane crosses: smaller vertex number, larger one.
type Edge = [u32; 2];

/// Where the boundary of a face crosses the plane.
struct Crossing {
    edge: Edge,
    point: Vector,
    upwards: bool,
}

/// The section as rings in the plane's coordinates, without repeated points; rings of fewer than three points (a touched
/// vertex or edge) are left out.
pub(super) fn rings(solid: &PolygonMesh, plane: &Plane, above: &[bool]) -> Result<Vec<Vec<[f64; 2]>>, SectionError> {
    let mut onward: BTreeMap<Edge, (Edge, Vector)> = BTreeMap::new();
    let mut order = Vec::new();
    for f in 0..solid.face_count() {
        for [from, to] in segments(solid, plane, above, f)? {
            // Two segments leaving one edge: more than two faces meet there, or they disagree in direction.
            if onward.insert(from.edge, (to.edge, from.point)).is_some() {
                return Err(open(from.edge));
            }
            order.push(from.edge);
        }
    }
    let mut rings = Vec::new();
    for start in order {
        let mut ring: Vec<[f64; 2]> = Vec::new();
        let mut at = start;
        while let Some((next, point)) = onward.remove(&at) {
            push(&mut ring, plane.project(&point));
            at = next;
            if at == start {
                break;
            }
        }
        if !ring.is_empty() && at != start {
            return Err(open(at));
        }
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        if ring.len() > 2 {
            rings.push(ring);
        }
    }
    Ok(rings)
}

fn open(edge: Edge) -> SectionError {
    SectionError::OpenChain(edge.map(|v| v + 1))
}

fn push(ring: &mut Vec<[f64; 2]>, point: [f64; 2]) {
    if ring.last() != Some(&point) {
        ring.push(point);
    }
}

/// The segments of one face, each from where its boundary goes down to where it comes up: counter-clockwise around the
/// solid, seen from the positive side, for faces that are counter-clockwise seen from outside.
fn segments(solid: &PolygonMesh, plane: &Plane, above: &[bool], f: usize) -> Result<Vec<[Crossing; 2]>, SectionError> {
    let face = solid.face(f);
    let mut crossings: Vec<Crossing> = Vec::new();
    for (k, &a) in face.iter().enumerate() {
        let b = face[(k + 1) % face.len()];
        if above[a as usize] != above[b as usize] {
            let edge = [a.min(b), a.max(b)];
            crossings.push(Crossing { edge, point: crossing_point(solid, plane, edge), upwards: above[b as usize] });
        }
    }
    if crossings.len() > 2 {
        // A face that is not convex: along the line of the cut, inside and outside take turns.
        let along = plane.normal.cross(&solid.vector_area(f));
        crossings.sort_by(|p, q| along.dot(&p.point).total_cmp(&along.dot(&q.point)));
    }
    let mut segments = Vec::new();
    let mut crossings = crossings.into_iter();
    while let (Some(p), Some(q)) = (crossings.next(), crossings.next()) {
        match (p.upwards, q.upwards) {
            (false, true) => segments.push([p, q]),
            (true, false) => segments.push([q, p]),
            _ => return Err(SectionError::Bent(f + 1)),
        }
    }
    Ok(segments)
}

/// The same bits for both faces of an edge: always computed from its smaller vertex number.
fn crossing_point(solid: &PolygonMesh, plane: &Plane, [a, b]: Edge) -> Vector {
    let (p, q) = (solid.vertices[a as usize], solid.vertices[b as usize]);
    let (from, to) = (plane.distance(&p), plane.distance(&q));
    let t = from / (from - to);
    if t.is_finite() { p + (q - p) * t.clamp(0.0, 1.0) } else { p }
}
