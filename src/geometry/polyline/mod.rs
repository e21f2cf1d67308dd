//! A polyline with a thickness becomes a polygon, note 3.6.

mod corner;

use super::polygon::{Polygon, PolygonError};
use corner::{Corner, unit};

/// The centre line of a thin-walled section: points joined by straight segments, open or closed.
#[derive(Debug, Clone, PartialEq)]
pub struct Centreline {
    points: Vec<[f64; 2]>,
    closed: bool,
    miter_limit: f64,
}

/// Longest miter, in half thicknesses, unless set otherwise.
pub const DEFAULT_MITER_LIMIT: f64 = 4.0;

/// Why there is no outline. Points and segments count from 1; segment i starts at point i.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolylineError {
    /// Too few points for a line, or for a closed one.
    #[error("{count} points are too few; give at least {least}")]
    TooFewPoints {
        /// How many came.
        count: usize,
        /// How many it takes.
        least: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {point} is not finite")]
    NotFinite {
        /// Which.
        point: usize,
    },
    /// Two consecutive points coincide.
    #[error("segment {segment} has no length: its ends coincide")]
    ZeroSegment {
        /// Which.
        segment: usize,
    },
    /// Not one thickness per segment.
    #[error("{found} thicknesses for {expected} segments; give one each, or one for all")]
    ThicknessCount {
        /// Segments.
        expected: usize,
        /// Thicknesses.
        found: usize,
    },
    /// A thickness is not positive.
    #[error("the thickness of segment {segment} is {value}; it must be positive and finite")]
    Thickness {
        /// Which segment.
        segment: usize,
        /// Its thickness.
        value: f64,
    },
    /// A miter limit below one would cut every corner.
    #[error("the miter limit is {value}; it must be 1 or more")]
    MiterLimit {
        /// What was given.
        value: f64,
    },
    /// One side of a segment is shorter than its corners eat.
    #[error("the outline folds over at segment {segment}: it is too short for its thickness and the corners at its ends")]
    FoldOver {
        /// Which.
        segment: usize,
    },
    /// The outline meets itself elsewhere.
    #[error("the outline of the thick polyline is not valid: {0}")]
    Outline(#[from] PolygonError),
}

/// A vertex of the outline, linear in the thicknesses: point + Σ direction·δ(segment).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffsetVertex {
    /// The point of the centre line it belongs to.
    pub point: [f64; 2],
    /// Two segments, counted from 0, and the vectors their thicknesses are multiplied by.
    pub terms: [(usize, [f64; 2]); 2],
}

impl OffsetVertex {
    /// Where it is for these thicknesses, one per segment.
    pub fn at(&self, thickness: impl Fn(usize) -> f64) -> [f64; 2] {
        std::array::from_fn(|d| self.point[d] + self.terms.iter().map(|(segment, by)| by[d] * thickness(*segment)).sum::<f64>())
    }
}

/// One side of the outline along one segment: its length is `length` + Σ factor·δ(segment).
#[derive(Debug, Clone, PartialEq)]
pub struct SideLength {
    /// The segment, counted from 0.
    pub segment: usize,
    /// Its length on the centre line.
    pub length: f64,
    /// Segments and factors: what the corners add.
    pub terms: Vec<(usize, f64)>,
}

/// The two sides of the strip, left and right in the direction of the points, corner by corner (one vertex, or two where it is cut).
struct Sides {
    left: Vec<Vec<OffsetVertex>>,
    right: Vec<Vec<OffsetVertex>>,
}

