//! What can be wrong with a polygon, every reason at once.

use std::collections::BTreeMap;
use std::fmt;

use super::crossings::{crossings, edges, orientation};
use super::ring_moments;

/// One thing that is wrong. Rings: 0 is the outer one, k the k-th hole; points and edges count from 1, edge i starts at point i.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum Defect {
    /// Three points make the smallest ring.
    #[error("{} has {count} points; it needs three or more", Ring(*ring))]
    TooFewPoints { ring: usize, count: usize },
    /// A coordinate is NaN or infinite.
    #[error("point {point} of {} is not finite", Ring(*ring))]
    NotFinite { ring: usize, point: usize },
    /// Two points of a ring coincide.
    #[error("points {first} and {second} of {} coincide", Ring(*ring))]
    DuplicatePoints { ring: usize, first: usize, second: usize },
    /// All points on one line.
    #[error("{} has no area", Ring(*ring))]
    ZeroArea { ring: usize },
    /// Two edges of one ring cross, touch or overlap.
    #[error("edges {first} and {second} of {} meet: it crosses or touches itself", Ring(*ring))]
    SelfIntersection { ring: usize, first: usize, second: usize },
    /// Edges of two rings cross, touch or overlap.
    #[error("edge {first_edge} of {} meets edge {second_edge} of {}", Ring(*first), Ring(*second))]
    RingsMeet { first: usize, first_edge: usize, second: usize, second_edge: usize },
    /// A hole lies outside the outer ring.
    #[error("{} lies outside the outer ring", Ring(*hole))]
    HoleOutside { hole: usize },
    /// A hole lies in another hole.
    #[error("{} lies inside {}", Ring(*inner), Ring(*outer))]
    HoleInHole { inner: usize, outer: usize },
}

struct Ring(usize);

impl fmt::Display for Ring {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.0 == 0 { write!(f, "the outer ring") } else { write!(f, "hole {}", self.0) }
    }
}

/// Points that bound no section, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct PolygonError {
    /// Every reason.
    pub defects: Vec<Defect>,
}

impl fmt::Display for PolygonError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "the points bound no valid polygon: ")?;
        for (at, defect) in self.defects.iter().enumerate() {
            write!(f, "{}{defect}", if at == 0 { "" } else { "; " })?;
        }
        Ok(())
    }
}

impl std::error::Error for PolygonError {}

/// Everything wrong with these rings; crossings are looked for only between finite points.
pub(super) fn defects(rings: &[Vec<[f64; 2]>]) -> Vec<Defect> {
    let mut found: Vec<Defect> = rings.iter().enumerate().flat_map(|(ring, points)| of_points(ring, points)).collect();
    if found.iter().any(|defect| matches!(defect, Defect::NotFinite { .. } | Defect::TooFewPoints { .. })) {
        return found;
    }
    found.extend(rings.iter().enumerate().filter(|(_, points)| flat(points)).map(|(ring, _)| Defect::ZeroArea { ring }));
    let meeting = crossings(edges(rings));
    found.extend(meeting.iter().map(|(a, b)| {
        let (first, second) = (a.at + 1, b.at + 1);
        if a.ring == b.ring {
            Defect::SelfIntersection { ring: a.ring, first, second }
        } else {
            Defect::RingsMeet { first: a.ring, first_edge: first, second: b.ring, second_edge: second }
        }
    }));
    let touching = |p: usize, q: usize| meeting.iter().any(|(a, b)| (a.ring, b.ring) == (p, q) || (a.ring, b.ring) == (q, p));
    for hole in 1..rings.len() {
        if !touching(0, hole) && !inside(rings[hole][0], &rings[0]) {
            found.push(Defect::HoleOutside { hole });
        }
        let around = (1..rings.len()).filter(|other| *other != hole && !touching(hole, *other));
        found.extend(
            around.filter(|other| inside(rings[hole][0], &rings[*other])).map(|outer| Defect::HoleInHole { inner: hole, outer }),
        );
    }
    found
}

fn of_points(ring: usize, points: &[[f64; 2]]) -> Vec<Defect> {
    let mut found = Vec::new();
    if points.len() < 3 {
        found.push(Defect::TooFewPoints { ring, count: points.len() });
    }
    let mut seen = BTreeMap::new();
    for (at, point) in points.iter().enumerate() {
        if !point.iter().all(|coordinate| coordinate.is_finite()) {
            found.push(Defect::NotFinite { ring, point: at + 1 });
            continue;
        }
        // Adding zero makes −0 equal to 0.
        let key = point.map(|coordinate| (coordinate + 0.0).to_bits());
        if let Some(first) = seen.insert(key, at + 1) {
            found.push(Defect::DuplicatePoints { ring, first, second: at + 1 });
        }
    }
    found
}

/// No area beyond the rounding of its sum.
fn flat(points: &[[f64; 2]]) -> bool {
    let origin = points[0];
    let reach = |d: usize| points.iter().map(|point| (point[d] - origin[d]).abs()).fold(0.0, f64::max);
    let bound = points.len() as f64 * f64::EPSILON * reach(0) * reach(1);
    let area = ring_moments(points, origin).area.abs();
    // No number where the coordinates overflow.
    area <= bound || area.is_nan()
}

/// Is the point inside the ring (not on it)? By the winding of the edges over it.
fn inside(point: [f64; 2], ring: &[[f64; 2]]) -> bool {
    let mut winding = 0;
    for (from, to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let side = orientation(*from, *to, point);
        if from[1] <= point[1] && to[1] > point[1] && side > 0.0 {
            winding += 1;
        } else if from[1] > point[1] && to[1] <= point[1] && side < 0.0 {
            winding -= 1;
        }
    }
    winding != 0
}
