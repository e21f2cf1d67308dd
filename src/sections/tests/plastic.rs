//! Plastic moduli, perimeters and radii against the outline, by another method.

use super::*;

/// ∫|y − c| dA about the level c with half the area on either side, by thin strips.
fn first_moment(polygon: &Polygon, d: usize) -> f64 {
    let rings = polygon.rings();
    let all = || rings[0].iter().map(|vertex| vertex[d]);
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let count = 40_000;
    let step = (high - low) / f64::from(count);
    let chord = |at: f64| -> f64 {
        let mut crossings = Vec::new();
        for ring in rings {
            for (p, q) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                if (p[d] > at) != (q[d] > at) {
                    crossings.push(p[1 - d] + (at - p[d]) / (q[d] - p[d]) * (q[1 - d] - p[1 - d]));
                }
            }
        }
        crossings.sort_by(f64::total_cmp);
        crossings.chunks(2).map(|pair| pair[1] - pair[0]).sum()
    };
    let strips: Vec<(f64, f64)> =
        (0..count).map(|k| low + (f64::from(k) + 0.5) * step).map(|at| (at, chord(at) * step)).collect();
    let whole: f64 = strips.iter().map(|(_, area)| area).sum();
    let mut below = 0.0;
    let level = strips.iter().find(|(_, area)| {
        below += area;
        2.0 * below >= whole
    });
    let level = level.expect("an area").0;
    strips.iter().map(|(at, area)| (at - level).abs() * area).sum()
}

#[test]
fn plastic_moduli_perimeters_and_radii_are_those_of_the_outline() {
    for case in CASES.iter().filter(|case| !["polyline", "superellipse"].contains(&case.kind)) {
        let rings = case.kind().rings(case.form(), case.given, &case.outline(), 1e-8);
        let polygon = Polygon::new(rings[0].clone(), rings[1..].to_vec()).unwrap();
        let around = |ring: &Ring| {
            let sides = ring.iter().zip(ring.iter().cycle().skip(1));
            sides.map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1])).sum::<f64>()
        };
        let own = polygon.properties();
        let expected = [
            ("Wplx", first_moment(&polygon, 1)),
            ("Wply", first_moment(&polygon, 0)),
            ("perimeter", around(&rings[0])),
            ("ix", (own.ix / own.area).sqrt()),
            ("iy", (own.iy / own.area).sqrt()),
        ];
        for (name, expected) in expected {
            let Some(ours) = case.value(name) else { continue };
            assert!((ours / expected - 1.0).abs() < 2e-4, "{} {name}: {ours} {expected}", case.kind);
        }
    }
}
