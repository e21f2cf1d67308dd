//! What an office needs of a run: units in every report, lists in tables, a schedule as a workbook, hints.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn ribopt(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ribopt")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A purlin with everything in units, told in others than its own.
const PURLIN: &str = r#"
title = "Purlin"
units = { length = "m", force = "kN" }
show = { stress = "MPa", length = "mm", volume = "dm^3" }
[parameters]
fm = "14.8 MPa"
q = "3 kN/m"
[sections.s]
kind = "rectangle"
b = { lower = "60 mm", upper = "200 mm" }
h = { lower = "100 mm", upper = "400 mm" }
[[ribs]]
name = "main"
section = "s"
length = "4.5 m"
[[constraints]]
name = "bending"
for = "ribs"
require = "q*length^2/8/from.Wx <= fm"
[[constraints]]
name = "slender"
for = "sections"
require = "h <= 5*b"
"#;

#[test]
fn reports_tell_units_as_they_are_wanted_and_results_the_files_own() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("purlin.toml"), PURLIN).unwrap();
    let output = ribopt(folder.path(), &["solve", "purlin.toml", "--report", "--out", "run"]);
    let said = text(&output.stdout);
    assert!(output.status.success(), "{said}{}", text(&output.stderr));
    let line = |begin: &str| {
        said.lines().find(|line| line.trim_start().starts_with(begin)).unwrap_or_else(|| panic!("{begin}:\n{said}"))
    };
    assert!(line("s.b").ends_with("mm") && line("s.b").contains(" 200 "), "{said}");
    assert!(line("volume =").ends_with("dm^3"), "{said}");
    // A limit of 14.8 MPa, and its price in dm³ per MPa: a thousandth part of a MPa is one kN/m², of a m³ one dm³.
    assert!(line("bending[main]").contains("14.8") && line("bending[main]").ends_with("MPa"), "{said}");
    let result: Value = serde_json::from_str(&fs::read_to_string(folder.path().join("run/result.json")).unwrap()).unwrap();
    let row = |name: &str| result["constraints"].as_array().unwrap().iter().find(|row| row["name"] == name).unwrap().clone();
    assert_eq!((row("bending[main]")["unit"].as_str(), row("bending[main]")["upper"].as_f64()), (Some("kN/m²"), Some(14_800.0)));
    assert_eq!(result["bounds"][0]["unit"], "m");
    assert_eq!(result["problem"]["show"]["kN/m²"][0], "MPa");
    let page = fs::read_to_string(folder.path().join("run/report.html")).unwrap();
    assert!(page.contains("<td>MPa</td>") && page.contains("<td>mm</td>"));
    let per_unit = |said: &str| said.split_whitespace().nth(4).unwrap().parse::<f64>().unwrap();
    let priced = row("bending[main]")["sensitivity"].as_f64().unwrap() * 1000.0 * 1000.0;
    assert!((per_unit(line("bending[main]")) / priced - 1.0).abs() < 1e-4, "{priced}: {said}");
    // The page and the network are ribopt's own, and give way to those of the next run.
    let again = ribopt(folder.path(), &["solve", "purlin.toml", "--report", "--out", "run", "--quiet"]);
    assert!(again.status.success(), "{}", text_of(&again));
}

#[test]
fn a_tiny_lower_bound_that_governs_is_hinted_at() {
    let folder = tempfile::tempdir().unwrap();
    let file = |lower: &str| {
        let text = format!(
            "minimize = \"x + 1/y\"\n[variables]\nx = {{ lower = {lower}, upper = 5, start = 1 }}\ny = {{ lower = 1, upper = 2 }}\n"
        );
        fs::write(folder.path().join("tiny.toml"), text).unwrap();
        text_of(&ribopt(folder.path(), &["solve", "tiny.toml", "--quiet"]))
    };
    let text_of_hint = file("1e-6");
    assert!(text_of_hint.contains("x (1e-6) rests on its lower bound, tiny beside the start"), "{text_of_hint}");
    assert!(!file("0.5").contains("tiny"));
    assert!(!file("0").contains("tiny"));
}

