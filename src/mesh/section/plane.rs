//! A plane that tells exactly on which side a point lies.

use std::cmp::Ordering;

use robust::{Coord3D, orient3d};

use crate::mesh::{Vector, unit};

/// A plane through three points, with axes of its own. Sides are told by `robust`'s exact predicate with respect to these
/// three points, so that a vertex on an axis-parallel plane is known to be on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    points: [Vector; 3],
    /// Where (0, 0) of the section lies.
    pub origin: Vector,
    /// The section's x axis.
    pub u: Vector,
    /// The section's y axis.
    pub v: Vector,
    /// u × v, towards the positive side.
    pub normal: Vector,
}

impl Plane {
    /// The plane through `origin` with this normal and, as nearly as possible, this direction of the section's x axis;
    /// `None` where the normal is zero or along x.
    ///
    /// ```
    /// use ribopt::mesh::{Vector, section::Plane};
    /// let plane = Plane::new(Vector::new(0.0, 0.0, 0.1), Vector::z(), Vector::x()).ok_or("no plane")?;
    /// assert!(plane.side(&Vector::new(7.0, -3.0, 0.1)).is_eq());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn new(origin: Vector, normal: Vector, x: Vector) -> Option<Plane> {
        let normal = unit(normal)?;
        let v = unit(normal.cross(&unit(x)?)).filter(|_| normal.cross(&x).norm() > 1e-9 * x.norm())?;
        let u = v.cross(&normal);
        let all_finite = origin.iter().all(|c| c.is_finite());
        all_finite.then(|| Plane { points: [origin, origin + u, origin + v], origin, u, v, normal })
    }

    /// The plane of this normal through `origin`, its x axis along the global x, or along y where the normal is nearly x.
    pub fn facing(origin: Vector, normal: Vector) -> Option<Plane> {
        let direction = unit(normal)?;
        let x = if direction.x.abs() < 0.9 { Vector::x() } else { Vector::y() };
        Plane::new(origin, normal, x)
    }

    /// Greater: on the positive side; equal: exactly on the plane.
    pub fn side(&self, point: &Vector) -> Ordering {
        let coord = |p: &Vector| Coord3D { x: p.x, y: p.y, z: p.z };
        let [a, b, c] = &self.points;
        // orient3d is positive below a counter-clockwise triangle.
        let sign = -orient3d(coord(a), coord(b), coord(c), coord(point));
        sign.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
    }

    /// Signed distance, rounded.
    pub fn distance(&self, point: &Vector) -> f64 {
        self.normal.dot(&(point - self.origin))
    }

    /// Coordinates in the plane.
    pub fn project(&self, point: &Vector) -> [f64; 2] {
        let from = point - self.origin;
        [self.u.dot(&from), self.v.dot(&from)]
    }
}
