//! What moves the objective most, each name varied alone.

use crate::report::number::significant;
use crate::report::pictures::axes::{Panel, Scale};
use crate::report::pictures::canvas::{Canvas, Ink, cut};

/// One name's swing.
#[derive(Debug, Clone, Default)]
pub struct Swing {
    /// The varied name.
    pub name: String,
    /// Values and objectives where the objective is least and greatest.
    pub ends: [(f64, f64); 2],
}

const BAR: f64 = 26.0;
const LEFT: f64 = 230.0;

/// Bars around the base point's objective, the widest on top.
pub fn tornado(title: &str, objective: &str, base: f64, swings: &[Swing]) -> String {
    let mut swings: Vec<&Swing> = swings.iter().collect();
    let width = |swing: &Swing| swing.ends[1].1 - swing.ends[0].1;
    swings.sort_by(|a, b| width(b).total_cmp(&width(a)));
    let height = BAR * swings.len() as f64;
    let mut canvas =
        Canvas::new(820.0, height + 130.0, title, "Each name alone, the others as in the file; values beside the bars");
    let ends = swings.iter().flat_map(|swing| swing.ends.iter().map(|end| end.1)).chain([base]);
    let panel = Panel { left: LEFT, top: 60.0, width: 500.0, height, x: Scale::linear(ends), y: Scale::between(0.0, 1.0) };
    panel.draw_along(&mut canvas, objective);
    let at = |value: f64| panel.left + panel.width * panel.x.share(value);
    for (row, swing) in swings.iter().enumerate() {
        let top = panel.top + BAR * row as f64 + 4.0;
        for (number, &(value, reached)) in swing.ends.iter().enumerate() {
            let ([from, to], ink) = ([at(base), at(reached)], Ink::Curve(number));
            let data = format!("M{from:.2} {top}H{to:.2}V{}H{from:.2}Z", top + BAR - 8.0);
            canvas.shape(&data, [ink.colours()[0], &format!("{} a", ink.class())], 0.8, &format!("{}: {reached}", swing.name));
            let (anchor, gap) = if to < from { ("end", -5.0) } else { ("start", 5.0) };
            if to != from {
                canvas.note(to + gap, top + BAR / 2.0, anchor, &significant(value, 3));
            }
        }
        canvas.text(LEFT - 40.0, top + BAR / 2.0, "end", &cut(&swing.name, 24.0));
    }
    canvas.line([at(base), panel.top, at(base), panel.top + height], Ink::Strong);
    canvas.finish()
}
