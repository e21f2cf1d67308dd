//! One corner of a thick polyline: miter, bevel, shoulder or butt.

use super::OffsetVertex;

/// Two segments that meet, each with its number and unit direction.
pub(super) struct Corner {
    pub point: [f64; 2],
    pub before: (usize, [f64; 2]),
    pub after: (usize, [f64; 2]),
    /// May their thicknesses differ?
    pub stepped: bool,
    pub limit: f64,
}

/// Sines below this are rounding: the segments are parallel.
const PARALLEL: f64 = 1e-12;

impl Corner {
    /// The vertices on one side: +1 left, −1 right.
    pub(super) fn vertices(&self, side: f64) -> Vec<OffsetVertex> {
        let (a, b) = (self.before.1, self.after.1);
        let (sin, cos) = (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
        let straight = cos > 0.0;
        // Length of an even miter in half thicknesses: 1/cos(half the turn).
        let miter = (2.0 / (1.0 + cos).max(f64::MIN_POSITIVE)).sqrt();
        let reversal = !straight && sin.abs() <= PARALLEL;
        let shoulder = self.stepped && straight && sin.abs() < 1.0 / self.limit;
        let bevel = miter > self.limit && sin * side < 0.0;
        if reversal || shoulder || bevel {
            return vec![square(self.point, self.before, side), square(self.point, self.after, side)];
        }
        vec![if self.stepped { self.intersection(side, sin) } else { self.bisector(side, cos) }]
    }

    /// The note's intersection: p ± (δ1·d_b − δ2·d_a)/(2·sin).
    fn intersection(&self, side: f64, sin: f64) -> OffsetVertex {
        let factor = side / (2.0 * sin);
        let (before, after) = (self.before, self.after);
        OffsetVertex {
            point: self.point,
            terms: [(before.0, after.1.map(|d| factor * d)), (after.0, before.1.map(|d| -factor * d))],
        }
    }

    /// The same for equal thicknesses, p ± δ/2·(n_a + n_b)/(1 + cos), which holds for parallel segments too.
    fn bisector(&self, side: f64, cos: f64) -> OffsetVertex {
        let factor = side / (2.0 * (1.0 + cos));
        let (a, b) = (self.before.1, self.after.1);
        let by = [-factor * (a[1] + b[1]), factor * (a[0] + b[0])];
        OffsetVertex { point: self.point, terms: [(self.before.0, by), (self.after.0, [0.0; 2])] }
    }
}

/// Half a thickness square off the line: p ± δ/2·n.
pub(super) fn square(point: [f64; 2], (segment, [x, y]): (usize, [f64; 2]), side: f64) -> OffsetVertex {
    OffsetVertex { point, terms: [(segment, [-0.5 * side * y, 0.5 * side * x]), (segment, [0.0; 2])] }
}

/// The unit tangent of a segment.
pub(super) fn unit([from, to]: [[f64; 2]; 2]) -> [f64; 2] {
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    let length = x.hypot(y);
    [x / length, y / length]
}
