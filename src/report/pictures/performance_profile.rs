//! A performance profile as an SVG picture, logarithmic in the factor.

use std::fmt::Write as _;

use super::canvas::{Canvas, Ink, Style};
use crate::report::number::significant;
use crate::report::performance_profile::{Curve, Profile};

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 460.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 290.0;
const TOP: f64 = 60.0;
/// Curves of as many colours come before dashes tell them apart.
const COLOURS: usize = 8;
const BOTTOM: f64 = 50.0;
const DASHES: [&str; 3] = ["", "6 3", "2 3"];

/// Draws the profile.
pub fn draw(profile: &Profile) -> String {
    let plot = Plot { decades: profile.largest_ratio().log10().max(0.3) * 1.05 };
    let shown = format!("Problems solved within a factor of the fewest {}", profile.measure);
    let mut canvas = Canvas::new(WIDTH, HEIGHT, "Performance profile", &shown);
    plot.axes(&mut canvas);
    for (index, curve) in profile.curves.iter().enumerate() {
        let same = profile.curves[..index].iter().find(|other| other.ratios == curve.ratios);
        plot.curve(&mut canvas, index, curve, same);
    }
    canvas.finish()
}

struct Plot {
    decades: f64,
}

impl Plot {
    fn x(&self, factor: f64) -> f64 {
        LEFT + (WIDTH - LEFT - RIGHT) * factor.log10() / self.decades
    }

    fn y(share: f64) -> f64 {
        HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share
    }

    /// What a decade is divided at: the wider the range, the fewer labels have room.
    fn ticks(&self) -> &'static [f64] {
        match self.decades {
            decades if decades < 2.5 => &[1.0, 2.0, 5.0],
            decades if decades < 4.0 => &[1.0, 3.0],
            _ => &[1.0],
        }
    }

    fn axes(&self, canvas: &mut Canvas) {
        let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        for step in 0..=5 {
            let (share, y) = (f64::from(step) / 5.0, Self::y(f64::from(step) / 5.0));
            canvas.line([LEFT, y, right, y], Ink::Faint);
            canvas.note(LEFT - 8.0, y + 4.0, "end", &format!("{} %", significant(100.0 * share, 3)));
        }
        let mut factor: f64 = 1.0;
        while factor.log10() <= self.decades {
            for &multiple in self.ticks() {
                if (factor * multiple).log10() <= self.decades {
                    let x = self.x(factor * multiple);
                    canvas.line([x, TOP, x, bottom], Ink::Faint);
                    canvas.note(x, bottom + 18.0, "middle", &significant(factor * multiple, 3));
                }
            }
            factor *= 10.0;
        }
        canvas.line([LEFT, bottom, right, bottom], Ink::Middle);
        canvas.line([LEFT, TOP, LEFT, bottom], Ink::Middle);
        canvas.text((LEFT + right) / 2.0, bottom + 38.0, "middle", "factor");
    }

    fn curve(&self, canvas: &mut Canvas, index: usize, curve: &Curve, same: Option<&Curve>) {
        // A curve that lies over an earlier one leaves it to be seen.
        let dash = if same.is_some() { "2 6" } else { DASHES[(index / COLOURS) % DASHES.len()] };
        let end = 10f64.powf(self.decades);
        let mut path = format!("M{:.2} {:.2}", self.x(1.0), Self::y(curve.share(1.0)));
        for &ratio in curve.ratios.iter().filter(|&&ratio| ratio > 1.0) {
            // Writing to a string cannot fail.
            let _ = write!(path, "H{:.2}V{:.2}", self.x(ratio), Self::y(curve.share(ratio)));
        }
        let _ = write!(path, "H{:.2}", self.x(end));
        let style = Style { dash, ..Style::line(Ink::Curve(index), 2.0) };
        canvas.path(&path, style);
        let (x, y) = (WIDTH - RIGHT + 14.0, TOP + 10.0 + 18.0 * index as f64);
        canvas.path(&format!("M{x} {y}h24"), style);
        canvas.text(
            x + 32.0,
            y + 4.0,
            "start",
            &format!(
                "{} ({:.0} %){}",
                curve.solver,
                100.0 * curve.share(f64::MAX),
                same.map_or(String::new(), |other| format!(", over {}", other.solver))
            ),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_solver_has_a_curve_and_an_entry_in_the_legend() {
        let costs = [vec![Some(1.0), Some(40.0)], vec![None, Some(2.0)]];
        let svg = draw(&Profile::new("evaluations", &["nlopt slsqp".into(), "a<b".into()], &costs, 1.0));
        assert_eq!(svg.matches("<path").count(), 4);
        assert!(svg.contains("nlopt slsqp (100 %)") && svg.contains("a&lt;b (50 %)"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }

    #[test]
    fn a_profile_without_problems_is_still_a_picture() {
        let svg = draw(&Profile::new("seconds", &["argmin".into()], &[vec![]], 1e-3));
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"));
    }
}
