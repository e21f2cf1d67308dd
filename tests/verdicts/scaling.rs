//! The same design in other units, with rows and variables of extreme size, and with an offset on the objective.

use super::whole_program::solve;
use serde_json::Value;

fn value(result: &Value, name: &str) -> f64 {
    result["variables"][name].as_f64().unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * b.abs()
}

/// A cantilever of rectangles with stress, deflection and slenderness limits; `m` and `kN` are the units' sizes in the file's
/// units. `offset` is added to the objective, `row` multiplies both sides of the stress limit.
fn cantilever(m: f64, kn: f64, offset: f64, row: f64) -> String {
    format!(
        r#"
minimize = "b*h*l/m^3 + w*0.1*h/b + {offset:e}"
[parameters]
m = {m:e}
kN = {kn:e}
l = "3*m"
P = "20*kN"
E = "210e6*kN/m^2"
w = 0.01
[variables]
b = {{ lower = "0.01*m", upper = "0.5*m", start = "0.2*m" }}
h = {{ lower = "0.02*m", upper = "1.0*m", start = "0.4*m" }}
[[constraints]]
name = "stress"
require = "{row:e}*6*P*l/(b*h^2) <= {row:e}*140e3*kN/m^2"
[[constraints]]
name = "sag"
require = "P*l^3/(3*E*b*h^3/12) <= l/150"
[[constraints]]
name = "slender"
require = "h - 8*b + b^2/m <= 0"
"#
    )
}

#[test]
fn millimetres_metres_newtons_and_kilonewtons_give_one_design() {
    let (code, reference) = solve(&cantilever(1.0, 1.0, 0.0, 1.0));
    assert_eq!(code, 0);
    for (m, kn) in [(1e3, 1.0), (1.0, 1e3), (1e3, 1e3), (1e-3, 1e-6), (1e6, 1e6)] {
        let (code, other) = solve(&cantilever(m, kn, 0.0, 1.0));
        assert_eq!((code, &other["status"]), (0, &reference["status"]), "{m} {kn}: {}", other["message"]);
        for name in ["b", "h"] {
            assert!(close(value(&other, name) / m, value(&reference, name)), "{m} {kn}: {name} {other}");
        }
    }
}

#[test]
fn rows_from_tiny_to_huge_give_one_design() {
    let (_, reference) = solve(&cantilever(1.0, 1.0, 0.0, 1.0));
    for row in [1e-10, 1e-5, 1e5, 1e10] {
        let (code, other) = solve(&cantilever(1.0, 1.0, 0.0, row));
        assert_eq!(code, 0, "{row}: {}", other["message"]);
        assert!(close(value(&other, "b"), value(&reference, "b")) && close(value(&other, "h"), value(&reference, "h")), "{row}");
    }
}

#[test]
fn an_offset_of_a_billion_on_the_objective_changes_nothing() {
    let (_, reference) = solve(&cantilever(1.0, 1.0, 0.0, 1.0));
    let (code, other) = solve(&cantilever(1.0, 1.0, 1e9, 1.0));
    assert_eq!(code, 0, "{}", other["message"]);
    assert!(close(value(&other, "b"), value(&reference, "b")) && close(value(&other, "h"), value(&reference, "h")), "{other}");
}

#[test]
fn variables_from_a_millionth_to_a_million_are_found_alike() {
    let of_size = |size: f64| {
        solve(&format!(
            r#"
minimize = "(x/s - 2)^2 + (y - 1)^2 + x*y/s"
[parameters]
s = {size:e}
[variables]
x = {{ lower = 0, upper = "10*s", start = "5*s" }}
y = {{ lower = 0, upper = 10, start = 5 }}
[[constraints]]
name = "disc"
require = "(x/s)^2 + y^2 <= 2"
"#
        ))
    };
    let (_, reference) = of_size(1.0);
    for size in [1e-6, 1e-3, 1e3, 1e6] {
        let (code, result) = of_size(size);
        assert_eq!(code, 0, "{size}: {}", result["message"]);
        assert!(close(value(&result, "x") / size, value(&reference, "x")), "{size}: {result}");
        assert!(close(value(&result, "y"), value(&reference, "y")), "{size}: {result}");
    }
}
