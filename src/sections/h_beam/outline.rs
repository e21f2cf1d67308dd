//! An H beam's boundary.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crate::geometry::polygon::Ring;

/// Half lengths of an H beam: web thickness and height, flange width, overall height.
pub(super) struct Halves {
    pub web: f64,
    pub clear: f64,
    pub flange: f64,
    pub height: f64,
}

impl Halves {
    /// The twelve corners, anticlockwise.
    pub fn sharp(&self) -> Ring {
        let Halves { web: w, clear: y, flange: x, height: top } = *self;
        vec![[-x, -top], [x, -top], [x, -y], [w, -y], [w, y], [x, y], [x, top], [-x, top], [-x, y], [-w, y], [-w, -y], [-x, -y]]
    }

    /// With fillets of radius r, each of as many pieces; points between their ends lie at `share` of the radius.
    pub fn rounded(&self, r: f64, pieces: usize, share: f64) -> Ring {
        let Halves { web: w, clear: y, flange: x, height: top } = *self;
        // Middles of the circles, and the angle at which the outline meets them: it turns clockwise there.
        let corner = |middle: [f64; 2], from: f64| {
            (0..=pieces).map(move |k| {
                let reach = if k == 0 || k == pieces { r } else { share * r };
                let (sin, cos) = (from - FRAC_PI_2 * k as f64 / pieces as f64).sin_cos();
                [middle[0] + reach * cos, middle[1] + reach * sin]
            })
        };
        let mut ring = vec![[-x, -top], [x, -top], [x, -y]];
        ring.extend(corner([w + r, r - y], -FRAC_PI_2));
        ring.extend(corner([w + r, y - r], PI));
        ring.extend([[x, y], [x, top], [-x, top], [-x, y]]);
        ring.extend(corner([-w - r, y - r], FRAC_PI_2));
        ring.extend(corner([-w - r, r - y], 0.0));
        ring.push([-x, -y]);
        ring
    }
}

/// Pieces of a quarter of a circle whose chords lie within `tolerance` of it: r·(1 − cos(π/4n)) ≤ tolerance.
pub(super) fn pieces(r: f64, tolerance: f64) -> usize {
    /// As many as a quadrant of a superellipse is cut into at the most.
    const MOST: f64 = 16384.0;
    let half_angle = (1.0 - tolerance / r).clamp(0.0, 1.0).acos();
    (FRAC_PI_4 / half_angle).ceil().clamp(1.0, MOST) as usize
}

/// The share of the radius at which the points between have to lie so that the polygon from the middle has the quarter's area:
/// q in (n − 2)/2·q² + q = π/(4·sin(π/2n)).
pub(super) fn share_of_equal_area(pieces: usize) -> f64 {
    let (between, sine) = (pieces as f64 - 2.0, (FRAC_PI_2 / pieces as f64).sin());
    ((1.0 + between * FRAC_PI_2 / sine).sqrt() - 1.0) / between
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Polygon;

    #[test]
    fn sixteen_pieces_have_the_fillets_area() {
        let halves = Halves { web: 2.8, clear: 91.5, flange: 50.0, height: 100.0 };
        let ring = halves.rounded(12.0, 16, share_of_equal_area(16));
        let area = Polygon::new(ring, Vec::new()).unwrap().properties().area;
        assert!((area - (2.0 * 850.0 + 183.0 * 5.6 + (4.0 - PI) * 144.0)).abs() < 1e-10, "{area}");
        assert_eq!((pieces(12.0, 12.0), pieces(12.0, 1e-300)), (1, 16384));
    }
}
