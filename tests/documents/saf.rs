//! `solve --saf`: sheets and columns of the Structural Analysis Format 2.2 (the format's published documentation), references that lead
//! somewhere, and what it has no word for.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::support::workbook::{sheet, sheet_names};

/// Sheets with the columns that are required in every row, and those that are there in some.
const SAF: [(&str, &[&str], &[&str]); 16] = [
    ("StructuralMaterial", &["Name", "Type", "Quality"], &["Unit mass [kg/m3]", "E modulus [MPa]"]),
    ("StructuralCrossSection", &["Name", "Material", "Cross-section type"], &["Shape", "Parameters [mm]", "Profile"]),
    ("CompositeShapeDef", &["Name", "Polygon contour 1", "Material name 1"], &[]),
    ("StructuralPointConnection", &["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"], &[]),
    (
        "StructuralCurveMember",
        &["Name", "Cross section", "Nodes", "Segments", "LCS", "LCS Rotation [deg]", "Coordinate X [m]", "System line"],
        &["Arbitrary definition", "Behaviour in analysis", "Analysis Z Eccentricity of End Node [mm]"],
    ),
    ("StructuralCurveMemberVarying", &["Name", "Cross sections 1", "Span 1", "Alignment 1"], &[]),
    ("StructuralPointSupport", &["Name", "Boundary condition", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz"], &[]),
    ("RelConnectsStructuralMember", &["Name", "Member", "Position", "ux", "uy", "uz", "fix", "fiy", "fiz"], &[]),
    ("StructuralLoadGroup", &["Name", "Load group type", "Relation"], &[]),
    ("StructuralLoadCase", &["Name", "Action type", "Load group", "Load type"], &[]),
    (
        "StructuralLoadCombination",
        &["Name", "Category", "Type", "Load factor 1", "Multiplier 1", "Load case name 1"],
        &["Load case name 2"],
    ),
    (
        "StructuralPointAction",
        &["Name", "Direction", "Force action", "Value [kN]", "Load case", "Coordinate system"],
        &["Reference node", "Reference member", "Origin", "Coordinate definition", "Position x [m]", "Repeat (n)"],
    ),
    ("StructuralPointMoment", &["Name", "Direction", "Force action", "Value [kNm]", "Load case", "Coordinate system"], &[]),
    (
        "StructuralCurveAction",
        &[
            "Name",
            "Force action",
            "Distribution",
            "Direction",
            "Value 1 [kN/m]",
            "Member",
            "Load case",
            "Coordinate system",
            "Location",
            "Coordinate definition",
            "Origin",
            "Extent",
            "Start point [m]",
            "End point [m]",
            "Eccentricity ey [mm]",
            "Eccentricity ez [mm]",
        ],
        &["Value 2 [kN/m]"],
    ),
    (
        "StructuralCurveActionThermal",
        &["Name", "Force action", "Variation", "Member", "Load case", "Coordinate definition", "Origin", "End point [m]"],
        &["deltaT [°C]", "TempT [°C]", "TempB [°C]"],
    ),
    ("StructuralPointSupportDef", &["Name", "Point support", "Direction", "Load case"], &["Translation value [mm]"]),
];

/// Which cells name what stands in the first column of which other sheet; several names in one cell are separated.
const REFERENCES: [(&str, &str, &str); 14] = [
    ("StructuralCrossSection", "Material", "StructuralMaterial"),
    ("StructuralCrossSection", "Profile", "CompositeShapeDef"),
    ("CompositeShapeDef", "Material name 1", "StructuralMaterial"),
    ("StructuralCurveMember", "Cross section", "StructuralCrossSection"),
    ("StructuralCurveMember", "Nodes", "StructuralPointConnection"),
    ("StructuralCurveMember", "Arbitrary definition", "StructuralCurveMemberVarying"),
    ("StructuralCurveMemberVarying", "Cross sections 1", "StructuralCrossSection"),
    ("StructuralPointSupport", "Node", "StructuralPointConnection"),
    ("StructuralLoadCase", "Load group", "StructuralLoadGroup"),
    ("StructuralLoadCombination", "Load case name 1", "StructuralLoadCase"),
    ("StructuralLoadCombination", "Load case name 2", "StructuralLoadCase"),
    ("StructuralPointAction", "Load case", "StructuralLoadCase"),
    ("StructuralCurveAction", "Member", "StructuralCurveMember"),
    ("StructuralPointSupportDef", "Point support", "StructuralPointSupport"),
];

/// A plane frame with every kind of load and section that the format has a word for.
const FRAME: &str = include_str!("../data/saf-frame.toml");

fn ribopt(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ribopt")).current_dir(folder).args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&[&output.stdout[..], &output.stderr].concat()).into_owned()
}

/// The sheets that a problem's answer is written as.
struct Workbook(HashMap<String, Vec<Vec<String>>>);

impl Workbook {
    fn of(problem: &str) -> Workbook {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("frame.toml"), problem).unwrap();
        let output = ribopt(folder.path(), &["solve", "frame.toml", "--quiet", "--saf", "frame.xlsx"]);
        assert!(output.status.success(), "{}", said(&output));
        let path = folder.path().join("frame.xlsx");
        Workbook(sheet_names(&path).into_iter().zip(1..).map(|(name, at)| (name, sheet(&path, at))).collect())
    }

    fn column(&self, table: &str, title: &str) -> Vec<&str> {
        let rows = self.0.get(table).unwrap_or_else(|| panic!("there is no sheet {table}"));
        let at = rows[0].iter().position(|known| known == title).unwrap_or_else(|| panic!("{table} lacks {title}"));
        rows[1..].iter().map(|row| row.get(at).map_or("", String::as_str)).collect()
    }

    /// The cells of a column, in the row of a name.
    fn cell(&self, table: &str, name: &str, title: &str) -> &str {
        let row = self.column(table, "Name").iter().position(|known| *known == name).unwrap();
        self.column(table, title)[row]
    }

    /// Rows by the cells of some columns.
    fn rows(&self, table: &str, titles: &[&str]) -> Vec<Vec<&str>> {
        let columns: Vec<Vec<&str>> = titles.iter().map(|title| self.column(table, title)).collect();
        (0..columns[0].len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
    }
}

#[test]
fn every_sheet_has_the_columns_and_every_reference_leads_somewhere() {
    let book = Workbook::of(
        &FRAME
            .replace("section = \"beam\"", "from = \"beam\"\nto = \"deep\"")
            .replace("numbers = {", "deep = { kind = \"h-beam\", b = 100, hw = 250, tf = 8, tw = 5 }\nnumbers = {"),
    );
    for (table, required, further) in SAF {
        if table == "RelConnectsStructuralMember" {
            continue; // the frame has no hinges: there is no row
        }
        for title in required {
            assert!(book.column(table, title).iter().all(|cell| !cell.is_empty()), "{table}: {title} has empty cells");
        }
        further.iter().for_each(|title| assert!(book.column(table, title).len() == book.column(table, "Name").len()));
        let mut names = book.column(table, "Name");
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{table}: {names:?}");
    }
    for (table, title, named) in REFERENCES {
        let names = book.column(named, "Name");
        for cell in book.column(table, title).iter().flat_map(|cell| cell.split([';', ','])).map(str::trim) {
            assert!(cell.is_empty() || names.contains(&cell), "{table}, {title}: `{cell}` is none of {names:?}");
        }
    }
}

#[test]
fn sections_without_a_shape_by_name_are_outlines_or_have_the_same_numbers() {
    let book = Workbook::of(FRAME);
    let sections = "StructuralCrossSection";
    assert_eq!(book.column(sections, "Name"), ["leg of steel", "leg of timber", "beam", "numbers", "bar"]);
    assert_eq!(
        book.column("StructuralCurveMember", "Cross section"),
        ["leg of steel", "beam", "numbers", "leg of timber", "bar"]
    );
    assert_eq!(book.cell(sections, "leg of steel", "Cross-section type"), "General");
    let outlines = "CompositeShapeDef";
    let contour = |ring: usize| {
        let text = book.cell(outlines, "leg of timber", &format!("Polygon contour {ring}"));
        text.split("| ")
            .map(|point| point.split("; ").map(|number| number.parse::<f64>().unwrap()).collect::<Vec<_>>())
            .collect::<Vec<_>>()
    };
    // Material anticlockwise, the opening clockwise and of none (the shoelace formula).
    let area = |points: Vec<Vec<f64>>| {
        (0..points.len())
            .map(|i| (&points[i], &points[(i + 1) % points.len()]))
            .map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0]))
            .sum::<f64>()
    };
    assert!((area(contour(1)) - 80.0 * 120.0).abs() < 1e-6 && (area(contour(2)) + 70.0 * 110.0).abs() < 1e-6);
    assert_eq!(book.cell(outlines, "leg of timber", "Material name 1"), "timber");
    assert_eq!(book.cell(outlines, "leg of timber", "Material name 2"), "");
    // Of numbers in a plane a rectangle has both: A = 1200, I = bh³/12 = 1e6.
    assert_eq!(book.cell(sections, "numbers", "Shape"), "Rectangle");
    assert_eq!(book.cell(sections, "numbers", "Parameters [mm]"), "100; 12");
    assert_eq!(book.cell(sections, "bar", "Shape"), "Circle");
}

