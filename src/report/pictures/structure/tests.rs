use super::*;
use crate::problem::structure::Plane;
use crate::report::About;
use crate::report::structure::{CaseCourses, MemberPlace, NodePlace};

/// A cantilever along x with an arm of 0.2 at its root and a load of 1 at its tip.
fn cantilever(plane: Plane) -> Courses {
    let node = |name: &str, x: f64, held: [bool; 6]| NodePlace { name: name.into(), position: [x, 0.0, 0.0], held };
    let member = MemberPlace {
        rib: 0,
        name: "arm & more".into(),
        nodes: [0, 1],
        ends: [[0.2, 0.0, 0.0], [2.0, 0.0, 0.0]],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        pinned: false,
    };
    let stations = vec![0.0, 0.5, 1.0];
    let case = CaseCourses {
        name: "P".into(),
        nodes: vec![[0.0; 6], [0.0, 0.0, -0.01, 0.0, 0.1, 0.0]],
        reactions: vec![(0, [0.0, 0.0, 1.0, 0.0, -2.0, 0.0])],
        forces: vec![[0.0, 0.0, 1.0, 0.0, -1.8, 0.0], [0.0, 0.0, 1.0, 0.0, -0.9, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]],
        moved: vec![[0.0; 3], [0.0, 0.0, -0.004], [0.0, 0.0, -0.01]],
    };
    let nodes = vec![node("root", 0.0, [true; 6]), node("tip", 2.0, [false; 6])];
    Courses { plane, stations, nodes, members: vec![member], cases: vec![case], simple_cases: 1 }
}

#[test]
fn the_shape_tells_where_it_moves_most_and_how_it_is_drawn() {
    let about = About { title: "T".into(), units: vec![("length".into(), "m".into())], ..About::default() };
    let picture = displaced(&cantilever(Plane::Xz), &about);
    assert!(picture.contains("the largest, 0.01 m, at tip") && picture.contains("-fold"), "{picture}");
}

#[test]
fn only_forces_that_are_there_are_drawn_and_moments_stand_in_tension() {
    let picture = forces(&cantilever(Plane::Xz), &About::default()).unwrap();
    assert!(picture.contains("P: Vz") && picture.contains("P: My") && !picture.contains("P: N"), "{picture}");
    // A hogging moment is in tension at the top: its number stands above the rib, which is in the middle of the panel.
    let line = picture.lines().find(|line| line.contains(">-1.8<")).unwrap();
    let y: f64 = line.split("y=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap().parse().unwrap();
    assert!(y < TOP + NAME - 10.0 + 54.0, "{line}");
}

#[test]
fn nothing_at_all_makes_pictures_too() {
    let none = Courses { stations: vec![0.0, 1.0], cases: vec![CaseCourses::default()], simple_cases: 1, ..Courses::default() };
    assert!(displaced(&none, &About::default()).ends_with("</svg>\n"));
    assert!(forces(&none, &About::default()).is_none());
    let mut nan = cantilever(Plane::Space);
    nan.members[0].ends = [[f64::NAN; 3]; 2];
    assert!(!displaced(&nan, &About::default()).contains("NaN"));
}

#[test]
fn tables_leave_out_directions_that_a_plane_has_not() {
    let mut text = Vec::new();
    cantilever(Plane::Xz).write_displacements(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert_eq!(text, "node,case,x,y,z,rx,ry,rz\nroot,P,0.0,,0.0,,0.0,\ntip,P,0.0,,-0.01,,0.1,\n");
    let mut text = Vec::new();
    cantilever(Plane::Xz).write_forces(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert_eq!(text.lines().nth(2), Some("arm & more,P,0.5,0.0,0.0,1.0,0.0,-0.9,0.0"));
}

#[test]
fn vtu_has_points_cells_and_what_there_is_of_forces() {
    let mut text = Vec::new();
    crate::report::structure::write_vtu(&cantilever(Plane::Space), &[Some(0.5)], &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    for expected in ["NumberOfPoints=\"3\" NumberOfCells=\"2\"", "P displacement", "\"P My\"", "0 0 -0.004", "utilisation"] {
        assert!(text.contains(expected), "{expected}: {text}");
    }
    assert!(!text.contains("\"P N\""));
}
