//! Lines of ribs from the side and from above, before and after: height and width along the ribs.

use super::axes::{Panel, Scale};
use super::canvas::{Canvas, cut, through};
use super::chains::{Chain, chains};
use super::{AFTER, BEFORE, before_and_after, with_unit};
use crate::problem::Problem;
use crate::report::About;
use crate::report::cross_section::CrossSection;
use crate::report::number::significant;

/// Lines drawn at the most, and ribs of each.
const MOST_CHAINS: usize = 12;
const MOST_RIBS: usize = 400;

/// Pixels one line takes: two panels side by side.
const BLOCK: f64 = 200.0;
const WIDTH: f64 = 860.0;

/// Height and width along every line of ribs; the heading says how many there are where not all are drawn. `None` without ribs.
pub fn elevation(problem: &Problem, about: &About, start: &[f64], answer: &[f64]) -> Option<String> {
    let all = chains(problem);
    if all.is_empty() {
        return None;
    }
    let drawn = all.len().min(MOST_CHAINS);
    let which = match all.len() {
        1 => "Along the ribs".into(),
        number if number > drawn => format!("Along the ribs: the first {drawn} of {number} lines"),
        number => format!("Along the ribs: {number} lines"),
    };
    let mut canvas = Canvas::new(WIDTH, 60.0 + BLOCK * drawn as f64, &about.title, &which);
    before_and_after(&mut canvas);
    for (at, chain) in all.iter().take(drawn).enumerate() {
        line(&mut canvas, problem, about, chain, 60.0 + BLOCK * at as f64, [start, answer]);
    }
    Some(canvas.finish())
}

fn line(canvas: &mut Canvas, problem: &Problem, about: &About, chain: &Chain, top: f64, points: [&[f64]; 2]) {
    let shown = Chain { ribs: chain.ribs.iter().copied().take(MOST_RIBS).collect(), ..chain.clone() };
    let stations = shown.stations(problem);
    let length = stations.last().map_or(0.0, |&(at, _)| at);
    let ribs = match chain.ribs.len() {
        number if number > MOST_RIBS => format!(", the first {MOST_RIBS} of {number} ribs"),
        1 => ", 1 rib".into(),
        number => format!(", {number} ribs"),
    };
    canvas.text(80.0, top + 14.0, "start", &cut(&format!("{}{ribs}", chain.name), 60.0));
    for (at, (property, what)) in [("height", "height"), ("width", "width")].into_iter().enumerate() {
        let [before, after] = points.map(|x| extents(problem, &stations, x, property));
        let reach = before.iter().chain(&after).map(|[_, extent]| extent / 2.0).filter(|reach| reach.is_finite());
        let reach = reach.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let (x, y) = (Scale::between(0.0, length), Scale::linear([-reach, reach].into_iter()));
        let left = 80.0 + 425.0 * at as f64;
        let panel = Panel { left, top: top + 24.0, width: 330.0, height: 118.0, x, y };
        let times = panel.exaggeration();
        if !(0.95..1.05).contains(&times) {
            let note = format!("{what} drawn {}-fold", significant(times, 2));
            canvas.note(left + 330.0, top + 18.0, "end", &note);
        }
        panel.draw_extent(canvas, &with_unit("along the line", about), &with_unit(what, about));
        for (extents, style) in [(before, BEFORE), (after, AFTER)] {
            let edge = |sign: f64| extents.iter().map(move |[at, extent]| [*at, sign * extent / 2.0]);
            let around = edge(1.0).chain(edge(-1.0).rev()).map(|point| panel.at(point));
            canvas.path(&through(around, true), style);
        }
    }
}

fn extents(problem: &Problem, stations: &[(f64, u32)], x: &[f64], property: &str) -> Vec<[f64; 2]> {
    let extent = |s: u32| CrossSection::of(problem, s, x).and_then(|section| section.value(property)).unwrap_or(f64::NAN);
    stations.iter().map(|&(at, s)| [at, extent(s)]).collect()
}
