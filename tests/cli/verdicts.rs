//! Exit codes, and what is said with them.

use super::*;

/// The exit code of `solve` on a problem, and the status in its JSON.
fn verdict(problem: &str, options: &str) -> (i32, String) {
    let folder = folder(problem);
    let output = ribopt(&folder, &format!("solve rib.toml --json {options}"));
    assert!(!err(&output).contains("panicked"), "{}", err(&output));
    (code(&output), json(&output)["status"].as_str().unwrap().to_string())
}

#[test]
fn sensitivity_is_minus_the_multiplier_for_both_senses() {
    for (objective, sign) in [("minimize = \"x\"", 1.0), ("maximize = \"-x\"", -1.0)] {
        let problem =
            format!("{objective}\n[variables]\nx = {{ lower = 0, upper = 9 }}\n[[constraints]]\nrequire = \"x >= 2\"\n");
        let value = json(&ribopt(&folder(&problem), "solve rib.toml --json"));
        let row = &value["constraints"][0];
        let (multiplier, sensitivity) = (row["multiplier"].as_f64().unwrap(), row["sensitivity"].as_f64().unwrap());
        assert!((sensitivity - sign).abs() < 1e-6, "{row}");
        assert_eq!(sensitivity, -multiplier);
        assert!((value["objective"].as_f64().unwrap() - 2.0 * sign).abs() < 1e-6, "{value}");
    }
}

#[test]
fn every_verdict_has_its_exit_code() {
    let infeasible = "minimize = \"x\"\n[variables]\nx = { lower = 0, upper = 1 }\n[[constraints]]\nrequire = \"x >= 2\"\n";
    assert_eq!(verdict(infeasible, ""), (3, "infeasible".into()));
    let unbounded = "minimize = \"x + y^2\"\n[variables]\nx = { start = 1 }\ny = { start = 1 }\n";
    assert_eq!(verdict(unbounded, ""), (4, "unbounded".into()));
    let not_attained = "minimize = \"exp(-x)\"\n[variables]\nx = { start = 1 }\n";
    assert_eq!(verdict(not_attained, ""), (4, "not-attained".into()));
    assert_eq!(verdict(LONG, "--max-evaluations 1"), (5, "limit-reached".into()));
    let no_number = "minimize = \"sqrt(-1 - x^2)\"\n[variables]\nx = { lower = -1, upper = 1 }\n";
    assert_eq!(verdict(no_number, ""), (6, "invalid-value".into()));
    assert_eq!(verdict("minimize = \"y\"\n[variables]\nx = { lower = 0 }\n", ""), (2, "invalid-input".into()));
}

#[test]
fn mistakes_of_the_file_are_told_and_nothing_is_written() {
    let folder = folder("minimize = \"depht\"\n[variables]\ndepth = { lower = 2, upper = 1 }\n");
    let output = ribopt(&folder, "solve rib.toml --json");
    let value = json(&output);
    assert_eq!((code(&output), value["status"].as_str()), (2, Some("invalid-input")));
    let mistakes = value["mistakes"].as_array().unwrap();
    assert_eq!(mistakes.len(), 2, "{value}");
    assert!(
        mistakes.iter().all(|mistake| mistake["file"] == "rib.toml" && mistake["line"].is_u64() && mistake["column"].is_u64())
    );
    assert!(!folder.path().join("results").exists());
    assert!(err(&output).contains("rib.toml:"), "{}", err(&output));
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    let folder = folder(RIB);
    for arguments in [
        "solve",
        "solve missing.toml",
        "solve rib.toml --backend ipopt",
        "solve rib.toml --algorithm simplex",
        "solve rib.toml --optimality-tolerance 2",
        "solve rib.toml --max-seconds -1",
        "solve rib.toml --starts 0",
        "solve rib.toml --set nobody=1",
        "solve rib.toml --set left.b.upper",
        "solve rib.toml --start missing.json",
        "solve rib.toml --out /dev/null/results",
        "verify rib.toml missing.csv",
        "frobnicate",
        "new cube",
    ] {
        let output = ribopt(&folder, arguments);
        assert_eq!((code(&output), output.stdout.len()), (2, 0), "{arguments}: {}", out(&output));
        assert!(!err(&output).is_empty() && !err(&output).contains("panicked"), "{arguments}: {}", err(&output));
        let output = ribopt(&folder, &format!("{arguments} --json"));
        assert_eq!(code(&output), 2, "{arguments}");
        assert!(!json(&output)["mistakes"].as_array().unwrap().is_empty(), "{arguments}");
    }
}
