//! Triangles: area in the plane and in space (note 2.1), area and second moments by the note's integrals and in closed form (2.5.1).

use nalgebra::Vector3;

use crate::math::quadrature::integrate;
use crate::math::{norms, signed_area};

/// Signed area of a plane triangle, positive when A, B, C run anticlockwise: half of u × v, u = AB, v = AC; note (2.1.1) to (2.1.3).
///
/// ```
/// assert_eq!(ribopt::geometry::triangle::area_2d([0.0, 0.0], [4.0, 0.0], [0.0, 3.0]), 6.0);
/// ```
pub fn area_2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    0.5 * signed_area([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]])
}

/// Area of a triangle in space, ½‖u × v‖ with u = AB, v = AC; note (2.1.3).
///
/// The note's last line in coordinates has three letters and two indices: it holds with (u_k, v_k, w_k), k = 1, 2, read as the
/// components of the two vectors, not with u and v of (2.1.1) and (2.1.2).
///
/// ```
/// let area = ribopt::geometry::triangle::area_3d([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// assert!((area - 3f64.sqrt() / 2.0).abs() < 1e-15);
/// ```
pub fn area_3d(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let (a, b, c) = (Vector3::from(a), Vector3::from(b), Vector3::from(c));
    0.5 * norms::l2((b - a).cross(&(c - a)).as_slice())
}

/// Area and second moments of a triangle in the y–z plane about the origin: signed, positive for anticlockwise vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriangleMoments {
    /// A
    pub area: f64,
    /// Iy = ∫z² dA
    pub iy: f64,
    /// Iz = ∫y² dA
    pub iz: f64,
}

/// Area and second moments of the triangle of vertices (y, z), in closed form; for every triangle.
///
/// A = ½[(y2−y1)(z3−z1) − (y3−y1)(z2−z1)], Iy = A/6·(Σz² + z1z2 + z2z3 + z3z1), Iz alike in y.
///
/// ```
/// let t = ribopt::geometry::triangle::moments([[0.0, 0.0], [6.0, 0.0], [0.0, 3.0]]);
/// assert_eq!((t.area, t.iy, t.iz), (9.0, 6.0 * 27.0 / 12.0, 3.0 * 216.0 / 12.0)); // b·h³/12, h·b³/12
/// ```
pub fn moments(vertices: [[f64; 2]; 3]) -> TriangleMoments {
    let area = area_2d(vertices[0], vertices[1], vertices[2]);
    let moment = |k: usize| {
        let [p, q, r] = vertices.map(|vertex| vertex[k]);
        area / 6.0 * (p * p + q * q + r * r + p * q + q * r + r * p)
    };
    TriangleMoments { area, iy: moment(1), iz: moment(0) }
}

/// Iyz = ∫yz dA of the same triangle, A/12·(ΣyΣz + Σyz).
pub fn product_moment(vertices: [[f64; 2]; 3]) -> f64 {
    let sum = |f: &dyn Fn([f64; 2]) -> f64| vertices.iter().map(|vertex| f(*vertex)).sum::<f64>();
    let (y, z, yz) = (sum(&|v| v[0]), sum(&|v| v[1]), sum(&|v| v[0] * v[1]));
    area_2d(vertices[0], vertices[1], vertices[2]) / 12.0 * (y * z + yz)
}

/// An edge is parallel to an axis, where the note's integrals divide by zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the edge between vertices {} and {} is parallel to an axis: the integrals of 2.5.1 divide by zero there; use the closed form", edge[0], edge[1])]
pub struct AxisParallelEdge {
    /// Its vertices, counted from 1.
    pub edge: [usize; 2],
}

