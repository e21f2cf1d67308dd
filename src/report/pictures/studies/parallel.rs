//! Parallel coordinates: every point a line over the varied names and the objective.

use super::Answer;
use crate::report::number::significant;
use crate::report::pictures::axes::{Scale, range};
use crate::report::pictures::canvas::{Canvas, Ink, Style, cut, through};

const TOP: f64 = 70.0;
const HEIGHT: f64 = 340.0;
const LEFT: f64 = 60.0;
/// Lines at the most: more are a carpet.
const MOST: usize = 2000;
/// Groups by the objective, the best first.
const INKS: [Ink; 3] = [Ink::Curve(0), Ink::Curve(4), Ink::Curve(1)];

/// One line per point; the last axis is the objective. Blue: the best third; points without a design are grey and end before it.
pub fn parallel(title: &str, names: &[&str], points: &[(Vec<f64>, Answer)], is_maximum: bool) -> String {
    let step = (760.0 / names.len().saturating_sub(1).max(1) as f64).min(200.0);
    let width = (2.0 * LEFT + step * names.len().saturating_sub(1) as f64).max(420.0);
    let mut canvas = Canvas::new(width, 470.0, title, "By thirds of the objective: blue the best; grey: no design");
    let column = |at: usize| points.iter().filter_map(move |(values, _)| values.get(at).copied());
    let last = names.len() - 1;
    let objectives = || points.iter().filter_map(|(_, answer)| answer.value());
    let scales: Vec<Scale> =
        (0..names.len()).map(|at| if at == last { Scale::linear(objectives()) } else { Scale::linear(column(at)) }).collect();
    let mut sorted: Vec<f64> = objectives().collect();
    sorted.sort_by(f64::total_cmp);
    let third = |value: f64| {
        let rank = sorted.partition_point(|other| *other < value) * 3 / sorted.len().max(1);
        if is_maximum { 2 - rank.min(2) } else { rank.min(2) }
    };
    let place = |at: usize, value: f64| [LEFT + step * at as f64, TOP + HEIGHT * (1.0 - scales[at].share(value))];
    for (values, answer) in points.iter().take(MOST) {
        let own = values.iter().enumerate().map(|(at, &value)| place(at, value));
        let line = through(own.chain(answer.value().map(|value| place(last, value))), false);
        let ink = answer.value().map_or(Ink::Middle, |value| INKS[third(value)]);
        canvas.path(&line, Style::line(ink, if answer.value().is_some() { 1.0 } else { 0.6 }));
    }
    for (at, name) in names.iter().enumerate() {
        let x = LEFT + step * at as f64;
        canvas.line([x, TOP, x, TOP + HEIGHT], Ink::Strong);
        let values: Vec<f64> = if at == last { objectives().collect() } else { column(at).collect() };
        if let Some((low, high)) = range(values.into_iter()) {
            canvas.note(x, place(at, high)[1] - 6.0, "middle", &significant(high, 3));
            canvas.note(x, place(at, low)[1] + 14.0, "middle", &significant(low, 3));
        }
        canvas.text(x, TOP + HEIGHT + 34.0, "middle", &cut(name, step / 7.0));
    }
    if points.len() > MOST {
        canvas.note(LEFT, 462.0, "start", &format!("the first {MOST} of {} points", points.len()));
    }
    canvas.finish()
}
