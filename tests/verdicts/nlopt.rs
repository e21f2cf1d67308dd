//! What NLopt cannot take, through the whole program: no crash, no run without end.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::whole_program::solve_with;

/// What `--max-seconds 2` may take on a machine that does much else.
const SOON: Duration = Duration::from_secs(30);

/// A girder under a moment of this size.
fn girder(moment: &str) -> String {
    format!(
        r#"
[parameters]
M = {moment}
sigma = 235
[sections.beam]
kind = "tee"
tw = {{ lower = 6, upper = 20 }}
hw = {{ lower = 50, upper = 400 }}
b = {{ lower = 50, upper = 300 }}
tf = {{ lower = 8, upper = 40 }}
[[ribs]]
name = "girder"
section = "beam"
length = 6000
[[constraints]]
name = "stress at the top"
require = "M/beam.Wx_top <= sigma"
[[constraints]]
name = "stress at the bottom"
require = "M/beam.Wx_bottom <= sigma"
[[constraints]]
name = "web slenderness"
require = "beam.hw <= 20*beam.tw"
[[constraints]]
name = "flange slenderness"
require = "beam.b <= 20*beam.tf"
"#
    )
}

/// `ribopt` on this problem, its JSON read by nobody.
fn start(problem: &str, arguments: &[&str]) -> (tempfile::TempDir, Child) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p.toml"), problem).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    command.current_dir(&folder).args(["solve", "p.toml", "--quiet", "--backend", "nlopt"]).args(arguments);
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    (folder, child)
}

/// Its exit code; a run that goes on is ended.
fn ended_within(child: &mut Child, limit: Duration) -> Option<i32> {
    let begun = Instant::now();
    while begun.elapsed() < limit {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    None
}

#[test]
fn rows_of_absurd_size_do_not_keep_cobyla_past_the_deadline() {
    for moment in ["1e290", "1e304", "1e306", "1e307", "1e308"] {
        let (_folder, mut child) = start(&girder(moment), &["--algorithm", "cobyla", "--max-seconds", "2"]);
        let code = ended_within(&mut child, SOON);
        assert!(matches!(code, Some(1 | 3 | 5 | 6)), "M = {moment}: {code:?}");
    }
}

/// Long enough a run that a signal meets it.
const LONG: &str = "minimize = \"sum((x - 0.3)^2) - 0.1*sum(cos(25*x))\"\n[variables]\n\
                    x = { size = 60, lower = -5, upper = 5, start = 2.5 }\n";

#[cfg(unix)]
#[test]
fn one_signal_ends_derivative_free_runs() {
    for (algorithm, signal) in [("cobyla", "-TERM"), ("bobyqa", "-INT")] {
        let (_folder, mut child) = start(LONG, &["--algorithm", algorithm]);
        std::thread::sleep(Duration::from_millis(500));
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        assert!(ended_within(&mut child, SOON).is_some(), "{algorithm} goes on after {signal}");
    }
}

/// Rows k·x + y = k + 1, which meet in (1, 1), the least of x² + y² on the first row alone as well.
fn concurrent_lines(count: usize, shift: f64) -> String {
    let row = |k: usize| {
        format!("[[constraints]]\nname = \"r{k}\"\nrequire = \"{k}*x + y == {}\"\n", (k + 1) as f64 + shift * (k * k) as f64)
    };
    let rows: String = (1..=count).map(row).collect();
    format!(
        "minimize = \"x^2 + y^2\"\n[variables]\nx = {{ lower = -9, upper = 9, start = 0.5 }}\ny = {{ lower = -9, upper = 9, start = 0.5 }}\n{rows}"
    )
}

#[test]
fn more_equalities_than_variables_do_not_overrun_slsqps_workspace() {
    for count in 1..=12 {
        let (code, result) = solve_with(&concurrent_lines(count, 0.0), &["--backend", "nlopt", "--algorithm", "slsqp"]);
        assert_eq!(code, 0, "{count} rows: {result}");
        assert!((result["objective"].as_f64().unwrap() - 2.0).abs() < 1e-8, "{count} rows: {result}");
    }
    let (code, result) = solve_with(&concurrent_lines(9, 1e-3), &["--backend", "nlopt"]);
    assert_eq!((code, result["status"].as_str()), (3, Some("infeasible")), "{result}");
}

/// The variables that are fixed leave two for eight equalities.
#[test]
fn fixed_variables_do_not_hide_surplus_equalities() {
    let rows: String = (1..=8)
        .map(|k| format!("[[constraints]]\nname = \"r{k}\"\nrequire = \"{k}*x[1] + x[2] == {k} + x[{}]\"\n", k + 2))
        .collect();
    let ones = ["1"; 8].join(", ");
    let variables = format!("x = {{ size = 10, lower = [-9, -9, {ones}], upper = [9, 9, {ones}], start = [0.5, 0.5, {ones}] }}");
    let (code, result) =
        solve_with(&format!("minimize = \"x[1]^2 + x[2]^2\"\n[variables]\n{variables}\n{rows}"), &["--backend", "nlopt"]);
    assert_eq!(code, 0, "{result}");
    assert!((result["objective"].as_f64().unwrap() - 2.0).abs() < 1e-8, "{result}");
}
