//! Whatever is restated for a solver says what the user wrote: kinks replaced by auxiliaries, logarithms of variables, flange
//! thicknesses. At random points of the box, objective, rows and feasibility of the transformed model are the original's.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::support::{name, problem_files, read};
use ribopt::model::{Model, Substitution};
use ribopt::run::Subject;

/// Relative to the size of the values compared: what rounding of a few operations amounts to.
const ROUNDING: f64 = 1e-9;

/// A row this far inside or outside its limits, relative, must be so in every form.
const CLEAR: f64 = 1e-6;

struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.uniform() * count as f64) as usize
    }

    fn pick<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len())]
    }

    /// A point of the box, now and then on a bound.
    fn point(&mut self, model: &dyn Model) -> Vec<f64> {
        let meta = model.meta();
        let one = |j: usize, random: &mut Random| {
            let (lower, upper, start) = (meta.lower[j], meta.upper[j], meta.start[j]);
            let (low, high) = (lower.max(start - 2.0 * start.abs().max(1.0)), upper.min(start + 2.0 * start.abs().max(1.0)));
            match random.below(10) {
                0 if lower.is_finite() => lower,
                1 if upper.is_finite() => upper,
                _ => low + random.uniform() * (high - low),
            }
        };
        (0..meta.variables()).map(|j| one(j, self)).collect()
    }
}

