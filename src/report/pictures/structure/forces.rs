//! The course of forces along the ribs: a block per case, a panel per force.

use std::collections::BTreeMap;

use super::super::canvas::{Canvas, Ink, Style, cut, through};
use super::drawing::{Drawing, line_width};
use super::labels::{self, LETTER, Label};
use super::{MANY_RIBS, MARGIN, NAME, TOP, WIDTH, chosen, of_cases};
use crate::problem::structure::Plane;
use crate::report::About;
use crate::report::number::significant;
use crate::report::structure::{CaseCourses, Courses, FORCES};

/// Panels beside one another.
const COLUMNS: usize = 3;

/// The largest ordinate, in pixels.
const DRAWN: f64 = 34.0;

/// The widest of these lines.
const WIDEST: f64 = 7.0;

/// Numbers in a panel, and in one of many ribs.
const MOST_LABELS: [usize; 2] = [10, 4];

/// Forces below this share of the largest of their kind in a case are rounding.
const NOTHING: f64 = 1e-9;

/// Draws the forces; `None` where there are none.
pub fn forces(courses: &Courses, about: &About) -> Option<String> {
    let drawn = chosen(courses);
    let shown: Vec<usize> =
        (0..FORCES.len()).filter(|&force| drawn.iter().any(|&case| is_there(&courses.cases[case], force))).collect();
    if shown.is_empty() {
        return None;
    }
    let columns = shown.len().min(COLUMNS);
    let width = (WIDTH - 2.0 * MARGIN) / columns as f64;
    let drawing = Drawing::fit(courses, width);
    let panel = drawing.height + NAME;
    let lines = shown.len().div_ceil(columns);
    let block = lines as f64 * panel;
    let heading = format!("Forces along the ribs: {}. {}", of_cases(courses, drawn.len()), legend(courses, &shown));
    let mut canvas = Canvas::new(WIDTH, TOP + drawn.len() as f64 * block + MARGIN, &about.title, &heading);
    for (number, case) in drawn.iter().map(|&case| &courses.cases[case]).enumerate() {
        let top = TOP + block * number as f64;
        for (at, &force) in shown.iter().enumerate() {
            let corner = [MARGIN + width * (at % columns) as f64, top + panel * (at / columns) as f64];
            let panel = Panel { drawing: &drawing, corner: [corner[0], corner[1] + NAME - 10.0], force };
            let unit = unit(about, force);
            let name = format!("{}: {}{}", case.name, FORCES[force], unit.map_or(String::new(), |unit| format!(", in {unit}")));
            canvas.text(corner[0], corner[1] + 14.0, "start", &cut(&name, width / 6.6));
            panel.draw(&mut canvas, courses, case);
        }
    }
    Some(canvas.finish())
}

fn legend(courses: &Courses, shown: &[usize]) -> &'static str {
    match (courses.members.len() > MANY_RIBS, shown) {
        (_, [0]) => "Blue: tension; orange: compression; width by size.",
        (true, _) => "Blue: positive; orange: negative; width by the largest value along the rib.",
        _ => "Blue: positive (N: tension); orange: negative. Moments stand on the side in tension.",
    }
}

fn unit(about: &About, force: usize) -> Option<String> {
    let own = about.unit("force")?;
    if force < 3 { Some(own.into()) } else { Some(format!("{own}·{}", about.unit("length")?)) }
}

fn is_there(case: &CaseCourses, force: usize) -> bool {
    let kind = if force < 3 { 0..3 } else { 3..6 };
    let largest = |range: std::ops::Range<usize>| {
        case.forces.iter().flat_map(|all| all[range.clone()].iter().map(|value| value.abs())).fold(0.0, f64::max)
    };
    largest(force..force + 1) > NOTHING * largest(kind)
}

struct Panel<'a> {
    drawing: &'a Drawing,
    corner: [f64; 2],
    force: usize,
}

