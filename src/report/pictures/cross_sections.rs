//! Cross-sections with their dimensions: as they are, or before and after.

use super::canvas::{Canvas, Ink, cut, through};
use super::{AFTER, BEFORE, before_and_after};
use crate::problem::Problem;
use crate::report::About;
use crate::report::cross_section::CrossSection;
use crate::report::number::significant;
use crate::sections;

/// Sections drawn at the most.
const MOST: u32 = 24;
const WIDTH: f64 = 860.0;
/// Room for heading and legend.
const TOP: f64 = 60.0;
/// Room within a cell for dimension lines and the words below.
const ROOM: f64 = 44.0;
const WORDS: f64 = 44.0;

/// A section smaller than this share of the largest is drawn at a scale of its own.
const TOO_SMALL: f64 = 0.12;

type Rings = Vec<Vec<[f64; 2]>>;

/// One cell of the picture: a section's name, its dimensions, its outlines before and after.
struct Cell {
    name: String,
    dimensions: Vec<String>,
    before: Rings,
    after: Rings,
}

/// Low and high corner of an outline.
type Bounds = [[f64; 2]; 2];

impl Cell {
    fn of(section: &CrossSection, before: Rings) -> Cell {
        let dimension = |(name, value): &(&str, f64)| format!("{name} {}", significant(*value, 4));
        let after = centred(section.rings());
        let mut dimensions: Vec<String> = section.dimensions.iter().map(dimension).collect();
        if !sections::kind(section.kind).is_some_and(|kind| kind.has_rings()) {
            dimensions.push(format!("kind {}: no outline", section.kind));
        }
        Cell { name: section.name.clone(), dimensions, before: centred(before), after }
    }

    /// Half the larger extent of either outline.
    fn reach(&self) -> f64 {
        let all = self.before.iter().chain(&self.after).flatten().flatten();
        all.fold(0.0, |reach: f64, one| reach.max(one.abs()))
    }
}

/// The outline about the middle of its extents, so that before and after lie over one another.
fn centred(rings: Rings) -> Rings {
    let Some([low, high]) = bounds(&rings) else { return rings };
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let moved = |ring: Vec<[f64; 2]>| ring.into_iter().map(|[x, y]| [x - middle[0], y - middle[1]]).collect();
    rings.into_iter().map(moved).collect()
}

fn bounds(rings: &Rings) -> Option<Bounds> {
    let points = || rings.iter().flatten();
    let extreme = |k: usize, join: fn(f64, f64) -> f64| points().map(|point| point[k]).reduce(join);
    Some([[extreme(0, f64::min)?, extreme(1, f64::min)?], [extreme(0, f64::max)?, extreme(1, f64::max)?]])
}

/// One section or several, as they are; `at_start`: those of a file at its starts.
pub fn cross_section(sections: &[CrossSection], at_start: bool) -> String {
    let cells: Vec<Cell> = sections.iter().take(MOST as usize).map(|section| Cell::of(section, Vec::new())).collect();
    let what = if at_start { "Cross-sections at the start, not at an answer" } else { "Cross-sections" };
    let title = if let [one] = sections { one.name.clone() } else { String::from("Sections") };
    drawn(&title, &heading(what, sections.len()), cells, false, "")
}

/// The first sections of a problem at the start and at the answer.
pub fn cross_sections(problem: &Problem, about: &About, start: &[f64], answer: &[f64]) -> String {
    let count = problem.sections.names.len();
    let cell = |s: u32| {
        let before = CrossSection::of(problem, s, start).map_or_else(Vec::new, |section| section.rings());
        Some(Cell::of(&CrossSection::of(problem, s, answer)?, before))
    };
    let cells: Vec<Cell> = (0..count.min(MOST as usize) as u32).filter_map(cell).collect();
    drawn(&about.title, &heading("Cross-sections", count), cells, true, about.unit("length").unwrap_or_default())
}

fn heading(what: &str, count: usize) -> String {
    if count > MOST as usize { format!("{what}: the first {MOST} of {count}") } else { what.to_owned() }
}

