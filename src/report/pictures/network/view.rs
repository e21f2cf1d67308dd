//! From space to paper.

use crate::mesh::Vector;
use crate::mesh::solids::SizedRib;

/// The isometric projection, fitted to the sheet.
pub struct View {
    scale: f64,
    shift: [f64; 2],
    /// What the drawing takes up.
    pub height: f64,
}

impl View {
    /// With the upper left corner here, no wider and no higher than `room`.
    pub fn of(ribs: &[SizedRib], [left, top]: [f64; 2], room: f64) -> View {
        let points = || ribs.iter().flat_map(|rib| rib.geometry.ends).map(isometric);
        let range = |d: usize| {
            points().map(|p| p[d]).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        };
        let ([low, high], [lowest, highest]) = (range(0), range(1));
        let (width, height) = (high - low, highest - lowest);
        let largest = width.max(height);
        if !(largest > 0.0 && largest.is_finite()) {
            return View { scale: 0.0, shift: [left, top], height: 0.0 };
        }
        let scale = room / largest;
        // In the middle of the sheet where it is narrow.
        let shift = [left + (room - width * scale) / 2.0 - low * scale, top - lowest * scale];
        View { scale, shift, height: height * scale }
    }

    /// In pixels.
    pub fn mean_length(&self, ribs: &[SizedRib]) -> f64 {
        let length = |rib: &SizedRib| {
            let [p, q] = rib.geometry.ends.map(isometric);
            (q[0] - p[0]).hypot(q[1] - p[1]) * self.scale
        };
        ribs.iter().map(length).sum::<f64>() / ribs.len().max(1) as f64
    }

    /// Where a point stands on the sheet.
    pub fn place(&self, point: Vector) -> [f64; 2] {
        let p = isometric(point);
        [p[0] * self.scale + self.shift[0], p[1] * self.scale + self.shift[1]]
    }
}

/// Along the line of sight, towards the eye.
pub fn nearness(rib: &SizedRib) -> f64 {
    (rib.geometry.ends[0] + rib.geometry.ends[1]).sum()
}

/// y downwards as on screens.
fn isometric(p: Vector) -> [f64; 2] {
    [(p.y - p.x) * 3f64.sqrt() / 2.0, (p.x + p.y) / 2.0 - p.z]
}