fn text_of(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

#[test]
fn tables_of_sections_have_lists() {
    let folder = tempfile::tempdir().unwrap();
    let table = "name,kind,b.lower [mm],b.upper [mm],b.step [mm],h.values [mm]\ns,rectangle,60,200,20,100 160 220 300\n";
    fs::write(folder.path().join("sections.csv"), table).unwrap();
    let head = PURLIN.split("[sections.s]").next().unwrap();
    let tail = PURLIN.split("[[ribs]]").nth(1).unwrap();
    fs::write(folder.path().join("list.toml"), format!("{head}\n[tables]\nsections = \"sections.csv\"\n[[ribs]]{tail}")).unwrap();
    let output = ribopt(folder.path(), &["solve", "list.toml", "--json"]);
    let result: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text_of(&output)));
    assert_eq!(result["status"], "certified", "{}", result["message"]);
    // W ≥ 3·4.5²/8/14800 = 5.131e-4 m³, h ≤ 5·b: of all pairs 80 × 220 is the smallest area with W enough.
    let (b, h) = (result["variables"]["s.b"].as_f64().unwrap(), result["variables"]["s.h"].as_f64().unwrap());
    let best = [60, 80, 100, 120, 140, 160, 180, 200]
        .into_iter()
        .flat_map(|b| [100, 160, 220, 300].map(|h| (b, h)))
        .filter(|&(b, h)| h <= 5 * b && f64::from(b * h * h) / 6e9 >= 3.0 * 4.5 * 4.5 / 8.0 / 14_800.0)
        .min_by_key(|&(b, h)| b * h)
        .unwrap();
    assert_eq!(((1000.0 * b).round() as i32, (1000.0 * h).round() as i32), best);
    let twice = table.replace("100 160 220 300", "100 x");
    fs::write(folder.path().join("sections.csv"), twice).unwrap();
    let refused = text_of(&ribopt(folder.path(), &["check", "list.toml"]));
    assert!(refused.contains("mistake[units]: the column has a unit, and this is no number"), "{refused}");
}

/// The text of a part of a workbook.
fn part(path: &Path, name: &str) -> String {
    let mut archive = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut text = String::new();
    archive.by_name(name).unwrap().read_to_string(&mut text).unwrap();
    text
}

#[test]
fn the_schedule_is_a_workbook_with_every_rib() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let problem = root.join("problems/portal-frame.toml");
    let solve = |out: &str| {
        let output = ribopt(folder.path(), &["solve", problem.to_str().unwrap(), "--quiet", "--schedule", out]);
        assert!(output.status.success(), "{}", text_of(&output));
        folder.path().join(out)
    };
    let first = solve("first.xlsx");
    assert_eq!(fs::read(&first).unwrap(), fs::read(solve("second.xlsx")).unwrap(), "the same file every time");
    let strings = part(&first, "xl/sharedStrings.xml");
    for word in ["column1", "rafter1", "length [m]", "volume [m³]", "mass [t]", "hw from", "utilisation", "governs", "certified"]
    {
        assert!(strings.contains(word), "{word} is missing: {strings}");
    }
    let sheets = part(&first, "xl/workbook.xml");
    assert!(sheets.contains("\"ribs\"") && sheets.contains("\"sections\"") && sheets.contains("\"origin\""), "{sheets}");
    // A header and four ribs.
    assert_eq!(part(&first, "xl/worksheets/sheet1.xml").matches("<row ").count(), 5);
    let refused = ribopt(folder.path(), &["solve", problem.to_str().unwrap(), "--schedule", "ribs.csv"]);
    assert_eq!(refused.status.code(), Some(2), "{}", text_of(&refused));
    assert!(text_of(&refused).contains("ends in .xlsx"));
}

/// The titles of a sheet and its rows, by the shared strings of the workbook.
fn sheet(path: &Path, number: usize) -> Vec<Vec<String>> {
    let unescaped = |text: &str| text.replace("&amp;", "&").replace("&lt;", "<");
    let strings = part(path, "xl/sharedStrings.xml");
    let strings: Vec<String> = strings
        .split("<si>")
        .skip(1)
        .map(|item| unescaped(item.split_once('>').unwrap().1.split("</t>").next().unwrap()))
        .collect();
    let cell = |text: &str| {
        let value = text.split("<v>").nth(1).map_or("", |rest| rest.split("</v>").next().unwrap());
        if text.contains("t=\"s\"") { strings[value.parse::<usize>().unwrap()].clone() } else { value.to_owned() }
    };
    let column = |text: &str| {
        text.split('"')
            .next()
            .unwrap()
            .bytes()
            .take_while(u8::is_ascii_uppercase)
            .fold(0, |at, letter| 26 * at + usize::from(letter - b'A') + 1)
    };
    let rows = part(path, &format!("xl/worksheets/sheet{number}.xml"));
    let row = |text: &str| {
        let mut cells = Vec::new();
        for part in text.split("<c r=\"").skip(1) {
            cells.resize(column(part).max(cells.len()), String::new());
            *cells.last_mut().unwrap() = cell(part);
        }
        cells
    };
    rows.split("<row ").skip(1).map(row).collect()
}

