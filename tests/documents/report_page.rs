//! `report.html` in a browser: headless Chromium opens pages about runs and a page with ten thousand ribs. Where Node, its package
//! playwright-core (`npm ci` in tests/browser) or Chromium is not there, the test says so and passes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use ribopt::report::page::{Left, page};
use serde_json::json;

const FOLDER: &str = "tests/browser";

/// Chromium, where it can be opened; else what is missing.
fn browser() -> Result<String, &'static str> {
    let runs = |program: &str| Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success());
    if !runs("node") {
        return Err("node");
    }
    if !Path::new(FOLDER).join("node_modules/playwright-core").is_dir() {
        return Err("playwright-core: npm ci in tests/browser");
    }
    let known = ["chromium", "chromium-browser", "google-chrome"];
    let found = known.into_iter().find(|name| runs(name)).ok_or("Chromium")?;
    let path = Command::new("which").arg(found).output().map_err(|_| "which")?;
    Ok(String::from_utf8_lossy(&path.stdout).trim().to_owned())
}

fn solve(file: &str, folder: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    let output = command.args(["solve", file, "--report", "--quiet", "--out"]).arg(folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// A page about a plate of n·n fields: ribs along both ways.
fn plate(n: usize) -> (String, usize) {
    let mut ribs = Vec::new();
    let mut rows = String::from("rib,utilisation,governs,case,station,point,value,side,limit\n");
    for line in 0..=n {
        for field in 0..n {
            for (way, ends, y) in [
                ("x", [[field, line], [field + 1, line]], [0.0, 1.0, 0.0]),
                ("y", [[line, field], [line, field + 1]], [-1.0, 0.0, 0.0]),
            ] {
                let place = |[x, y]: [usize; 2]| json!([x, y, (((x * y) as f64) / (n * n) as f64)]);
                let (name, share) = (format!("{way}{line}_{field}"), (line + field) as f64 / (2 * n) as f64);
                rows += &format!("{name},{share},stress,ULS,0.5,top,1,upper,1\n");
                ribs.push(json!({
                    "name": name, "section": if way == "x" { "main" } else { "cross" }, "ends": ends.map(place), "y": y,
                    "z": [0.0, 0.0, 1.0], "outlines": [0, 0], "share": share, "limit": "stress",
                }));
            }
        }
    }
    let count = ribs.len();
    let outline = json!([[[-0.05, -0.1], [0.05, -0.1], [0.05, 0.1], [-0.05, 0.1]]]);
    let network = json!({ "format": "ribopt-network/1", "outlines": [outline], "ribs": ribs }).to_string();
    let result = json!({ "status": "certified", "scope": "global", "problem": { "title": "Plate" }, "objective": 1.0 });
    let tables = vec![("utilisation.csv".to_owned(), rows)];
    (page(&[Left { result, tables, network: Some(network), ..Left::default() }]), count)
}

#[test]
fn pages_open_without_errors_or_requests_and_can_be_used() {
    let chromium = match browser() {
        Ok(path) => path,
        Err(missing) => return eprintln!("skipped: no browser to open a page with; missing is {missing}"),
    };
    // Pictures to be looked at stay where this says, else they go with the folder.
    let folder = tempfile::tempdir().unwrap();
    let place = std::env::var_os("RIBOPT_PAGES").map_or_else(|| folder.path().to_path_buf(), PathBuf::from);
    fs::create_dir_all(&place).unwrap();
    let mut pages = Vec::new();
    for (name, ribs) in [("haunched-floor-rib", None), ("ten-bar-truss", Some(10)), ("portal-frame", Some(4)), ("vault", None)] {
        let results = place.join(name);
        solve(&format!("problems/{name}.toml"), &results);
        let in_space = fs::read_to_string(results.join("network.json")).ok();
        let count =
            in_space.map(|text| serde_json::from_str::<serde_json::Value>(&text).unwrap()["ribs"].as_array().unwrap().len());
        if let Some(ribs) = ribs {
            assert_eq!(count, Some(ribs), "{name}");
        }
        let page = results.join("report.html").display().to_string();
        pages.push(count.map_or(page.clone(), |count| format!("{page}#{count}")));
    }
    let several = place.join("several.html");
    let runs = ["ten-bar-truss", "portal-frame"].map(|name| place.join(name));
    let output = Command::new(env!("CARGO_BIN_EXE_ribopt")).arg("report").args(&runs).arg("-o").arg(&several).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    pages.push(format!("{}#10", several.display()));
    let (html, count) = plate(70);
    let large = place.join("plate.html");
    fs::write(&large, html).unwrap();
    pages.push(format!("{}#{count}", large.display()));

    let output = Command::new("node").arg(format!("{FOLDER}/report.mjs")).arg(chromium).args(&pages).output().unwrap();
    println!("{}", String::from_utf8_lossy(&output.stdout));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