impl Centreline {
    /// From its points. A closed line runs from the last point back to the first; a last point that repeats the first closes it too.
    ///
    /// # Errors
    /// Fewer than two points (three for a closed line), coordinates that are not finite, segments without length.
    pub fn new(mut points: Vec<[f64; 2]>, closed: bool) -> Result<Self, PolylineError> {
        let repeats = points.len() > 2 && points.first() == points.last();
        if repeats {
            points.pop();
        }
        let closed = closed || repeats;
        let least = if closed { 3 } else { 2 };
        if points.len() < least {
            return Err(PolylineError::TooFewPoints { count: points.len(), least });
        }
        if let Some(at) = points.iter().position(|point| !point.iter().all(|coordinate| coordinate.is_finite())) {
            return Err(PolylineError::NotFinite { point: at + 1 });
        }
        let line = Centreline { points, closed, miter_limit: DEFAULT_MITER_LIMIT };
        match (0..line.segments()).find(|segment| line.ends(*segment)[0] == line.ends(*segment)[1]) {
            Some(segment) => Err(PolylineError::ZeroSegment { segment: segment + 1 }),
            None => Ok(line),
        }
    }

    /// With another miter limit: a corner whose miter is longer than that many half thicknesses is cut by a bevel.
    ///
    /// # Errors
    /// A limit below 1.
    pub fn with_miter_limit(mut self, limit: f64) -> Result<Self, PolylineError> {
        if limit < 1.0 || limit.is_nan() {
            return Err(PolylineError::MiterLimit { value: limit });
        }
        self.miter_limit = limit;
        Ok(self)
    }

    /// Number of segments.
    pub fn segments(&self) -> usize {
        if self.closed { self.points.len() } else { self.points.len() - 1 }
    }

    /// True for a closed line.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The points, the first not repeated.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Length of a segment, counted from 0.
    ///
    /// # Panics
    /// On a segment the line does not have.
    pub fn segment_length(&self, segment: usize) -> f64 {
        let [from, to] = self.ends(segment);
        (to[0] - from[0]).hypot(to[1] - from[1])
    }

    /// Length of the whole line.
    pub fn length(&self) -> f64 {
        (0..self.segments()).map(|segment| self.segment_length(segment)).sum()
    }

    fn ends(&self, segment: usize) -> [[f64; 2]; 2] {
        [self.points[segment], self.points[(segment + 1) % self.points.len()]]
    }

    /// The section as a polygon, one thickness for all segments (`&[t]`) or one each.
    ///
    /// Corners are the note's intersections, p + (δ1·d_b − δ2·d_a)/(2·d_a×d_b) with *unit* tangents d (the note's cross products e_a, e_b are
    /// not normalised, which would make the offset grow with the segment's length). Beyond the miter limit they are bevelled; a step of thickness
    /// on (nearly) parallel segments gets a square shoulder, a reversal and the ends of an open line a butt.
    /// With one thickness and mitres only, the area is thickness × length, exactly.
    ///
    /// ```
    /// use ribopt::geometry::Centreline;
    /// let channel = Centreline::new(vec![[4.0, 0.0], [0.0, 0.0], [0.0, 10.0], [4.0, 10.0]], false)?;
    /// let polygon = channel.polygon(&[0.5])?;
    /// assert!((polygon.area() - 0.5 * 18.0).abs() < 1e-14);
    /// # Ok::<(), ribopt::geometry::PolylineError>(())
    /// ```
    ///
    /// # Errors
    /// Thicknesses of the wrong number or not positive, segments too short for their corners, an outline that meets itself.
    pub fn polygon(&self, thickness: &[f64]) -> Result<Polygon, PolylineError> {
        let each = self.checked(thickness)?;
        let sides = self.sides(|before, after| each[before] != each[after]);
        self.fold_over(&sides, &each)?;
        let mut rings = self.joined(sides).into_iter().map(|ring| ring.iter().map(|vertex| vertex.at(|k| each[k])).collect());
        let outer = rings.next().unwrap_or_default();
        Ok(Polygon::new(outer, rings.collect())?)
    }

    /// The outline with its vertices as linear forms in the thicknesses, so that every property is an exact function of them: the outer ring
    /// anticlockwise, a closed line's inner one clockwise. `stepped` says whether neighbouring segments may differ in thickness: then nearly parallel
    /// ones (|sin| < 1/miter limit) get a shoulder, whose place does not depend on the thicknesses.
    pub fn outline(&self, stepped: bool) -> Vec<Vec<OffsetVertex>> {
        self.joined(self.sides(|_, _| stepped))
    }

