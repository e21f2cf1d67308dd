//! Every property of every kind against its own outline, and derivatives against differences.

mod other_sources;
mod plastic;

use super::*;
use crate::expression::tape;
use crate::geometry::Polygon;

/// A kind at some dimensions, with points where it has an outline.
struct Case {
    kind: &'static str,
    form: usize,
    given: &'static [f64],
    outline: &'static [&'static [[f64; 2]]],
}

const ANGLE: &[&[[f64; 2]]] = &[&[[0.0, 0.0], [0.6, 0.0], [0.6, 0.1], [0.1, 0.1], [0.1, 1.0], [0.0, 1.0]]];
const CHANNEL: &[&[[f64; 2]]] = &[&[[0.4, 0.0], [0.0, 0.0], [0.0, 1.0], [0.5, 1.1]]];
/// With a triangle and a square cut out, the second anticlockwise.
const PLATE: &[&[[f64; 2]]] = &[
    &[[0.0, 0.0], [0.8, -0.1], [1.0, 0.4], [0.6, 0.9], [0.1, 0.7]],
    &[[0.2, 0.1], [0.4, 0.3], [0.4, 0.1]],
    &[[0.5, 0.4], [0.7, 0.4], [0.7, 0.6], [0.5, 0.6]],
];
const RING: &[&[[f64; 2]]] = &[&[[0.0, 0.0], [1.0, 0.0], [1.2, 0.7], [0.3, 0.9], [0.0, 0.0]]];
const STEPPED: &[&[[f64; 2]]] = &[&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.02], [1.0, 0.8]]];

const CASES: &[Case] = &[
    Case { kind: "rectangle", form: 0, given: &[0.2, 0.5], outline: &[] },
    Case { kind: "h-beam", form: 0, given: &[0.02, 0.4, 0.3, 0.03], outline: &[] },
    Case { kind: "h-beam", form: 4, given: &[0.02, 0.4, 0.3, 0.46], outline: &[] },
    Case { kind: "h-beam", form: 6, given: &[0.02, 0.4, 0.3, 0.03, 0.05], outline: &[] },
    Case { kind: "h-beam", form: 7, given: &[0.02, 0.3, 0.03, 0.46, 0.05], outline: &[] },
    Case { kind: "superellipse", form: 0, given: &[0.3, 0.5, 2.5], outline: &[] },
    Case { kind: "superellipse", form: 0, given: &[0.3, 0.2, 0.8], outline: &[] },
    Case { kind: "tee", form: 0, given: &[0.02, 0.4, 0.3, 0.03], outline: &[] },
    Case { kind: "tee", form: 1, given: &[0.02, 0.4, 0.3, 0.43], outline: &[] },
    Case { kind: "tee", form: 2, given: &[0.02, 0.3, 0.03, 0.43], outline: &[] },
    // The plastic axis in the flange, and in the web.
    Case { kind: "tee", form: 0, given: &[0.02, 0.2, 0.3, 0.03], outline: &[] },
    Case { kind: "tee", form: 0, given: &[0.04, 0.4, 0.3, 0.03], outline: &[] },
    Case { kind: "i-section", form: 0, given: &[0.01, 0.3, 0.1, 0.02, 0.4, 0.05], outline: &[] },
    Case { kind: "i-section", form: 0, given: &[0.01, 0.3, 0.4, 0.05, 0.1, 0.02], outline: &[] },
    Case { kind: "channel", form: 0, given: &[0.02, 0.2, 0.3, 0.04], outline: &[] },
    Case { kind: "angle", form: 0, given: &[0.3, 0.1, 0.03], outline: &[] },
    Case { kind: "box", form: 0, given: &[0.3, 0.5, 0.01, 0.02], outline: &[] },
    Case { kind: "circle", form: 0, given: &[0.3], outline: &[] },
    Case { kind: "tube", form: 0, given: &[0.3, 0.02], outline: &[] },
    Case { kind: "polygon", form: 0, given: &[0.7], outline: ANGLE },
    Case { kind: "polygon", form: 1, given: &[0.7, 1.3], outline: ANGLE },
    Case { kind: "polygon", form: 0, given: &[0.7], outline: PLATE },
    Case { kind: "polygon", form: 1, given: &[0.7, 1.3], outline: PLATE },
    Case { kind: "polyline", form: 0, given: &[0.05], outline: CHANNEL },
    Case { kind: "polyline", form: 3, given: &[0.05, 0.03, 0.04], outline: CHANNEL },
    Case { kind: "polyline", form: 0, given: &[0.05], outline: RING },
    Case { kind: "polyline", form: 4, given: &[0.05, 0.03, 0.04, 0.05], outline: RING },
    Case { kind: "polyline", form: 3, given: &[0.05, 0.03, 0.04], outline: STEPPED },
    Case { kind: "i-section", form: 0, given: &[0.02, 0.4, 0.2, 0.03, 0.3, 0.04], outline: &[] },
    Case { kind: "channel", form: 0, given: &[0.02, 0.4, 0.15, 0.03], outline: &[] },
    Case { kind: "channel", form: 1, given: &[0.02, 0.15, 0.03, 0.46], outline: &[] },
    Case { kind: "angle", form: 0, given: &[0.15, 0.25, 0.02], outline: &[] },
];

