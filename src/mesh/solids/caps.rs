//! Triangles over rings with holes, by spade's constrained Delaunay triangulation: it uses every point, also those on
//! straight sides, so that caps and sides have the same edges.

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::Ring;

/// The triangles inside the rings, counter-clockwise, over their points in sequence; `None` where rings cross or touch
/// themselves or one another, or have no area.
pub(super) fn triangulate(rings: &[Ring]) -> Option<Vec<Vec<u32>>> {
    if rings.iter().any(|ring| ring.len() < 3) {
        return None;
    }
    let points: Vec<Point2<f64>> = rings.iter().flatten().map(|p| Point2::new(p[0], p[1])).collect();
    let mut triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handles = Vec::with_capacity(points.len());
    for &point in &points {
        handles.push(triangulation.insert(point).ok()?);
    }
    if triangulation.num_vertices() != points.len() {
        return None;
    }
    let mut first = 0;
    for ring in rings {
        for k in 0..ring.len() {
            let (a, b) = (handles[first + k], handles[first + (k + 1) % ring.len()]);
            if !triangulation.can_add_constraint(a, b) {
                return None;
            }
            triangulation.add_constraint(a, b);
        }
        first += ring.len();
    }
    // Handles number vertices in the order of insertion.
    let triangles = triangulation.inner_faces().map(|face| face.vertices().map(|v| v.fix().index()));
    let inside = triangles.filter(|triangle| is_inside(rings, centre(triangle.map(|v| points[v]))));
    let inside: Vec<Vec<u32>> = inside.map(|triangle| triangle.map(|v| v as u32).to_vec()).collect();
    // n points in one ring need n − 2 triangles, every hole two more; fewer means rings that touch.
    let expected = (points.len() + 2 * rings.len()).checked_sub(4)?;
    (inside.len() == expected).then_some(inside)
}

fn centre(corners: [Point2<f64>; 3]) -> [f64; 2] {
    let [a, b, c] = corners;
    [(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0]
}

/// Even–odd rule over all rings. Centres of triangles lie off the rings.
fn is_inside(rings: &[Ring], [x, y]: [f64; 2]) -> bool {
    let crossings = |ring: &Ring| {
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        let crosses =
            |(p, q): &(&[f64; 2], &[f64; 2])| (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
        pairs.filter(crosses).count()
    };
    rings.iter().map(crossings).sum::<usize>() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(size: f64) -> Ring {
        vec![[-size, -size], [size, -size], [size, size], [-size, size]]
    }

    #[test]
    fn points_on_straight_sides_are_used() {
        let ring = vec![[0., 0.], [1., 0.], [2., 0.], [2., 1.], [1., 1.], [0., 1.]];
        assert_eq!(triangulate(&[ring]).map(|t| t.len()), Some(4));
    }

    #[test]
    fn holes_stay_open_and_crossing_rings_are_refused() {
        let mut hole = square(1.0);
        hole.reverse();
        assert_eq!(triangulate(&[square(2.0), hole]).map(|t| t.len()), Some(8));
        assert_eq!(triangulate(&[vec![[0., 0.], [1., 1.], [1., 0.], [0., 1.]]]), None);
        assert_eq!(triangulate(&[vec![[0., 0.], [1., 1.]]]), None);
        assert_eq!(triangulate(&[vec![[0., 0.], [1., 0.], [f64::NAN, 1.]]]), None);
    }
}
