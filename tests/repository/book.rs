//! The documentation as a book: every page is in it once, and the tutorial's file has the answers that the tutorial tells.

use std::fs;

use ribopt::run::Subject;
use ribopt::run::solve::outcome;

#[test]
fn every_page_is_in_the_book() {
    let summary = fs::read_to_string("docs/SUMMARY.md").unwrap();
    let mut listed: Vec<&str> = summary.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    let mut pages: Vec<String> =
        fs::read_dir("docs").unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    pages.retain(|name| name.ends_with(".md") && name != "SUMMARY.md");
    listed.sort_unstable();
    pages.sort_unstable();
    assert_eq!(listed, pages);
}

fn objective(text: &str) -> f64 {
    let subject = Subject::of_text("rib.toml", text).unwrap_or_else(|error| panic!("{error}"));
    let outcome = outcome(&subject).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(outcome.status.as_str(), "certified", "{}", outcome.message);
    outcome.objective.unwrap()
}

#[test]
fn the_tutorial_tells_the_truth() {
    let page = fs::read_to_string("docs/tutorial.md").unwrap();
    let file = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let free = objective(file);
    assert!(page.contains("volume = 0.08603966837 m³") && (free - 0.08603966837).abs() < 1e-11, "{free}");
    let listed = file.replace("upper = \"200 mm\"", "upper = \"200 mm\", step = \"20 mm\"");
    let listed = objective(&listed.replace("upper = \"400 mm\"", "upper = \"400 mm\", step = \"20 mm\""));
    assert!((listed - 0.06 * 0.32 * 4.5).abs() < 1e-12, "{listed}");
    assert!(page.contains("0.419 %") && (listed / free - 1.00419).abs() < 1e-5, "{}", listed / free);
}

/// In the site only what stands under docs/ is there.
#[test]
fn no_page_links_out_of_the_book() {
    for entry in fs::read_dir("docs").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "md") {
            assert!(!fs::read_to_string(&path).unwrap().contains("](../"), "{} links out of docs/", path.display());
        }
    }
}
