//! Corners that weakly active limits leave, one alone or several together.

use super::*;

/// Σx_i² − share·Σx_i·x_j over all pairs, every x_i ≥ 0 as a bound or as a row.
fn tied(count: usize, share: f64, by_rows: bool) -> Sample {
    let objective = move |x: &[Value]| {
        let mut total = Value::from(0.0);
        for i in 0..count {
            total += x[i] * x[i];
            (0..i).for_each(|j| total -= x[i] * x[j] * share);
        }
        total
    };
    let model = Sample::new(&vec![1.0; count], objective);
    (0..count).fold(model, |model, i| if by_rows { model.row(0.0, INF, move |x| x[i]) } else { model.bound(i, 0.0, INF) })
}

#[test]
fn corners_that_only_several_weak_limits_together_leave_do_not_pass() {
    for count in 2..7 {
        // Falls along (1, …, 1) where share > 2/(count − 1), and no smaller face shows it.
        let edge = 2.0 / (count as f64 - 1.0);
        for by_rows in [false, true] {
            let origin = vec![0.0; count];
            let point = judge(&tied(count, 1.05 * edge, by_rows), &origin);
            assert!(!point.certified && point.negative_curvature);
            let escape = point.escape.unwrap();
            assert!(escape.iter().all(|v| *v > 0.8 * escape[0]), "{escape:?}");
            assert!(judge(&tied(count, 0.95 * edge, by_rows), &origin).certified);
        }
    }
    let point = judge(&tied(2, 3.0, false), &[0.0, 0.0]);
    assert!(point.messages.iter().any(|text| text.contains("x[1] +0.71") && text.contains("x[2] +0.71")), "{:?}", point.messages);
}

#[test]
fn dependent_weak_limits_are_looked_at() {
    let thrice = |share: f64| tied(2, share, true).row(0.0, INF, |x| x[0] + x[1]).row(0.0, INF, |x| x[0] * 2.0);
    let point = judge(&thrice(3.0), &[0.0, 0.0]);
    assert!(!point.certified && point.negative_curvature && point.multipliers_not_unique);
    assert!(judge(&thrice(1.9), &[0.0, 0.0]).certified);
    // Two limits that leave no way but along them: what S does across does not count.
    let pinned = Sample::new(&[1.0, 1.0], |x| x[1] * x[1] - x[0] * x[0] * 5.0 + x[0] * x[1] * 7.0);
    let pinned = pinned.row(0.0, INF, |x| x[0]).row(-INF, 0.0, |x| x[0]);
    assert!(judge(&pinned, &[0.0, 0.0]).certified);
}

#[test]
fn weak_limits_beside_strict_and_free_directions() {
    // x strictly active, y weakly, z free: on the cone y² − 4yz + 3z² falls for z = ⅔y, though the curvature along z alone is positive.
    let corner = |cross: f64| {
        Sample::new(&[1.0, 1.0, 1.0], move |x| x[0] - x[0] * x[0] * 9.0 + x[1] * x[1] - x[1] * x[2] * cross + x[2] * x[2] * 3.0)
            .bound(0, 0.0, INF)
            .bound(1, 0.0, INF)
    };
    assert!(judge(&corner(4.0), &[0.0; 3]).negative_curvature);
    assert!(judge(&corner(3.0), &[0.0; 3]).certified);
    // Nearly saddles: a little beside one, multipliers of rounding's size hold nothing.
    let saddle = Sample::new(&[1.0, 1.0], |x| x[1] * x[1] + x[0] * x[1] * 10.0 - x[0] * x[0]).bound(0, 0.0, INF);
    for beside in [0.0, 1e-9, 4e-7] {
        assert!(!judge(&saddle, &[0.0, beside]).certified, "{beside}");
    }
}

#[test]
fn flat_faces_are_left_inwards() {
    // xy has no positive curvature on the edges of the quadrant; what lies beyond decides.
    let quadrant =
        |power: f64| Sample::new(&[1.0, 1.0], move |x| x[0] * x[1] + x[0].powi(3) * power).bound(0, 0.0, INF).bound(1, 0.0, INF);
    let point = judge(&quadrant(-1.0), &[0.0, 0.0]);
    assert!(!point.certified && point.descends_at_higher_order && point.escape.unwrap()[0] > 0.0);
    assert!(judge(&quadrant(1.0), &[0.0, 0.0]).certified);
    // Two at once: x⁴ + y⁴ − 3x²y² rises along both edges.
    let both = Sample::new(&[1.0, 1.0], |x| x[0].powi(4) + x[1].powi(4) - x[0] * x[0] * x[1] * x[1] * 3.0);
    assert!(judge(&both.bound(0, 0.0, INF).bound(1, 0.0, INF), &[0.0, 0.0]).descends_at_higher_order);
}

#[test]
fn too_many_weak_limits_to_look_at_are_no_proof() {
    // Motzkin and Straus 1965: τ(Σx)² less the edges of a graph is copositive from τ = 1 − 1/ω on; eight pentagons, all joined,
    // hold ω = 16 but far too many faces.
    let count = 40;
    let horn = Sample::new(&vec![1.0; count], move |x| {
        let sum = |range: std::ops::Range<usize>| range.fold(Value::from(0.0), |sum, i| sum + x[i]);
        let mut total = sum(0..count) * sum(0..count) * (15.0 / 16.0 + 0.001 - 1.0);
        for group in 0..count / 5 {
            let first = 5 * group;
            total += sum(first..first + 5) * sum(first..first + 5);
            (0..5).for_each(|i| total -= x[first + i] * x[first + (i + 1) % 5] * 2.0);
        }
        total
    });
    let horn = (0..count).fold(horn, |model, i| model.bound(i, 0.0, INF));
    let point = judge(&horn, &vec![0.0; count]);
    assert!(!point.certified && !point.negative_curvature && point.undecided == Some(count), "{point:?}");
    assert!(point.messages.iter().any(|text| text.contains("not proved at 40 weakly active limits")));
    // A convex class needs no second order.
    let convex = certify(&horn, Class::Convex, &vec![0.0; count], None, Tolerances::default()).unwrap();
    assert!(convex.certified && convex.undecided.is_none());
}
