//! Polygons with holes: area, second moments and vertex gradients, note 2.5.

mod crossings;
mod gradient;
mod moments;
mod plastic;
mod validity;

pub use gradient::VertexGradient;
pub use moments::{RingMoments, SectionProperties, ring_moments};
pub use validity::{Defect, PolygonError};

/// Vertices of a closed curve, in order; the last is not the first again.
pub type Ring = Vec<[f64; 2]>;

/// A valid polygon: one outer ring, anticlockwise, and holes, clockwise. Rings are not closed by repeating their first point.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    rings: Vec<Vec<[f64; 2]>>,
}

impl Polygon {
    /// From an outer ring and holes, in any orientation: rings are reversed where they run the wrong way round (absolute values,
    /// as the note suggests, would lose the sign of Ixy). A last point that repeats the first is dropped.
    ///
    /// ```
    /// use ribopt::geometry::Polygon;
    /// let frame = Polygon::new(
    ///     vec![[0.0, 0.0], [0.0, 4.0], [2.0, 4.0], [2.0, 0.0]],          // clockwise: turned
    ///     vec![vec![[0.5, 1.0], [1.5, 1.0], [1.5, 3.0], [0.5, 3.0]]])?;
    /// let properties = frame.properties();
    /// assert_eq!(properties.area, 6.0);
    /// assert_eq!(properties.centroid, [1.0, 2.0]);
    /// assert_eq!(properties.ix, (2.0 * 64.0 - 1.0 * 8.0) / 12.0);
    /// # Ok::<(), ribopt::geometry::PolygonError>(())
    /// ```
    ///
    /// # Errors
    /// [`PolygonError`] with every reason: too few or duplicate points, crossing edges, no area, holes outside or overlapping.
    pub fn new(outer: Vec<[f64; 2]>, holes: Vec<Vec<[f64; 2]>>) -> Result<Self, PolygonError> {
        let mut rings: Vec<_> = std::iter::once(outer).chain(holes).map(opened).collect();
        let defects = validity::defects(&rings);
        if !defects.is_empty() {
            return Err(PolygonError { defects });
        }
        for (at, ring) in rings.iter_mut().enumerate() {
            let anticlockwise = ring_moments(ring, ring[0]).area > 0.0;
            if anticlockwise != (at == 0) {
                ring.reverse();
            }
        }
        Ok(Polygon { rings })
    }

    /// The outer ring, anticlockwise.
    pub fn outer(&self) -> &[[f64; 2]] {
        &self.rings[0]
    }

    /// The holes, clockwise.
    pub fn holes(&self) -> &[Vec<[f64; 2]>] {
        &self.rings[1..]
    }

    /// All rings, the outer one first.
    pub fn rings(&self) -> &[Vec<[f64; 2]>] {
        &self.rings
    }

    /// Signed sums over all rings about a point.
    pub fn moments_about(&self, origin: [f64; 2]) -> RingMoments {
        self.rings.iter().map(|ring| ring_moments(ring, origin)).fold(RingMoments::default(), |sum, ring| sum + ring)
    }

    /// Mean of the outer vertices: an origin near the section, against cancellation.
    fn middle(&self) -> [f64; 2] {
        let n = self.rings[0].len() as f64;
        // Differences from one vertex, so that far coordinates do not overflow the sum's digits.
        let first = self.rings[0][0];
        std::array::from_fn(|d| first[d] + self.rings[0].iter().map(|vertex| vertex[d] - first[d]).sum::<f64>() / n)
    }
}

/// Without a repeated last point.
fn opened(mut ring: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

#[cfg(test)]
mod tests;
