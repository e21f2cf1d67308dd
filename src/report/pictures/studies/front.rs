//! A front between two objectives.

use crate::report::pictures::axes::{Panel, Scale, range};
use crate::report::pictures::canvas::{Canvas, Ink, Style, through};

/// What is known of a front.
#[derive(Debug, Clone, Default)]
pub struct Front {
    /// The second objective, and the first.
    pub names: [String; 2],
    /// Certified points: second, first, and the slope of the tangent there.
    pub points: Vec<([f64; 2], Option<f64>)>,
    /// Below this there is no feasible point, where that is proved.
    pub bound: Vec<[f64; 2]>,
}

/// Half a tangent, a share of the panel's width and height at the most.
const TANGENT: f64 = 0.05;

/// Points with their tangents; below the bound the region that is proved to be empty.
pub fn front(title: &str, front: &Front) -> String {
    let shown = match front.bound.is_empty() {
        true => "Certified points and their tangents",
        false => "Certified points and their tangents; below the dashed line no feasible point is possible",
    };
    let mut canvas = Canvas::new(760.0, 520.0, title, shown);
    let all = || front.points.iter().map(|(at, _)| at);
    let panel = Panel {
        left: 90.0,
        top: 60.0,
        width: 640.0,
        height: 400.0,
        x: Scale::linear(all().map(|at| at[0])),
        y: Scale::linear(all().map(|at| at[1])),
    };
    panel.draw(&mut canvas, &front.names[0], &front.names[1]);
    let bound = through(front.bound.iter().map(|&at| panel.at(at)), false);
    canvas.path(&bound, Style { stroke: Ink::Middle, width: 1.5, dash: "5 4", filled: false });
    let width = |axis: usize| range(all().map(|at| at[axis])).map_or(0.0, |(low, high)| high - low);
    for ([x, y], slope) in &front.points {
        if let Some(slope) = slope {
            let half = TANGENT * width(0) / (slope.abs() * width(0) / width(1)).hypot(1.0);
            let ends = [-half, half].map(|step| panel.at([x + step, y + slope * step]));
            canvas.path(&through(ends, false), Style::line(Ink::Curve(1), 1.5));
        }
        canvas.dot(panel.at([*x, *y]), 3.5, Ink::Curve(0), true);
    }
    canvas.finish()
}