impl Panel<'_> {
    fn draw(&self, canvas: &mut Canvas, courses: &Courses, case: &CaseCourses) {
        let value = |member: usize, station: usize| case.forces[courses.at(member, station)][self.force];
        let sizes = case.forces.iter().map(|all| all[self.force].abs()).filter(|value| value.is_finite());
        let largest = if is_there(case, self.force) { sizes.fold(0.0, f64::max) } else { 0.0 };
        let (mut labels, mut lines) = (Vec::new(), Lines::new());
        let as_widths = courses.members.len() > MANY_RIBS || courses.members.iter().all(|member| member.pinned);
        let thin = if as_widths { 0.5 } else { line_width(courses) };
        self.drawing.structure(canvas, self.corner, courses, Style::line(Ink::Middle, thin));
        for (number, member) in courses.members.iter().enumerate().filter(|_| largest > 0.0) {
            let values: Vec<f64> = (0..courses.stations.len()).map(|station| value(number, station)).collect();
            if as_widths {
                self.line(member.ends, &values, largest, (&mut lines, &mut labels));
            } else {
                self.diagram(canvas, courses, number, &values, largest, &mut labels);
            }
        }
        for ((negative, tenths), data) in lines {
            canvas.path(&data, Style::line(ink(if negative { -1.0 } else { 1.0 }), f64::from(tenths) / 10.0));
        }
        labels::write(canvas, labels, MOST_LABELS[usize::from(courses.members.len() > MANY_RIBS)]);
    }

    /// A rib as a line whose width and colour are its force of the largest size.
    fn line(&self, ends: [[f64; 3]; 2], values: &[f64], largest: f64, (lines, labels): (&mut Lines, &mut Vec<Label>)) {
        let most = values.iter().copied().fold(0.0, |most: f64, value| if value.abs() > most.abs() { value } else { most });
        let ends = ends.map(|end| self.drawing.at(self.corner, end));
        let tenths = (10.0 * WIDEST * most.abs() / largest).round() as u32;
        if tenths > 0 {
            lines.entry((most < 0.0, tenths)).or_default().push_str(&through(ends, false));
        }
        // Not in the middle, where bars cross.
        let at = std::array::from_fn(|d| ends[0][d] + 0.4 * (ends[1][d] - ends[0][d]));
        labels.push(Label { at, weight: most.abs(), text: significant(most, 4) });
    }

    /// Ordinates beside a rib, on the side of its z or y axis; of moments on the side in tension.
    fn diagram(
        &self,
        canvas: &mut Canvas,
        courses: &Courses,
        number: usize,
        values: &[f64],
        largest: f64,
        labels: &mut Vec<Label>,
    ) {
        let member = &courses.members[number];
        let towards = self.side(courses.plane, member.ends, member.axes);
        let point = |station: usize| self.drawing.at(self.corner, courses.point(number, station));
        let base: Vec<[f64; 2]> = (0..values.len()).map(point).collect();
        let tip = |at: [f64; 2], value: f64| {
            let length = DRAWN * value / largest;
            [at[0] + towards[0] * length, at[1] + towards[1] * length]
        };
        for run in runs(&base, values) {
            let outline = run.iter().map(|(at, _)| *at).chain(run.iter().rev().map(|(at, value)| tip(*at, *value)));
            let sign = run.iter().map(|(_, value)| value).sum::<f64>();
            canvas.path(&through(outline, true), Style { filled: true, ..Style::line(ink(sign), 0.8) });
        }
        for station in peaks(values) {
            let (at, value) = (tip(base[station], values[station]), values[station]);
            let text = significant(value, 3);
            // Words are wider than high.
            let half = [LETTER / 2.0 * text.chars().count() as f64 + 2.0, 9.0];
            let at = std::array::from_fn(|d| at[d] + towards[d] * half[d] * value.signum());
            labels.push(Label { at, weight: value.abs(), text });
        }
    }

    /// The direction of positive ordinates on the sheet; where that points at the eye, across the rib.
    fn side(&self, plane: Plane, ends: [[f64; 3]; 2], axes: [[f64; 3]; 3]) -> [f64; 2] {
        let (axis, sign) = match FORCES[self.force] {
            "My" => (axes[2], -1.0),
            "Mz" => (axes[1], -1.0),
            "Vy" => (axes[1], 1.0),
            _ => (axes[2], 1.0),
        };
        let [x, y] = self.drawing.direction(axis);
        let [from, to] = ends.map(|end| self.drawing.at([0.0; 2], end));
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy).max(1e-9);
        // How far the direction leads away from the rib on the sheet.
        let away = (dx * y - dy * x) / length;
        if plane == Plane::Space && away.abs() < 0.3 {
            return [sign * dy / length, -sign * dx / length];
        }
        [sign * x, sign * y]
    }
}

/// Paths by sign and by width in tenths of a pixel: a path for each rib would be megabytes.
type Lines = BTreeMap<(bool, u32), String>;

fn ink(value: f64) -> Ink {
    if value < 0.0 { Ink::Curve(1) } else { Ink::Curve(0) }
}

/// Places along a rib with their values.
type Run = Vec<([f64; 2], f64)>;

/// Runs of one sign, cut where the course passes through 0.
fn runs(base: &[[f64; 2]], values: &[f64]) -> Vec<Run> {
    let mut all: Vec<Run> = Vec::new();
    let mut run: Run = Vec::new();
    for (at, (&place, &value)) in base.iter().zip(values).enumerate() {
        if let Some(before) = at.checked_sub(1).filter(|&before| values[before] * value < 0.0) {
            let share = values[before] / (values[before] - value);
            let zero = std::array::from_fn(|d| base[before][d] + share * (place[d] - base[before][d]));
            run.push((zero, 0.0));
            all.push(std::mem::replace(&mut run, vec![(zero, 0.0)]));
        }
        run.push((place, value));
    }
    all.push(run);
    all.retain(|run| run.iter().any(|(_, value)| *value != 0.0));
    all
}

/// Stations whose values are worth a number: both ends, and the extremes between them.
fn peaks(values: &[f64]) -> Vec<usize> {
    let Some(last) = values.len().checked_sub(1) else { return Vec::new() };
    let mut found = vec![0, last];
    let largest = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    for extreme in [f64::max as fn(f64, f64) -> f64, f64::min] {
        let value = values.iter().copied().reduce(extreme).unwrap_or(0.0);
        let at = values.iter().position(|own| *own == value).unwrap_or(0);
        // An extreme that the ends have as well stands there.
        let beside = |end: usize| (values[end] - value).abs() <= 0.02 * largest;
        if !beside(0) && !beside(last) {
            found.push(at);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_is_cut_where_it_passes_through_zero() {
        let base = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]];
        let runs = runs(&base, &[-1.0, 1.0, 2.0, 0.0]);
        assert_eq!(runs.len(), 2);
        assert_eq!((runs[0].last(), runs[1].first()), (Some(&([0.5, 0.0], 0.0)), Some(&([0.5, 0.0], 0.0))));
    }

    #[test]
    fn numbers_stand_at_the_ends_and_at_extremes_between() {
        assert_eq!(peaks(&[0.0, 3.0, 4.0, 3.0, 0.0]), [0, 4, 2]);
        assert_eq!(peaks(&[2.0, 1.0, 0.0]), [0, 2]);
        assert_eq!(peaks(&[]), [0usize; 0]);
    }
}
