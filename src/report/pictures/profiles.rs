//! Profiles along the line, before and after, with their control values.

use super::axes::{Panel, Scale};
use super::canvas::{Canvas, Ink, Style, through};
use super::{BEFORE, before_and_after};
use crate::problem::{Problem, Profile};
use crate::report::About;

/// Profiles drawn at the most.
const MOST: usize = 12;

/// Pieces a curve is drawn in.
const PIECES: u32 = 200;

const ANSWER: Style = Style::line(Ink::Curve(0), 2.0);
const CONTROL: Style = Style::line(Ink::Curve(1), 0.8);

/// Each profile over s from 0 to 1; dots are control values over their Greville abscissae. `None` without profiles.
pub fn profiles(problem: &Problem, about: &About, start: &[f64], answer: &[f64]) -> Option<String> {
    let count = problem.profiles.len().min(MOST);
    if count == 0 {
        return None;
    }
    let more =
        if problem.profiles.len() > count { format!(": the first {count} of {}", problem.profiles.len()) } else { String::new() };
    let mut canvas = Canvas::new(760.0, 60.0 + 250.0 * count as f64, &about.title, &format!("Profiles along the line{more}"));
    before_and_after(&mut canvas);
    canvas.path("M340 38h24", CONTROL);
    canvas.dot([352.0, 38.0], 3.0, Ink::Curve(1), true);
    canvas.text(372.0, 42.0, "start", "control values of the answer");
    for (at, profile) in problem.profiles.iter().take(MOST).enumerate() {
        let dots = controls(profile, answer);
        let [before, after] = [start, answer].map(|x| curve(profile, x));
        let values = before.iter().chain(&after).chain(&dots).map(|point| point[1]);
        let (x, y) = (Scale::between(0.0, 1.0), Scale::linear(values));
        let panel = Panel { left: 90.0, top: 60.0 + 250.0 * at as f64, width: 640.0, height: 200.0, x, y };
        panel.draw(&mut canvas, "s, share of the line's length", &profile.name);
        canvas.path(&through(before.into_iter().map(|point| panel.at(point)), false), BEFORE);
        canvas.path(&through(after.into_iter().map(|point| panel.at(point)), false), ANSWER);
        canvas.path(&through(dots.iter().map(|point| panel.at(*point)), false), CONTROL);
        for point in dots.into_iter().map(|point| panel.at(point)) {
            canvas.dot(point, 3.0, Ink::Curve(1), true);
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
