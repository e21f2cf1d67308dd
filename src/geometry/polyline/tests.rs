use super::*;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Long segments with turns up to a right angle each way: no fold-over for thin walls.
fn wandering() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec((2.0..4.0f64, -1.2..1.2f64), 2..6).prop_map(|steps| {
        let (mut points, mut heading) = (vec![[0.0, 0.0]], 0.0f64);
        for (at, (length, turn)) in steps.into_iter().enumerate() {
            // Turns alternate, so that the line never meets itself.
            heading += if at % 2 == 0 { turn.abs() } else { -turn.abs() };
            let [x, y] = points[points.len() - 1];
            points.push([x + length * heading.cos(), y + length * heading.sin()]);
        }
        points
    })
}

proptest! {
    #[test]
    fn area_is_thickness_times_length(points in wandering(), thickness in 0.01..0.5f64) {
        let line = Centreline::new(points, false).unwrap();
        let area = line.polygon(&[thickness]).unwrap().area();
        prop_assert!((area - thickness * line.length()).abs() < 1e-13 * area.max(1.0));
        let same = line.polygon(&vec![thickness; line.segments()]).unwrap().area();
        prop_assert_eq!(area, same);
    }

    #[test]
    fn closed_rings_too(n in 3usize..9, thickness in 0.01..0.3f64, clockwise: bool) {
        let mut points: Vec<[f64; 2]> = (0..n).map(|k| (TAU * k as f64 / n as f64).sin_cos()).map(|(s, c)| [3.0 * c, 2.0 * s]).collect();
        if clockwise {
            points.reverse();
        }
        let line = Centreline::new(points, true).unwrap();
        let polygon = line.polygon(&[thickness]).unwrap();
        prop_assert_eq!(polygon.holes().len(), 1);
        prop_assert!((polygon.area() - thickness * line.length()).abs() < 1e-13 * polygon.area());
    }

    #[test]
    fn corners_lie_on_both_offset_lines(turn in 0.3..2.2f64, first in 0.1..0.5f64, second in 0.1..0.5f64, side: bool) {
        let turn = if side { turn } else { -turn };
        let (sin, cos) = turn.sin_cos();
        let line = Centreline::new(vec![[-9.0, 0.0], [0.0, 0.0], [9.0 * cos, 9.0 * sin]], false).unwrap();
        let polygon = line.polygon(&[first, second]).unwrap();
        // Distances of the note's corner from the two centre lines are half the thicknesses.
        let corners = polygon.outer().iter().filter(|v| v[0].hypot(v[1]) < 3.0);
        for [x, y] in corners {
            prop_assert!((y.abs() - first / 2.0).abs() < 1e-12 && ((x * sin - y * cos).abs() - second / 2.0).abs() < 1e-12);
        }
        prop_assert_eq!(polygon.outer().len(), 6);
    }

    #[test]
    fn linear_forms_give_the_same_polygon(points in wandering(), thickness in prop::collection::vec(0.05..0.3f64, 6)) {
        let line = Centreline::new(points, false).unwrap();
        let each = &thickness[..line.segments()];
        if let Ok(polygon) = line.polygon(each) {
            let outline = line.outline(true);
            let ring: Vec<[f64; 2]> = outline[0].iter().map(|vertex| vertex.at(|k| each[k])).collect();
            prop_assert_eq!(polygon.outer(), ring.as_slice());
        }
    }
}

#[test]
fn the_printed_solution() {
    // The note's t1 … t4 for one corner: lines through p_a and p_b with the segments' slopes.
    let (p0, p1, p2): ([f64; 2], [f64; 2], [f64; 2]) = ([0.0, 0.0], [3.0, 1.0], [4.0, 4.0]);
    let (delta_a, delta_b) = (0.2, 0.3);
    let normal = |from: [f64; 2], to: [f64; 2]| {
        let [dx, dy] = corner::unit([from, to]);
        [-dy, dx]
    };
    let (na, nb) = (normal(p0, p1), normal(p1, p2));
    let (ya, za) = (p1[0] + delta_a / 2.0 * na[0], p1[1] + delta_a / 2.0 * na[1]);
    let (yb, zb) = (p1[0] + delta_b / 2.0 * nb[0], p1[1] + delta_b / 2.0 * nb[1]);
    let (t1, t2, t3, t4) = (p1[1] - p0[1], p1[0] - p0[0], p2[1] - p1[1], p2[0] - p1[0]);
    let y = (t1 * t4 * ya - t2 * t3 * yb - t2 * t4 * za + t2 * t4 * zb) / (t1 * t4 - t2 * t3);
    let z = (t1 * t3 * ya - t1 * t3 * yb - t2 * t3 * za + t1 * t4 * zb) / (t1 * t4 - t2 * t3);
    let polygon = Centreline::new(vec![p0, p1, p2], false).unwrap().polygon(&[delta_a, delta_b]).unwrap();
    assert!(polygon.outer().iter().any(|v| (v[0] - y).abs() < 1e-14 && (v[1] - z).abs() < 1e-14), "{polygon:?} {y} {z}");
}

