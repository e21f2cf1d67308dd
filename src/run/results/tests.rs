use super::*;
use tempfile::TempDir;

const HASH: &str = "abc";

fn open(place: &TempDir) -> Results {
    Results::open(place.path(), &["argmin"], &Inputs::default()).unwrap()
}

fn result(status: &str, file: &str) -> String {
    format!(
        "{{\"format\": \"ribopt-result/1\", \"problem\": {{\"file\": \"{file}\", \"sha256\": \"{HASH}\"}}, \"status\": \"{status}\", \"variables\": {{}}}}"
    )
}

/// A run that leaves a log and a result.
fn run(place: &TempDir, status: &str, cut_short: bool) -> PathBuf {
    let results = open(place);
    fs::write(results.log("argmin"), format!("iteration,evaluations,objective,\n{status}")).unwrap();
    let text = result(status, "rib.toml");
    let ending = Ending { sha256: HASH, cut_short };
    let (_, path, written) = results.leave(ending, |writer| writer.file("result.json", |out| out.write_all(text.as_bytes())));
    written.unwrap();
    path
}

fn read(place: &TempDir, name: &str) -> String {
    fs::read_to_string(place.path().join(name)).unwrap_or_default()
}

#[test]
fn a_certified_answer_and_its_log_outlive_a_run_cut_short() {
    let place = tempfile::tempdir().unwrap();
    run(&place, "certified", false);
    assert_eq!(run(&place, "interrupted", true), place.path().join("interrupted"));
    assert!(read(&place, "result.json").contains("certified") && read(&place, "log-argmin.csv").contains("certified"));
    assert!(read(&place, "interrupted/result.json").contains("interrupted"));
    assert!(read(&place, "interrupted/log-argmin.csv").contains("interrupted"));
    // A run that ends well takes both places.
    run(&place, "certified", false);
    assert!(!place.path().join("interrupted").exists() && !place.path().join("log-argmin.csv.earlier").exists());
}

#[test]
fn an_answer_that_is_not_certified_gives_way() {
    let place = tempfile::tempdir().unwrap();
    run(&place, "uncertified", false);
    assert_eq!(run(&place, "interrupted", true), place.path());
    assert!(read(&place, "result.json").contains("interrupted"));
}

#[test]
fn logs_of_a_killed_run_go_and_those_of_the_answer_stay() {
    let place = tempfile::tempdir().unwrap();
    run(&place, "certified", false);
    let killed = open(&place);
    fs::write(killed.log("argmin"), "iteration,evaluations,objective,\nkilled").unwrap();
    drop(killed);
    run(&place, "interrupted", true);
    assert!(read(&place, "log-argmin.csv").contains("certified"));
}

#[test]
fn stale_pictures_go_and_files_of_others_stay() {
    let place = tempfile::tempdir().unwrap();
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\"></svg>";
    fs::write(place.path().join("sections.svg"), svg).unwrap();
    fs::write(place.path().join("log-mine.csv"), "mine").unwrap();
    fs::write(place.path().join("notes.txt"), "mine").unwrap();
    run(&place, "certified", false);
    assert!(!place.path().join("sections.svg").exists());
    assert_eq!((read(&place, "log-mine.csv"), read(&place, "notes.txt")), ("mine".into(), "mine".into()));
}

#[test]
fn a_file_of_somebody_else_is_not_overwritten() {
    for (name, text) in [
        ("variables.csv", "name,kind,b\ns,rectangle,1\n"),
        ("result.json", "[sections.a]\n"),
        ("ribs.svg", "<?xml version=\"1.0\"?>"),
    ] {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join(name), text).unwrap();
        let error = Results::open(place.path(), &["argmin"], &Inputs::default()).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains("--out"), "{error}");
        assert_eq!(read(&place, name), text);
    }
}

#[test]
fn results_of_another_file_are_named() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("result.json"), result("certified", "a/rib.toml")).unwrap();
    let results = open(&place);
    assert!(results.belongs_to_another("b/rib.toml", "other").unwrap().contains("a/rib.toml"));
    assert_eq!(results.belongs_to_another("b/rib.toml", HASH), None);
    assert_eq!(results.belongs_to_another("a/rib.toml", "other"), None);
}

#[test]
fn what_cannot_be_written_leaves_the_earlier_files() {
    let place = tempfile::tempdir().unwrap();
    run(&place, "certified", false);
    let results = open(&place);
    fs::write(results.log("argmin"), "iteration,evaluations,objective,\nnew").unwrap();
    let ending = Ending { sha256: HASH, cut_short: false };
    let (.., written) = results.leave(ending, |writer| {
        writer.file("variables.csv", |out| out.write_all(b"name"))?;
        writer.file("result.json", |_| Err(io::Error::other("the disk is full")))
    });
    assert!(written.unwrap_err().to_string().contains("result.json: the disk is full"));
    assert!(read(&place, "log-argmin.csv").contains("certified") && read(&place, "variables.csv").is_empty());
}
