//! Cross-sections at one scale: as they are, or before and after.

use super::canvas::{Canvas, through};
use super::{AFTER, BEFORE, before_and_after};
use crate::problem::Problem;
use crate::report::cross_section::CrossSection;
use crate::report::number::significant;

/// Sections drawn at the most.
const MOST: u32 = 24;
const COLUMNS: usize = 4;
const CELL: f64 = 190.0;

/// One cell of the picture: a section's title, its outlines before and after.
struct Cell {
    title: String,
    before: Vec<Vec<[f64; 2]>>,
    after: Vec<Vec<[f64; 2]>>,
}

/// One section or several, as they are.
pub fn cross_section(sections: &[CrossSection]) -> String {
    let cell = |section: &CrossSection| Cell { title: title(section), before: Vec::new(), after: section.rings() };
    drawn("Cross-sections", sections.iter().take(MOST as usize).map(cell).collect(), false)
}

/// The first sections of a problem at the start and at the answer.
pub fn cross_sections(problem: &Problem, start: &[f64], answer: &[f64]) -> String {
    let count = problem.sections.names.len() as u32;
    let cell = |s: u32| {
        let (before, after) = (CrossSection::of(problem, s, start)?, CrossSection::of(problem, s, answer)?);
        Some(Cell { title: title(&after), before: before.rings(), after: after.rings() })
    };
    let cells: Vec<Cell> = (0..count.min(MOST)).filter_map(cell).collect();
    let heading = match count > MOST {
        true => format!("Cross-sections: the first {MOST} of {count}"),
        false => "Cross-sections".to_owned(),
    };
    drawn(&heading, cells, true)
}

fn title(section: &CrossSection) -> String {
    let size = ["width", "height"].map(|name| significant(section.value(name).unwrap_or(f64::NAN), 3));
    format!("{}: {} x {}", section.name, size[0], size[1])
}

fn drawn(heading: &str, cells: Vec<Cell>, legend: bool) -> String {
    let rows = cells.len().div_ceil(COLUMNS).max(1);
    let width = CELL * COLUMNS as f64;
    let mut canvas = Canvas::new(width, 50.0 + CELL * rows as f64, heading);
    if legend {
        before_and_after(&mut canvas, width, 20.0);
    }
    let all = cells.iter().flat_map(|cell| cell.before.iter().chain(&cell.after)).flatten().flatten();
    let reach = all.fold(0.0, |reach: f64, one| reach.max(one.abs()));
    let scale = if reach > 0.0 { (CELL / 2.0 - 22.0) / reach } else { 1.0 };
    for (at, cell) in cells.iter().enumerate() {
        let middle = [CELL * (at % COLUMNS) as f64 + CELL / 2.0, 40.0 + CELL * (at / COLUMNS) as f64 + CELL / 2.0];
        canvas.line([middle[0] - 8.0, middle[1], middle[0] + 8.0, middle[1]], "#bbbbbb");
        canvas.line([middle[0], middle[1] - 8.0, middle[0], middle[1] + 8.0], "#bbbbbb");
        let on_sheet = |[x, y]: [f64; 2]| [middle[0] + scale * x, middle[1] - scale * y];
        for (rings, style) in [(&cell.after, AFTER), (&cell.before, BEFORE)] {
            let data: String = rings.iter().map(|ring| through(ring.iter().map(|point| on_sheet(*point)), true)).collect();
            canvas.path(&data, style);
        }
        canvas.text(middle[0], middle[1] + CELL / 2.0 - 4.0, "middle", &cell.title);
    }
    canvas.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sections::kind;

    #[test]
    fn holes_are_rings_of_one_path() {
        let tube = CrossSection::new("pipe", &kind("tube").unwrap().forms()[0], &[0.2, 0.01], &[]).unwrap();
        let svg = cross_section(&[tube]);
        assert!(svg.contains("pipe: 0.2 x 0.2") && svg.contains("ZM") && !svg.contains("NaN"));
    }

    #[test]
    fn a_section_that_cannot_be_is_left_blank() {
        let tube = CrossSection::new("pipe", &kind("tube").unwrap().forms()[0], &[0.2, 0.11], &[]).unwrap();
        assert!(tube.defect.is_some());
        assert!(!cross_section(&[tube]).contains("NaN"));
    }
}