#[test]
fn loads_are_what_they_are_here() {
    let book = Workbook::of(FRAME);
    // The weight of all ribs stands apart, with the same factor.
    assert_eq!(book.column("StructuralLoadCase", "Name"), ["G", "S", "W", "T", "G self-weight"]);
    assert_eq!(book.cell("StructuralLoadCase", "G self-weight", "Load type"), "Self weight");
    let combined: Vec<&str> = (1..=4)
        .flat_map(|at| [format!("Load factor {at}"), format!("Load case name {at}")])
        .map(|title| book.cell("StructuralLoadCombination", "ULS", &title))
        .collect();
    assert_eq!(combined, ["1.35", "G", "1.35", "G self-weight", "1.5", "S", "0.9", "W"]);
    assert_eq!(book.cell("StructuralLoadCombination", "G", "Load case name 2"), "G self-weight");
    let mass: f64 = book.cell("StructuralMaterial", "steel", "Unit mass [kg/m3]").parse().unwrap();
    assert!((mass - 7850.0).abs() < 1e-9, "{mass}");
    let lines =
        ["Load case", "Member", "Distribution", "Direction", "Value 1 [kN/m]", "Value 2 [kN/m]", "Start point [m]", "Location"];
    assert_eq!(
        book.rows("StructuralCurveAction", &lines),
        [["G", "top", "Trapez", "Z", "-2", "-3", "0.25", "Length"], ["S", "wood", "Uniform", "Z", "-1", "", "0", "Projection"]]
    );
    let points = ["Load case", "Reference node", "Reference member", "Direction", "Coordinate system", "Position x [m]"];
    assert_eq!(
        book.rows("StructuralPointAction", &points),
        [["W", "b", "", "X", "Global", ""], ["W", "", "top", "Z", "Local", "0.5"]]
    );
    assert_eq!(book.column("StructuralPointAction", "Value [kN]"), ["2", "-0.5"]);
    assert_eq!(book.rows("StructuralPointMoment", &["Direction", "Value [kNm]"]), [["My", "0.5"], ["My", "0.1"]]);
    let thermal = ["Variation", "deltaT [°C]", "TempL [°C]", "TempT [°C]", "TempB [°C]"];
    assert_eq!(
        book.rows("StructuralCurveActionThermal", &thermal),
        [["Constant", "20", "", "", ""], ["Linear", "", "0", "5", "-5"]]
    );
    let settled = ["Point support", "Direction", "Translation value [mm]", "Rotation value [mrad]"];
    assert_eq!(book.rows("StructuralPointSupportDef", &settled), [["S d", "Z", "-4", ""]]);
}