fn rings(outline: &[&[[f64; 2]]]) -> Vec<Ring> {
    outline.iter().map(|ring| ring.to_vec()).collect()
}

impl Case {
    fn kind(&self) -> &'static dyn Kind {
        kind(self.kind).unwrap()
    }

    fn form(&self) -> &'static Form {
        &self.kind().forms()[self.form]
    }

    fn outline(&self) -> Vec<Ring> {
        rings(self.outline)
    }

    fn value(&self, name: &str) -> Option<f64> {
        evaluate(self.kind(), self.form(), self.given, &self.outline(), name)
    }

    fn curved(&self) -> bool {
        ["superellipse", "circle", "tube"].contains(&self.kind) || self.form().dimensions.contains(&"r") && self.kind == "h-beam"
    }
}

#[test]
fn properties_are_those_of_the_outline() {
    for case in CASES {
        let rings = case.kind().rings(case.form(), case.given, &case.outline(), 1e-8);
        let polygon = Polygon::new(rings[0].clone(), rings[1..].to_vec()).unwrap();
        // Rings come oriented and about the centroid.
        assert_eq!(polygon.rings(), rings, "{}", case.kind);
        let own = polygon.properties();
        assert!(own.centroid.iter().all(|part| part.abs() < 1e-9), "{}: {:?}", case.kind, own.centroid);
        let span = |d: usize| {
            let all = || rings[0].iter().map(|vertex| vertex[d]);
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        let expected = [
            ("A", own.area),
            ("Ix", own.ix),
            ("Iy", own.iy),
            ("Ixy", own.ixy),
            ("Wx", own.wx()),
            ("Wx_top", own.wx_top),
            ("Wx_bottom", own.wx_bottom),
            ("Wy", own.wy()),
            ("Wy_left", own.wy_left),
            ("Wy_right", own.wy_right),
            ("width", span(0)),
            ("height", span(1)),
        ];
        let tolerance = if case.curved() { 1e-5 } else { 1e-11 };
        for (name, expected) in expected {
            let Some(ours) = case.value(name) else {
                assert!(!case.kind().properties().contains(&name), "{} lacks {name}", case.kind);
                continue;
            };
            assert!((ours - expected).abs() <= tolerance * expected.abs(), "{} {name}: {ours} {expected}", case.kind);
        }
    }
}

#[test]
fn every_listed_name_is_offered_and_no_other() {
    for case in CASES {
        for name in case.kind().properties() {
            let of_another_form = name.starts_with("thickness") || name.starts_with("scale");
            let value = case.value(name);
            assert!(value.is_some_and(f64::is_finite) || of_another_form, "{} {name}: {value:?}", case.kind);
        }
        for dimension in case.form().dimensions {
            assert!(case.kind().properties().contains(dimension) && case.value(dimension).is_some(), "{} {dimension}", case.kind);
        }
        assert_eq!(case.value("nonsense"), None);
        assert_eq!(case.kind().defect(case.form(), case.given, &case.outline()), None, "{}", case.kind);
    }
}

#[test]
fn parts_make_up_the_area() {
    for case in CASES {
        let mut graph = Graph::new();
        let dimensions: Vec<NodeId> = case.given.iter().map(|value| graph.constant(*value)).collect();
        let given = Given { form: case.form(), dimensions: &dimensions, outline: &case.outline() };
        let parts = case.kind().parts(&mut graph, &given);
        let sum: f64 = parts.iter().map(|part| graph.as_constant(*part).unwrap()).sum();
        assert!((sum - case.value("A").unwrap()).abs() < 1e-15, "{}", case.kind);
        let length = |length: &Length| {
            let less = length.minus.map_or(0.0, |(factor, at)| factor * case.given[at]);
            length.scale * (case.given[length.plus] - less)
        };
        let factors = case.kind().part_factors(case.form());
        for ([first, second], part) in factors.iter().zip(&parts) {
            assert!((length(first) * length(second) - graph.as_constant(*part).unwrap()).abs() < 1e-15, "{}", case.kind);
        }
        let count = match case.kind {
            "h-beam" => {
                if case.form().dimensions.contains(&"r") {
                    3
                } else {
                    2
                }
            }
            "tee" | "angle" => 2,
            "i-section" | "channel" => 3,
            _ => 1,
        };
        assert_eq!(parts.len(), count, "{}", case.kind);
    }
}

/// The tape of a property in the case's dimensions, slots in their order.
fn property_tape(case: &Case, name: &str) -> (tape::Tape, tape::Binding) {
    let mut graph = Graph::new();
    let dimensions: Vec<NodeId> = (0..case.given.len() as u32).map(|slot| graph.input(slot)).collect();
    let outline = case.outline();
    let given = Given { form: case.form(), dimensions: &dimensions, outline: &outline };
    let node = case.kind().property(&mut graph, &given, name).unwrap();
    tape::Tape::compile(&graph, node).unwrap()
}

#[test]
fn first_and_second_derivatives_by_differences() {
    let mut workspace = tape::Workspace::default();
    for case in CASES {
        for name in case.kind().properties().iter().filter(|name| case.value(name).is_some()) {
            let (tape, binding) = property_tape(case, name);
            let inputs: Vec<usize> = binding.inputs.iter().map(|slot| *slot as usize).collect();
            let at: Vec<f64> = inputs.iter().map(|slot| case.given[*slot]).collect();
            let mut gradient = |x: &[f64]| {
                let mut gradient = vec![0.0; x.len()];
                let value = tape.gradient(x, &[], &mut workspace, &mut gradient);
                (value, gradient)
            };
            let (value, exact) = gradient(&at);
            assert!((value - case.value(name).unwrap()).abs() <= 1e-14 * value.abs(), "{} {name}", case.kind);
            let mut second = vec![0.0; tape.hessian_pattern().len()];
            let moved: Vec<_> = (0..at.len())
                .map(|j| {
                    let step = 1e-5 * at[j];
                    let by =
                        |step: f64| at.iter().enumerate().map(|(k, x)| if k == j { x + step } else { *x }).collect::<Vec<_>>();
                    (2.0 * step, gradient(&by(step)), gradient(&by(-step)))
                })
                .collect();
            for (j, (width, plus, minus)) in moved.iter().enumerate() {
                let difference = (plus.0 - minus.0) / width;
                assert!(
                    (exact[j] - difference).abs() <= 1e-7 * ((value / at[j]).abs() + exact[j].abs()),
                    "{} {name} by {j}: {} {difference}",
                    case.kind,
                    exact[j]
                );
            }
            tape.hessian(&at, &[], &mut workspace, &mut second);
            for (entry, (row, column)) in second.iter().zip(tape.hessian_pattern()) {
                let (row, column) = (*row as usize, *column as usize);
                let (width, plus, minus) = &moved[column];
                let difference = (plus.1[row] - minus.1[row]) / width;
                let size = (value / (at[row] * at[column])).abs() + entry.abs();
                assert!((entry - difference).abs() <= 1e-6 * size, "{} {name} {row} {column}: {entry} {difference}", case.kind);
            }
        }
    }
}

#[test]
fn defects_are_told() {
    let defect = |kind_name: &str, form: usize, given: &[f64], outline: &[&[[f64; 2]]]| {
        let kind = kind(kind_name).unwrap();
        kind.defect(&kind.forms()[form], given, &rings(outline))
    };
    assert_eq!(defect("tube", 0, &[0.1, 0.06], &[]).unwrap(), "di is -0.01999999999999999; it must be positive");
    assert_eq!(defect("circle", 0, &[0.0], &[]).unwrap(), "d is 0; it must be positive");
    assert!(defect("tee", 1, &[0.02, 0.4, 0.3, 0.35], &[]).unwrap().starts_with("tf is"));
    assert!(defect("polyline", 0, &[1.0], CHANNEL).unwrap().starts_with("clear is"));
    assert!(defect("polyline", 2, &[0.1, 0.1], CHANNEL).unwrap().starts_with("2 thicknesses for 3 segments"));
    let hook = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0], [0.0, 0.2]];
    assert!(defect("polyline", 0, &[0.5], &[&hook]).unwrap().contains("crosses or touches itself"));
    let bow = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let polygon = kind("polygon").unwrap();
    assert!(polygon.has_outline() && polygon.outline_defect(&polygon.forms()[0], &[bow]).unwrap().contains("edges 1 and 3"));
    assert_eq!(polygon.outline_defect(&polygon.forms()[0], &rings(PLATE)), None);
}

#[test]
fn posynomial_volumes_are_told_by_form() {
    let of = |name: &str| {
        let kind = kind(name).unwrap();
        kind.forms().iter().map(|form| kind.posynomial_volume(form)).collect::<Vec<_>>()
    };
    assert_eq!(of("h-beam"), [true, false, false, true, false, false, true, false]);
    assert_eq!(of("tee"), [true, false, false]);
    assert_eq!((of("box"), of("tube"), of("polygon")), (vec![false], vec![false], vec![true, true]));
}
