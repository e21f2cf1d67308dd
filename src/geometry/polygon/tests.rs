use super::*;
use geo::{Area, Centroid};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A star-shaped ring about a centre: always simple.
fn ring() -> impl Strategy<Value = Vec<[f64; 2]>> {
    (prop::collection::vec(0.5..2.0f64, 3..12), prop::array::uniform2(-5.0..5.0f64)).prop_map(|(radii, centre)| {
        let n = radii.len() as f64;
        let at = |(k, r): (usize, f64)| [centre[0] + r * (TAU * k as f64 / n).cos(), centre[1] + r * (TAU * k as f64 / n).sin()];
        radii.into_iter().enumerate().map(at).collect()
    })
}

/// With a hole of its own shape, half its size.
fn with_hole(ring: &[[f64; 2]]) -> Polygon {
    let n = ring.len() as f64;
    let middle: [f64; 2] = std::array::from_fn(|d| ring.iter().map(|v| v[d]).sum::<f64>() / n);
    let hole = ring.iter().map(|v| std::array::from_fn(|d| middle[d] + 0.1 * (v[d] - middle[d]))).collect();
    Polygon::new(ring.to_vec(), vec![hole]).unwrap()
}

proptest! {
    #[test]
    fn orientation_and_starting_point_do_not_matter(ring in ring(), turn in 0usize..12) {
        let straight = Polygon::new(ring.clone(), vec![]).unwrap().properties();
        let mut turned = ring;
        turned.reverse();
        let by = turn % turned.len();
        turned.rotate_left(by);
        let reversed = Polygon::new(turned, vec![]).unwrap().properties();
        prop_assert!((straight.ixy - reversed.ixy).abs() < 1e-11 && (straight.ix - reversed.ix).abs() < 1e-11);
        prop_assert!(straight.area > 0.0 && (straight.area - reversed.area).abs() < 1e-12);
    }

    #[test]
    fn steiner_moves_the_axes(ring in ring(), to in prop::array::uniform2(-3.0..3.0f64)) {
        let polygon = Polygon::new(ring, vec![]).unwrap();
        let (own, moved) = (polygon.properties(), polygon.moments_about(to));
        let [dx, dy] = [own.centroid[0] - to[0], own.centroid[1] - to[1]];
        prop_assert!((moved.ix - own.ix - own.area * dy * dy).abs() < 1e-9);
        prop_assert!((moved.iy - own.iy - own.area * dx * dx).abs() < 1e-9);
        prop_assert!((moved.ixy - own.ixy - own.area * dx * dy).abs() < 1e-9);
    }

    #[test]
    fn area_and_centroid_as_geo(ring in ring()) {
        let ours = with_hole(&ring);
        let line = |ring: &Vec<[f64; 2]>| ring.iter().map(|&[x, y]| (x, y)).collect::<geo::LineString>();
        let theirs = geo::Polygon::new(line(&ours.rings()[0]), ours.holes().iter().map(line).collect());
        let centroid = theirs.centroid().unwrap();
        let own = ours.properties();
        prop_assert!((own.area - theirs.unsigned_area()).abs() < 1e-13 * own.area.max(1.0));
        prop_assert!((own.centroid[0] - centroid.x()).hypot(own.centroid[1] - centroid.y()) < 1e-12);
    }

    #[test]
    fn principal_axes_have_no_product(ring in ring()) {
        let properties = Polygon::new(ring.clone(), vec![]).unwrap().properties();
        let (s, c) = (-properties.angle).sin_cos();
        let turned: Vec<[f64; 2]> = ring.iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect();
        let own = Polygon::new(turned, vec![]).unwrap().properties();
        prop_assert!(own.ixy.abs() < 1e-10);
        prop_assert!((own.ix - properties.principal[0]).abs() < 1e-10 && (own.iy - properties.principal[1]).abs() < 1e-10);
    }

    #[test]
    fn far_from_the_origin_the_digits_stay(ring in ring()) {
        let near = Polygon::new(ring.clone(), vec![]).unwrap().properties();
        let far: Vec<[f64; 2]> = ring.iter().map(|[x, y]| [x + 1048576.0, y - 1048576.0]).collect();
        let far = Polygon::new(far, vec![]).unwrap().properties();
        prop_assert!((near.ix - far.ix).abs() < 1e-8 * near.ix && (near.ixy - far.ixy).abs() < 1e-8 * near.ix);
    }

    #[test]
    fn vertex_gradients_by_central_differences(ring in ring()) {
        let polygon = with_hole(&ring);
        let step = 1e-6;
        for (at, gradients) in polygon.vertex_gradients().iter().enumerate() {
            for (vertex, gradient) in gradients.iter().enumerate() {
                for d in 0..2 {
                    let moved = |by: f64| {
                        let mut rings = polygon.rings().to_vec();
                        rings[at][vertex][d] += by;
                        Polygon { rings }.properties()
                    };
                    let (plus, minus) = (moved(step), moved(-step));
                    let close = |ours: f64, plus: f64, minus: f64| (ours - (plus - minus) / (2.0 * step)).abs() < 1e-6;
                    prop_assert!(close(gradient.area[d], plus.area, minus.area));
                    prop_assert!(close(gradient.ix[d], plus.ix, minus.ix), "{} {}", gradient.ix[d], (plus.ix - minus.ix) / (2.0 * step));
                    prop_assert!(close(gradient.iy[d], plus.iy, minus.iy));
                    prop_assert!(close(gradient.ixy[d], plus.ixy, minus.ixy));
                }
            }
        }
    }

    #[test]
    fn random_rings_cross_as_brute_force_says(points in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 4..9)) {
        let n = points.len();
        let orient = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let crossing = (0..n).flat_map(|i| (i + 2..n).map(move |j| (i, j))).filter(|&(i, j)| !(i == 0 && j == n - 1)).any(|(i, j)| {
            let (a, b, c, d) = (points[i], points[i + 1], points[j], points[(j + 1) % n]);
            orient(a, b, c) * orient(a, b, d) < 0.0 && orient(c, d, a) * orient(c, d, b) < 0.0
        });
        prop_assert_eq!(Polygon::new(points, vec![]).is_err(), crossing);
    }
}

