//! A sample of the metamorphic tests (docs/testing.md): rewritten files whose verdict must stay.

#[allow(dead_code, reason = "the example uses the rest")]
#[path = "../examples/metamorphic/campaign/mod.rs"]
mod campaign;

use campaign::judge::Grade;
use campaign::{Finding, Plan, report};

/// Of this the test is a sample of the problems and kinds; `examples/metamorphic` runs any number.
const RUNS: usize = 60;

/// Folder and stem of files that are wrongly judged as yet, and why. One that no longer is must leave the table.
const KNOWN_FAILURES: &[(&str, &str)] = &[];

#[test]
fn rewritten_files_are_not_wrongly_certified_nor_wrongly_infeasible() {
    let folder = tempfile::TempDir::new().unwrap();
    let plan = Plan {
        folders: vec!["problems".into(), "tests/extra".into()],
        seed: 11,
        first: 0,
        count: RUNS,
        only: None,
        jobs: std::thread::available_parallelism().map_or(2, usize::from),
        seconds: 10.0,
        folder: folder.path().into(),
        without: Vec::new(),
        quiet: true,
    };
    let found = campaign::run(&plan).unwrap();
    assert!(found.runs + 2 * found.left_out.len() + 10 > RUNS, "{}", report::text(&found));
    let is_grave = |finding: &&Finding| finding.fault.0 != Grade::Different;
    let is_known = |finding: &Finding| KNOWN_FAILURES.iter().any(|(file, _)| finding.problem == *file);
    let grave: Vec<&Finding> = found.findings.iter().filter(is_grave).collect();
    let new = grave.iter().any(|finding| !is_known(finding));
    let gone = KNOWN_FAILURES.iter().find(|(file, _)| !grave.iter().any(|finding| finding.problem == *file));
    assert!(!new, "{}", report::text(&found));
    assert!(gone.is_none(), "{gone:?} no longer fails, take it from the table");
}