    fn checked(&self, thickness: &[f64]) -> Result<Vec<f64>, PolylineError> {
        let expected = self.segments();
        let each = match thickness {
            [one] => vec![*one; expected],
            _ if thickness.len() == expected => thickness.to_vec(),
            _ => return Err(PolylineError::ThicknessCount { expected, found: thickness.len() }),
        };
        match each.iter().position(|value| !(*value > 0.0 && value.is_finite())) {
            Some(at) => Err(PolylineError::Thickness { segment: at + 1, value: each[at] }),
            None => Ok(each),
        }
    }

    fn sides(&self, stepped: impl Fn(usize, usize) -> bool) -> Sides {
        let directions: Vec<[f64; 2]> = (0..self.segments()).map(|segment| unit(self.ends(segment))).collect();
        let n = self.points.len();
        let corner = |i: usize, side: f64| {
            let point = self.points[i];
            if !self.closed && (i == 0 || i == n - 1) {
                let segment = i.min(n - 2);
                return vec![corner::square(point, (segment, directions[segment]), side)];
            }
            let (before, after) = ((i + self.segments() - 1) % self.segments(), i);
            let corner = Corner {
                point,
                before: (before, directions[before]),
                after: (after, directions[after]),
                stepped: stepped(before, after),
                limit: self.miter_limit,
            };
            corner.vertices(side)
        };
        Sides { left: (0..n).map(|i| corner(i, 1.0)).collect(), right: (0..n).map(|i| corner(i, -1.0)).collect() }
    }

    /// The rings of the two sides: outer anticlockwise, inner clockwise.
    fn joined(&self, Sides { left, right }: Sides) -> Vec<Vec<OffsetVertex>> {
        let (right, left): (Vec<_>, Vec<_>) = (right.concat(), left.concat());
        let backwards = |side: Vec<OffsetVertex>| side.into_iter().rev().collect::<Vec<_>>();
        if !self.closed {
            return vec![right.into_iter().chain(backwards(left)).collect()];
        }
        // Anticlockwise centre lines have their right side outside.
        let anticlockwise = super::polygon::ring_moments(&self.points, self.points[0]).area >= 0.0;
        if anticlockwise { vec![right, backwards(left)] } else { vec![backwards(left), right] }
    }

    /// How long the two sides of the outline are along each segment, linear in the thicknesses.
    /// Where one is not positive the outline folds over.
    pub fn sides_along(&self, stepped: bool) -> Vec<SideLength> {
        self.lengths(&self.sides(|_, _| stepped))
    }

    fn lengths(&self, sides: &Sides) -> Vec<SideLength> {
        let mut found = Vec::new();
        for segment in 0..self.segments() {
            let [x, y] = unit(self.ends(segment));
            let along = |vertex: &OffsetVertex, sign: f64| vertex.terms.map(|(by, v)| (by, sign * (v[0] * x + v[1] * y)));
            for side in [&sides.left, &sides.right] {
                let (Some(from), Some(to)) = (side[segment].last(), side[(segment + 1) % side.len()].first()) else { continue };
                let terms = [along(from, -1.0), along(to, 1.0)].concat();
                found.push(SideLength { segment, length: self.segment_length(segment), terms });
            }
        }
        found
    }

    /// Both sides of every segment must still run its way.
    fn fold_over(&self, sides: &Sides, each: &[f64]) -> Result<(), PolylineError> {
        let left = |side: &SideLength| side.length + side.terms.iter().map(|(by, factor)| factor * each[*by]).sum::<f64>();
        match self.lengths(sides).iter().find(|side| left(side) <= 0.0) {
            Some(side) => Err(PolylineError::FoldOver { segment: side.segment + 1 }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
