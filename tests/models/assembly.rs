//! From problem text to a model: derivatives, sharing, classes.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use ribopt::certificate::{Tolerances, certify};
use ribopt::input;
use ribopt::model::derivative_check::derivative_check;
use ribopt::model::{Assembled, Class, Model, RibModel, assemble, assemble_any, classify};
use ribopt::problem::Problem;

fn model(text: &str) -> RibModel {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("problem.toml");
    fs::write(&file, text).unwrap();
    model_of(&file)
}

fn read(file: &Path) -> Arc<Problem> {
    let input = input::read(file).unwrap_or_else(|mistakes| panic!("{}:\n{mistakes}", file.display()));
    Arc::new(input.problem.without_kinks())
}

fn model_of(file: &Path) -> RibModel {
    assemble(&read(file)).unwrap()
}

fn assert_derivatives(model: &dyn Model, what: &str) {
    // Off the bounds, where differences have room on both sides.
    let meta = model.meta();
    let x: Vec<f64> = (0..meta.variables())
        .map(|j| {
            let (lower, upper) = (meta.lower[j], meta.upper[j]);
            let inside = if lower.is_finite() && upper.is_finite() { 0.4 * lower + 0.6 * upper } else { meta.start[j] };
            if inside == 0.0 { 0.37 + 0.1 * j as f64 } else { inside }
        })
        .collect();
    let check = derivative_check(model, &x).unwrap();
    assert!(check.compared > 0, "{what}");
    assert_eq!(check.disagreements, 0, "{what}: {:?}", check.worst);
}

#[test]
fn exact_derivatives_of_every_shipped_problem_agree_with_differences() {
    let mut files = 0;
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("problems")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let assembled: Assembled = assemble_any(&read(&path)).unwrap();
            assert_derivatives(assembled.model(), &path.display().to_string());
            files += 1;
        }
    }
    assert!(files >= 10);
}

#[test]
fn what_some_variables_reach_changes_with_them_as_the_whole_does() {
    let text = r#"
parameters = { N = 1000 }
minimize = "sum(i in 1..N: x[i]^2*x[i+1]) + x[7]*y"
[variables]
x = { size = "N + 1", lower = 0.1, upper = 2, start = 0.7 }
y = { lower = 0, upper = 9, start = 1 }
[[constraints]]
name = "link"
for = "i in 1..N"
require = "x[i]*x[i+1]^3 + 2*x[i] <= 30"
[[constraints]]
name = "all"
require = "sum(i in 1..N: log(x[i]) + 3*x[i]) + y^2 <= 9000"
"#;
    let whole = model(text);
    let selected: Vec<u32> = (0..whole.meta().variables() as u32).step_by(251).collect();
    let near = whole.around(&selected).unwrap();
    assert!(near.variables.len() <= 4 * selected.len() && near.rows.len() <= 3 * selected.len());
    let x: Vec<f64> = (0..whole.meta().variables()).map(|j| 0.5 + (j as f64 * 0.618).fract()).collect();
    let own = |x: &[f64]| -> Vec<f64> { near.variables.iter().map(|&j| x[j as usize]).collect() };
    let rows = |model: &dyn Model, x: &[f64]| {
        let mut rows = vec![0.0; model.meta().rows()];
        model.constraints(x, &mut rows).unwrap();
        rows
    };
    let mut moved = x.clone();
    selected.iter().for_each(|&j| moved[j as usize] += 0.01);
    let of_whole = whole.objective(&moved).unwrap() - whole.objective(&x).unwrap();
    let of_part = near.model.objective(&own(&moved)).unwrap() - near.model.objective(&own(&x)).unwrap();
    assert!((of_whole - of_part).abs() < 1e-10 && of_part.abs() > 1e-3);
    let (before, after) = (rows(&whole, &x), rows(&whole, &moved));
    let (part_before, part_after) = (rows(near.model.as_ref(), &own(&x)), rows(near.model.as_ref(), &own(&moved)));
    for (k, &i) in near.rows.iter().enumerate() {
        let (of_whole, name) = (after[i as usize] - before[i as usize], whole.meta().names.row(i as usize));
        assert!((of_whole - (part_after[k] - part_before[k])).abs() < 1e-10, "{name}");
        assert_eq!(name, near.model.row_name(k));
    }
    assert_derivatives(&whole, "the whole, by what is near");
}

/// Two ribs between three sections of one kind, by both laws, with rows on every property.
fn ribs_of(kind: &str, dimensions: &str, properties: &[&str]) -> String {
    let mut text = String::new();
    for section in ["p", "q", "r"] {
        text += &format!("[sections.{section}]\nkind = \"{kind}\"\n{dimensions}\n");
    }
    text += "[[ribs]]\nname = \"one\"\nfrom = \"p\"\nto = \"q\"\nlength = 2.0\n";
    text += "[[ribs]]\nname = \"two\"\nfrom = \"q\"\nto = \"r\"\nlength = 3.0\nvolume = \"prismatoid\"\n";
    text += "[[ribs]]\nname = \"three\"\nsection = \"p\"\nlength = 1.5\n";
    for property in properties {
        text += &format!("[[constraints]]\nname = \"{property}\"\nfor = \"sections\"\nrequire = \"{property} >= 1e-9\"\n");
    }
    text + "[[constraints]]\nname = \"line\"\nfor = \"ribs\"\nrequire = \"sum(ribs: length/(from.Ix + to.Ix)) >= 1e-9*volume_prismatoid\"\n"
}

