//! What a run says, and the exit code it ends with.

use std::fs;
use std::process::Command;

use super::whole_program::{solve, solve_with};
use serde_json::Value;
use tempfile::TempDir;

/// A file from an objective, lines of variables, and requirements named r1, r2, ….
fn problem(objective: &str, variables: &str, rows: &[&str]) -> String {
    let row = |(k, require): (usize, &&str)| format!("[[constraints]]\nname = \"r{}\"\nrequire = \"{require}\"\n", k + 1);
    let rows: String = rows.iter().enumerate().map(row).collect();
    format!("minimize = \"{objective}\"\n[variables]\n{variables}\n{rows}")
}

fn message(result: &Value) -> &str {
    result["message"].as_str().unwrap()
}

fn near(value: &Value, expected: f64) -> bool {
    value.as_f64().is_some_and(|value| (value - expected).abs() <= 1e-6 * expected.abs().max(1.0))
}

#[test]
fn another_point_of_equal_value_makes_the_minimiser_not_unique() {
    let box_of_three = "b = { size = 3, lower = 0.01, upper = 0.2 }";
    let (code, result) = solve(&problem("b[1] + b[2] + b[3]", box_of_three, &["b[1] + b[2] + b[3] >= 0.2"]));
    assert_eq!(code, 0);
    let is = message(&result).contains("The minimiser is not unique");
    let may_be = message(&result).contains("the minimiser may not be unique");
    // The first is said where the other backend ended elsewhere on the flat face, the second where both ended at one point: either is true.
    assert!(is ^ may_be, "{result}");
    let apart = result["agreement"]["variable_difference"].as_f64().is_some_and(|apart| apart > 1e-3);
    assert_eq!(is, apart);
}

#[test]
fn complementarity_constraints_and_dependent_rows_are_solved() {
    let (code, result) = solve(&problem(
        "(x-1)^2 + (y-2)^2",
        "x = { lower = 0, upper = 10, start = 1 }\ny = { lower = 0, upper = 10, start = 1 }",
        &["x*y <= 0"],
    ));
    assert!(code == 0 && near(&result["objective"], 1.0), "{result}");
    let rows = ["x >= 1", "y >= 1", "x + y >= 2", "x + 2*y >= 3", "x + 2*y >= 3"];
    let (code, result) = solve(&problem("x + y", "x = { start = 3 }\ny = { start = 3 }", &rows));
    assert!(code == 0 && near(&result["objective"], 2.0));
    assert!(message(&result).contains("one choice of many"));
    let rows = ["x + y == 2", "2*x + 2*y == 4", "x + y >= 2"];
    let (code, result) = solve(&problem("x^2 + y^2", "x = { start = 5 }\ny = { start = 5 }", &rows));
    assert!(code == 0 && near(&result["objective"], 2.0));
}

#[test]
fn a_constant_objective_equalities_only_fixed_variables_and_no_rows_are_solved() {
    let two = "x = { start = 0 }\ny = { start = 0 }";
    let (code, result) = solve(&problem("1", two, &["x^2 + y^2 == 4", "x*y == 1"]));
    assert!(code == 0 && near(&result["objective"], 1.0));
    let (code, result) = solve(&problem("x^2", "x = { lower = 2, upper = 2 }", &["x >= 1"]));
    assert!(code == 0 && near(&result["objective"], 4.0));
    let (code, result) = solve(&problem("(x-1)^2", "x = {}", &[]));
    assert!(code == 0 && near(&result["objective"], 0.0));
    let (code, result) = solve(&problem("x + y", two, &["x^2 + y^2 == 2"]));
    assert!(code == 0 && near(&result["objective"], -2.0), "singular Jacobian at the start");
}

#[test]
fn where_no_multipliers_exist_the_answer_is_close_but_not_certified() {
    let variables = "x = { lower = 0, start = 0 }\ny = { lower = 0, start = 0 }";
    let (code, result) = solve(&problem("(x-2)^2 + y^2", variables, &["(1-x)^3 - y >= 0"]));
    assert_eq!(code, 1, "{result}");
    // A violation of 1e-8 enters the objective by its third root here.
    let off = (result["objective"].as_f64().unwrap() - 1.0).abs();
    assert!(off < 5e-3, "{off}");
    assert!(message(&result).contains("no multipliers may exist"), "{}", message(&result));
}

