//! How area and centroidal moments change with the vertices.

use super::Polygon;

/// Derivatives by the coordinates (x, y) of one vertex.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct VertexGradient {
    /// ∂A/∂(x_i, y_i) = ((y_{i+1} − y_{i−1})/2, (x_{i−1} − x_{i+1})/2)
    pub area: [f64; 2],
    /// Of Ix about the centroid.
    pub ix: [f64; 2],
    /// Of Iy about the centroid.
    pub iy: [f64; 2],
    /// Of Ixy about the centroid.
    pub ixy: [f64; 2],
}

impl Polygon {
    /// Gradients by every vertex, ring by ring in the order of [`Polygon::rings`].
    ///
    /// Moments are taken about the centroid: there the first moments vanish, and with them the derivative of −Sx²/A, so that the derivatives
    /// of the sums of note 2.5 are those of the centroidal moments.
    ///
    /// ```
    /// use ribopt::geometry::Polygon;
    /// let square = Polygon::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], vec![])?;
    /// assert_eq!(square.vertex_gradients()[0][2].area, [1.0, 1.0]);
    /// # Ok::<(), ribopt::geometry::PolygonError>(())
    /// ```
    pub fn vertex_gradients(&self) -> Vec<Vec<VertexGradient>> {
        let [cx, cy] = self.properties().centroid;
        let about = |vertex: &[f64; 2]| [vertex[0] - cx, vertex[1] - cy];
        let of_ring = |ring: &Vec<[f64; 2]>| {
            let n = ring.len();
            (0..n).map(|i| vertex_gradient(about(&ring[(i + n - 1) % n]), about(&ring[i]), about(&ring[(i + 1) % n]))).collect()
        };
        self.rings().iter().map(of_ring).collect()
    }
}

/// From the two edges p → v → q that meet at the vertex.
fn vertex_gradient(p: [f64; 2], v: [f64; 2], q: [f64; 2]) -> VertexGradient {
    let [x, y] = v;
    let (before, after) = (p[0] * y - x * p[1], x * q[1] - q[0] * y);
    // Σ over both edges of factor·∂w/∂v + w·∂factor/∂v, w = x_i·y_{i+1} − x_{i+1}·y_i.
    let combine = |factor: [f64; 2], by_x: [f64; 2], by_y: [f64; 2], divisor: f64| {
        [
            (-p[1] * factor[0] + q[1] * factor[1] + before * by_x[0] + after * by_x[1]) / divisor,
            (p[0] * factor[0] - q[0] * factor[1] + before * by_y[0] + after * by_y[1]) / divisor,
        ]
    };
    let square = |d: usize| [p, q].map(|o| o[d] * o[d] + o[d] * v[d] + v[d] * v[d]);
    let slope = |d: usize| [p, q].map(|o| o[d] + 2.0 * v[d]);
    let mixed = [p, q].map(|o| o[0] * y + 2.0 * o[0] * o[1] + 2.0 * x * y + x * o[1]);
    VertexGradient {
        area: [(q[1] - p[1]) / 2.0, (p[0] - q[0]) / 2.0],
        ix: combine(square(1), [0.0; 2], slope(1), 12.0),
        iy: combine(square(0), slope(0), [0.0; 2], 12.0),
        ixy: combine(mixed, [p, q].map(|o| 2.0 * y + o[1]), [p, q].map(|o| o[0] + 2.0 * x), 24.0),
    }
}
