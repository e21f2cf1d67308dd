//! SVG, written by hand: the few elements the pictures need.

use std::fmt::Write as _;

/// Okabe and Ito's colours, which colour-blind people can tell apart.
pub const COLOURS: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#b8a800"];

/// A picture being drawn, in pixels from the upper left corner.
pub struct Canvas {
    svg: String,
}

impl Canvas {
    /// A white sheet with a title.
    pub fn new(width: f64, height: f64, title: &str) -> Canvas {
        let mut canvas = Canvas { svg: String::new() };
        // Writing to a string cannot fail.
        let _ = writeln!(
            canvas.svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
             <text x=\"60\" y=\"24\" font-size=\"15\">{}</text>",
            escaped(title)
        );
        canvas
    }

    /// A straight line from (x1, y1) to (x2, y2).
    pub fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], colour: &str) {
        let _ = writeln!(self.svg, "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" stroke=\"{colour}\"/>");
    }

    /// Text whose `anchor` (start, middle, end) is at x, its baseline at y.
    pub fn text(&mut self, x: f64, y: f64, anchor: &str, content: &str) {
        let _ = writeln!(self.svg, "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{}</text>", escaped(content));
    }

    /// Text that runs upwards, its middle at (x, y).
    pub fn upright(&mut self, x: f64, y: f64, content: &str) {
        let turn = format!("transform=\"rotate(-90 {x:.2} {y:.2})\"");
        let _ = writeln!(self.svg, "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"middle\" {turn}>{}</text>", escaped(content));
    }

    /// A path by its data, with attributes for stroke and fill.
    pub fn path(&mut self, data: &str, style: &str) {
        let _ = writeln!(self.svg, "<path d=\"{data}\" {style}/>");
    }

    /// A dot.
    pub fn dot(&mut self, x: f64, y: f64, radius: f64, colour: &str) {
        let _ = writeln!(self.svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{colour}\"/>");
    }

    /// The finished picture.
    pub fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }
}

/// Path data through points; points that are no numbers interrupt it.
pub fn through(points: impl IntoIterator<Item = [f64; 2]>, closed: bool) -> String {
    let mut data = String::new();
    let mut begun = false;
    for [x, y] in points {
        if x.is_finite() && y.is_finite() {
            let _ = write!(data, "{}{x:.2} {y:.2}", if begun { 'L' } else { 'M' });
        }
        begun = x.is_finite() && y.is_finite();
    }
    if closed && begun {
        data.push('Z');
    }
    data
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_interrupt_a_path() {
        let points = [[0.0, 0.0], [1.0, f64::NAN], [2.0, 1.0], [3.0, 1.0]];
        assert_eq!(through(points, false), "M0.00 0.00M2.00 1.00L3.00 1.00");
        assert_eq!(through([[0.0, 0.0], [1.0, 2.0]], true), "M0.00 0.00L1.00 2.00Z");
    }
}