#[test]
fn a_start_outside_the_domain_is_moved_and_said_so() {
    let variables = "x = { lower = -10, upper = 10, start = -1 }\ny = { lower = -10, upper = 10, start = 3 }";
    let (code, result) = solve(&problem("(x-5)^2 + (y+3)^2", variables, &["log(x-y) >= 0"]));
    assert_eq!(code, 0, "{result}");
    let warnings = result["warnings"].to_string();
    assert!(warnings.contains("outside the domain") && warnings.contains("row r1"), "{warnings}");
    let (code, result) = solve(&problem("x - log(x-2)", "x = { start = -1 }", &[]));
    assert!(code == 0 && near(&result["variables"]["x"], 3.0), "{result}");
}

#[test]
fn where_no_point_has_a_value_the_term_and_the_point_are_named() {
    let (code, result) = solve(&problem("x + sqrt(-1 - x^2)", "x = { lower = -1, upper = 1, start = 0.5 }", &[]));
    assert_eq!((code, result["status"].as_str()), (6, Some("invalid-value")));
    assert!(message(&result).contains("square root of -1.25"), "{}", message(&result));
}

#[test]
fn a_linear_conflict_names_rows_bounds_places_and_the_least_moves() {
    let unit = "x = { lower = 0, upper = 1 }\ny = { lower = 0, upper = 1 }";
    let (code, result) = solve(&problem("x + y", unit, &["x + y >= 3", "x - y <= 0.5"]));
    assert_eq!((code, result["scope"].as_str()), (3, Some("global")));
    let conflict = &result["conflict"];
    assert_eq!(conflict["constraints"], serde_json::json!(["r1"]));
    assert_eq!(conflict["bounds"], serde_json::json!(["x.upper", "y.upper"]));
    assert_eq!(conflict["minimal"], true, "{conflict}");
    assert!(conflict["places"][0].as_str().is_some_and(|place| place.contains("problem.toml:")), "{conflict}");
    let alternatives = conflict["alternatives"].as_array().unwrap();
    let to = |limit: &str| alternatives.iter().find(|found| found["limit"] == limit).map(|found| found["to"].as_f64().unwrap());
    // With x alone released, r2 is in the way.
    assert_eq!((to("r1"), to("x.upper"), to("y.upper")), (Some(2.0), None, Some(2.0)), "{conflict}");
    assert!(alternatives.iter().all(|found| found["least"] == true));
    assert!(message(&result).contains("no point meets every limit"));
}

#[test]
fn a_nonlinear_conflict_is_called_local() {
    let three = "x = { lower = -3, upper = 3, start = 1 }\ny = { lower = -3, upper = 3, start = 1 }";
    let (code, result) = solve(&problem("x", three, &["sin(x) + y^2 <= -1.5"]));
    assert_eq!((code, result["scope"].as_str()), (3, Some("local")));
    assert!(message(&result).contains("locally infeasible") && message(&result).contains("no point nearby"));
    assert_eq!(result["conflict"]["minimal"], false);
}

#[test]
fn infeasible_by_a_millionth_is_infeasible_and_by_a_billionth_is_not() {
    let x = "x = { lower = 0, upper = 10, start = 1 }";
    assert_eq!(solve(&problem("x", x, &["x >= 2.000001", "x <= 2"])).0, 3);
    assert_eq!(solve(&problem("x", x, &["x >= 2.000000001", "x <= 2"])).0, 0);
}

#[test]
fn unbounded_and_not_attained_are_told_apart_quickly_and_named() {
    let (code, result) = solve(&problem("-x*y", "x = { lower = 0 }\ny = {}", &["y <= sqrt(x+1)"]));
    assert_eq!((code, result["status"].as_str()), (4, Some("unbounded")));
    assert!(result["direction"]["x"].as_f64().is_some_and(|x| x > 0.0));
    let (code, result) = solve(&problem("1/x + y", "x = { lower = 0.1 }\ny = { lower = 1 }", &["x*y >= 1"]));
    assert_eq!((code, result["status"].as_str()), (4, Some("not-attained")), "{result}");
    assert_eq!(result["runaway"], serde_json::json!(["x"]));
    let (code, result) = solve(&problem("exp(-x) + (y-1)^2", "x = {}\ny = {}", &[]));
    assert_eq!((code, result["status"].as_str()), (4, Some("not-attained")));
}

