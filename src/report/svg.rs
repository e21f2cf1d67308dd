//! A performance profile as an SVG picture, logarithmic in the factor.

use std::fmt::Write as _;

use super::number::significant;
use super::profile::{Curve, Profile};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 460.0;
const LEFT: f64 = 60.0;
const RIGHT: f64 = 210.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;
/// Okabe and Ito's colours, which colour-blind people can tell apart.
const COLOURS: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#b8a800"];
const DASHES: [&str; 3] = ["", "6 3", "2 3"];

/// Draws the profile.
pub fn draw(profile: &Profile) -> String {
    let plot = Plot { decades: profile.largest_ratio().log10().max(0.3) * 1.05 };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"24\" font-size=\"15\">Problems solved within a factor of the fewest {}</text>\n",
        escaped(&profile.measure)
    );
    plot.axes(&mut svg);
    for (index, curve) in profile.curves.iter().enumerate() {
        plot.curve(&mut svg, index, curve);
    }
    svg.push_str("</svg>\n");
    svg
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

    fn axes(&self, svg: &mut String) {
        let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        for step in 0..=5 {
            let (share, y) = (f64::from(step) / 5.0, Self::y(f64::from(step) / 5.0));
            line(svg, [LEFT, y, right, y], "#dddddd");
            text(svg, LEFT - 8.0, y + 4.0, "end", &format!("{} %", significant(100.0 * share, 3)));
        }
        let mut factor: f64 = 1.0;
        while factor.log10() <= self.decades {
            for multiple in [1.0, 2.0, 5.0] {
                if (factor * multiple).log10() <= self.decades {
                    let x = self.x(factor * multiple);
                    line(svg, [x, TOP, x, bottom], "#dddddd");
                    text(svg, x, bottom + 18.0, "middle", &significant(factor * multiple, 3));
                }
            }
            factor *= 10.0;
        }
        line(svg, [LEFT, bottom, right, bottom], "black");
        line(svg, [LEFT, TOP, LEFT, bottom], "black");
        text(svg, (LEFT + right) / 2.0, bottom + 38.0, "middle", "factor");
    }

    fn curve(&self, svg: &mut String, index: usize, curve: &Curve) {
        let colour = COLOURS[index % COLOURS.len()];
        let dash = DASHES[(index / COLOURS.len()) % DASHES.len()];
        let end = 10f64.powf(self.decades);
        let mut path = format!("M{:.2} {:.2}", self.x(1.0), Self::y(curve.share(1.0)));
        for &ratio in curve.ratios.iter().filter(|&&ratio| ratio > 1.0) {
            // Writing to a string cannot fail.
            let _ = write!(path, "H{:.2}V{:.2}", self.x(ratio), Self::y(curve.share(ratio)));
        }
        let _ = write!(path, "H{:.2}", self.x(end));
        let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dash}\"");
        let _ = writeln!(svg, "<path d=\"{path}\" {style}/>");
        let (x, y) = (WIDTH - RIGHT + 14.0, TOP + 10.0 + 18.0 * index as f64);
        let _ = writeln!(svg, "<path d=\"M{x} {y}h24\" {style}/>");
        text(svg, x + 32.0, y + 4.0, "start", &format!("{} ({:.0} %)", curve.solver, 100.0 * curve.share(f64::MAX)));
    }
}

fn line(svg: &mut String, [x1, y1, x2, y2]: [f64; 4], colour: &str) {
    let _ = writeln!(svg, "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" stroke=\"{colour}\"/>");
}

fn text(svg: &mut String, x: f64, y: f64, anchor: &str, content: &str) {
    let _ = writeln!(svg, "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{}</text>", escaped(content));
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
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
