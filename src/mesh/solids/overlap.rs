//! How much material butted solids share where they meet.
//!
//! Two ribs that leave a joint at an angle α reach into one another on the inner side of the bend θ = π − α. Each passes the
//! bisecting plane by S·tan(θ/2), with S the first moment of the inner half of its section; together 2·S·tan(θ/2), exact for
//! two equal ribs, and summed over neighbours also for two that cross. No pair counts more than the smaller of its ribs.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Ring, SizedRib, prismatoid_volume};
use crate::mesh::{Vector, angle, unit};

/// The overlap at one joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointOverlap {
    /// The joint's number.
    pub joint: u32,
    /// Where it is.
    pub position: [f64; 3],
    /// Ribs that end there.
    pub ribs: usize,
    /// Estimate of the volume counted more than once.
    pub volume: f64,
}

/// A rib's end at a joint.
struct End<'a> {
    rib: &'a SizedRib,
    /// 0 or 1.
    end: usize,
    /// Away from the joint.
    direction: Vector,
    volume: f64,
}

/// All joints where ribs overlap, in order.
pub(super) fn joints(ribs: &[SizedRib]) -> Vec<JointOverlap> {
    let mut ends: BTreeMap<u32, Vec<End>> = BTreeMap::new();
    for rib in ribs {
        let volume = prismatoid_volume(&rib.rings, rib.geometry.length());
        for (end, sign) in [(0, 1.0), (1, -1.0)] {
            let direction = rib.geometry.frame.x * sign;
            ends.entry(rib.geometry.joints[end]).or_default().push(End { rib, end, direction, volume });
        }
    }
    let overlap = |(joint, ends): (u32, Vec<End>)| {
        let pairs = (0..ends.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let volume: f64 = pairs.map(|(i, j)| pair(&ends[i], &ends[j])).sum();
        let position = ends.first().map(|e| e.rib.geometry.ends[e.end].into()).unwrap_or_default();
        (volume > 0.0).then_some(JointOverlap { joint, position, ribs: ends.len(), volume })
    };
    ends.into_iter().filter_map(overlap).collect()
}

/// 2·min(S)·tan(θ/2), at most the smaller rib.
fn pair(a: &End, b: &End) -> f64 {
    let bend = std::f64::consts::PI - angle(&a.direction, &b.direction);
    if bend < 1e-9 {
        return 0.0;
    }
    // Towards the inner side of the bend.
    let Some(inner) = unit(a.direction + b.direction) else { return a.volume.min(b.volume) };
    let moment = half_moment(a, &inner).min(half_moment(b, &inner));
    let smaller = a.volume.min(b.volume);
    let overlap = 2.0 * moment * (bend / 2.0).tan();
    if overlap.is_finite() { overlap.clamp(0.0, smaller) } else { smaller }
}

/// ∫ of the distance from the centre plane over the part of the section on the inner side.
fn half_moment(end: &End, inner: &Vector) -> f64 {
    let frame = &end.rib.geometry.frame;
    let towards = [inner.dot(&frame.y), inner.dot(&frame.z)];
    let size = towards[0].hypot(towards[1]);
    if size == 0.0 {
        return 0.0;
    }
    let (c, s) = (towards[0] / size, towards[1] / size);
    let height = |p: &[f64; 2]| [s * p[0] - c * p[1], c * p[0] + s * p[1]];
    end.rib.rings[end.end].iter().map(|ring| upper_moment(&ring.iter().map(height).collect::<Vec<_>>())).sum()
}

/// ∫ y dA over the part of a ring above y = 0; the ring turns counter-clockwise in coordinates where x runs to the right.
fn upper_moment(ring: &Ring) -> f64 {
    let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
    pairs.map(|(p, q)| clipped(*p, *q)).sum()
}

/// The side's share of −½∫ y² dx, where it lies above y = 0 (Green's theorem; the line y = 0 itself adds nothing).
fn clipped(mut p: [f64; 2], mut q: [f64; 2]) -> f64 {
    if p[1] <= 0.0 && q[1] <= 0.0 {
        return 0.0;
    }
    let cut = |a: [f64; 2], b: [f64; 2]| [a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]), 0.0];
    if p[1] < 0.0 {
        p = cut(p, q);
    } else if q[1] < 0.0 {
        q = cut(p, q);
    }
    -(q[0] - p[0]) * (p[1] * p[1] + p[1] * q[1] + q[1] * q[1]) / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_a_rectangle() {
        // b = 2, h = 4: ∫ y dA over the upper half is b·(h/2)²/2 = 4.
        let ring = vec![[-1., -2.], [1., -2.], [1., 2.], [-1., 2.]];
        assert_eq!(upper_moment(&ring), 4.0);
    }
}