fn square(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
    vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
}

#[test]
fn every_defect_is_named() {
    let of = |outer: Vec<[f64; 2]>, holes: Vec<Vec<[f64; 2]>>| Polygon::new(outer, holes).unwrap_err().defects;
    assert_eq!(of(vec![[0.0, 0.0], [1.0, 0.0]], vec![]), [Defect::TooFewPoints { ring: 0, count: 2 }]);
    let bow = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 2.0]];
    assert_eq!(of(bow, vec![]), [Defect::SelfIntersection { ring: 0, first: 1, second: 3 }]);
    let line = vec![[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]];
    assert!(of(line, vec![]).contains(&Defect::ZeroArea { ring: 0 }));
    let spike = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    assert!(of(spike, vec![]).contains(&Defect::SelfIntersection { ring: 0, first: 1, second: 2 }));
    let mut twice = square(0.0, 0.0, 1.0);
    twice.insert(2, [1.0, 0.0]);
    assert_eq!(of(twice, vec![]), [Defect::DuplicatePoints { ring: 0, first: 2, second: 3 }]);
    assert_eq!(of(square(0.0, 0.0, 4.0), vec![square(5.0, 5.0, 1.0)]), [Defect::HoleOutside { hole: 1 }]);
    let crossing = of(square(0.0, 0.0, 4.0), vec![square(3.0, 1.0, 2.0)]);
    assert_eq!(crossing.len(), 2);
    assert!(crossing.iter().all(|defect| matches!(defect, Defect::RingsMeet { first: 0, second: 1, .. })));
    let nested = of(square(0.0, 0.0, 9.0), vec![square(2.0, 2.0, 4.0), square(3.0, 3.0, 1.0)]);
    assert_eq!(nested, [Defect::HoleInHole { inner: 2, outer: 1 }]);
    assert_eq!(of(vec![[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0]], vec![]), [Defect::NotFinite { ring: 0, point: 2 }]);
    // Several at once, and the words.
    let error = Polygon::new(square(0.0, 0.0, 1.0), vec![square(5.0, 5.0, 1.0), vec![[0.0; 2]]]).unwrap_err();
    assert_eq!(error.to_string(), "the points bound no valid polygon: hole 2 has 1 points; it needs three or more");
}

