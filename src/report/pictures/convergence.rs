//! How objective, feasibility and optimality went, by iteration and backend, on logarithmic axes.

use super::axes::{Panel, Scale};
use super::canvas::{Canvas, Ink, Style, through};
use crate::report::About;
use crate::report::text::count;

/// Rows of a run kept for the picture; beyond that every second one goes.
const MOST: usize = 4000;

/// Values below this are drawn at the foot: on a logarithmic axis there is no zero.
const FLOOR: f64 = 1e-17;

/// Points of a curve that are still marked one by one.
const MARKED: usize = 60;

/// What a panel shows of a row.
type Value<'a> = &'a dyn Fn(&[f64; 3]) -> f64;

/// What one backend showed of its ways, run by run.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    /// The backend.
    pub backend: String,
    runs: Vec<Run>,
    /// Which run is drawn.
    chosen: usize,
}

#[derive(Debug, Clone)]
struct Run {
    /// Rows with their numbers: objective, feasibility, optimality.
    rows: Vec<(u64, [f64; 3])>,
    seen: u64,
    stride: u64,
}

impl Trace {
    /// A trace without rows.
    pub fn new(backend: &str) -> Trace {
        Trace { backend: backend.into(), runs: Vec::new(), chosen: 1 }
    }

    /// Adds an iteration of run number `attempt`, from 1: objective, feasibility, optimality.
    pub fn add(&mut self, attempt: usize, row: [f64; 3]) {
        while self.runs.len() < attempt {
            self.runs.push(Run { rows: Vec::new(), seen: 0, stride: 1 });
        }
        if let Some(run) = attempt.checked_sub(1).and_then(|at| self.runs.get_mut(at)) {
            run.add(row);
        }
    }

    /// The same with run number `attempt` to be drawn: the one that gave the answer.
    pub fn of(self, attempt: usize) -> Trace {
        Trace { chosen: attempt, ..self }
    }

    fn run(&self) -> Option<&Run> {
        self.runs.get(self.chosen.checked_sub(1)?)
    }

    fn rows(&self) -> &[(u64, [f64; 3])] {
        self.run().map_or(&[], |run| &run.rows)
    }

    fn seen(&self) -> u64 {
        self.run().map_or(0, |run| run.seen)
    }

    /// `argmin, run 2 of 3, 46 rows`
    fn name(&self) -> String {
        let rows = count(self.seen() as usize, "row");
        match self.runs.len() {
            _ if self.run().is_none() => format!("{}: no rows of the run that gave the answer", self.backend),
            0 | 1 => format!("{}, {rows}", self.backend),
            runs => format!("{}, run {} of {runs}, {rows}", self.backend, self.chosen),
        }
    }
}

impl Run {
    fn add(&mut self, row: [f64; 3]) {
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

/// Three panels, one above the other, of the runs that gave the answers. The objective is shown as its relative distance from
/// `answer`.
///
/// ```
/// use ribopt::report::{About, pictures::{Trace, convergence}};
/// let mut trace = Trace::new("nlopt");
/// trace.add(1, [3.0, 0.1, 1.0]);
/// trace.add(1, [2.0, 1e-12, 1e-9]);
/// let svg = convergence(&[trace], &About::default(), Some(2.0));
/// assert!(svg.contains("nlopt") && svg.contains("first-order optimality"));
/// ```
pub fn convergence(traces: &[Trace], about: &About, answer: Option<f64>) -> String {
    let shown = "Convergence: the runs that gave the answers; circles at the foot are zeros";
    let mut canvas = Canvas::new(760.0, 800.0, &about.title, shown);
    let size = answer.map_or(1.0, |value| value.abs()).max(f64::MIN_POSITIVE);
    let of_objective = move |value: f64| answer.map_or(f64::NAN, |answer| (value - answer).abs() / size);
    let panels: [(&str, Value); 3] = [
        ("|objective − answer|, relative", &|row| of_objective(row[0])),
        ("feasibility (violation)", &|row| row[1]),
        ("first-order optimality", &|row| row[2]),
    ];
    let last = traces.iter().map(Trace::seen).max().unwrap_or(1);
    for (at, (name, value)) in panels.into_iter().enumerate() {
        let all = || traces.iter().flat_map(|trace| trace.rows().iter().map(|(_, row)| value(row)));
        let y = Scale::logarithmic(all().filter(|value| *value > FLOOR));
        let panel = Panel {
            left: 90.0,
            top: 90.0 + 237.0 * at as f64,
            width: 640.0,
            height: 175.0,
            x: Scale::between(1.0, last as f64),
            y,
        };
        let is_last = at == 2;
        panel.draw(&mut canvas, if is_last { "row of the log: iteration, or improving evaluation (nlopt)" } else { "" }, name);
        for (index, trace) in traces.iter().enumerate() {
            curve(&mut canvas, &panel, index, trace, value);
        }
        let silent =
            traces.iter().filter(|trace| !trace.rows().is_empty() && trace.rows().iter().all(|(_, row)| value(row).is_nan()));
        let silent: Vec<&str> = silent.map(|trace| trace.backend.as_str()).collect();
        if !silent.is_empty() {
            canvas.note(724.0, panel.top + 14.0, "end", &format!("{} shows none", silent.join(", ")));
        }
    }
    legend(&mut canvas, traces);
    canvas.finish()
}

fn curve(canvas: &mut Canvas, panel: &Panel, index: usize, trace: &Trace, value: Value) {
    let place = |(number, row): &(u64, [f64; 3])| (panel.at([*number as f64, value(row)]), value(row) > FLOOR);
    let points: Vec<([f64; 2], bool)> = trace.rows().iter().map(place).collect();
    canvas.path(&through(points.iter().map(|(point, _)| *point), false), Style::line(Ink::Curve(index), 1.6));
    if points.len() <= MARKED {
        for (point, full) in points.into_iter().filter(|(point, _)| point.iter().all(|one| one.is_finite())) {
            canvas.dot(point, 2.6, Ink::Curve(index), full);
        }
    }
}

fn legend(canvas: &mut Canvas, traces: &[Trace]) {
    for (index, trace) in traces.iter().enumerate() {
        let x = 90.0 + 320.0 * index as f64;
        canvas.path(&format!("M{x} 66h24"), Style::line(Ink::Curve(index), 2.0));
        canvas.text(x + 32.0, 70.0, "start", &trace.name());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_runs_are_thinned_and_nothing_is_no_number() {
        let mut trace = Trace::new("argmin");
        for k in 1..=20_000 {
            trace.add(1, [1.0 / f64::from(k), 0.0, f64::NAN]);
        }
        assert!(trace.rows().len() <= MOST && trace.rows().len() > MOST / 4);
        let svg = convergence(&[trace], &About::default(), Some(0.0));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert!(svg.contains("argmin shows none"));
    }

    #[test]
    fn a_run_without_rows_is_still_a_picture() {
        assert!(convergence(&[Trace::new("nlopt")], &About::default(), None).ends_with("</svg>\n"));
    }

    #[test]
    fn the_run_that_gave_the_answer_is_drawn() {
        let mut trace = Trace::new("argmin");
        for (attempt, rows) in [(1, 5), (2, 2)] {
            (0..rows).for_each(|_| trace.add(attempt, [1.0, 1.0, 1.0]));
        }
        trace.add(2, [0.5, 0.0, 0.0]);
        assert_eq!(trace.clone().of(2).name(), "argmin, run 2 of 2, 3 rows");
        assert_eq!(trace.clone().of(1).rows().len(), 5);
        assert!(trace.of(7).name().contains("no rows"));
    }
}
