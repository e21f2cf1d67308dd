use super::*;
use crate::geometry::polygon::ring_moments;
use crate::math::integrate;
use proptest::prelude::*;
use std::f64::consts::PI;

fn shapes() -> impl Strategy<Value = Superellipse> {
    (0.1..10.0f64, 0.1..10.0f64, prop_oneof![0.4..6.0f64, Just(1.0), Just(2.0)]).prop_map(|(a, b, r)| Superellipse { a, b, r })
}

proptest! {
    #[test]
    fn area_is_the_printed_one(shape in shapes()) {
        let Superellipse { a, b, r } = shape;
        let gammas = (ln_gamma(1.0 + 1.0 / r) - ln_gamma(0.5 + 1.0 / r)).exp();
        let printed = 4f64.powf(1.0 - 1.0 / r) * a * b * PI.sqrt() * gammas;
        prop_assert!((shape.area() - printed).abs() <= 1e-13 * printed);
    }

    #[test]
    fn gradients_by_central_differences(shape in shapes()) {
        let Superellipse { a, b, r } = shape;
        let step = 1e-6;
        let differences = |f: &dyn Fn(Superellipse) -> f64| {
            let slope = |plus, minus| (f(plus) - f(minus)) / (2.0 * step);
            [
                slope(Superellipse { a: a + step, b, r }, Superellipse { a: a - step, b, r }),
                slope(Superellipse { a, b: b + step, r }, Superellipse { a, b: b - step, r }),
                slope(Superellipse { a, b, r: r + step }, Superellipse { a, b, r: r - step }),
            ]
        };
        for (value, ours, theirs) in [
            (shape.area(), shape.area_gradient(), differences(&|s| s.area())),
            (shape.ix(), shape.ix_gradient(), differences(&|s| s.ix())),
            (shape.iy(), shape.iy_gradient(), differences(&|s| s.iy())),
        ] {
            for k in 0..3 {
                prop_assert!((ours[k] - theirs[k]).abs() <= 1e-6 * (value + ours[k].abs()), "{k}: {} {}", ours[k], theirs[k]);
            }
        }
    }

    #[test]
    fn the_printed_slope_of_ix(shape in shapes()) {
        let r = shape.r;
        let printed = -2.0 / r + (4.0 * digamma(1.0 + 4.0 / r) - digamma(1.0 / r) - 3.0 * digamma(3.0 / r)) / (r * r);
        prop_assert!((shape.moment_slope() - printed).abs() < 1e-12 * (1.0 + 1.0 / (r * r)));
    }

    #[test]
    fn polygons_keep_their_tolerance(shape in shapes(), t in 0.0..(2.0 * PI)) {
        let tolerance = 1e-3 * shape.a.min(shape.b);
        let polygon = shape.polygon(tolerance).unwrap();
        let [x, y] = shape.point(t);
        let nearest = (0..polygon.len())
            .map(|i| distance([x, y], polygon[i], polygon[(i + 1) % polygon.len()]))
            .fold(f64::INFINITY, f64::min);
        prop_assert!(nearest <= tolerance * (1.0 + 1e-9), "{nearest} {tolerance}");
        for [x, y] in polygon {
            prop_assert!(((x / shape.a).abs().powf(shape.r) + (y / shape.b).abs().powf(shape.r) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn curve_lies_on_the_equation(shape in shapes(), t in 0.0..(2.0 * PI)) {
        let [x, y] = shape.point(t);
        prop_assert!(((x / shape.a).abs().powf(shape.r) + (y / shape.b).abs().powf(shape.r) - 1.0).abs() < 1e-12);
        prop_assert!(x * t.cos() >= 0.0 && y * t.sin() >= 0.0);
    }
}

fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (d, e) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let share = ((d[0] * e[0] + d[1] * e[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
    (e[0] - share * d[0]).hypot(e[1] - share * d[1])
}

#[test]
fn special_cases_in_closed_form() {
    let of = |r| Superellipse::new(3.0, 2.0, r).unwrap();
    let close = |ours: f64, exact: f64| assert!((ours - exact).abs() < 1e-13 * exact, "{ours} {exact}");
    // Astroid 3π/8·ab, diamond 2ab with Ix = ab³/3, ellipse πab with πab³/4.
    close(of(2.0 / 3.0).area(), 3.0 / 8.0 * PI * 6.0);
    close(of(1.0).area(), 12.0);
    close(of(1.0).ix(), 3.0 * 8.0 / 3.0);
    close(of(2.0).area(), 6.0 * PI);
    close(of(2.0).iy(), PI * 2.0 * 27.0 / 4.0);
    // Ever larger exponents approach the rectangle 2a × 2b.
    close(of(1e9).area(), 24.0);
    close(of(1e9).ix(), 6.0 * 64.0 / 12.0);
    assert_eq!(SPECIAL_CASES.map(|(r, _)| of(r).name()), SPECIAL_CASES.map(|(_, name)| Some(name)));
}

#[test]
fn moments_by_quadrature_and_by_polygon() {
    for r in [0.6, 1.0, 2.5, 4.0, 7.3] {
        let shape = Superellipse::new(1.5, 0.8, r).unwrap();
        // ∫y² dA = ∫ (2/3)·y(x)³ dx over the width
        let upper = |x: f64| 0.8 * (1.0 - (x / 1.5).powf(r)).max(0.0).powf(1.0 / r);
        let by_strips = integrate(|x| 4.0 / 3.0 * upper(x).powi(3), 0.0, 1.5, 1e-9).unwrap().value;
        assert!((shape.ix() - by_strips).abs() < 1e-8 * by_strips, "{r}");
        let polygon = ring_moments(&shape.polygon(1e-7).unwrap(), [0.0; 2]);
        assert!((polygon.area - shape.area()).abs() < 1e-6 * shape.area(), "{r}");
        assert!(
            (polygon.ix - shape.ix()).abs() < 2e-6 * shape.ix() && (polygon.iy - shape.iy()).abs() < 2e-6 * shape.iy(),
            "{r}"
        );
        assert!(polygon.ixy.abs() < 1e-12);
    }
}

#[test]
fn extremes_and_bad_input() {
    assert_eq!(
        Superellipse::new(1.0, 1.0, 1.0).unwrap().polygon(1e-9).unwrap(),
        [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]
    );
    for r in [0.05, 0.999, 1.001, 200.0] {
        let polygon = Superellipse::new(2.0, 1.0, r).unwrap().polygon(1e-4).unwrap();
        assert!(polygon.len() >= 4 && polygon.iter().flatten().all(|value| value.is_finite()), "{r}");
    }
    assert_eq!(Superellipse::new(1.0, 1.0, 0.0), Err(NotPositive { what: "r", value: 0.0 }));
    assert!(Superellipse::new(1.0, -1.0, 2.0).is_err() && Superellipse::new(f64::NAN, 1.0, 2.0).is_err());
    assert!(Superellipse::new(1.0, 1.0, 2.0).unwrap().polygon(0.0).is_err());
}
