//! The ribs in space, isometric: height of section as width of line, and as colour how far the ribs are used; where all are used
//! alike, as where every line governs, which limit governs each; where that is one and the same, the area of their sections.

mod ink;
mod view;

use super::canvas::{Canvas, cut};
use crate::mesh::Vector;
use crate::mesh::solids::SizedRib;
use crate::report::About;
use crate::report::number::{significant, with_unit_power};
use ink::{Coloured, STEPS, Tint};
use view::View;

/// How far a rib is used, and by which constraint.
#[derive(Debug, Clone, Default)]
pub struct Load {
    /// 1 being fully; `None` where no limit speaks of it.
    pub share: Option<f64>,
    /// The constraint's name.
    pub limit: String,
}

/// Width of the sheet.
const WIDTH: f64 = 1000.0;
/// Heading above, legend below.
const TOP: f64 = 60.0;
const LEGEND: f64 = 70.0;
const MARGIN: f64 = 30.0;
/// Width of the tallest section at most, and at most this part of the mean rib, so that a dense network stays legible.
const WIDEST: f64 = 9.0;
const WIDEST_PART: f64 = 0.3;
/// Ribs whose outer side is turned away are drawn this strong.
const PALE: f64 = 0.3;

/// One rib as drawn.
struct Stroke<'a> {
    rib: &'a SizedRib,
    heights: [f64; 2],
    load: &'a Load,
}

/// Draws ribs seen from (1, 1, 1), far ones first. Widths are in one scale throughout, given in the legend.
pub fn network(ribs: &[SizedRib], loads: &[Load], about: &About) -> String {
    let strokes: Vec<Stroke<'_>> =
        ribs.iter().zip(loads).map(|(rib, load)| Stroke { rib, heights: [height(rib, 0), height(rib, 1)], load }).collect();
    let view = View::of(ribs, [MARGIN, TOP + 10.0], WIDTH - 2.0 * MARGIN);
    let tallest = strokes.iter().flat_map(|stroke| stroke.heights).filter(|h| h.is_finite()).fold(0.0, f64::max);
    let widest = WIDEST.min(WIDEST_PART * view.mean_length(ribs));
    let thickness = if tallest > 0.0 { widest / tallest } else { 1.0 };
    let coloured = Coloured::of(ribs, loads);

    let mut canvas = Canvas::new(WIDTH, TOP + view.height + 2.0 * MARGIN + LEGEND, &about.title, &shown(ribs, &coloured));
    canvas.styles(&ink::styles());
    let mut order: Vec<&Stroke<'_>> = strokes.iter().collect();
    order.sort_by(|a, b| view::nearness(a.rib).total_cmp(&view::nearness(b.rib)));
    for stroke in order {
        draw(&mut canvas, &view, stroke, thickness, coloured.tint(stroke.rib, stroke.load), about);
    }
    legend(&mut canvas, TOP + view.height + 2.0 * MARGIN, [tallest, thickness], &coloured, about);
    canvas.finish()
}

fn shown(ribs: &[SizedRib], coloured: &Coloured) -> String {
    let paler = if ribs.iter().any(turned_away) { "; paler: seen from the inner side" } else { "" };
    let count = match ribs.len() {
        1 => "1 rib".into(),
        number => format!("{number} ribs"),
    };
    format!("{count}, coloured by {}{paler}", coloured.what())
}

/// Height of a rib's section at an end.
fn height(rib: &SizedRib, end: usize) -> f64 {
    let heights = || rib.rings[end].iter().flatten().map(|point| point[1]);
    heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
}

fn turned_away(rib: &SizedRib) -> bool {
    rib.geometry.frame.z.dot(&Vector::new(1.0, 1.0, 1.0)) < -1e-3
}

/// A rib as a quadrilateral, so that tapers show.
fn draw(canvas: &mut Canvas, view: &View, stroke: &Stroke<'_>, thickness: f64, tint: Tint, about: &About) {
    let [p, q] = stroke.rib.geometry.ends.map(|end| view.place(end));
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let length = dx.hypot(dy).max(1e-9);
    let half = stroke.heights.map(|h| if h.is_finite() { (h * thickness / 2.0).max(0.3) } else { 0.3 });
    let corner = |at: [f64; 2], by: f64| format!("{:.1} {:.1}", at[0] - dy / length * by, at[1] + dx / length * by);
    let data = format!("M{}L{}L{}L{}Z", corner(p, half[0]), corner(q, half[1]), corner(q, -half[1]), corner(p, -half[0]));
    let opacity = if turned_away(stroke.rib) { PALE } else { 1.0 };
    let [light, class] = [tint.colour(), tint.class()];
    canvas.shape(&data, [&light, &class], opacity, &label(stroke, about));
}

/// What a viewer shows under the pointer.
fn label(stroke: &Stroke<'_>, about: &About) -> String {
    let number = |value: f64, power: u32| with_unit_power(value, about.unit("length"), power);
    let heights = stroke.heights.map(|value| number(value, 1)).join(" and ");
    let mut label = format!("{}: heights {heights}, area {}", stroke.rib.geometry.name, number(stroke.rib.mean_area(), 2));
    if let Some(share) = stroke.load.share {
        label.push_str(&format!(", used {} % by {}", significant(100.0 * share, 3), stroke.load.limit));
    }
    label
}

/// The scale of widths, then that of colours.
fn legend(canvas: &mut Canvas, top: f64, [tallest, thickness]: [f64; 2], coloured: &Coloured, about: &About) {
    let middle = top + 20.0;
    let half = (tallest * thickness / 2.0).max(0.3);
    let bar = format!("M{MARGIN} {:.1}h30v{:.1}h-30Z", middle - half, 2.0 * half);
    canvas.shape(&bar, [&Tint::Unknown.colour(), &Tint::Unknown.class()], 1.0, "");
    let text = format!("height {}", with_unit_power(tallest, about.unit("length"), 1));
    canvas.text(MARGIN + 38.0, middle + 4.0, "start", &text);
    let left = MARGIN + 190.0;
    match coloured {
        Coloured::Limits(names) => {
            let room = (WIDTH - left - MARGIN) / names.len().min(4) as f64;
            for (at, name) in names.iter().enumerate() {
                let (x, y) = (left + room * (at % 4) as f64, middle + 18.0 * (at / 4) as f64);
                patch(canvas, [x, y], 14.0, Tint::Kind(at));
                canvas.text(x + 20.0, y + 4.0, "start", &cut(name, (room - 28.0) / 7.0));
            }
        }
        Coloured::Share | Coloured::Area(_) => {
            for k in 0..STEPS {
                patch(canvas, [left + 8.0 * k as f64, middle], 8.4, Tint::Step(k));
            }
            canvas.text(left + 8.0 * STEPS as f64 + 8.0, middle + 4.0, "start", &coloured.scale(about));
            if matches!(coloured, Coloured::Share) {
                patch(canvas, [left + 400.0, middle], 14.0, Tint::Over);
                canvas.text(left + 420.0, middle + 4.0, "start", "above 100 %");
                patch(canvas, [left + 520.0, middle], 14.0, Tint::Unknown);
                canvas.text(left + 540.0, middle + 4.0, "start", "no limit");
            }
        }
    }
}

fn patch(canvas: &mut Canvas, [x, y]: [f64; 2], width: f64, tint: Tint) {
    let data = format!("M{x:.1} {:.1}h{width:.1}v12h-{width:.1}Z", y - 6.0);
    canvas.shape(&data, [&tint.colour(), &tint.class()], 1.0, "");
}

#[cfg(test)]
mod tests;
