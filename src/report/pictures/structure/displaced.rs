//! The displaced shape, one panel per case.

use super::super::canvas::{Canvas, Ink, Style, cut, through};
use super::drawing::{Drawing, line_width};
use super::{MARGIN, NAME, TOP, WIDTH, chosen, of_cases};
use crate::report::About;
use crate::report::number::{significant, with_unit_power};
use crate::report::structure::{CaseCourses, Courses};

/// The largest displacement is drawn about this long.
const DRAWN: f64 = 40.0;

/// Draws the structure as it stands and, magnified, as it moves.
pub fn displaced(courses: &Courses, about: &About) -> String {
    let drawn = chosen(courses);
    let columns = if drawn.len() > 1 { 2 } else { 1 };
    let width = (WIDTH - 2.0 * MARGIN) / columns as f64;
    let drawing = Drawing::fit(courses, width);
    let panel = drawing.height + NAME;
    let lines = drawn.len().div_ceil(columns) as f64;
    let shown = format!("Displaced shape: {}", of_cases(courses, drawn.len()));
    let mut canvas = Canvas::new(WIDTH, TOP + lines * panel + MARGIN, &about.title, &shown);
    for (number, case) in drawn.iter().map(|&case| &courses.cases[case]).enumerate() {
        let corner = [MARGIN + width * (number % columns) as f64, TOP + panel * (number / columns) as f64];
        one(&mut canvas, courses, case, about, (&drawing, corner, width));
    }
    canvas.finish()
}

fn one(
    canvas: &mut Canvas,
    courses: &Courses,
    case: &CaseCourses,
    about: &About,
    (drawing, corner, width): (&Drawing, [f64; 2], f64),
) {
    let largest = largest(courses, case);
    let size = largest.as_ref().map_or(0.0, |(_, size)| *size);
    let times = if size > 0.0 { round(DRAWN / (size * drawing.scale())) } else { 1.0 };
    let words = match largest {
        Some((place, size)) => {
            let size = with_unit_power(size, about.unit("length"), 1);
            format!("{}: drawn {}-fold; the largest, {size}, at {place}", case.name, significant(times, 2))
        }
        None => format!("{}: nothing moves", case.name),
    };
    canvas.text(corner[0], corner[1] + 14.0, "start", &cut(&words, width / 6.6));
    let below = [corner[0], corner[1] + NAME - 10.0];
    let before = Style { dash: "4 3", ..Style::line(Ink::Middle, 1.0) };
    drawing.structure(canvas, below, courses, before);
    let mut all = String::new();
    for member in 0..courses.members.len() {
        let places = (0..courses.stations.len()).map(|station| {
            let (point, moved) = (courses.point(member, station), case.moved[courses.at(member, station)]);
            drawing.at(below, std::array::from_fn(|axis| point[axis] + times * moved[axis]))
        });
        let places: Vec<[f64; 2]> = places.collect();
        let ends = [places.first(), places.last()];
        for (end, node) in
            ends.into_iter().zip(courses.members[member].nodes).filter_map(|(end, node)| Some((*end?, node as usize)))
        {
            let (position, moved) = (courses.nodes[node].position, case.nodes[node]);
            let node = drawing.at(below, std::array::from_fn(|axis| position[axis] + times * moved[axis]));
            // A rigid arm.
            if (node[0] - end[0]).hypot(node[1] - end[1]) > 0.5 {
                canvas.path(&through([node, end], false), Style::line(Ink::Curve(0), 2.5));
            }
        }
        all.push_str(&through(places, false));
    }
    canvas.path(&all, Style::line(Ink::Curve(0), line_width(courses)));
    drawing.node_names(canvas, below, courses);
}

/// Where the structure moves most, and how far.
fn largest(courses: &Courses, case: &CaseCourses) -> Option<(String, f64)> {
    let size = |v: &[f64]| v[..3].iter().map(|value| value * value).sum::<f64>().sqrt();
    let nodes = courses.nodes.iter().zip(&case.nodes).map(|(node, moved)| (node.name.clone(), size(moved)));
    let node = nodes.fold(None, |most: Option<(String, f64)>, next| match most {
        Some(most) if most.1 >= next.1 => Some(most),
        _ => Some(next),
    });
    let mut most = node.filter(|(_, size)| *size > 0.0);
    for (number, member) in courses.members.iter().enumerate() {
        for (station, s) in courses.stations.iter().enumerate() {
            let size = size(&case.moved[courses.at(number, station)]);
            // A node at a rib's end is named first.
            if size > most.as_ref().map_or(0.0, |most| most.1) * (1.0 + 1e-9) {
                most = Some((format!("{} of {}", significant(*s, 3), member.name), size));
            }
        }
    }
    most
}

/// The next of 1, 2, 5, 10, … below.
fn round(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|step| step * power).find(|step| *step <= value).unwrap_or(value)
}
