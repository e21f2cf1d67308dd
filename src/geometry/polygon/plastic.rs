//! Plastic moduli: ∫|y − c| dA about the level c with half the area on either side.

use super::Polygon;

/// Halvings of the extent: past the last bit of a double.
const HALVINGS: usize = 64;

impl Polygon {
    /// Of bending about the x axis for d = 1, the y axis for d = 0. About c the integral is least, so that c's own error counts twice as small.
    ///
    /// ```
    /// use ribopt::geometry::Polygon;
    /// let tee = Polygon::new(vec![[4.0, 0.0], [6.0, 0.0], [6.0, 8.0], [10.0, 8.0], [10.0, 10.0], [0.0, 10.0], [0.0, 8.0], [4.0, 8.0]], vec![])?;
    /// // 18 of 36 lie below 8.2: the web about there, then both parts of the flange.
    /// assert!((tee.plastic_modulus(1) - (16.0 * 4.2 + 10.0 * 0.02 + 10.0 * 1.62)).abs() < 1e-12);
    /// # Ok::<(), ribopt::geometry::PolygonError>(())
    /// ```
    pub fn plastic_modulus(&self, d: usize) -> f64 {
        let levels = || self.outer().iter().map(|vertex| vertex[d]);
        let (mut low, mut high) = (levels().fold(f64::INFINITY, f64::min), levels().fold(f64::NEG_INFINITY, f64::max));
        let [whole, first] = self.below(d, f64::INFINITY, low);
        let base = low;
        for _ in 0..HALVINGS {
            let middle = low + 0.5 * (high - low);
            let [area, _] = self.below(d, middle, base);
            if 2.0 * area < whole { low = middle } else { high = middle }
        }
        let c = high - base;
        let [area, moment] = self.below(d, high, base);
        (first - c * whole) - 2.0 * (moment - c * area)
    }

    /// Area and ∫(y − base) dA of what lies below a level.
    fn below(&self, d: usize, level: f64, base: f64) -> [f64; 2] {
        let edges = self.rings().iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
        // Green's theorem: the area is ∮x dy = −∮y dx. The level itself adds nothing.
        let sign = if d == 1 { 1.0 } else { -1.0 };
        let parts = edges.map(|(p, q)| strip([p[d], p[1 - d]], [q[d], q[1 - d]], level, base));
        parts.fold([0.0, 0.0], |[area, moment], [a, m]| [area + sign * a, moment + sign * m])
    }
}

/// ∫across dy and ∫across·(y − base) dy along the part of an edge from (y, across) to (y, across) that lies below a level.
fn strip(p: [f64; 2], q: [f64; 2], level: f64, base: f64) -> [f64; 2] {
    let [p, q] = [clipped(p, q, level), clipped(q, p, level)];
    let (Some(p), Some(q)) = (p, q) else { return [0.0, 0.0] };
    let (rise, middle) = (q[0] - p[0], 0.5 * (p[1] + q[1]));
    let own = [p[0] - base, q[0] - base];
    // Linear times linear, exactly.
    let product = (2.0 * (own[0] * p[1] + own[1] * q[1]) + own[0] * q[1] + own[1] * p[1]) / 6.0;
    [rise * middle, rise * product]
}

/// The end p of an edge to q, moved along it down to the level; `None` where all of the edge lies above.
fn clipped(p: [f64; 2], q: [f64; 2], level: f64) -> Option<[f64; 2]> {
    if p[0] <= level {
        return Some(p);
    }
    let share = (level - p[0]) / (q[0] - p[0]);
    (q[0] < level).then(|| [level, p[1] + share * (q[1] - p[1])])
}