#[test]
fn problem_files_mean_the_same_in_every_form() {
    let mut complaints = Vec::new();
    let mut points = 0;
    for path in problem_files("problems").into_iter().chain(problem_files("tests/extra")) {
        let subject = read(&path);
        // Models of some size differ from small ones in nothing that is looked at here.
        if subject.model().meta().variables() <= 500 {
            points += compared(&subject, &name(&path), 10, &mut complaints);
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    assert!(points > 1000, "{points}");
}

#[test]
fn random_problems_mean_the_same_in_every_form() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("problem.toml");
    let (mut random, mut complaints, mut points, mut logarithms, mut auxiliaries) = (Random(11), Vec::new(), 0, 0, 0);
    for number in 0..1500 {
        let text = problem(&mut random);
        fs::write(&file, &text).expect("a file");
        let Ok(subject) = Subject::read(Path::new(&file), &[]) else { continue };
        logarithms += usize::from(subject.substitution().is_some());
        auxiliaries += usize::from(subject.model().meta().variables() > subject.shown().meta().variables());
        let before = complaints.len();
        points += compared(&subject, &format!("problem {number}"), 12, &mut complaints);
        if complaints.len() > before {
            complaints.push(text);
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    assert!(points > 2000 && logarithms > 50 && auxiliaries > 200, "{points}, {logarithms}, {auxiliaries}");
}

/// A small problem with rows of every sign, kinks, and products.
fn problem(random: &mut Random) -> String {
    let lower = random.pick(&["0", "0.01", "0.5", "-2"]);
    // Every other one is made of what geometric programs are made of.
    let positive = random.below(2) == 0;
    let mut text = format!("minimize = \"{}\"\n[variables]\n", expression(random, 3, positive));
    for variable in ["x", "y", "z"] {
        let _ = writeln!(text, "{variable} = {{ lower = {lower}, upper = 4, start = 1.3 }}");
    }
    for row in 0..1 + random.below(3) {
        let (left, sign, limit) =
            (expression(random, 2, positive), random.pick(&["<=", ">="]), random.pick(&["-2", "-0.5", "0", "1", "3"]));
        let _ = writeln!(text, "[[constraints]]\nname = \"row {row}\"\nrequire = \"{left} {sign} {limit}\"");
    }
    text
}

fn expression(random: &mut Random, depth: usize, positive: bool) -> String {
    if depth == 0 {
        return random.pick(&["x", "y", "z", "2", "0.5", "3", "x", "y"]).into();
    }
    let (a, b) = (expression(random, depth - 1, positive), expression(random, depth - 1, positive));
    match random.below(20) {
        _ if positive => match random.below(9) {
            0..3 => format!("({a} + {b})"),
            3..6 => format!("{a}*{b}"),
            6 => format!("{a}/({})", random.pick(&["x", "y*z", "2"])),
            7 => format!("max({a}, {b})"),
            _ => format!("-{a}*{b}"),
        },
        0..4 => format!("({a} + {b})"),
        4..6 => format!("({a} - {b})"),
        6..10 => format!("{a}*{b}"),
        10 => format!("-{a}*{b}"),
        11..13 => format!("{a}/({b})"),
        13 => format!("({a})^{}", random.pick(&["2", "3", "-1", "0.5", "-1.5"])),
        14 => format!("max({a}, {b})"),
        15 => format!("min({a}, {b})"),
        16 => format!("abs({a} - {b})"),
        17 => format!("{}({a})", random.pick(&["exp", "log", "sqrt", "cos", "sin", "atan"])),
        18 => format!("max({a}, {b}, 1)^2"),
        _ => format!("1/min({a}, {b})"),
    }
}

/// Compares all forms of a problem at `count` points and the start; how many points had values.
fn compared(subject: &Subject, name: &str, count: usize, complaints: &mut Vec<String>) -> usize {
    let (model, shown) = (subject.model(), subject.shown());
    let mut random = Random(5);
    let mut points = vec![shown.meta().start.clone()];
    points.extend((0..count).map(|_| random.point(shown)));
    let mut used = 0;
    for x in points {
        let Some((objective, rows)) = values(shown, &x) else { continue };
        used += 1;
        let full = subject.completed(x.clone());
        let mut complain = |what: String| complaints.push(format!("{name} at {x:?}: {what}"));
        let Some((own_objective, own_rows)) = values(model, &full) else {
            // An infinite argument of a minimum or maximum that another one decides: a row of its own has no value there.
            if x.iter().all(|value| value.fract() != 0.0) {
                complain("no value without kinks".into());
            }
            continue;
        };
        if !same(objective, own_objective) {
            complain(format!("objective {objective}, without kinks {own_objective}"));
        }
        for (i, &row) in rows.iter().enumerate() {
            if !same(row, own_rows[i]) {
                complain(format!("row {i} is {row}, without kinks {}", own_rows[i]));
            }
        }
        let meta = model.meta();
        for (i, &row) in own_rows.iter().enumerate().skip(rows.len()) {
            if violation(meta.row_lower[i], meta.row_upper[i], row) > ROUNDING * full.iter().fold(1.0, |m, v| v.abs().max(m)) {
                complain(format!("auxiliary row {i} is violated: {row}"));
            }
        }
        for (j, &value) in full.iter().enumerate().skip(x.len()) {
            if violation(meta.lower[j], meta.upper[j], value) > ROUNDING {
                complain(format!("auxiliary {j} is outside its bounds: {value}"));
            }
        }
        if let Some(other) = subject.substitution() {
            substituted(model, other, &full, &mut complain);
        }
    }
    used
}

/// Compares a model in other variables, where the way there and back leaves the point where it is.
fn substituted(model: &dyn Model, other: &dyn Substitution, x: &[f64], complain: &mut dyn FnMut(String)) {
    let z = other.inward(x);
    let back = other.outward(&z);
    if !x.iter().zip(&back).all(|(&a, &b)| same(a, b)) {
        return; // on the edge of what the other variables reach
    }
    let (Some((objective, rows)), Some((inner_objective, inner_rows))) = (values(model, x), values(other.model(), &z)) else {
        return;
    };
    let outward = other.outward_objective(inner_objective);
    if !same(objective, outward) {
        complain(format!("objective {objective}, substituted {outward}"));
    }
    let (meta, inner) = (model.meta(), other.model().meta());
    for (i, &row) in rows.iter().enumerate() {
        let own = margin(meta.row_lower[i], meta.row_upper[i], row);
        let there = margin(inner.row_lower[i], inner.row_upper[i], inner_rows[i]);
        if own < -CLEAR * row.abs().max(1.0) && there > 0.0 || own > CLEAR * row.abs().max(1.0) && there < 0.0 {
            complain(format!("row {i} has {own} to spare, substituted {there}"));
        }
    }
}

fn values(model: &dyn Model, x: &[f64]) -> Option<(f64, Vec<f64>)> {
    let mut rows = vec![0.0; model.meta().rows()];
    model.constraints(x, &mut rows).ok()?;
    Some((model.objective(x).ok()?, rows))
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * a.abs().max(b.abs()).max(1.0)
}

fn violation(lower: f64, upper: f64, value: f64) -> f64 {
    -margin(lower, upper, value).min(0.0)
}

/// How far a value is inside its limits; negative outside.
fn margin(lower: f64, upper: f64, value: f64) -> f64 {
    (value - lower).min(upper - value)
}
