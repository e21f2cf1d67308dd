//! The objective over two varied names, cell by cell.

use super::Answer;
use crate::report::number::significant;
use crate::report::pictures::axes::range;
use crate::report::pictures::canvas::{Canvas, Ink, Style};

/// Answers over two names.
#[derive(Debug, Clone, Default)]
pub struct HeatMap {
    /// Of the columns and the rows.
    pub names: [String; 2],
    /// Values of the columns and the rows.
    pub values: [Vec<f64>; 2],
    /// Row by row.
    pub cells: Vec<Vec<Answer>>,
}

const LEFT: f64 = 110.0;
const TOP: f64 = 60.0;
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 400.0;
/// How much of its colour the least and the greatest value have.
const TINTS: [f64; 2] = [0.08, 0.95];
/// Labels along an axis at the most.
const LABELS: usize = 8;
/// Pixels between the lines of a hatching.
const HATCH: f64 = 7.0;

/// Cells tinted by the objective; hatched where there is no design, empty where nothing is known, with a dot where nothing is proved.
pub fn heat_map(title: &str, objective: &str, map: &HeatMap) -> String {
    let shown = format!("{objective}; hatched: no design meets the limits; a dot: not proved");
    let mut canvas = Canvas::new(820.0, 530.0, title, &shown);
    let known = || map.cells.iter().flatten().filter_map(|answer| answer.value());
    let (low, high) = range(known()).unwrap_or((f64::NAN, f64::NAN));
    let tint = |value: f64| {
        let share = if high > low { (value - low) / (high - low) } else { 0.5 };
        TINTS[0] + share * (TINTS[1] - TINTS[0])
    };
    let (columns, rows) = (map.values[0].len().max(1), map.values[1].len().max(1));
    let (wide, high_) = (WIDTH / columns as f64, HEIGHT / rows as f64);
    for (row, cells) in map.cells.iter().enumerate() {
        for (column, answer) in cells.iter().enumerate() {
            let [x, y] = [LEFT + wide * column as f64, TOP + HEIGHT - high_ * (row + 1) as f64];
            match answer {
                Answer::Certified(value) | Answer::Open(value) => {
                    let data = format!("M{x:.2} {y:.2}h{wide:.2}v{high_:.2}h-{wide:.2}Z");
                    let colour = [Ink::Curve(0).colours()[0], "k0 a"];
                    canvas.shape(&data, colour, (1e3 * tint(*value)).round() / 1e3, &significant(*value, 6));
                    if matches!(answer, Answer::Open(_)) {
                        canvas.dot([x + wide / 2.0, y + high_ / 2.0], 2.0, Ink::Strong, true);
                    }
                }
                Answer::None => canvas.path(&hatched([x, y], [wide, high_]), Style::line(Ink::Middle, 0.8)),
                Answer::Unknown => {}
            }
        }
    }
    frame(&mut canvas, map, [wide, high_]);
    for (at, value) in [low, (low + high) / 2.0, high].into_iter().enumerate().filter(|(_, value)| value.is_finite()) {
        let y = TOP + 20.0 + 22.0 * at as f64;
        canvas.shape(
            &format!("M{} {}h16v14h-16Z", LEFT + WIDTH + 24.0, y - 11.0),
            [Ink::Curve(0).colours()[0], "k0 a"],
            tint(value),
            "",
        );
        canvas.note(LEFT + WIDTH + 48.0, y, "start", &significant(value, 4));
    }
    canvas.finish()
}

/// Lines at 45 degrees within a rectangle.
fn hatched([x, y]: [f64; 2], [wide, high]: [f64; 2]) -> String {
    let mut data = String::new();
    // The line through (x + along, y + high) upwards to the right, cut at the sides.
    let mut along = HATCH / 2.0 - high;
    while along < wide {
        let (from, to) = (along.max(0.0), (along + high).min(wide));
        if to > from {
            let at = |right: f64| (x + right, y + high - (right - along));
            let ((x1, y1), (x2, y2)) = (at(from), at(to));
            data += &format!("M{x1:.2} {y1:.2}L{x2:.2} {y2:.2}");
        }
        along += HATCH;
    }
    data
}

fn frame(canvas: &mut Canvas, map: &HeatMap, [wide, high]: [f64; 2]) {
    canvas.path(&format!("M{LEFT} {TOP}h{WIDTH}v{HEIGHT}h-{WIDTH}Z"), Style::line(Ink::Middle, 1.0));
    let step = |count: usize| count.div_ceil(LABELS).max(1);
    for (at, value) in map.values[0].iter().enumerate().step_by(step(map.values[0].len())) {
        canvas.note(LEFT + wide * (at as f64 + 0.5), TOP + HEIGHT + 16.0, "middle", &significant(*value, 3));
    }
    for (at, value) in map.values[1].iter().enumerate().step_by(step(map.values[1].len())) {
        canvas.note(LEFT - 8.0, TOP + HEIGHT - high * (at as f64 + 0.5) + 4.0, "end", &significant(*value, 3));
    }
    canvas.text(LEFT + WIDTH / 2.0, TOP + HEIGHT + 36.0, "middle", &map.names[0]);
    canvas.upright(LEFT - 70.0, TOP + HEIGHT / 2.0, &map.names[1]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hatching_stays_in_its_cell() {
        let data = hatched([10.0, 20.0], [30.0, 12.0]);
        let numbers: Vec<f64> = data.split(['M', 'L', ' ']).filter_map(|text| text.parse().ok()).collect();
        assert!(numbers.len() >= 8);
        for point in numbers.chunks(2) {
            assert!((10.0..=40.0).contains(&point[0]) && (20.0..=32.0).contains(&point[1]), "{point:?}");
        }
    }
}
