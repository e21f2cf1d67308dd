//! Plane sections of a solid (note 3.2): closed loops, polygons with holes, their properties (2.5).
//!
//! Vertices exactly on the plane count as above it, as if the plane lay lower by less than any number; so every crossing is
//! an edge with ends on both sides, and loops close. A face wholly in the plane is an error: the section jumps there.

mod chains;
mod plane;
mod union;

use std::cmp::Ordering;

use serde::Serialize;

pub use plane::Plane;

use super::PolygonMesh;
use crate::geometry::polygon::{Polygon, PolygonError};

/// One connected piece of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Outline and holes in the plane's coordinates.
    pub polygon: Polygon,
    /// Its numbers.
    pub properties: PieceReport,
}

/// The numbers of one piece, about its centroid, along the plane's axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct PieceReport {
    pub area: f64,
    pub centroid: [f64; 2],
    pub ix: f64,
    pub iy: f64,
    pub ixy: f64,
    pub principal: [f64; 2],
    pub angle: f64,
    pub holes: usize,
}

/// Why there is no section. Faces and vertices count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum SectionError {
    #[error("there are no faces to cut; give the solid as a closed mesh")]
    Empty,
    #[error("face {0} lies in the plane, where the section is not one-valued; move the plane a little")]
    Coplanar(usize),
    #[error("the section does not close at the edge of vertices {} {}: the solid is open or its faces run the wrong way round", .0[0], .0[1])]
    OpenChain([u32; 2]),
    #[error("face {0} is bent so that the plane does not cut it in clean segments; triangulate it")]
    Bent(usize),
    #[error("the section is inside out: the solid's faces point inwards")]
    InsideOut,
    #[error("a loop of the section is no polygon ({0}); the solid may run through itself")]
    Polygon(#[from] PolygonError),
}

/// Cuts a solid. Pieces come in the order of the mesh's faces; none where the plane misses the solid.
///
/// # Errors
/// A face in the plane, a chain that does not close, loops that are no polygons.
///
/// ```
/// use ribopt::mesh::{Vector, generate, section::{Plane, cut}};
/// let plane = Plane::facing(Vector::new(0.0, 0.0, 0.3), Vector::z()).ok_or("no plane")?;
/// let pieces = cut(&generate::cube(2), &plane)?;
/// assert!((pieces[0].properties.area - 1.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cut(solid: &PolygonMesh, plane: &Plane) -> Result<Vec<Piece>, SectionError> {
    let sides: Vec<Ordering> = solid.vertices.iter().map(|vertex| plane.side(vertex)).collect();
    if solid.face_count() == 0 {
        return Err(SectionError::Empty);
    }
    let in_plane = |face: &[u32]| face.iter().all(|&v| sides[v as usize].is_eq());
    if let Some(f) = solid.faces().position(in_plane) {
        return Err(SectionError::Coplanar(f + 1));
    }
    let above: Vec<bool> = sides.iter().map(|side| side.is_ge()).collect();
    let rings = chains::rings(solid, plane, &above)?;
    pieces(rings)
}

/// The area of the union of pieces that overlap, as those of solids that run through one another; `None` where none do.
pub fn union_area(pieces: &[Piece]) -> Option<f64> {
    union::area(pieces)
}

/// Outer rings turn counter-clockwise, holes clockwise; a hole belongs to the smallest outer ring around it.
fn pieces(rings: Vec<Vec<[f64; 2]>>) -> Result<Vec<Piece>, SectionError> {
    let (outer, holes): (Vec<_>, Vec<_>) = rings.into_iter().partition(|ring| signed_area(ring) > 0.0);
    if outer.is_empty() && !holes.is_empty() {
        return Err(SectionError::InsideOut);
    }
    let mut holes_of: Vec<Vec<Vec<[f64; 2]>>> = vec![Vec::new(); outer.len()];
    for hole in holes {
        let around = (0..outer.len()).filter(|&k| hole.first().is_some_and(|&p| contains(&outer[k], p)));
        let smallest = around.min_by(|&a, &b| signed_area(&outer[a]).total_cmp(&signed_area(&outer[b])));
        holes_of[smallest.ok_or(SectionError::InsideOut)?].push(hole);
    }
    outer.into_iter().zip(holes_of).map(|(ring, holes)| piece(ring, holes)).collect()
}

fn piece(ring: Vec<[f64; 2]>, holes: Vec<Vec<[f64; 2]>>) -> Result<Piece, SectionError> {
    let count = holes.len();
    let polygon = Polygon::new(ring, holes)?;
    let p = polygon.properties();
    let properties = PieceReport {
        area: p.area,
        centroid: p.centroid,
        ix: p.ix,
        iy: p.iy,
        ixy: p.ixy,
        principal: p.principal,
        angle: p.angle,
        holes: count,
    };
    Ok(Piece { polygon, properties })
}

fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    crate::geometry::polygon::ring_moments(ring, origin).area
}

/// Even–odd rule.
fn contains(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
    let crosses =
        |(p, q): &(&[f64; 2], &[f64; 2])| (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
    pairs.filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests;
