use super::*;
use crate::mesh::stations::Frame;
use crate::mesh::{Vector, formats};

fn rectangle(b: f64, h: f64) -> Vec<Ring> {
    vec![vec![[-b / 2., -h / 2.], [b / 2., -h / 2.], [b / 2., h / 2.], [-b / 2., h / 2.]]]
}

pub(crate) fn h_beam(tw: f64, hw: f64, b: f64, h: f64) -> Vec<Ring> {
    let (w, y, x, top) = (tw / 2., hw / 2., b / 2., h / 2.);
    let right = [[x, -top], [x, -y], [w, -y], [w, y], [x, y], [x, top]];
    let left = right.iter().rev().map(|p| [-p[0], p[1]]);
    vec![right.into_iter().chain(left).collect()]
}

fn rib(name: &str, ends: [[f64; 3]; 2], joints: [u32; 2], rings: [Vec<Ring>; 2]) -> SizedRib {
    let ends = ends.map(Vector::from);
    let frame = Frame::new(ends[1] - ends[0], Vector::z()).unwrap();
    let geometry = RibGeometry { name: name.into(), line: "L1".into(), ends, frame, joints };
    SizedRib { geometry, rings, tags: vec![0.3], utilisation: Some(0.85), model_volume: None }
}

#[test]
fn a_tapered_h_beam_has_the_volume_of_formulas() {
    let rings = [h_beam(8., 180., 100., 200.), h_beam(6., 100., 60., 130.)];
    assert!((prismatoid_volume(&rings, 1000.0) / 2_960_000.0 - 1.0).abs() < 1e-15);
    let solids = build(&[rib("a", [[1., 2., 3.], [1., 1002., 3.]], [0, 1], rings)], &["h".into()]).unwrap();
    assert!((solids.report.volume / 2_960_000.0 - 1.0).abs() < 1e-12);
    assert!(solids.report.largest_difference < 1e-12 && solids.report.joints.is_empty());
    assert_eq!(solids.mesh.groups, ["a utilisation_080_090"]);
}

#[test]
fn a_twisting_rectangle_and_a_tube_too() {
    let tube = |r: f64, t: f64| -> Vec<Ring> {
        let ring = |r: f64| {
            (0..24).map(move |k| f64::from(k) * std::f64::consts::TAU / 24.0).map(move |a| [r * a.cos(), 0.5 * r * a.sin()])
        };
        vec![ring(r).collect(), ring(r - t).rev().collect()]
    };
    let ends = [[0., 0., 0.], [3., 4., 1.]];
    let ribs = [
        rib("flat", ends, [0, 1], [rectangle(0.05, 0.4), rectangle(0.4, 0.05)]),
        rib("tube", ends, [2, 3], [tube(0.2, 0.02), tube(0.3, 0.05)]),
    ];
    let solids = build(&ribs, &[]).unwrap();
    assert!(solids.report.largest_difference < 1e-12, "{:?}", solids.report);
    let mut stl = Vec::new();
    formats::write_stl(&mut stl, &solids.mesh).unwrap();
    let back = formats::read_stl(&mut std::io::Cursor::new(stl)).unwrap();
    assert!((back.volume() / solids.report.volume - 1.0).abs() < 1e-6, "{}", back.volume());
}

#[test]
fn overlap_of_a_right_angle_and_of_a_crossing() {
    let bar = || [rectangle(0.2, 0.5), rectangle(0.2, 0.5)];
    let arm = |k: usize, x: f64, y: f64| rib(&format!("r{k}"), [[0.; 3], [x, y, 0.]], [0, k as u32], bar());
    let corner = build(&[arm(1, 2., 0.), arm(2, 0., 2.)], &[]).unwrap();
    assert!((corner.report.overlap_volume - 0.1 * 0.1 * 0.5).abs() < 1e-12);
    let crossing = build(&[arm(1, 2., 0.), arm(2, 0., 2.), arm(3, -2., 0.), arm(4, 0., -2.)], &[]).unwrap();
    assert!((crossing.report.overlap_volume - 0.2 * 0.2 * 0.5).abs() < 1e-12);
    assert_eq!((crossing.report.overlapping_joints, crossing.report.joints[0].ribs), (1, 4));
    let straight = build(&[arm(1, 2., 0.), arm(3, -2., 0.)], &[]).unwrap();
    assert_eq!(straight.report.overlapping_joints, 0);
}

#[test]
fn ends_of_different_kinds_are_an_error() {
    let mixed = rib("x", [[0.; 3], [1., 0., 0.]], [0, 1], [rectangle(0.1, 0.2), h_beam(0.01, 0.1, 0.1, 0.2)]);
    assert!(build(&[mixed], &[]).unwrap_err().to_string().starts_with("x: its ends have different outlines (4 and 12"));
}