/// Area and second moments by the note's integrals 2.5.1: a box less the strips beside the three edges.
///
/// The note integrates Iz's box from y1 to y3 and leaves dz in Iz's strips; neither can hold, for the box is y2 − y1 wide and its strips are
/// functions of y. Here the box runs from y1 to y2 and the strips over dy.
///
/// ```
/// use ribopt::geometry::triangle::{moments, moments_by_integrals};
/// let vertices = [[0.0, 0.0], [4.0, 1.0], [1.0, 3.0]];
/// let (a, b) = (moments(vertices), moments_by_integrals(vertices)?);
/// assert!((a.area - b.area).abs() < 1e-13 && (a.iy - b.iy).abs() < 1e-12 && (a.iz - b.iz).abs() < 1e-12);
/// # Ok::<(), ribopt::geometry::triangle::AxisParallelEdge>(())
/// ```
///
/// # Errors
/// [`AxisParallelEdge`].
pub fn moments_by_integrals(vertices: [[f64; 2]; 3]) -> Result<TriangleMoments, AxisParallelEdge> {
    for edge in [[0, 1], [1, 2], [0, 2]] {
        let [p, q] = edge.map(|at| vertices[at]);
        if p[0] == q[0] || p[1] == q[1] {
            return Err(AxisParallelEdge { edge: edge.map(|at| at + 1) });
        }
    }
    let [[y1, z1], [y2, z2], [y3, z3]] = vertices;
    // The strips' widths as printed.
    let in_y = |power: i32| {
        strip(z1, z3, power, |_| y2 - y1)
            - strip(z1, z2, power, |z| (y2 - y1) - (y2 - y1) / (z2 - z1) * (z - z1))
            - strip(z2, z3, power, |z| (y2 - y3) / (z3 - z2) * (z - z2))
            - strip(z1, z3, power, |z| (y3 - y1) / (z3 - z1) * (z - z1))
    };
    let in_z = |power: i32| {
        strip(y1, y2, power, |_| z3 - z1)
            - strip(y1, y2, power, |y| (z2 - z1) / (y2 - y1) * (y - y1))
            - strip(y3, y2, power, |y| (z3 - z2) / (y2 - y3) * (y - y3))
            - strip(y1, y3, power, |y| (z3 - z1) - (z3 - z1) / (y3 - y1) * (y - y1))
    };
    Ok(TriangleMoments { area: in_y(0), iy: in_y(2), iz: in_z(2) })
}

/// ∫ width(x)·xⁿ dx; a cubic at most, on which one application of the rule is exact. NaN where the coordinates overflow.
fn strip(from: f64, to: f64, power: i32, width: impl Fn(f64) -> f64) -> f64 {
    integrate(|x| width(x) * x.powi(power), from, to, 1.0).map_or(f64::NAN, |integral| integral.value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::ring_moments;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = [f64; 2]> {
        prop::array::uniform2(-10.0..10.0f64)
    }

    proptest! {
        #[test]
        fn integrals_closed_form_and_polygon_agree(vertices in prop::array::uniform3(point())) {
            let apart = |k: usize| (0..3).all(|i| (vertices[i][k] - vertices[(i + 1) % 3][k]).abs() > 0.01);
            prop_assume!(apart(0) && apart(1));
            let (closed, integrals, polygon) = (moments(vertices), moments_by_integrals(vertices).unwrap(), ring_moments(&vertices, [0.0; 2]));
            prop_assert!((closed.area - integrals.area).abs() < 1e-11);
            prop_assert!((closed.iy - integrals.iy).abs() < 1e-9 && (closed.iz - integrals.iz).abs() < 1e-9);
            prop_assert!((closed.area - polygon.area).abs() < 1e-12);
            // The polygon's x, y are this triangle's y, z.
            prop_assert!((closed.iy - polygon.ix).abs() < 1e-10 && (closed.iz - polygon.iy).abs() < 1e-10);
            prop_assert!((product_moment(vertices) - polygon.ixy).abs() < 1e-10);
        }

        #[test]
        fn space_holds_the_plane(vertices in prop::array::uniform3(point()), turn in 0.0..6.0f64) {
            let [a, b, c] = vertices;
            let place = |p: [f64; 2]| (crate::math::rotation::about_axis([1.0, 2.0, -1.0], turn).unwrap() * Vector3::new(p[0], p[1], 3.0)).into();
            prop_assert!((area_3d(place(a), place(b), place(c)) - area_2d(a, b, c).abs()).abs() < 1e-12);
        }
    }

    #[test]
    fn axis_parallel_edges_are_for_the_closed_form() {
        let right = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]];
        assert_eq!(moments_by_integrals(right), Err(AxisParallelEdge { edge: [1, 2] }));
        assert_eq!(moments(right).area, 1.0);
    }
}
