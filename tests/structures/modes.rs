//! Buckling factors and natural frequencies: closed forms, derivatives, and optima at which several coincide.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::PathBuf;

use ribopt::certificate::Extent;
use ribopt::crosscheck::{Outcome, Status};
use ribopt::model::derivative_check::derivative_check;
use ribopt::run::Subject;
use ribopt::run::analyse::analyse;
use ribopt::run::solve::outcome;
use ribopt::run::verify::verify;

fn read(name: &str, text: &str) -> Subject {
    Subject::of_text(name, text).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn definition(text: &str, expression: &str) -> f64 {
    let subject = read("definition", &format!("{text}\n[definitions]\nasked = \"{expression}\"\n"));
    analyse(&subject, None, false).unwrap_or_else(|error| panic!("{expression}: {error}")).definitions[0].1
}

/// A column of 5 m, b × h = 0.1 × 0.2 at the foot and 0.1·t × 0.2·t at the top, 1 kN on it.
fn column(supports: &str, taper: f64, pieces: usize) -> String {
    format!(
        "minimize = \"volume\"\n[structure]\nplane = \"xz\"\nbuckling_pieces = {pieces}\n[materials]\ns = {{ E = 2.1e8, nu = 0.3, density = 7.85 }}\n\
         [nodes]\na = [0, 0]\nb = [0, 5]\n[supports]\n{supports}\n\
         [sections.foot]\nkind = \"rectangle\"\nb = 0.1\nh = 0.2\n[sections.top]\nkind = \"rectangle\"\nb = {}\nh = {}\n[[ribs]]\nname = \"m\"\nstart = \"a\"\nend = \"b\"\nfrom = \"foot\"\nto = \"top\"\n\
         [[loads]]\ncase = \"P\"\nnodes = [\"b\"]\nforce = [0, -1]\n",
        0.1 * taper,
        0.2 * taper
    )
}

const PINNED: &str = "a = \"pinned\"\nb = [\"x\"]";
const CLAMPED: &str = "a = \"fixed\"\nb = [\"x\", \"ry\"]";

/// EI of the section at the foot.
const STIFFNESS: f64 = 2.1e8 * 0.1 * 0.2 * 0.2 * 0.2 / 12.0;

/// Euler's load, and the errors of n pieces with cubic shapes (the exact ones of prismatic pieces): 22 %, 7.5e-3, 5.2e-4 for a pinned column.
#[test]
fn prismatic_columns_buckle_at_euler_s_load() {
    for (supports, exact, errors) in [
        (PINNED, PI * PI * STIFFNESS / 25.0, [(2, 7.52e-3), (4, 5.12e-4), (8, 3.28e-5)]),
        (CLAMPED, 4.0 * PI * PI * STIFFNESS / 25.0, [(2, 1.321e-2), (4, 7.522e-3), (8, 5.121e-4)]),
    ] {
        for (pieces, error) in errors {
            let factor = definition(&column(supports, 1.0, pieces), "buckling(P)");
            assert!(((factor / exact - 1.0) / error - 1.0).abs() < 2e-3, "{pieces}: {}", factor / exact - 1.0);
        }
    }
}

/// P = π²E√(I₁I₂)/L² for a column of similar sections (I goes with the fourth power of a linear side). Exact shapes make every factor an upper
/// bound, which falls with the fourth power of the pieces.
#[test]
fn tapered_columns_are_bounded_from_above() {
    let exact = PI * PI * STIFFNESS * 0.25 / 25.0;
    let factors = [1, 2, 4, 8].map(|pieces| definition(&column(PINNED, 0.5, pieces), "buckling(P)"));
    assert!(factors.is_sorted_by(|a, b| a > b), "{factors:?}");
    let half = [4, 8].map(|pieces| definition(&column(PINNED, 0.5, pieces), "buckling(P)") / exact - 1.0);
    assert!(half[0] > half[1] && half[1] > 0.0 && half[0] < 2e-3 && half[0] / half[1] > 12.0, "{half:?}");
}

/// ω = (βL)²√(EI/ρAL⁴) with βL = 1.8751041, 4.6940911 for a cantilever.
#[test]
fn cantilevers_vibrate_at_their_closed_form() {
    let text = column("a = \"fixed\"", 1.0, 8);
    let unit = (STIFFNESS / (7.85 * 0.02)).sqrt() / 25.0 / TAU;
    for (mode, root, error) in [(1, 1.875_104_068_711_961_f64, 2.1e-6), (2, 4.694_091_132_974_175, 8e-5)] {
        let frequency = definition(&text, &format!("frequency({mode})"));
        let relative = frequency / (root * root * unit) - 1.0;
        assert!(relative > 0.0 && relative < 1.1 * error, "{mode}: {relative}");
    }
}

/// A node mass on a massless spring bar: f = √(EA/(L·m))/2π.
#[test]
fn a_mass_on_a_bar_vibrates_as_a_spring_does() {
    let text = "minimize = \"volume\"\n[structure]\nplane = \"xz\"\njoints = \"pinned\"\n[materials]\ns = { E = 200 }\n[masses]\nb = 0.5\n\
        [nodes]\na = [0, 0]\nb = [2, 0]\n[supports]\na = \"pinned\"\nb = [\"z\"]\n[sections.s]\nkind = \"general\"\nA = 0.3\n\
        [[ribs]]\nname = \"m\"\nstart = \"a\"\nend = \"b\"\nsection = \"s\"\n";
    let exact = (200.0 * 0.3 / 2.0 / 0.5_f64).sqrt() / TAU;
    assert!((definition(text, "frequency(1)") / exact - 1.0).abs() < 1e-14);
}

/// Half a portal of tapered ribs with a hinge, an arm, a spring, self-weight and a ridge whose height is designed.
const PORTAL: &str = "minimize = \"volume\"\n[variables]\nrise = { start = 1.1, lower = 0.5, upper = 2 }\n[structure]\nplane = \"xz\"\ngravity = [0, -9.81]\nbuckling_pieces = 1\n\
    [materials]\ns = { E = 2.1e8, nu = 0.3, density = 7.85 }\n[nodes]\na = [0, 0]\nb = [0, 4]\nr = [4, \"4 + rise\"]\n\
    [supports]\na = \"fixed\"\nr = { fix = [\"x\"], springs = { z = 2e3 } }\n[masses]\nr = 0.4\n\
    [sections.foot]\nkind = \"rectangle\"\nb = 0.12\nh = { start = 0.21, lower = 0.1, upper = 0.5 }\n[sections.knee]\nkind = \"rectangle\"\nb = 0.12\nh = { start = 0.42, lower = 0.1, upper = 0.8 }\n\
    [sections.top]\nkind = \"rectangle\"\nb = 0.12\nh = 0.25\n\
    [[ribs]]\nname = \"c1\"\nstart = \"a\"\nend = \"b\"\nfrom = \"foot\"\nto = \"knee\"\nshear = true\n\
    [[ribs]]\nname = \"r1\"\nstart = \"b\"\nend = \"r\"\nfrom = \"knee\"\nto = \"top\"\nhinges = { start = [\"My\"] }\noffset = { start = [0.1, 0.05] }\n\
    [[loads]]\ncase = \"dead\"\nself_weight = true\n[[loads]]\ncase = \"dead\"\nribs = [\"r*\"]\nforce = [0, -6]\n[[loads]]\ncase = \"wind\"\nnodes = [\"b\"]\nforce = [9, 0]\n\
    [combinations]\nULS = { dead = 1.35, wind = 1.5 }\n";

/// First and second derivatives of factors (the prestress changes with the design, too), frequencies and formulas of them.
#[test]
fn derivatives_agree_with_differences() {
    let rows = "[[constraints]]\nname = \"b\"\nrequire = \"buckling(ULS) >= 3\"\n[[constraints]]\nname = \"f\"\nrequire = \"frequency(3) >= 0.5\"\n\
        [[constraints]]\nname = \"g\"\nrequire = \"sqrt(buckling(dead, 2))*knee.h + 1/frequency(1) >= 0\"\n";
    let subject = read("portal", &format!("{PORTAL}{rows}"));
    let model = subject.shown();
    let check = derivative_check(model, &model.meta().start).unwrap();
    assert!(check.compared > 20 && check.disagreements == 0, "{:?}", check.worst);
}

/// A structure turned in space, its ribs reversed, cut elsewhere: the same factors.
#[test]
fn factors_do_not_depend_on_the_way_a_structure_is_written() {
    let plane = definition(&column(CLAMPED, 0.6, 4), "buckling(P)");
    let turned = "minimize = \"volume\"\n[structure]\nbuckling_pieces = 4\n[materials]\ns = { E = 2.1e8, nu = 0.3, density = 7.85 }\n\
        [nodes]\na = [0, 0, 0]\nb = [3, 0, 4]\n[supports]\na = \"fixed\"\nb = [\"rx\", \"ry\", \"rz\", \"y\"]\n[sections.foot]\nkind = \"rectangle\"\nb = 0.1\nh = 0.2\n[sections.top]\nkind = \"rectangle\"\nb = 0.06\nh = 0.12\n\
        [[ribs]]\nname = \"m\"\nstart = \"b\"\nend = \"a\"\nfrom = \"top\"\nto = \"foot\"\nup = [-4, 0, 3]\n[[loads]]\ncase = \"P\"\nnodes = [\"b\"]\nforce = [-0.6, 0, -0.8]\n";
    // Held in y and against rotation, but free to sway in its plane: the same column as one that may sway.
    let swaying = definition(&column("a = \"fixed\"\nb = [\"ry\"]", 0.6, 4), "buckling(P)");
    let found = definition(turned, "buckling(P)");
    // About the other axis its ends are clamped: a quarter of the stiffness, a quarter of the clamped column's load, and the lower one.
    assert!((4.0 * found / plane - 1.0).abs() < 1e-9 && found < swaying, "{found} {swaying} {plane}");
    let second = definition(turned, "buckling(P, 2)");
    assert!((second / swaying - 1.0).abs() < 1e-9, "{second} {swaying}");
}

/// Two bars of length 1 at right angles hold a mass, turned by 30°: K = E·diag(A_p, A_q), M = m + ρ(A_p + A_q)/3 in both directions. Both areas come down
/// to A = ω²m/(E − 2ω²ρ/3), where both frequencies meet the limit: no single one has a derivative there.
fn cross(area: &str) -> String {
    let (c, s) = (30f64.to_radians().cos(), 30f64.to_radians().sin());
    format!(
        "minimize = \"p.A + q.A\"\n[structure]\nplane = \"xy\"\njoints = \"pinned\"\n[materials]\ns = {{ E = 7e10, density = 2700 }}\n[masses]\no = 450\n\
         [nodes]\no = [0, 0]\na = [{c}, {s}]\nb = [{}, {c}]\n[supports]\na = \"pinned\"\nb = \"pinned\"\n\
         [sections.p]\nkind = \"general\"\nA = {area}\n[sections.q]\nkind = \"general\"\nA = {area}\n\
         [[ribs]]\nname = \"rp\"\nstart = \"o\"\nend = \"a\"\nsection = \"p\"\n[[ribs]]\nname = \"rq\"\nstart = \"o\"\nend = \"b\"\nsection = \"q\"\n\
         [[constraints]]\nname = \"f\"\nrequire = \"frequency(1) >= 30\"\n",
        -s
    )
}

fn least_area() -> f64 {
    let square = (TAU * 30.0).powi(2);
    square * 450.0 / (7e10 - 2.0 * square * 2700.0 / 3.0)
}

#[test]
fn an_optimum_with_two_equal_frequencies_is_certified() {
    let found: Outcome = outcome(&read("cross", &cross("{ lower = 1e-6, start = 1e-3 }"))).unwrap();
    assert_eq!(found.status, Status::Certified, "{}", found.message);
    assert!(found.message.contains("Modes 1 and 2 of vibration coincide"), "{}", found.message);
    assert!((found.objective.unwrap() / (2.0 * least_area()) - 1.0).abs() < 1e-8, "{:?}", found.x);
    // K and M are affine in the areas: a linear program bounds every design from below.
    assert_eq!(found.scope, Extent::Global, "{}", found.message);
    assert!(found.lower_bound.unwrap() >= (1.0 - 1e-6) * found.objective.unwrap());
}

/// The same limit in other words has the same optimum, certified as well.
#[test]
fn limits_on_coinciding_frequencies_are_known_in_every_form() {
    let direct = cross("{ lower = 1e-6, start = 1e-3 }");
    for (form, definitions) in [
        ("f1 >= 30", "f1 = \"frequency(1)\""),
        ("1/frequency(1)^2 <= 1/900", ""),
        ("2 - f1/10 <= -1", "f1 = \"frequency(1)\""),
        ("-3*frequency(1) <= -90", ""),
        ("30 <= frequency(1) <= 40", ""),
        ("1e-3 <= 1/f1 <= 1/30", "f1 = \"frequency(1)\""),
    ] {
        let text = direct.replace("frequency(1) >= 30", form) + "[definitions]\n" + definitions;
        let found: Outcome = outcome(&read(form, &text)).unwrap();
        assert_eq!((found.status, found.scope), (Status::Certified, Extent::Global), "{form}: {}", found.message);
        assert!((found.objective.unwrap() / (2.0 * least_area()) - 1.0).abs() < 1e-8, "{form}: {:?}", found.x);
    }
}

/// Where both frequencies are held to one value, or their sum is maximised, each by itself has no derivative at the optimum: nothing is claimed.
#[test]
fn what_rests_on_a_single_one_of_coinciding_modes_is_not_certified() {
    let direct = cross("{ lower = 1e-6, start = 1e-3 }");
    let sum = direct.replace("minimize = \"p.A + q.A\"", "maximize = \"frequency(1) + frequency(2)\"");
    for (text, what) in [
        (direct.replace("frequency(1) >= 30", "frequency(1) == 30"), "held"),
        (sum.replace("frequency(1) >= 30", "p.A + q.A <= 2e-4"), "sum"),
    ] {
        let found: Outcome = outcome(&read(what, &text)).unwrap();
        assert_eq!(found.status, Status::Uncertified, "{what}: {}", found.message);
        assert!(!found.certificate.unwrap().certified, "{what}: one verdict");
    }
}

/// `verify` proves the point itself, neither one beside it that is heavier nor one that is too light.
#[test]
fn coinciding_frequencies_are_verified() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("modes");
    fs::create_dir_all(&folder).unwrap();
    let subject = read("cross", &cross("{ lower = 1e-6, start = 1e-3 }"));
    for (name, factors, status) in [
        ("itself", [1.0, 1.0], Status::Certified),
        ("heavier", [1.01, 1.01], Status::Uncertified),
        ("lopsided", [1.0, 1.01], Status::Uncertified),
        ("lighter", [0.999, 0.999], Status::Uncertified),
    ] {
        let answer = folder.join(format!("{name}.csv"));
        let [p, q] = factors.map(|factor| factor * least_area());
        fs::write(&answer, format!("name,value\np.A,{p:?}\nq.A,{q:?}\n")).unwrap();
        assert_eq!(verify(&subject, &answer).unwrap().outcome.status, status, "{name}");
    }
}