fn drawn(title: &str, heading: &str, cells: Vec<Cell>, legend: bool, unit: &str) -> String {
    let columns = ((cells.len() as f64).sqrt().ceil() as usize).clamp(1, 4);
    let rows = cells.len().div_ceil(columns).max(1);
    let size = (WIDTH / columns as f64).min(420.0);
    let heading = if unit.is_empty() { heading.to_owned() } else { format!("{heading}; dimensions in {unit}") };
    let mut canvas = Canvas::new(WIDTH, TOP + (size + WORDS) * rows as f64, title, &heading);
    if legend {
        before_and_after(&mut canvas);
    }
    let largest = cells.iter().map(Cell::reach).fold(0.0, f64::max);
    for (at, cell) in cells.iter().enumerate() {
        let row = at / columns;
        let in_row = (cells.len() - row * columns).min(columns);
        let left = 0.5 * (WIDTH - size * in_row as f64) + size * (at % columns) as f64;
        draw_cell(&mut canvas, cell, [left, TOP + (size + WORDS) * row as f64], size, largest);
    }
    canvas.finish()
}

fn draw_cell(canvas: &mut Canvas, cell: &Cell, [left, top]: [f64; 2], size: f64, largest: f64) {
    let own = cell.reach();
    let enlarged = own > 0.0 && own < TOO_SMALL * largest;
    let reach = if enlarged { own } else { largest };
    let scale = if reach > 0.0 { (size / 2.0 - ROOM) / reach } else { 1.0 };
    let middle = [left + size / 2.0, top + size / 2.0];
    let on_sheet = |[x, y]: [f64; 2]| [middle[0] + scale * x, middle[1] - scale * y];
    for (rings, style) in [(&cell.before, BEFORE), (&cell.after, AFTER)] {
        let data: String = rings.iter().map(|ring| through(ring.iter().map(|point| on_sheet(*point)), true)).collect();
        if !data.is_empty() {
            canvas.path(&data, style);
        }
    }
    if let Some([low, high]) = bounds(&cell.after) {
        let [x0, y0] = on_sheet([low[0], high[1]]);
        let [x1, y1] = on_sheet([high[0], low[1]]);
        // Clear of the start's outline, too.
        let [least, _] = bounds(&cell.before).unwrap_or([low, high]);
        let [left, foot] = on_sheet([least[0].min(low[0]), least[1].min(low[1])]);
        width_line(canvas, [x0, x1], foot + 14.0, high[0] - low[0]);
        height_line(canvas, left - 14.0, [y0, y1], high[1] - low[1]);
    }
    let name =
        if enlarged { format!("{} (enlarged {}-fold)", cell.name, significant(largest / own, 2)) } else { cell.name.clone() };
    let letters = size / 6.6;
    canvas.text(middle[0], top + size + 8.0, "middle", &cut(&name, letters));
    canvas.note(middle[0], top + size + 24.0, "middle", &cut(&cell.dimensions.join(", "), letters));
}

fn width_line(canvas: &mut Canvas, [x0, x1]: [f64; 2], y: f64, value: f64) {
    canvas.line([x0, y, x1, y], Ink::Middle);
    for x in [x0, x1] {
        canvas.line([x - 3.0, y + 3.0, x + 3.0, y - 3.0], Ink::Middle);
    }
    canvas.note(0.5 * (x0 + x1), y + 14.0, "middle", &significant(value, 4));
}

fn height_line(canvas: &mut Canvas, x: f64, [y0, y1]: [f64; 2], value: f64) {
    canvas.line([x, y0, x, y1], Ink::Middle);
    for y in [y0, y1] {
        canvas.line([x - 3.0, y + 3.0, x + 3.0, y - 3.0], Ink::Middle);
    }
    canvas.upright_note(x - 6.0, 0.5 * (y0 + y1), &significant(value, 4));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sections::kind;

    fn tube(name: &str, d: f64, t: f64) -> CrossSection {
        CrossSection::new(name, &kind("tube").unwrap().forms()[0], &[d, t], &[]).unwrap()
    }

    #[test]
    fn holes_are_rings_of_one_path_and_dimensions_are_told() {
        let svg = cross_section(&[tube("pipe", 0.2, 0.01)], false);
        assert!(svg.contains("d 0.2, t 0.01") && svg.contains("ZM") && !svg.contains("NaN"), "{svg}");
        assert!(cross_section(&[tube("pipe", 0.2, 0.01)], true).contains("at the start, not at an answer"));
    }

    #[test]
    fn a_section_that_cannot_be_is_left_blank() {
        let tube = tube("pipe", 0.2, 0.11);
        assert!(tube.defect.is_some());
        assert!(!cross_section(&[tube], false).contains("NaN"));
    }

    #[test]
    fn a_small_section_beside_a_large_one_is_enlarged_and_says_so() {
        let svg = cross_section(&[tube("wire", 1.0, 0.1), tube("pipe", 100.0, 1.0)], false);
        assert!(svg.contains("wire (enlarged 100-fold)"), "{svg}");
    }
}
