//! Area, centroid and second moments by sums over the edges, note 2.5; principal axes and section moduli.

use std::ops::Add;

use super::Polygon;

/// Signed sums over a ring about some origin: positive for an anticlockwise ring.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RingMoments {
    /// A
    pub area: f64,
    /// ∫y dA
    pub sx: f64,
    /// ∫x dA
    pub sy: f64,
    /// Ix = ∫y² dA
    pub ix: f64,
    /// Iy = ∫x² dA
    pub iy: f64,
    /// Ixy = ∫xy dA
    pub ixy: f64,
}

impl Add for RingMoments {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        RingMoments {
            area: self.area + other.area,
            sx: self.sx + other.sx,
            sy: self.sy + other.sy,
            ix: self.ix + other.ix,
            iy: self.iy + other.iy,
            ixy: self.ixy + other.ixy,
        }
    }
}

/// The note's sums (2.5) over one ring, about `origin`; the centroid's first moments and Ixy, which the note lacks, added.
/// They hold for a simple ring, anticlockwise; a clockwise one has every sign turned.
///
/// ```
/// let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// let sums = ribopt::geometry::polygon::ring_moments(&square, [0.0, 0.0]);
/// assert_eq!((sums.area, sums.sx, sums.ix, sums.ixy), (1.0, 0.5, 1.0 / 3.0, 0.25));
/// ```
pub fn ring_moments(ring: &[[f64; 2]], origin: [f64; 2]) -> RingMoments {
    let shifted = |vertex: &[f64; 2]| [vertex[0] - origin[0], vertex[1] - origin[1]];
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    let doubled = ends.map(|(p, q)| edge_sums(shifted(p), shifted(q))).fold(RingMoments::default(), |sum, edge| sum + edge);
    RingMoments {
        area: doubled.area / 2.0,
        sx: doubled.sx / 6.0,
        sy: doubled.sy / 6.0,
        ix: doubled.ix / 12.0,
        iy: doubled.iy / 12.0,
        ixy: doubled.ixy / 24.0,
    }
}

fn edge_sums([x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> RingMoments {
    let w = x1 * y2 - x2 * y1;
    RingMoments {
        area: w,
        sx: w * (y1 + y2),
        sy: w * (x1 + x2),
        ix: w * (y1 * y1 + y1 * y2 + y2 * y2),
        iy: w * (x1 * x1 + x1 * x2 + x2 * x2),
        ixy: w * (x1 * y2 + 2.0 * x1 * y1 + 2.0 * x2 * y2 + x2 * y1),
    }
}

/// A section's properties about its centroid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionProperties {
    /// A
    pub area: f64,
    /// Where the centroid is.
    pub centroid: [f64; 2],
    /// Ix = ∫y² dA about the centroid.
    pub ix: f64,
    /// Iy = ∫x² dA about the centroid.
    pub iy: f64,
    /// Ixy = ∫xy dA about the centroid.
    pub ixy: f64,
    /// Larger and smaller principal moment.
    pub principal: [f64; 2],
    /// Angle from the x axis to the axis of the larger principal moment, in (−π/2, π/2]; 0 where the two are equal.
    pub angle: f64,
    /// Elastic section modulus Ix/(distance to the topmost point).
    pub wx_top: f64,
    /// Elastic section modulus Ix/(distance to the lowest point).
    pub wx_bottom: f64,
    /// Elastic section modulus Iy/(distance to the leftmost point).
    pub wy_left: f64,
    /// Elastic section modulus Iy/(distance to the rightmost point).
    pub wy_right: f64,
}

impl SectionProperties {
    /// The smaller of the two moduli about the x axis.
    pub fn wx(&self) -> f64 {
        self.wx_top.min(self.wx_bottom)
    }

    /// The smaller of the two moduli about the y axis.
    pub fn wy(&self) -> f64 {
        self.wy_left.min(self.wy_right)
    }
}

impl Polygon {
    /// Area, holes taken off.
    pub fn area(&self) -> f64 {
        self.moments_about(self.middle()).area
    }

    /// All section properties about the centroid. The sums run about the mean vertex, so that a section far from the origin keeps its digits.
    ///
    /// ```
    /// use ribopt::geometry::Polygon;
    /// // An unequal angle: Ixy is not zero and the principal axes are turned.
    /// let angle = Polygon::new(vec![[0.0, 0.0], [6.0, 0.0], [6.0, 1.0], [1.0, 1.0], [1.0, 10.0], [0.0, 10.0]], vec![])?;
    /// let p = angle.properties();
    /// assert!(p.ixy < 0.0 && p.principal[0] > p.ix && p.principal[1] < p.iy);
    /// assert!((p.principal[0] + p.principal[1] - p.ix - p.iy).abs() < 1e-12);
    /// # Ok::<(), ribopt::geometry::PolygonError>(())
    /// ```
    pub fn properties(&self) -> SectionProperties {
        let middle = self.middle();
        let rough = self.moments_about(middle);
        let centroid = [middle[0] + rough.sy / rough.area, middle[1] + rough.sx / rough.area];
        // Once more about the centroid itself: nothing is left to subtract.
        let RingMoments { area, ix, iy, ixy, .. } = self.moments_about(centroid);
        let (half_sum, half_difference) = ((ix + iy) / 2.0, (ix - iy) / 2.0);
        let radius = half_difference.hypot(ixy);
        let reach = |d: usize, sign: f64| self.outer().iter().map(|v| sign * (v[d] - centroid[d])).fold(0.0, f64::max);
        SectionProperties {
            area,
            centroid,
            ix,
            iy,
            ixy,
            principal: [half_sum + radius, half_sum - radius],
            angle: 0.5 * (-2.0 * ixy).atan2(ix - iy),
            wx_top: ix / reach(1, 1.0),
            wx_bottom: ix / reach(1, -1.0),
            wy_left: iy / reach(0, -1.0),
            wy_right: iy / reach(0, 1.0),
        }
    }
}
