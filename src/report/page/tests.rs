use serde_json::json;

use super::*;

fn left() -> Left {
    let result = json!({
        "version": "0.1.0", "status": "certified", "scope": "global", "message": "Proved.", "objective": 2.5, "lower_bound": 2.5,
        "problem": { "title": "A & B", "file": "a.toml", "sha256": "00ff", "class": "linear", "variables": 1, "constraints": 2,
            "objective": "volume", "sense": "minimize", "units": { "length": "m" }, "changes": ["E=3"] },
        "volume": { "total": 2.5 }, "chosen": { "s": "IPE 300" },
        "constraints": [
            { "name": "idle", "active": "none", "sensitivity": 0.0 },
            { "name": "small", "active": "upper", "upper": 10.0, "sensitivity": -0.1 },
            { "name": "large", "active": "lower", "lower": 200.0, "sensitivity": 0.5 },
        ],
        "bounds": [],
        "solutions": [{ "backend": "argmin", "algorithm": "interior-point", "objective": 2.5, "certificate": { "certified": true, "primal_infeasibility": 0.0 } }],
        "warnings": ["<script>alert(1)</script>"],
    });
    let table = |name: &str, text: &str| (name.to_owned(), text.to_owned());
    Left {
        result,
        tables: vec![
            table("sizes.csv", "section,kind,name,value,given\ns,general,A,0.005,variable\ns,general,Ix,0.00008,variable\n"),
            table("volumes.csv", "rib,from,to,length,law,volume,density,mass\nr,s,s,3,frustum,0.015,,\n"),
            table("limits.csv", "name,constraint,of,item,value,side,limit,percent\nlarge,large,,,200,lower,200,100\n"),
        ],
        network: Some("{\"ribs\":[{\"name\":\"</script><b>\"}]}".into()),
        pictures: vec![table("sections.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0\"/></svg>")],
        inputs: vec![table("a.toml", "x = \"</pre><b>\"")],
        unchanged: Some(true),
    }
}

#[test]
fn the_page_shows_what_the_run_left() {
    let html = page(&[left()]);
    for part in ["A &amp; B", "No design that meets the limits is better", "IPE 300", "0.005", "E=3", "argmin", "00ff"] {
        assert!(html.contains(part), "{part} is missing");
    }
    let place = |text: &str| html.find(text).unwrap_or_else(|| panic!("{text} is missing"));
    assert!(place(">large<") < place(">small<"), "the costliest limit comes first");
    assert!(!html.contains(">idle<"), "limits without a price do not govern");
}

#[test]
fn texts_of_the_user_stay_texts_and_nothing_is_fetched() {
    let html = page(&[left()]);
    assert!(!html.contains("</script><b>") && html.contains("\\u003c/script>"));
    assert!(!html.contains("<script>alert") && html.contains("&lt;script&gt;alert"));
    assert!(!html.contains("</pre><b>"));
    // The one address is the name space within a picture, escaped: no element has a source outside the page.
    assert!(!html.contains("src=\"http") && !html.contains("href=\"http"));
    assert!(html.contains("default-src 'none'"));
}

#[test]
fn long_tables_are_cut_and_say_so() {
    let mut left = left();
    let rows: String = (0..tables::MOST_ROWS + 5).map(|k| format!("r{k},s,s,3,frustum,0.015,,\n")).collect();
    left.tables[1].1 = format!("rib,from,to,length,law,volume,density,mass\n{rows}");
    let html = page(&[left]);
    assert!(html.contains("5 more rows in <code>volumes.csv</code>") && !html.contains(&format!(">r{}<", tables::MOST_ROWS)));
}

#[test]
fn a_result_without_anything_is_a_page_too() {
    assert!(page(&[Left::default()]).contains("<!DOCTYPE html>"));
}

#[test]
fn several_runs_stand_side_by_side_and_one_after_the_other() {
    let other = Left { result: json!({ "status": "infeasible", "problem": { "title": "C" } }), ..Left::default() };
    let html = page(&[left(), other]);
    for part in ["2 runs", "href=\"#run-2\"", "id=\"run-2\"", "A &amp; B, C"] {
        assert!(html.contains(part), "{part} is missing");
    }
    assert!(!page(&[left()]).contains(" runs<"));
}

#[test]
fn rows_name_their_ribs() {
    let html = page(&[left()]);
    assert!(html.contains("<tr data-rib=\"r\">"));
    assert!(!html.contains("data-rib=\"large\""), "a limit of no rib names none");
}