#[test]
fn tapers_and_supports_of_a_portal() {
    let book = Workbook::of(&fs::read_to_string("problems/portal-frame.toml").unwrap());
    let tapers = book.column("StructuralCurveMember", "Arbitrary definition");
    assert_eq!(tapers, book.column("StructuralCurveMemberVarying", "Name"), "every rib of the portal tapers");
    // E of steel, and an H beam of six numbers, the web 8 mm thick.
    assert_eq!(book.column("StructuralMaterial", "E modulus [MPa]"), ["210000"]);
    let six = |text: &&str| text.split("; ").count() == 6 && text.ends_with("; 8");
    assert!(book.column("StructuralCrossSection", "Parameters [mm]").iter().all(six));
    // Held out of its plane, pinned in it.
    let of_foot = |title: &str| book.column("StructuralPointSupport", title)[0];
    assert_eq!(["ux", "uy", "uz", "fix", "fiy", "fiz"].map(of_foot), ["Rigid", "Rigid", "Rigid", "Rigid", "Free", "Rigid"]);
}

#[test]
fn what_the_format_has_no_word_for_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.toml");
    let pretension = "[[loads]]\ncase = \"W\"\nribs = [\"tie\"]\npretension = 100\n[combinations]";
    let part_weight = FRAME.replace("ribs = [\"*\"]\nself_weight", "ribs = [\"top\"]\nself_weight");
    let taper = part_weight.replace("section = \"beam\"", "from = \"beam\"\nto = \"deep\"");
    let taper = taper.replace("numbers = {", "deep = { kind = \"h-beam\", b = 100, hw = 250, tf = 8, tw = 5 }\nnumbers = {");
    for (problem, words) in [
        (FRAME.replace("[combinations]", pretension), "give `temperature` in its place"),
        (taper, "without `ribs` and gravity along -z"),
        (FRAME.replace("units = { length = \"mm\", force = \"N\", mass = \"t\" }\n", ""), "to `units`"),
    ] {
        fs::write(&path, problem).unwrap();
        let output = ribopt(folder.path(), &["solve", "frame.toml", "--quiet", "--saf", "frame.xlsx"]);
        assert!(said(&output).contains(words), "{words}: {}", said(&output));
        assert!(!folder.path().join("frame.xlsx").exists());
    }
    // The weight of a part of the ribs, of one section each, is a line load: 7.85e-9 t/mm³ · A · 9810 mm/s², here with A of 1600 + 5·hw mm².
    fs::write(&path, part_weight).unwrap();
    let output = ribopt(folder.path(), &["solve", "frame.toml", "--quiet", "--saf", "frame.xlsx"]);
    assert!(output.status.success(), "{}", said(&output));
}