#[test]
fn every_parametrisation_of_the_h_beam_has_exact_derivatives_and_one_volume() {
    let forms = [
        [
            "tw = {lower=4e-3,upper=6e-3}",
            "hw = {lower=0.2,upper=0.21}",
            "b = {lower=0.1,upper=0.2}",
            "tf = {lower=9e-3,upper=1e-2}",
        ],
        [
            "tw = {lower=4e-3,upper=6e-3}",
            "hw = {lower=0.2,upper=0.21}",
            "b = {lower=0.1,upper=0.2}",
            "h = {lower=0.22,upper=0.24}",
        ],
        [
            "tw = {lower=4e-3,upper=6e-3}",
            "h = {lower=0.22,upper=0.24}",
            "b = {lower=0.1,upper=0.2}",
            "tf = {lower=9e-3,upper=1e-2}",
        ],
        [
            "b1 = {lower=4e-3,upper=6e-3}",
            "h1 = {lower=0.2,upper=0.21}",
            "b2 = {lower=0.1,upper=0.2}",
            "t = {lower=2e-2,upper=3e-2}",
        ],
        [
            "b1 = {lower=4e-3,upper=6e-3}",
            "h1 = {lower=0.2,upper=0.21}",
            "b2 = {lower=0.1,upper=0.2}",
            "h2 = {lower=0.22,upper=0.24}",
        ],
        [
            "b1 = {lower=4e-3,upper=6e-3}",
            "h2 = {lower=0.22,upper=0.24}",
            "b2 = {lower=0.1,upper=0.2}",
            "t = {lower=2e-2,upper=3e-2}",
        ],
    ];
    for form in forms {
        let text = ribs_of("h-beam", &form.join("\n"), &["A", "Ix", "Iy", "Wx", "Wy", "tf"]);
        assert_derivatives(&model(&text), &form.join(", "));
    }
}

#[test]
fn closed_forms_and_expressions_give_the_same_volume() {
    // A computed dimension takes the way of expressions, a plain one that of closed forms.
    let plain = ribs_of("rectangle", "b = {lower=0.1,upper=0.3,start=0.2}\nh = {lower=0.2,upper=0.5,start=0.4}", &[]);
    let computed = plain.replace("b = {lower=0.1,upper=0.3,start=0.2}", "b = \"2*half\"");
    let computed = format!("[variables]\nhalf = {{ lower = 0.05, upper = 0.15, start = 0.1 }}\n{computed}");
    let (plain, computed) = (model(&plain), model(&computed));
    let at_start = |model: &RibModel| model.objective(&model.meta().start).unwrap();
    assert!((at_start(&plain) - at_start(&computed)).abs() < 1e-15);
    assert_derivatives(&computed, "computed dimensions");
}

#[test]
fn computed_dimensions_of_one_shape_keep_their_own_data() {
    // The ratio stands in the dimension and in the row: one slot for both. Section r is linked to a number and goes its own way.
    let mut text = String::from("[[constraints]]\nfor = \"sections\"\nrequire = \"ratio*Ix/c <= 1\"\n");
    let sections = [("p", 1.5, 2.0, "ratio*b + b"), ("q", 2.5, 3.0, "ratio*b + b"), ("r", 2.0, 5.0, "")];
    for (name, ratio, c, h) in sections {
        let own = if name == "r" { "kind = \"h-beam\"\ntw = 0.01\nhw = 0.3\ntf = \"ratio*tw\"" } else { "kind = \"rectangle\"" };
        let h = if name == "r" { String::new() } else { format!("h = \"{h}\"\n") };
        text += &format!("[sections.{name}]\n{own}\n{h}b = {{ lower = 0.1, upper = 0.3, start = 0.2 }}\n");
        text += &format!("data = {{ ratio = {ratio}, c = {c} }}\n");
    }
    text += "[[ribs]]\nname = \"one\"\nfrom = \"p\"\nto = \"q\"\nlength = 2.0\n";
    text += "[[ribs]]\nname = \"two\"\nfrom = \"q\"\nto = \"p\"\nlength = 3.0\n";
    let model = model(&text);
    assert_derivatives(&model, "computed dimensions with data");
    let (x, mut rows) = (&model.meta().start, [0.0; 3]);
    let heights = [2.5 * 0.2, 3.5 * 0.2];
    let areas = heights.map(|h| 0.2 * h);
    let volume = 5.0 / 3.0 * (areas[0] + areas[1] + f64::sqrt(areas[0] * areas[1]));
    assert!((model.objective(x).unwrap() / volume - 1.0).abs() < 1e-14);
    model.constraints(x, &mut rows).unwrap();
    let inertias = heights.map(|h| 0.2 * h.powi(3) / 12.0);
    assert!((rows[0] / (1.5 * inertias[0] / 2.0) - 1.0).abs() < 1e-14, "{rows:?}");
    assert!((rows[1] / (2.5 * inertias[1] / 3.0) - 1.0).abs() < 1e-14, "{rows:?}");
}