#[test]
fn bevels_shoulders_and_butts() {
    // A turn of 160°: the miter would be 5.8 half thicknesses long.
    let (sin, cos) = 160f64.to_radians().sin_cos();
    let sharp = Centreline::new(vec![[-5.0, 0.0], [0.0, 0.0], [5.0 * cos, 5.0 * sin]], false).unwrap();
    assert_eq!(sharp.polygon(&[0.1]).unwrap().outer().len(), 7);
    let spiked = sharp.with_miter_limit(6.0).unwrap().polygon(&[0.1]).unwrap();
    assert_eq!(spiked.outer().len(), 6);
    assert!((spiked.area() - 1.0).abs() < 1e-14);
    // A step on a straight line.
    let straight = Centreline::new(vec![[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]], false).unwrap();
    let stepped = straight.polygon(&[0.2, 0.4]).unwrap();
    assert_eq!(
        stepped.outer(),
        [[0.0, -0.1], [1.0, -0.1], [1.0, -0.2], [3.0, -0.2], [3.0, 0.2], [1.0, 0.2], [1.0, 0.1], [0.0, 0.1]]
    );
    assert!((straight.polygon(&[0.2]).unwrap().area() - 0.6).abs() < 1e-15);
    // A line that runs back over itself is cut square there, and its outline overlaps: refused.
    let back = Centreline::new(vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]], false).unwrap();
    let tip: Vec<[f64; 2]> = back.outline(false)[0].iter().map(|vertex| vertex.at(|_| 0.2)).filter(|v| v[0] > 1.5).collect();
    assert_eq!(tip.len(), 4);
    assert!(tip.iter().all(|v| v[0] == 2.0 && v[1].abs() == 0.1));
    assert!(matches!(back.polygon(&[0.2]), Err(PolylineError::Outline(_))));
}

#[test]
fn bad_input_is_refused_with_the_place() {
    let line = |points: &[[f64; 2]]| Centreline::new(points.to_vec(), false);
    assert_eq!(line(&[[0.0, 0.0]]), Err(PolylineError::TooFewPoints { count: 1, least: 2 }));
    assert_eq!(line(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]]), Err(PolylineError::ZeroSegment { segment: 2 }));
    assert_eq!(line(&[[0.0, 0.0], [f64::NAN, 0.0]]), Err(PolylineError::NotFinite { point: 2 }));
    assert_eq!(Centreline::new(vec![[0.0, 0.0], [1.0, 0.0]], true), Err(PolylineError::TooFewPoints { count: 2, least: 3 }));
    let corner = line(&[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0]]).unwrap();
    assert_eq!(corner.polygon(&[0.1, 0.1, 0.1]), Err(PolylineError::ThicknessCount { expected: 2, found: 3 }));
    assert_eq!(corner.polygon(&[0.1, 0.0]), Err(PolylineError::Thickness { segment: 2, value: 0.0 }));
    assert_eq!(corner.polygon(&[2.5]), Err(PolylineError::FoldOver { segment: 2 }));
    assert!(matches!(corner.with_miter_limit(0.5), Err(PolylineError::MiterLimit { .. })));
    // Far parts that run into one another.
    let hook = line(&[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0], [0.0, 0.1]]).unwrap();
    assert!(matches!(hook.polygon(&[0.3]), Err(PolylineError::Outline(_))));
    // The first point again closes the line.
    assert!(line(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]).unwrap().is_closed());
}