#[test]
fn open_bounds_of_a_geometric_program_still_give_a_lower_bound() {
    let open = "x = { lower = 0.1 }\ny = { lower = 0.1 }";
    let (code, result) = solve(&problem("x*y + 3*x", open, &["x*y^2 >= 4"]));
    assert_eq!((code, result["scope"].as_str()), (0, Some("global")));
    let (value, bound) = (result["objective"].as_f64().unwrap(), result["lower_bound"].as_f64().unwrap());
    // The answer may use the constraint tolerance: it can lie that much below the exact optimum, and so below the bound.
    assert!(bound <= value * (1.0 + 1e-8) && value - bound < 1e-7 * value, "{bound} for {value}");
}

#[test]
fn many_starts_find_the_best_minimum_the_same_way_every_time() {
    let text = problem("(x^2-1)^2 + x/4", "x = { lower = -3, upper = 3, start = 1 }", &[]);
    let (code, first) = solve_with(&text, &["--starts", "12"]);
    assert_eq!(code, 0);
    let minima = first["minima"].as_array().unwrap();
    assert_eq!(minima.len(), 2);
    assert!(first["variables"]["x"].as_f64().unwrap() < -1.0 && minima.iter().all(|minimum| minimum["count"].as_u64() > Some(0)));
    assert_eq!(first["minima"], solve_with(&text, &["--starts", "12"]).1["minima"]);
}

#[test]
fn check_names_the_term_that_misses_a_class() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("problem.toml");
    let variables = "x = { lower = 0.1, upper = 10 }\ny = { lower = 0.1, upper = 10 }";
    fs::write(&file, problem("x*y + 1/x", variables, &["x + y >= 3"])).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_ribopt")).arg("check").arg(&file).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("class: nonlinear") && text.contains("not shown to be a geometric program: constraint r1"), "{text}");
    assert!(text.contains("not shown to be convex: the objective"), "{text}");
}

#[test]
fn a_flange_that_vanishes_is_named_with_the_remedy() {
    let section = |name: &str| {
        format!(
            "[sections.{name}]\nkind = \"h-beam\"\nb1 = {{ lower = 4, upper = 50 }}\nh1 = {{ lower = 50, upper = 1500 }}\n\
             b2 = {{ lower = 50, upper = 600 }}\nh2 = {{ lower = 80, upper = 1700 }}\n"
        )
    };
    let rib = "[[ribs]]\nname = \"r\"\nfrom = \"left\"\nto = \"right\"\nlength = 4500\n";
    let row = "[[constraints]]\nname = \"w\"\nfor = \"sections\"\nrequire = \"Wx >= 1.4e6\"\n";
    let (code, result) = solve(&format!("{}{}{rib}{row}", section("left"), section("right")));
    assert_eq!(code, 1, "the frustum's root has no slope where a flange is gone: nothing can be proved there");
    assert!(result["remedy"].as_str().unwrap().contains("h2 − "), "{result}");
}

/// No certificate passed under an uncertified status, and the best one passed under a certified one.
fn is_one_verdict(code: i32, result: &Value) -> bool {
    let solutions = result["solutions"].as_array().unwrap();
    let passed = solutions.iter().any(|solution| solution["certificate"]["certified"] == true);
    match result["status"].as_str() {
        Some("certified") => code == 0 && passed,
        Some("uncertified") => code == 1 && !passed,
        _ => true,
    }
}

#[test]
fn lines_that_never_meet_are_infeasible_however_far_a_backend_goes() {
    let free = "x = { start = 1 }\ny = { start = -1 }";
    for rows in [["2*x - 5*y == 7", "2*x - 5*y == 9"], ["0.002*x - 0.005*y == 7", "2e-3*x - 5e-3*y == 9"]] {
        let (code, result) = solve(&problem("x^2 + 3*y^2", free, &rows));
        assert_eq!((code, result["scope"].as_str()), (3, Some("global")), "{result}");
        assert_eq!(result["conflict"]["constraints"], serde_json::json!(["r1", "r2"]));
    }
    // Three planes, each two of which meet.
    let rows = ["x + y >= 4", "x - 2*y >= 3", "-2*x + y >= -6.5"];
    assert_eq!(solve(&problem("x + 0*y", free, &rows)).0, 3);
}

#[test]
fn an_invented_start_is_no_excuse_for_a_violation() {
    let small = "p = { lower = 0, upper = 4e-6 }\nq = { lower = 0 }";
    let (code, result) = solve(&problem("q", small, &["2e5*p + 2e5*q == 0.0071", "2e5*p >= 0.00713"]));
    assert_eq!((code, result["scope"].as_str()), (3, Some("global")), "{result}");
}