/// Sheets of the format with the columns it requires (SAF 2.2, structural analysis elements, supports and hinges).
const SAF: [(&str, &[&str]); 7] = [
    ("StructuralMaterial", &["Name", "Type", "Quality"]),
    ("StructuralCrossSection", &["Name", "Material", "Cross-section type", "Shape", "Parameters [mm]"]),
    ("StructuralPointConnection", &["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"]),
    (
        "StructuralCurveMember",
        &[
            "Name",
            "Cross section",
            "Nodes",
            "Segments",
            "LCS",
            "LCS Rotation [deg]",
            "Coordinate X [m]",
            "System line",
            "Analysis Z Eccentricity of End Node [mm]",
            "Behaviour in analysis",
        ],
    ),
    ("StructuralCurveMemberVarying", &["Name", "Cross sections 1", "Span 1", "Alignment 1"]),
    ("StructuralPointSupport", &["Name", "Boundary condition", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz"]),
    ("RelConnectsStructuralMember", &["Name", "Member", "Position", "ux", "uy", "uz", "fix", "fiy", "fiz"]),
];

#[test]
fn the_structure_goes_to_other_programs() {
    let folder = tempfile::tempdir().unwrap();
    let problem = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/portal-frame.toml");
    let output = ribopt(folder.path(), &["solve", problem.to_str().unwrap(), "--quiet", "--saf", "portal.xlsx"]);
    assert!(output.status.success(), "{}", text_of(&output));
    let path = folder.path().join("portal.xlsx");
    let mut tables = std::collections::HashMap::new();
    for (at, (name, required)) in SAF.into_iter().enumerate() {
        assert!(part(&path, "xl/workbook.xml").contains(&format!("\"{name}\"")), "{name}");
        let rows = sheet(&path, at + 3);
        for title in required {
            let column = rows[0].iter().position(|known| known == title).unwrap_or_else(|| panic!("{name} lacks {title}"));
            assert!(
                rows[1..].iter().all(|row| row.get(column).is_some_and(|cell| !cell.is_empty())),
                "{name}: {title} has empty cells"
            );
        }
        tables.insert(name, rows);
    }
    let names = |table: &str| tables[table][1..].iter().map(|row| row[0].clone()).collect::<Vec<_>>();
    let of = |table: &str, title: &str| {
        let column = tables[table][0].iter().position(|known| known == title).unwrap();
        tables[table][1..].iter().map(|row| row[column].clone()).collect::<Vec<_>>()
    };
    // Every reference leads somewhere.
    assert!(of("StructuralCurveMember", "Cross section").iter().all(|section| names("StructuralCrossSection").contains(section)));
    let nodes = of("StructuralCurveMember", "Nodes");
    assert!(
        nodes.iter().flat_map(|pair| pair.split("; ")).all(|node| names("StructuralPointConnection").contains(&node.to_owned()))
    );
    assert!(of("StructuralPointSupport", "Node").iter().all(|node| names("StructuralPointConnection").contains(node)));
    assert!(of("StructuralCrossSection", "Material").iter().all(|material| names("StructuralMaterial").contains(material)));
    let tapers = of("StructuralCurveMember", "Arbitrary definition");
    assert_eq!(tapers, names("StructuralCurveMemberVarying"), "every rib of the portal tapers");
    for pair in of("StructuralCurveMemberVarying", "Cross sections 1") {
        assert!(pair.split(", ").all(|section| names("StructuralCrossSection").contains(&section.to_owned())), "{pair}");
    }
    // E of steel, and an H beam of six numbers, the web 8 mm thick.
    assert_eq!(of("StructuralMaterial", "E modulus [MPa]"), ["210000"]);
    assert!(
        of("StructuralCrossSection", "Parameters [mm]").iter().all(|text| text.split("; ").count() == 6 && text.ends_with("; 8"))
    );
    // Held out of its plane, pinned in it.
    let of_foot = |title: &str| of("StructuralPointSupport", title)[0].clone();
    assert_eq!(["ux", "uy", "uz", "fix", "fiy", "fiz"].map(of_foot), ["Rigid", "Rigid", "Rigid", "Rigid", "Free", "Rigid"]);
    let unitless = ribopt(folder.path(), &["solve", "none.toml", "--saf", "x.xlsx"]);
    assert_eq!(unitless.status.code(), Some(2));
}