#[test]
fn a_closing_point_is_dropped_and_touching_is_refused() {
    let mut closed = square(0.0, 0.0, 1.0);
    closed.push([0.0, 0.0]);
    assert_eq!(Polygon::new(closed, vec![]).unwrap().outer().len(), 4);
    // Straight points along an edge are fine; a hole that touches the outer ring is not.
    let mut straight = square(0.0, 0.0, 2.0);
    straight.insert(1, [1.0, 0.0]);
    assert!(Polygon::new(straight, vec![]).is_ok());
    assert!(Polygon::new(square(0.0, 0.0, 2.0), vec![square(0.0, 0.5, 1.0)]).is_err());
}

#[test]
fn a_rectangle_in_closed_form() {
    let properties = Polygon::new(vec![[1.0, 1.0], [4.0, 1.0], [4.0, 7.0], [1.0, 7.0]], vec![]).unwrap().properties();
    assert_eq!((properties.ix, properties.iy, properties.ixy), (54.0, 13.5, 0.0));
    assert_eq!((properties.wx(), properties.wy(), properties.angle), (18.0, 9.0, 0.0));
    assert_eq!(properties.principal, [54.0, 13.5]);
}

/// Values of sectionproperties and verdicts of GEOS, see tests/data/make_sections.py.
#[derive(serde::Deserialize)]
struct Reference {
    polygons: Vec<Case>,
    validity: Vec<Verdict>,
}

#[derive(serde::Deserialize)]
struct Case {
    outer: Vec<[f64; 2]>,
    holes: Vec<Vec<[f64; 2]>>,
    expected: Expected,
}

#[derive(serde::Deserialize)]
struct Expected {
    area: f64,
    centroid: [f64; 2],
    /// Ix, Iy, Ixy about the centroid.
    moments: [f64; 3],
    principal: [f64; 2],
    /// Wx at the top and at the bottom, Wy at the right and at the left.
    moduli: [f64; 4],
}

#[derive(serde::Deserialize)]
struct Verdict {
    ring: Vec<[f64; 2]>,
    valid: bool,
}

fn reference() -> Reference {
    serde_json::from_str(include_str!("../../../tests/data/sections.json")).unwrap()
}

#[test]
fn properties_as_sectionproperties() {
    for Case { outer, holes, expected } in reference().polygons {
        let ours = Polygon::new(outer, holes).unwrap().properties();
        let close = |ours: f64, theirs: f64, size: f64| assert!((ours - theirs).abs() <= 1e-8 * size, "{ours} {theirs}");
        close(ours.area, expected.area, expected.area);
        for d in 0..2 {
            close(ours.centroid[d], expected.centroid[d], 1.0);
            close(ours.principal[d], expected.principal[d], expected.principal[0]);
        }
        for (ours, theirs) in [ours.ix, ours.iy, ours.ixy].into_iter().zip(expected.moments) {
            close(ours, theirs, expected.moments[0]);
        }
        for (ours, theirs) in [ours.wx_top, ours.wx_bottom, ours.wy_right, ours.wy_left].into_iter().zip(expected.moduli) {
            close(ours, theirs, expected.moduli[0]);
        }
    }
}

#[test]
fn validity_as_geos() {
    for Verdict { ring, valid } in reference().validity {
        match Polygon::new(ring.clone(), vec![]) {
            Ok(_) => assert!(valid, "{ring:?}"),
            // GEOS lets points repeat; here that is a mistake.
            Err(error) => {
                let repeats = error.defects.iter().any(|defect| matches!(defect, Defect::DuplicatePoints { .. }));
                assert!(!valid || repeats, "{ring:?}: {error}");
            }
        }
    }
}
