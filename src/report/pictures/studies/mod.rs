//! Pictures of many runs: a front, courses over what is varied, what moves most, maps.

mod course;
mod front;
mod heat_map;
mod parallel;
mod tornado;

pub use course::{Course, course};
pub use front::{Front, front};
pub use heat_map::{HeatMap, heat_map};
pub use parallel::parallel;
pub use tornado::{Swing, tornado};

use super::canvas::{Canvas, Ink, cut};

/// What a cell or a line of a map stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Answer {
    /// A proved one, with its objective.
    Certified(f64),
    /// One that is not proved.
    Open(f64),
    /// There is none: infeasible, unbounded.
    None,
    /// Nothing is known.
    Unknown,
}

impl Answer {
    /// Its number, where there is one.
    pub fn value(self) -> Option<f64> {
        match self {
            Answer::Certified(value) | Answer::Open(value) => Some(value),
            Answer::None | Answer::Unknown => None,
        }
    }
}

/// Room for a name beside a sample of its colour.
const LINE: f64 = 18.0;

/// Letters of a name in a legend.
const LETTERS: f64 = 34.0;

/// A sample and a name, number `at` of a list that begins at (x, y).
fn legend(canvas: &mut Canvas, [x, y]: [f64; 2], at: usize, ink: Ink, name: &str) {
    let y = y + LINE * at as f64;
    canvas.shape(&format!("M{x} {}h12v10h-12Z", y - 9.0), [ink.colours()[0], &format!("{} a", ink.class())], 1.0, "");
    canvas.text(x + 18.0, y, "start", &cut(name, LETTERS));
}
