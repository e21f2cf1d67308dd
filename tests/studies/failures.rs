//! Studies that are wrong, and points that bring no answer.

use std::fs;

use crate::{folder, number, said, sweep, table};

#[test]
fn mistakes_point_into_the_study() {
    for (study, words) in [
        ("problem = \"rib.toml\"\n", "varies nothing"),
        ("problem = \"rib.toml\"\n[vary]\nN = { values = [1] }\n", "there is no parameter or variable `N`"),
        ("problem = \"rib.toml\"\n[vary]\nM = { from = 1 }\n", "study.toml:3:1"),
        ("problem = \"rib.toml\"\n[vary]\nM = { from = 1, to = 2 }\n", "needs a `count`"),
        ("problem = \"rib.toml\"\n[vary]\nM = { from = 0, to = 2, count = 3, scale = \"log\" }\n", "logarithms"),
        ("problem = \"rib.toml\"\n[vary]\nM = { values = [] }\n", "no values"),
        ("problem = \"rib.toml\"\n[vary]\nM = { values = [\"2*x\"] }\n", "x"),
        ("problem = \"rib.toml\"\n[vary]\nM = { values = [nan] }\n", "no finite number"),
        ("problem = \"rib.toml\"\n[vary]\nM = { values = [1] }\n[run]\nchain = \"f\"\n", "`f` is not varied"),
        ("problem = \"rib.toml\"\n[vary]\nM = { values = [1] }\n[report]\nquantities = { status = \"1\" }\n", "column"),
        ("problem = \"rib.toml\"\n[vary]\nM = { values = [1] }\n[report]\nquantities = { w = \"volum\" }\n", "volum"),
        ("problem = \"rib.toml\"\n[vary]\nM = { from = 1, to = 2, count = 4000000 }\n", "at most"),
        ("problem = \"rib.toml\"\n[vary]\nM = { from = 1, to = 2 }\n[design]\nmethod = \"sobol\"\n", "samples"),
        ("problem = \"rib.toml\"\n[design]\nmethod = \"list\"\ntable = \"none.csv\"\n", "none.csv"),
        ("problem = \"rib.toml\"\n[pareto]\nminimize = [\"volume\"]\n", "two objectives"),
        ("problem = \"rib.toml\"\nvery = 1\n", "unknown field"),
        ("problem = \"lost.toml\"\n[vary]\nM = { values = [1] }\n", "lost.toml"),
        ("problem = \n", "study.toml:1"),
        ("", "empty"),
    ] {
        let folder = folder(study);
        let output = sweep(folder.path(), &[]);
        assert_eq!(output.status.code(), Some(2), "{study}\n{}", said(&output));
        assert!(said(&output).contains(words), "{study}\n{}", said(&output));
        assert!(!folder.path().join("out").exists(), "{study}");
    }
}

#[test]
fn failures_are_rows_with_words() {
    // Depth is not enough for the last moments, and one value is no length at all.
    let study = r#"
problem = "rib.toml"
[vary]
M = { values = [10, 1e9] }
"s.b" = { values = [-1.0, 0.2] }
"#;
    let folder = folder(study);
    let output = sweep(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(2), "the first point must be readable: {}", said(&output));
    fs::write(folder.path().join("study.toml"), study.replace("[-1.0, 0.2]", "[0.2, -1.0]")).unwrap();
    let output = sweep(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let rows = table(folder.path());
    let status: Vec<&str> = rows.iter().map(|row| row["status"].as_str()).collect();
    assert_eq!(status, ["certified", "mistake", "infeasible", "mistake"]);
    for row in &rows[1..] {
        assert!(row["objective"].is_empty() && row["volume"].is_empty() && !row["message"].is_empty(), "{row:?}");
    }
    // A variable that is varied has one column.
    assert!((number(&rows[0], "s.b") - 0.2).abs() < 1e-15 && rows[0].contains_key("s.h"));
}

#[test]
fn a_study_may_stop_at_failures_and_try_again() {
    let study = "problem = \"rib.toml\"\n[vary]\nM = { values = [10, 20] }\n[run]\nmax_seconds = 0\n";
    let stopping = folder(&format!("{study}on_failure = \"stop\"\n"));
    let output = sweep(stopping.path(), &[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("point 0") && said(&output).contains("stops"), "{}", said(&output));
    let folder = folder(study);
    assert_eq!(sweep(folder.path(), &[]).status.code(), Some(1));
    assert!(table(folder.path()).iter().all(|row| row["status"] == "limit-reached"));
    let before = fs::metadata(folder.path().join("out/chains/000000.json")).unwrap().modified().unwrap();
    assert_eq!(sweep(folder.path(), &["--retry", "limit"]).status.code(), Some(1));
    assert!(fs::metadata(folder.path().join("out/chains/000000.json")).unwrap().modified().unwrap() > before);
    let output = sweep(folder.path(), &["--retry", "lost"]);
    assert!(output.status.code() == Some(2) && said(&output).contains("limit-reached"), "{}", said(&output));
}
