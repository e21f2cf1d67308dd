//! The line of ribs from the side and from above, before and after: height and width along the ribs.

use super::axes::{Panel, Scale};
use super::canvas::{Canvas, through};
use super::{AFTER, BEFORE, before_and_after};
use crate::problem::Problem;
use crate::report::cross_section::CrossSection;

/// Ribs drawn at the most.
const MOST: usize = 400;

/// Ribs end to end: positions along the line and the section there.
type Line = Vec<(f64, u32)>;

/// Height and width along the first line of ribs: those that follow one another in the file end to start. `None` without ribs.
pub fn elevation(problem: &Problem, start: &[f64], answer: &[f64]) -> Option<String> {
    let line = first_line(problem)?;
    let length = line.last()?.0;
    let mut canvas = Canvas::new(760.0, 560.0, "Along the ribs");
    before_and_after(&mut canvas, 740.0, 20.0);
    for (at, (property, what)) in [("height", "height, from the side"), ("width", "width, from above")].into_iter().enumerate() {
        let [before, after] = [start, answer].map(|x| extents(problem, &line, x, property));
        let reach = before.iter().chain(&after).map(|[_, extent]| extent / 2.0).filter(|reach| reach.is_finite());
        let reach = reach.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let scale = Scale::linear([-reach, reach].into_iter());
        let (x, top) = (Scale::between(0.0, length), 45.0 + 255.0 * at as f64);
        let panel = Panel { left: 90.0, top, width: 640.0, height: 200.0, x, y: scale };
        panel.draw(&mut canvas, "along the line", what);
        for (extents, style) in [(after, AFTER), (before, BEFORE)] {
            let edge = |sign: f64| extents.iter().map(move |[at, extent]| [*at, sign * extent / 2.0]);
            let around = edge(1.0).chain(edge(-1.0).rev()).map(|point| panel.at(point));
            canvas.path(&through(around, true), style);
        }
    }
    Some(canvas.finish())
}

fn extents(problem: &Problem, line: &Line, x: &[f64], property: &str) -> Vec<[f64; 2]> {
    let extent = |s: u32| CrossSection::of(problem, s, x).and_then(|section| section.value(property)).unwrap_or(f64::NAN);
    line.iter().map(|&(at, s)| [at, extent(s)]).collect()
}

fn first_line(problem: &Problem) -> Option<Line> {
    let ribs = &problem.ribs;
    let mut line: Line = vec![(0.0, *ribs.from.first()?)];
    for (r, &from) in ribs.from.iter().enumerate().take(MOST) {
        let &(at, end) = line.last()?;
        if from != end {
            break;
        }
        line.push((at + ribs.length.get(r)?, *ribs.to.get(r)?));
    }
    Some(line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_where_ribs_do_not_meet() {
        let mut problem = Problem::default();
        (problem.ribs.from, problem.ribs.to, problem.ribs.length) = (vec![0, 1, 5], vec![1, 2, 6], vec![2.0, 3.0, 4.0]);
        assert_eq!(first_line(&problem), Some(vec![(0.0, 0), (2.0, 1), (5.0, 2)]));
        assert_eq!(first_line(&Problem::default()), None);
    }
}