/// The heaviest allowed is given, and the lowest frequency is to be as high as can be: the dual of the problem above, with the same optimum.
#[test]
fn the_highest_of_coinciding_frequencies_is_certified() {
    let minimised = cross("{ lower = 1e-6, start = 1e-3 }");
    for (objective, value) in [
        ("maximize = \"frequency(1)\"", 30.0),
        ("minimize = \"100/f1^2\"\n[definitions]\nf1 = \"frequency(1)\"", 1.0 / 9.0),
        ("maximize = \"min(frequency(1), frequency(2)) - 3\"", 27.0),
    ] {
        let text = minimised.replace("minimize = \"p.A + q.A\"", objective);
        let limit = format!("require = \"p.A + q.A <= {:?}\"", 2.0 * least_area());
        let text = text.replace("require = \"frequency(1) >= 30\"", &limit);
        let found: Outcome = outcome(&read("highest", &text)).unwrap();
        assert_eq!(found.status, Status::Certified, "{objective}: {}", found.message);
        assert!(found.message.contains("Modes 1 and 2 of vibration coincide"), "{}", found.message);
        let sign = if objective.starts_with("maximize") { -1.0 } else { 1.0 };
        assert!((sign * found.objective.unwrap() / value - 1.0).abs() < 1e-8, "{objective}: {:?}", found.objective);
    }
}

