//! Every clause decides a design once.

use ribopt::certificate::Side;
use ribopt::crosscheck::Status;
use ribopt::run::solve::outcome;

use super::Bar;

const THICK: &str = "tw = 10\nhw = 200\nb = 200\ntf = { lower = 4, upper = 60, start = 20 }";
const NARROW: &str = "tw = 8\nhw = 300\nb = 120\ntf = { lower = 4, upper = 60, start = 20 }";
const WEB: &str = "tw = { lower = 1, upper = 60, start = 20 }\nhw = 200\nb = 200\ntf = 20";

const EN: &str = "code = \"EN 1993-1-1\"\nfy = \"material.fy\"\ngamma_M1 = 1\nstress_unit = 1\nweb = \"bending\"\n";
const GENERAL: &str = "ltb = { length = LENGTH, C1 = 1, curve = \"c\" }\n";
const ROLLED: &str = "ltb = { length = LENGTH, C1 = 1, curve = \"c\", clause = \"6.3.2.3\", lambda_LT0 = 0.4, beta = 0.75 }\n";
const CM: &str = "Cm = { y = 0.9, z = 0.9, LT = 0.9 }\n";

fn en(class: u8, y: f64, z: f64, further: &str) -> String {
    format!(
        "{EN}class = {class}\nbuckling = {{ y = {{ length = {y}, curve = \"b\" }}, z = {{ length = {z}, curve = \"c\" }} }}\n{further}"
    )
}

fn lateral(text: &str, length: f64) -> String {
    text.replace("LENGTH", &length.to_string())
}

fn aisc(made: &str, y: f64, z: f64) -> String {
    format!(
        "code = \"AISC 360-22\"\nfy = \"material.fy\"\nphi = 0.9\nmade = \"{made}\"\n\
         buckling = {{ y = {{ length = {y} }}, z = {{ length = {z} }} }}"
    )
}

/// The least volume of such a bar rests on a row of the clause, and is certified.
fn governs(clause: &str, length: f64, forces: [f64; 3], kind: &str, dimensions: &str, check: &str) {
    // Wider flanges are stronger: only the largest rests on the join.
    let minimize = if clause.contains("join") { "-1*s.b" } else { "volume" };
    let subject = Bar { length, forces, kind, dimensions, check, minimize }.subject();
    let found = outcome(&subject).unwrap_or_else(|error| panic!("{clause}: {error}"));
    assert_eq!(found.status, Status::Certified, "{clause}: {}", found.message);
    let certificate = found.certificate.unwrap();
    let active = certificate.row_sides.iter().enumerate().filter(|(_, side)| **side != Side::None);
    let names: Vec<String> = active.map(|(i, _)| subject.shown().row_name(i)).collect();
    let wanted = format!("k {clause}[");
    assert!(!names.is_empty() && names.iter().all(|name| name.starts_with(&wanted)), "{clause}: {names:?}");
}

#[test]
fn flexural_buckling() {
    let euler = |y: &str, z: &str| format!("code = \"Euler\"\nsafety = 1.5\nbuckling = {{ y = {y}, z = {z} }}");
    let (own, held) = ("{ length = \"length\" }", "\"held\"");
    let force = [900e3, 0.0, 0.0];
    governs("Euler y", 4e3, force, "rectangle", "b = 60\nh = { lower = 20, upper = 300, start = 100 }", &euler(own, held));
    governs("Euler z", 4e3, force, "rectangle", "h = 100\nb = { lower = 20, upper = 300, start = 100 }", &euler(held, own));
    governs("6.3.1 y", 4e3, [1500e3, 0.0, 0.0], "h-beam", THICK, &en(3, 8e3, 2e3, ""));
    governs("6.3.1 z", 4e3, [1500e3, 0.0, 0.0], "h-beam", THICK, &en(3, 2e3, 4e3, ""));
    governs("6.3.1 cap", 500.0, [3000e3, 0.0, 0.0], "h-beam", THICK, &en(3, 300.0, 300.0, ""));
    governs("E3-2 z", 4e3, [1500e3, 0.0, 0.0], "h-beam", THICK, &aisc("rolled", 2e3, 4e3));
    governs("E3-3 z", 10e3, [300e3, 0.0, 0.0], "h-beam", THICK, &aisc("rolled", 2e3, 10e3));
    let wide = "tw = 10\nhw = 200\ntf = 12\nb = { lower = 50, upper = 600, start = 150 }";
    governs("E3 join z", 10e3, [100e3, 0.0, 0.0], "h-beam", wide, &aisc("rolled", 2e3, 5e3));
}

#[test]
fn lateral_torsional_buckling_and_interaction() {
    let moment = |my: f64| [1e3, my, 0.0];
    governs("6.3.2.2", 4e3, moment(150e6), "h-beam", THICK, &en(2, 300.0, 300.0, &lateral(GENERAL, 4e3)));
    governs("6.3.2.3", 4e3, moment(100e6), "h-beam", NARROW, &en(2, 300.0, 300.0, &lateral(ROLLED, 4e3)));
    governs("6.3.2.3 slender", 20e3, moment(30e6), "h-beam", NARROW, &en(2, 300.0, 300.0, &lateral(ROLLED, 20e3)));
    governs("6.3.2 cap", 500.0, moment(250e6), "h-beam", NARROW, &en(2, 300.0, 300.0, "ltb = \"held\"\n"));
    let small = "ltb = \"held\"\nCm = { y = 0.4, z = 0.4, LT = 0.4 }\n";
    governs("6.3.3 cap", 500.0, [1e3, 1e3, 60e6], "h-beam", NARROW, &en(2, 300.0, 300.0, small));
    let both = |length: f64| format!("{}{CM}", lateral(GENERAL, length));
    governs("6.61", 4e3, [800e3, 120e6, 0.0], "h-beam", NARROW, &en(2, 8e3, 1e3, &both(1e3)));
    governs("6.62", 4e3, [400e3, 60e6, 0.0], "h-beam", NARROW, &en(2, 2e3, 4e3, &both(4e3)));
}

#[test]
fn local_buckling() {
    let small = [1e3, 1e6, 0.0];
    governs("Table 5.2 flange", 4e3, small, "h-beam", THICK, &en(3, 2e3, 4e3, ""));
    governs("Table 5.2 web", 4e3, small, "h-beam", WEB, &en(3, 2e3, 4e3, ""));
    let pipe = "d = 200\nt = { lower = 0.5, upper = 20, start = 10 }";
    governs("Table 5.2 wall", 4e3, small, "tube", pipe, &en(3, 2e3, 4e3, ""));
    let hollow = "b = 300\nh = 300\ntw = 10\ntf = { lower = 1, upper = 20, start = 12 }";
    governs("Table 5.2 flange", 4e3, small, "box", hollow, &en(3, 2e3, 4e3, ""));
    let tee = "tw = { lower = 1, upper = 60, start = 30 }\nhw = 200\nb = 200\ntf = 20";
    governs("Table 5.2 web", 1e3, small, "tee", tee, &en(3, 1e3, 1e3, ""));
    governs("B4.1a flange", 1e3, [1e3, 0.0, 0.0], "h-beam", THICK, &aisc("built-up", 500.0, 500.0));
    governs("B4.1a web", 1e3, [1e3, 0.0, 0.0], "h-beam", WEB, &aisc("built-up", 500.0, 500.0));
}
