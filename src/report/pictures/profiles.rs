//! Profiles along the line, before and after, with their control values.

use super::axes::{Panel, Scale};
use super::canvas::{COLOURS, Canvas, through};
use super::{BEFORE, before_and_after};
use crate::problem::{Problem, Profile};

/// Profiles drawn at the most.
const MOST: usize = 12;

/// Pieces a curve is drawn in.
const PIECES: u32 = 200;

/// Each profile over s from 0 to 1; dots are control values over their Greville abscissae. `None` without profiles.
pub fn profiles(problem: &Problem, start: &[f64], answer: &[f64]) -> Option<String> {
    let count = problem.profiles.len().min(MOST);
    if count == 0 {
        return None;
    }
    let mut canvas = Canvas::new(760.0, 60.0 + 260.0 * count as f64, "Profiles along the line");
    before_and_after(&mut canvas, 740.0, 20.0);
    for (at, profile) in problem.profiles.iter().take(MOST).enumerate() {
        let dots = controls(profile, answer);
        let [before, after] = [start, answer].map(|x| curve(profile, x));
        let values = before.iter().chain(&after).chain(&dots).map(|point| point[1]);
        let (x, y) = (Scale::between(0.0, 1.0), Scale::linear(values));
        let panel = Panel { left: 90.0, top: 45.0 + 260.0 * at as f64, width: 640.0, height: 200.0, x, y };
        panel.draw(&mut canvas, "s", &profile.name);
        canvas.path(&through(before.into_iter().map(|point| panel.at(point)), false), BEFORE);
        let style = format!("fill=\"none\" stroke=\"{}\" stroke-width=\"2\"", COLOURS[0]);
        canvas.path(&through(after.into_iter().map(|point| panel.at(point)), false), &style);
        let polygon = through(dots.iter().map(|point| panel.at(*point)), false);
        canvas.path(&polygon, &format!("fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"", COLOURS[1]));
        for [x, y] in dots.into_iter().map(|point| panel.at(point)) {
            canvas.dot(x, y, 3.5, COLOURS[1]);
        }
    }
    Some(canvas.finish())
}

fn curve(profile: &Profile, x: &[f64]) -> Vec<[f64; 2]> {
    let at = |k: u32| f64::from(k) / f64::from(PIECES);
    (0..=PIECES).map(|k| [at(k), profile.value(at(k), x).unwrap_or(f64::NAN)]).collect()
}

fn controls(profile: &Profile, x: &[f64]) -> Vec<[f64; 2]> {
    let values = x.iter().skip(profile.first as usize);
    profile.knots.greville().into_iter().zip(values).map(|(s, value)| [s, *value]).collect()
}