#[test]
fn items_of_one_shape_share_their_kernels() {
    let text = ribs_of("rectangle", "b = {lower=0.1,upper=0.3}\nh = {lower=0.2,upper=0.5}", &["A", "Ix"]);
    let (objective, rows, kernels) = model(&text).elements();
    assert_eq!((objective, rows), (3, 6 + 3 * 3 + 9), "three ribs; six section rows, three sums with three volumes each");
    assert!(kernels <= 9, "{kernels} kernels");
}

fn class(text: &str) -> Class {
    classify(&model(text)).unwrap().class
}

#[test]
fn classes_are_proved_by_structure() {
    let problem = |objective: &str, row: &str| {
        format!(
            "minimize = \"{objective}\"\n[variables]\nx = {{lower=0.1,upper=9}}\ny = {{lower=0.1,upper=9}}\n[definitions]\ng = \"x - 2*y\"\n[[constraints]]\nname = \"row\"\nrequire = \"{row}\"\n"
        )
    };
    assert_eq!(class(&problem("x + 2*y", "x - y <= 3")), Class::Linear);
    assert_eq!(class(&problem("x*y + x/y", "x*y^3/12 >= 2")), Class::GeometricProgram);
    assert_eq!(class(&problem("x*y", "g <= 0")), Class::GeometricProgram, "a definition is seen through");
    assert_eq!(class(&problem("x*y", "1/x + y <= 4 - 1")), Class::GeometricProgram);
    let maximised = problem("-(x*y + x/y)", "x*y^3/12 >= 2").replace("minimize", "maximize");
    assert_eq!(class(&maximised), Class::GeometricProgram, "maximising −f is minimising f");
    assert_eq!(class(&maximised.replace("-(x*y + x/y)", "2*(-(x*y) - x/y)")), Class::GeometricProgram);
    assert_eq!(class(&problem("x^2 + exp(y)", "x^2 - sqrt(y) <= 3")), Class::Convex);
    assert_eq!(class(&problem("x*y", "x + y >= 1")), Class::Nonlinear, "a posynomial bounded from below");
    assert_eq!(class(&problem("x*y", "x*y == 2")), Class::GeometricProgram);
    assert_eq!(class(&problem("x*y", "x + y == 2")), Class::Nonlinear);
}

#[test]
fn rectangles_are_geometric_programs_and_h_beams_with_stiffness_are_not() {
    let rectangle = ribs_of("rectangle", "b = {lower=0.1,upper=0.3}\nh = {lower=0.2,upper=0.5}", &["A", "Ix", "Wy"]);
    let first = |text: &str| text.split("[[constraints]]\nname = \"line\"").next().unwrap().to_string();
    assert_eq!(class(&first(&rectangle)), Class::GeometricProgram);
    let h_beam =
        "tw = {lower=4e-3,upper=6e-3}\nhw = {lower=0.2,upper=0.3}\nb = {lower=0.1,upper=0.2}\ntf = {lower=9e-3,upper=1e-2}";
    assert_eq!(class(&first(&ribs_of("h-beam", h_beam, &[]))), Class::GeometricProgram);
    let stiff = model(&first(&ribs_of("h-beam", h_beam, &["Ix"])));
    let classification = classify(&stiff).unwrap();
    assert_eq!(classification.class, Class::Nonlinear);
    assert!(classification.not_geometric.unwrap().contains("constraint Ix"));
}

#[test]
fn fixed_variables_are_numbers_in_the_terms_of_a_row() {
    let row = |name: &str, require: &str| format!("[[constraints]]\nname = \"{name}\"\nrequire = \"{require}\"\n");
    let rows =
        row("a", "k*(x^2 - 4) >= 0") + &row("b", "(outer - k)/k <= 5") + &row("c", "k*x + k^2 >= 1") + &row("d", "exp(k*x) <= 9");
    let text = format!(
        "minimize = \"x\"\n[definitions]\nouter = \"2*k*(x^2 - 4)\"\n[variables]\n\
         x = {{ lower = 0, start = 1, upper = 9 }}\nk = {{ lower = 3, start = 3, upper = 3 }}\n{rows}"
    );
    assert_eq!(model(&text).meta().row_constants, [-12.0, -9.0, 9.0, 0.0]);
}

#[test]
fn parts_that_pass_pass_together() {
    // Thirty parts, each with a gap just within what is accepted; their sum is beyond.
    let model = model("minimize = \"sum(x)\"\n[variables]\nx = {size=30,lower=1,start=1.5}\n");
    let judge = |gap: f64| certify(&model, Class::Nonlinear, &[1.0 + gap; 30], None, Tolerances::default()).unwrap();
    assert!(judge(5e-7).certified, "{:?}", judge(5e-7).messages);
    assert!(!judge(5e-6).certified);
}
