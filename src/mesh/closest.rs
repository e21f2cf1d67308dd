//! Nearest points on a surface, by an R*-tree over its triangles (`rstar`).

use rstar::{AABB, PointDistance, RTree, RTreeObject};

use super::{PolygonMesh, Vector};

/// A surface made ready for nearest-point queries. Quads count as the two triangles of their fan.
pub struct Surface {
    tree: RTree<Piece>,
}

/// A triangle; segments and points are triangles whose corners coincide.
struct Piece {
    corners: [Vector; 3],
}

impl Surface {
    /// The faces of a mesh. A mesh without faces has no nearest points.
    pub fn of_faces(mesh: &PolygonMesh) -> Self {
        let corners = |(_, triangle): (usize, [u32; 3])| triangle.map(|v| mesh.vertices[v as usize]);
        Surface { tree: RTree::bulk_load(mesh.fans().map(|fan| Piece { corners: corners(fan) }).collect()) }
    }

    /// A set of segments, such as a boundary.
    pub fn of_segments(segments: impl Iterator<Item = [Vector; 2]>) -> Self {
        Surface { tree: RTree::bulk_load(segments.map(|[a, b]| Piece { corners: [a, b, b] }).collect()) }
    }

    /// The nearest point, or `None` where there is nothing.
    ///
    /// ```
    /// use ribopt::mesh::{Vector, closest::Surface, generate};
    /// let plate = Surface::of_faces(&generate::grid(2, 2, 1.0));
    /// let nearest = plate.nearest(&Vector::new(0.3, 5.0, 7.0)).ok_or("no faces")?;
    /// assert!((nearest - Vector::new(0.3, 2.0, 0.0)).norm() < 1e-15);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn nearest(&self, point: &Vector) -> Option<Vector> {
        self.tree.nearest_neighbor((*point).into()).map(|piece| closest_on_triangle(point, &piece.corners))
    }

    /// One more triangle.
    pub fn insert(&mut self, corners: [Vector; 3]) {
        self.tree.insert(Piece { corners });
    }

    /// The triangles (of segments: with a corner twice) whose boxes meet this one.
    pub fn pieces_in(&self, low: &Vector, high: &Vector) -> impl Iterator<Item = &[Vector; 3]> {
        let window = AABB::from_corners((*low).into(), (*high).into());
        self.tree.locate_in_envelope_intersecting(window).map(|piece| &piece.corners)
    }

    /// The distance to the nearest point; infinite where there is nothing.
    pub fn distance(&self, point: &Vector) -> f64 {
        self.nearest(point).map_or(f64::INFINITY, |nearest| (nearest - point).norm())
    }
}

impl RTreeObject for Piece {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_points(&self.corners.map(<[f64; 3]>::from))
    }
}

impl PointDistance for Piece {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let point = Vector::from(*point);
        (closest_on_triangle(&point, &self.corners) - point).norm_squared()
    }
}

/// The nearest point of triangle abc, by regions (Ericson, Real-Time Collision Detection, 5.1.5).
pub(super) fn closest_on_triangle(p: &Vector, [a, b, c]: &[Vector; 3]) -> Vector {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if ab.cross(&ac).norm_squared() == 0.0 {
        let ends = [on_segment(p, a, b), on_segment(p, a, c), on_segment(p, b, c)];
        return ends.into_iter().min_by(|x, y| (x - p).norm_squared().total_cmp(&(y - p).norm_squared())).unwrap_or(*a);
    }
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return on_segment(p, a, b);
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return on_segment(p, a, c);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return on_segment(p, b, c);
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

/// The nearest point of a segment.
pub(super) fn on_segment(p: &Vector, a: &Vector, b: &Vector) -> Vector {
    let along = b - a;
    let t = (p - a).dot(&along) / along.norm_squared();
    if t.is_nan() || t <= 0.0 {
        *a
    } else if t >= 1.0 {
        *b
    } else {
        a + along * t
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(-2.0..2.0).prop_map(Vector::from)
    }

    proptest! {
        #[test]
        fn no_sampled_point_of_a_triangle_is_nearer(p in point(), a in point(), b in point(), c in point()) {
            let near = (closest_on_triangle(&p, &[a, b, c]) - p).norm();
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                    let sample = a + (b - a) * u + (c - a) * v;
                    prop_assert!((sample - p).norm() >= near - 1e-9);
                }
            }
        }
    }
}
