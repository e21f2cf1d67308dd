//! The objective over one varied name, and what governs where.

use super::legend;
use crate::report::pictures::axes::{Panel, Scale, range};
use crate::report::pictures::canvas::{Canvas, Ink, Style, through};

/// One line over a varied name.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// What the other varied names are along it; empty where there are none.
    pub name: String,
    /// The name's values, the objective where there is a certified one, and the limit that governs there.
    pub points: Vec<(f64, Option<f64>, String)>,
}

/// Lines at the most: the colours that can be told apart.
pub(super) const MOST: usize = 8;

/// The lines over the name; of a single line also bands of what governs.
pub fn course(title: &str, names: [&str; 2], courses: &[Course]) -> String {
    let shown = match courses {
        [_] => "Bands: the limit that costs most",
        _ => "By the other varied names",
    };
    let mut canvas = Canvas::new(860.0, 480.0, title, shown);
    let drawn = &courses[..courses.len().min(MOST)];
    let all = || drawn.iter().flat_map(|course| &course.points);
    let (low, high) = range(all().map(|point| point.0)).unwrap_or((0.0, 1.0));
    let panel = Panel {
        left: 90.0,
        top: 60.0,
        width: 500.0,
        height: 360.0,
        x: Scale::between(low, high),
        y: Scale::linear(all().filter_map(|point| point.1)),
    };
    if let [course] = courses {
        bands(&mut canvas, &panel, course);
    }
    panel.draw(&mut canvas, names[0], names[1]);
    for (at, course) in drawn.iter().enumerate() {
        let ink = if courses.len() == 1 { Ink::Strong } else { Ink::Curve(at) };
        let points = course.points.iter().map(|(x, y, _)| panel.at([*x, y.unwrap_or(f64::NAN)]));
        canvas.path(&through(points.clone(), false), Style::line(ink, 1.8));
        points.for_each(|point| canvas.dot(point, 2.0, ink, true));
        if courses.len() > 1 {
            legend(&mut canvas, [610.0, 76.0], at, ink, &course.name);
        }
    }
    if courses.len() > MOST {
        canvas.note(610.0, 76.0 + super::LINE * MOST as f64, "start", &format!("and {} more", courses.len() - MOST));
    }
    canvas.finish()
}

/// A band for every stretch with the same limit; it reaches halfway to its neighbours.
fn bands(canvas: &mut Canvas, panel: &Panel, course: &Course) {
    let points = &course.points;
    let mut names: Vec<&str> = Vec::new();
    let mut from = 0;
    while from < points.len() {
        let governs = &points[from].2;
        let to = points[from..].iter().position(|point| point.2 != *governs).map_or(points.len(), |at| from + at);
        let edge = |at: usize| if at == 0 { points[0].0 } else { (points[at - 1].0 + points[at.min(points.len() - 1)].0) / 2.0 };
        let end = if to == points.len() { points[to - 1].0 } else { edge(to) };
        if !governs.is_empty() {
            let number = names.iter().position(|name| name == governs).unwrap_or_else(|| {
                names.push(governs);
                legend(canvas, [610.0, 76.0], names.len() - 1, Ink::Curve(names.len() - 1), governs);
                names.len() - 1
            });
            let (left, right) =
                (panel.left + panel.width * panel.x.share(edge(from)), panel.left + panel.width * panel.x.share(end));
            let (top, bottom) = (panel.top, panel.top + panel.height);
            let ink = Ink::Curve(number);
            let data = format!("M{left:.2} {top}H{right:.2}V{bottom}H{left:.2}Z");
            canvas.shape(&data, [ink.colours()[0], &format!("{} a", ink.class())], 0.16, governs);
        }
        from = to;
    }
}