/// A frequency that a variable asks for, which is paid for: 2·A(x) − c·x has its minimum at 30, where c = 2·A'(30).
#[test]
fn coinciding_frequencies_beside_a_variable_are_certified() {
    let (x, bar, mass): (f64, f64, f64) = (30.0, 7e10, 450.0);
    let square = (TAU * x).powi(2);
    let slope = mass * bar / (bar - 2.0 * square * 2700.0 / 3.0).powi(2) * 2.0 * TAU * TAU * x;
    let text = cross("{ lower = 1e-6, start = 1e-3 }")
        .replace(
            "p.A + q.A\"",
            &format!("p.A + q.A - {:?}*x\"\n[variables]\nx = {{ lower = 1, upper = 100, start = 20 }}", 2.0 * slope),
        )
        .replace("frequency(1) >= 30", "frequency(1) >= x");
    let found: Outcome = outcome(&read("beside", &text)).unwrap();
    assert_eq!(found.status, Status::Certified, "{}", found.message);
    assert!((found.x[0] / 30.0 - 1.0).abs() < 1e-6, "{:?}", found.x);
}

/// Keller's strongest column, pinned, of similar sections (EI = A²): the factor of the lightest with 8 equal pieces is that asked for, and its volume
/// lies above the continuous column's √3/2 and below the prismatic one's 1.
#[test]
fn the_strongest_pinned_column_is_found() {
    let mut text = "minimize = \"volume\"\n[structure]\nplane = \"xz\"\nbuckling_pieces = 1\n[materials]\ns = { E = 12, nu = 0.3 }\n[variables]\n".to_owned();
    (1..=4).for_each(|at| text += &format!("A{at} = {{ lower = 0.01, start = 1 }}\n"));
    text += "[nodes]\n";
    (0..=8).for_each(|at| text += &format!("n{at} = [0, {}]\n", f64::from(at) / 8.0));
    text += "[supports]\nn0 = \"pinned\"\nn8 = [\"x\"]\n";
    for at in 0..8 {
        let area = format!("A{}", at.min(7 - at) + 1);
        text += &format!(
            "[sections.s{at}]\nkind = \"general\"\nA = \"{area}\"\nIx = \"{area}^2/12\"\nIy = \"{area}^2/12\"\nJ = 0.1\n"
        );
        text += &format!("[[ribs]]\nname = \"m{at}\"\nstart = \"n{at}\"\nend = \"n{}\"\nsection = \"s{at}\"\n", at + 1);
    }
    text += &format!(
        "[[loads]]\ncase = \"P\"\nnodes = [\"n8\"]\nforce = [0, -1]\n[[constraints]]\nname = \"stable\"\nrequire = \"buckling(P) >= {:?}\"\n",
        PI * PI
    );
    let subject = read("strongest", &text);
    let found = outcome(&subject).unwrap();
    assert_eq!(found.status, Status::Certified, "{}", found.message);
    let volume = found.objective.unwrap();
    assert!(volume > 0.75_f64.sqrt() && volume < 0.91, "{volume}");
    let at_limit = found.certificate.unwrap().row_values[0];
    assert!((at_limit / (PI * PI) - 1.0).abs() < 1e-7, "{at_limit}");
}

#[test]
fn mistakes_say_what_is_missing() {
    for (expression, message) in [
        ("frequency()", "needs the number of a mode"),
        ("frequency(0)", "this is no number of a mode"),
        ("buckling(P, 1.5)", "this is no number of a mode"),
        ("buckling(Q)", "there is no case or combination `Q`"),
        ("buckling(P, 1, 2)", "this is no argument"),
    ] {
        let text = format!("{}\n[definitions]\nasked = \"{expression}\"\n", column(PINNED, 1.0, 4));
        let told = Subject::of_text("mistake", &text).err().unwrap_or_else(|| panic!("{expression} was taken")).to_string();
        assert!(told.contains(message), "{expression}: {told}");
    }
    let weightless = column(PINNED, 1.0, 4).replace(", density = 7.85", "") + "\n[definitions]\nasked = \"frequency(1)\"\n";
    let told = Subject::of_text("mistake", &weightless).err().unwrap().to_string();
    assert!(told.contains("`frequency` needs the density of `s`"), "{told}");
}