#[test]
fn status_exit_code_and_certificates_agree() {
    let flat = "u = { lower = 0, upper = 2 }\nv = { lower = 0, upper = 2 }\nz = {}";
    let (code, result) = solve(&problem("z", flat, &["u^2 + v >= 3.1", "v - z == 0"]));
    assert!(is_one_verdict(code, &result) && near(&result["objective"], 0.0), "{result}");
    let roots = "p = { lower = 0, start = 3 }\nq = { lower = 0, start = 1 }";
    let (code, result) = solve(&problem("sqrt(-log(p - q))", roots, &["p - q >= 0", "p - q <= 1"]));
    assert!(is_one_verdict(code, &result) && result["objective"].as_f64().unwrap() < 1e-3, "{result}");
    let outside = "k = { lower = 0.5, start = 6 }\nm = { start = -4 }";
    let (code, result) = solve(&problem("k/m - log(m)/k + m", outside, &["k*m >= 1"]));
    assert!(is_one_verdict(code, &result), "{result}");
}

#[test]
fn the_best_point_is_shown_where_the_slope_is_infinite() {
    let two = "x = { start = 5 }\ny = { start = 5 }";
    let (code, result) = solve(&problem("sqrt((x - 1)^2 + (y + 2)^2)", two, &[]));
    assert!(is_one_verdict(code, &result) && result["objective"].as_f64().unwrap() < 1e-6, "{result}");
}

#[test]
fn each_single_move_that_is_offered_is_enough_and_less_is_not() {
    let beam = "units = { length = \"mm\", force = \"N\" }\n[sections.s]\nkind = \"rectangle\"\n\
                b = { lower = 20, upper = 60 }\nh = { lower = 20, upper = 150 }\n\
                [[ribs]]\nname = \"r\"\nsection = \"s\"\nlength = 2500\n\
                [[constraints]]\nname = \"bending\"\nrequire = \"80e6/s.Wx <= 160\"\n\
                [[constraints]]\nname = \"slender\"\nrequire = \"s.h <= 6*s.b\"\n";
    let (code, result) = solve(beam);
    assert_eq!(code, 3);
    let alternatives = result["conflict"]["alternatives"].as_array().unwrap().clone();
    let limits: Vec<&str> = alternatives.iter().map(|found| found["limit"].as_str().unwrap()).collect();
    assert!(["s.h.upper", "s.b.upper", "bending"].iter().all(|limit| limits.contains(limit)), "{limits:?}");
    let shares: Vec<f64> = alternatives.iter().map(|found| found["relative"].as_f64().unwrap()).collect();
    assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]), "{shares:?}");
    for found in alternatives.iter().filter(|found| found["limit"].as_str().unwrap().ends_with(".upper")) {
        let (limit, to) = (found["limit"].as_str().unwrap(), found["to"].as_f64().unwrap());
        assert_eq!(found["least"], true);
        assert_eq!(solve_with(beam, &["--set", &format!("{limit}={to}")]).0, 0, "{limit} at {to}");
        assert_eq!(solve_with(beam, &["--set", &format!("{limit}={}", to * 0.9999)]).0, 3, "{limit} below {to}");
    }
    assert!(result["remedy"].as_str().unwrap().starts_with("any one of these is enough: s.h.upper 150 -> "), "{result}");
}

#[test]
fn a_large_linear_problem_does_not_wait_for_a_backend_that_is_slow_on_it() {
    let n = 90;
    let chain: Vec<String> = (1..n).map(|k| format!("x[{}] >= 1.01*x[{k}] + 0.1*y[{k}]", k + 1)).collect();
    let load: Vec<String> = (1..n).map(|k| format!("y[{k}] >= 0.5*y[{}] + 1", k + 1)).collect();
    let rows: Vec<&str> = chain.iter().chain(&load).map(String::as_str).collect();
    let variables = format!("x = {{ size = {n}, lower = 0, start = 1 }}\ny = {{ size = {n}, lower = 0, start = 1 }}");
    let (code, result) = solve(&problem(&format!("x[{n}]"), &variables, &rows));
    assert_eq!((code, result["scope"].as_str()), (0, Some("global")));
    let seconds: f64 = result["solutions"].as_array().unwrap().iter().map(|found| found["seconds"].as_f64().unwrap()).sum();
    assert!(seconds < 10.0, "{seconds}");
}
