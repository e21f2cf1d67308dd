//! Cuts, turns and reversals that must not change anything.

use super::*;

/// A rotation with nothing special about it: three turns about three axes.
fn turned([x, y, z]: [f64; 3]) -> [f64; 3] {
    let (a, b, c) = (0.4_f64, -0.7_f64, 1.1_f64);
    let [x, y] = [x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos()];
    let [y, z] = [y * b.cos() - z * b.sin(), y * b.sin() + z * b.cos()];
    let [x, z] = [x * c.cos() + z * c.sin(), -x * c.sin() + z * c.cos()];
    [x, y, z]
}

/// A frame in space with taper, loads on spans, temperature and self-weight; `cut` splits a rib, `turn` turns everything, `back` reverses it.
fn frame(cut: Option<f64>, turn: bool, back: bool) -> String {
    let list = |v: [f64; 3]| format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2]);
    let place = |v: [f64; 3]| list(if turn { turned(v) } else { v });
    let up = place([0.0, 0.0, 1.0]);
    let side = place([1.0, 0.0, 0.0]);
    let mut text = format!("minimize = \"volume\"\n[structure]\ngravity = {}\n{MATERIAL}", place([0.0, 0.0, -1.0]));
    text += &format!(
        "[nodes]\nfoot = {}\ncorner = {}\nend = {}\nfar = {}\n",
        place([0.0, 0.0, 0.0]),
        place([0.0, 0.0, 3.0]),
        place([4.0, 1.0, 3.5]),
        place([4.0, 5.0, 3.5])
    );
    if let Some(at) = cut {
        text += &format!("middle = {}\n", place([4.0 * at, at, 3.0 + 0.5 * at]));
    }
    text += "[supports]\nfoot = \"fixed\"\nfar = \"pinned\"\n";
    let between = |at: f64| (0.2 - 0.08 * at, 0.5 - 0.25 * at);
    for (name, (b, h)) in [("thick", between(0.0)), ("thin", between(1.0)), ("cut", between(cut.unwrap_or(0.5)))] {
        text +=
            &format!("[sections.{name}]\nkind = \"rectangle\"\nb = {b:?}\nh = {{ lower = 0.05, upper = 0.9, start = {h:?} }}\n");
    }
    let mut rib = |name: &str, start: &str, end: &str, from: &str, to: &str, up: &str| {
        text += &format!(
            "[[ribs]]\nname = \"{name}\"\nstart = \"{start}\"\nend = \"{end}\"\nfrom = \"{from}\"\nto = \"{to}\"\nup = {up}\n"
        );
    };
    rib("column", "foot", "corner", "thick", "thick", &side);
    match (cut, back) {
        (Some(_), _) => {
            rib("beam", "corner", "middle", "thick", "cut", &up);
            rib("beam2", "middle", "end", "cut", "thin", &up);
        }
        (None, false) => rib("beam", "corner", "end", "thick", "thin", &up),
        (None, true) => rib("beam", "end", "corner", "thin", "thick", &up),
    }
    rib("tie", "end", "far", "thin", "thin", &up);
    let beams = if cut.is_some() { "[\"beam\", \"beam2\"]" } else { "[\"beam\"]" };
    text += &format!("[[loads]]\ncase = \"q\"\nribs = {beams}\nforce = {}\n", place([1.0, 2.0, -9.0]));
    text += "[[loads]]\ncase = \"q\"\nself_weight = true\n";
    text += &format!("[[loads]]\ncase = \"q\"\nribs = {beams}\ntemperature = 25\n");
    text += &format!("[[loads]]\ncase = \"q\"\nnodes = [\"end\"]\nforce = {}\n", place([3.0, -4.0, 5.0]));
    let half = if cut.is_some() { "force(q, beam2, N, 1)" } else { "force(q, beam, N, 1)" };
    let half = if back { "force(q, beam, N, 0)" } else { half };
    let start = if back { 1 } else { 0 };
    text += &format!(
        "[definitions]\nwork = \"compliance(q)\"\ncolumn_my = \"force(q, column, My, 1)\"\ncolumn_t = \"force(q, column, T, 0.3)\"\nbeam_my = \"force(q, beam, My, {start})\"
beam_mz = \"force(q, beam, Mz, {start})\"\nbeam_n = \"{half}\"\ncorner_stress = \"stress(q, tie, 0.5, top-right)\"
"
    );
    text
}

fn values(name: &str, text: &str) -> Vec<(String, f64)> {
    analysed(name, text).definitions
}

#[test]
fn a_cut_changes_nothing() {
    let whole = values("whole", &frame(None, false, false));
    for at in [0.3, 0.5, 0.81] {
        for ((name, one), (_, other)) in whole.iter().zip(values("cut", &frame(Some(at), false, false))) {
            // Compliance counts the work of the equivalent end forces, which depend on where ribs end.
            if name != "work" {
                assert!((one - other).abs() < 1e-9 * one.abs().max(1.0), "{name}, cut at {at}: {one} and {other}");
            }
        }
    }
}

#[test]
fn a_turn_in_space_changes_nothing() {
    let turned = values("turned", &frame(None, true, false));
    for ((name, one), (_, other)) in values("straight", &frame(None, false, false)).iter().zip(turned) {
        assert!((one - other).abs() < 1e-10 * one.abs().max(1.0), "{name}: {one} and {other}");
    }
}

/// A reversed member keeps N, T and My, and turns Mz.
#[test]
fn a_reversed_member_carries_the_same() {
    let back = values("back", &frame(None, false, true));
    for ((name, one), (_, other)) in values("forth", &frame(None, false, false)).iter().zip(back) {
        let other = if name == "beam_mz" { -other } else { other };
        assert!((one - other).abs() < 1e-9 * one.abs().max(1.0), "{name}: {one} and {other}");
    }
}

#[test]
fn reactions_carry_the_loads() {
    let analysis = analysed("balance", &frame(None, false, false));
    let sum = |axis: usize| -> f64 {
        analysis.cases[0].reactions.iter().filter(|(_, direction, _)| *direction == axis).map(|(_, _, value)| value).sum()
    };
    let length = (16.0_f64 + 1.0 + 0.25).sqrt();
    let volume = 3.0 * 0.2 * 0.5 + 4.0 * 0.12 * 0.25 + length * (0.2 * 0.5 + 0.12 * 0.25 + 4.0 * 0.16 * 0.375) / 6.0;
    assert_near(sum(0), -(length + 3.0), "x");
    assert_near(sum(1), -(2.0 * length - 4.0), "y");
    assert_near(sum(2), 9.0 * length - 5.0 + 77.0 * volume, "z");
}
