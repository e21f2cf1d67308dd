//! How objective, feasibility and optimality went, by iteration and backend, on logarithmic axes.

use super::axes::{Panel, Scale};
use super::canvas::{COLOURS, Canvas, through};

/// Rows of a backend kept for the picture; beyond that every second one goes.
const MOST: usize = 4000;

/// Values below this are drawn here: on a logarithmic axis there is no zero.
const FLOOR: f64 = 1e-17;

/// What one backend showed of its way.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    /// The backend.
    pub backend: String,
    /// Rows with their numbers: objective, feasibility, optimality.
    rows: Vec<(u64, [f64; 3])>,
    seen: u64,
    stride: u64,
}

impl Trace {
    /// A trace without rows.
    pub fn new(backend: &str) -> Trace {
        Trace { backend: backend.into(), rows: Vec::new(), seen: 0, stride: 1 }
    }

    /// Adds an iteration: objective, feasibility, optimality.
    pub fn add(&mut self, row: [f64; 3]) {
        self.seen += 1;
        if self.stride <= 1 || self.seen % self.stride == 1 {
            self.rows.push((self.seen, row));
        }
        if self.rows.len() > MOST {
            let mut at = 0;
            self.rows.retain(|_| {
                at += 1;
                at % 2 == 1
            });
            self.stride = 2 * self.stride.max(1);
        }
    }
}

/// Three panels, one above the other. The objective is shown as its relative distance from `answer`.
///
/// ```
/// use ribopt::report::pictures::{Trace, convergence};
/// let mut trace = Trace::new("nlopt");
/// trace.add([3.0, 0.1, 1.0]);
/// trace.add([2.0, 1e-12, 1e-9]);
/// let svg = convergence(&[trace], Some(2.0));
/// assert!(svg.contains("nlopt") && svg.contains("first-order optimality"));
/// ```
pub fn convergence(traces: &[Trace], answer: Option<f64>) -> String {
    let mut canvas = Canvas::new(760.0, 760.0, "Convergence");
    let size = answer.map_or(1.0, |value| value.abs()).max(f64::MIN_POSITIVE);
    let of_objective = move |value: f64| answer.map_or(f64::NAN, |answer| (value - answer).abs() / size);
    let panels: [(&str, &dyn Fn(&[f64; 3]) -> f64); 3] = [
        ("|objective - answer|, relative", &|row| of_objective(row[0])),
        ("feasibility (violation)", &|row| row[1]),
        ("first-order optimality", &|row| row[2]),
    ];
    let last = traces.iter().map(|trace| trace.seen).max().unwrap_or(1);
    for (at, (name, value)) in panels.into_iter().enumerate() {
        let values = traces.iter().flat_map(|trace| trace.rows.iter().map(|(_, row)| value(row))).filter(|value| *value > FLOOR);
        let y = Scale::logarithmic(values);
        let x = Scale::between(1.0, last as f64);
        let panel = Panel { left: 90.0, top: 50.0 + 235.0 * at as f64, width: 630.0, height: 180.0, x, y };
        panel.draw(&mut canvas, "row of the log: iteration, or improving evaluation (nlopt)", name);
        for (index, trace) in traces.iter().enumerate() {
            curve(&mut canvas, &panel, index, trace, value);
        }
    }
    legend(&mut canvas, traces);
    canvas.finish()
}

fn curve(canvas: &mut Canvas, panel: &Panel, index: usize, trace: &Trace, value: &dyn Fn(&[f64; 3]) -> f64) {
    let colour = COLOURS[index % COLOURS.len()];
    let points: Vec<[f64; 2]> = trace.rows.iter().map(|(number, row)| panel.at([*number as f64, value(row)])).collect();
    let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"");
    canvas.path(&through(points.iter().copied(), false), &style);
    if points.len() <= 60 {
        for [x, y] in points.into_iter().filter(|point| point.iter().all(|one| one.is_finite())) {
            canvas.dot(x, y, 2.4, colour);
        }
    }
}

fn legend(canvas: &mut Canvas, traces: &[Trace]) {
    for (index, trace) in traces.iter().enumerate() {
        let (x, colour) = (300.0 + 210.0 * index as f64, COLOURS[index % COLOURS.len()]);
        canvas.path(&format!("M{x} 20h24"), &format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\""));
        canvas.text(x + 32.0, 24.0, "start", &format!("{} ({} rows)", trace.backend, trace.seen));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_runs_are_thinned_and_nothing_is_no_number() {
        let mut trace = Trace::new("argmin");
        for k in 1..=20_000 {
            trace.add([1.0 / f64::from(k), 0.0, f64::NAN]);
        }
        assert!(trace.rows.len() <= MOST && trace.rows.len() > MOST / 4);
        let svg = convergence(&[trace], Some(0.0));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }

    #[test]
    fn a_run_without_rows_is_still_a_picture() {
        assert!(convergence(&[Trace::new("nlopt")], None).ends_with("</svg>\n"));
    }
}
