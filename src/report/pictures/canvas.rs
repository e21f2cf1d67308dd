//! SVG, written by hand: the few elements the pictures need, legible on white and on dark grounds.

use std::fmt::Write as _;

use crate::report::text::plain;

/// Colours of curves: Okabe and Ito's, which colour-blind people can tell apart, and lighter ones for dark grounds.
const CURVES: [[&str; 2]; 8] = [
    ["#0072b2", "#56b4e9"],
    ["#d55e00", "#ff9e4a"],
    ["#009e73", "#33c79b"],
    ["#cc79a7", "#e39ac4"],
    ["#e69f00", "#f0c04a"],
    ["#56b4e9", "#9fd6f5"],
    ["#000000", "#ffffff"],
    ["#b8a800", "#d8d03a"],
];

/// What lines and areas are drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// Text and outlines.
    Strong,
    /// Axes and dimension lines.
    Middle,
    /// Grids.
    Faint,
    /// One of the curves' colours, which come round again after eight.
    Curve(usize),
}

impl Ink {
    pub(super) fn class(self) -> &'static str {
        match self {
            Ink::Strong => "strong",
            Ink::Middle => "middle",
            Ink::Faint => "faint",
            Ink::Curve(number) => ["k0", "k1", "k2", "k3", "k4", "k5", "k6", "k7"][number % 8],
        }
    }

    /// On white, and on a dark ground.
    pub(super) fn colours(self) -> [&'static str; 2] {
        match self {
            Ink::Strong => ["#1a1a1a", "#e8e8e8"],
            Ink::Middle => ["#767676", "#a0a8b0"],
            Ink::Faint => ["#e2e2e2", "#363d45"],
            Ink::Curve(number) => CURVES[number % CURVES.len()],
        }
    }

    fn all() -> impl Iterator<Item = Ink> {
        [Ink::Strong, Ink::Middle, Ink::Faint].into_iter().chain((0..CURVES.len()).map(Ink::Curve))
    }
}

/// How a path is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Style {
    /// Its line.
    pub stroke: Ink,
    /// The line's width.
    pub width: f64,
    /// Lengths of dashes and gaps; empty for an unbroken line.
    pub dash: &'static str,
    /// Whether the inside is tinted with the line's colour.
    pub filled: bool,
}

impl Style {
    /// An unbroken line.
    pub const fn line(stroke: Ink, width: f64) -> Style {
        Style { stroke, width, dash: "", filled: false }
    }
}

/// A picture being drawn, in pixels from the upper left corner. What has no place (sizes beyond all numbers) is left out.
pub struct Canvas {
    svg: String,
    width: f64,
}

/// The ground on white and dark screens.
const GROUND: [&str; 2] = ["#ffffff", "#16191d"];

/// Pixels a letter of the heading takes at the most.
const LETTER: f64 = 8.0;

impl Canvas {
    /// A sheet with a heading: what the problem is called, and below it what is shown.
    pub fn new(width: f64, height: f64, title: &str, shown: &str) -> Canvas {
        let (title, shown) = (escaped(&cut(title, (width - 40.0) / LETTER)), escaped(shown));
        let mut svg = String::new();
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <title>{title}</title>\n<desc>{shown}</desc>\n<style>\n{}</style>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\" class=\"ground\"/>\n\
             <text x=\"20\" y=\"24\" font-size=\"15\" font-weight=\"bold\" fill=\"{}\" class=\"strong t\">{title}</text>\n\
             <text x=\"20\" y=\"42\" fill=\"{}\" class=\"middle t\">{shown}</text>\n",
            dark(),
            GROUND[0],
            Ink::Strong.colours()[0],
            Ink::Middle.colours()[0],
        );
        Canvas { svg, width }
    }

    /// The sheet's width.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// A straight line from (x1, y1) to (x2, y2).
    pub fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], ink: Ink) {
        if ![x1, y1, x2, y2].iter().all(|at| at.is_finite()) {
            return;
        }
        let (colour, class) = (ink.colours()[0], ink.class());
        let _ = writeln!(
            self.svg,
            "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" stroke=\"{colour}\" class=\"{class} s\"/>"
        );
    }

    /// Text whose `anchor` (start, middle, end) is at x, its baseline at y.
    pub fn text(&mut self, x: f64, y: f64, anchor: &str, content: &str) {
        self.words([x, y], anchor, content, Ink::Strong, "");
    }

    /// A number over other lines: its centre at (x, y), on a rim of the ground's colour.
    pub fn number(&mut self, [x, y]: [f64; 2], content: &str) {
        if x.is_finite() && y.is_finite() {
            let rim = format!(" stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"", GROUND[0]);
            self.words([x, y + 4.0], "middle", content, Ink::Strong, &format!("{rim} data-rim=\"\""));
        }
    }

    /// The same, less strong: notes and numbers.
    pub fn note(&mut self, x: f64, y: f64, anchor: &str, content: &str) {
        self.words([x, y], anchor, content, Ink::Middle, "");
    }

    /// Text that runs upwards, its middle at (x, y).
    pub fn upright(&mut self, x: f64, y: f64, content: &str) {
        self.words([x, y], "middle", content, Ink::Strong, &format!(" transform=\"rotate(-90 {x:.2} {y:.2})\""));
    }

    /// A number that runs upwards along a dimension line.
    pub fn upright_note(&mut self, x: f64, y: f64, content: &str) {
        self.words([x, y], "middle", content, Ink::Middle, &format!(" transform=\"rotate(-90 {x:.2} {y:.2})\""));
    }

    fn words(&mut self, [x, y]: [f64; 2], anchor: &str, content: &str, ink: Ink, turn: &str) {
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let (colour, class, content) = (ink.colours()[0], ink.class(), escaped(content));
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" fill=\"{colour}\" class=\"{class} t\"{turn}>{content}</text>"
        );
    }

    /// A path by its data.
    pub fn path(&mut self, data: &str, style: Style) {
        let Style { stroke, width, dash, filled } = style;
        let (colour, class) = (stroke.colours()[0], stroke.class());
        let fill = if filled {
            format!("fill=\"{colour}\" fill-opacity=\"0.22\" fill-rule=\"evenodd\"")
        } else {
            "fill=\"none\"".into()
        };
        let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
        let also = if filled { " a" } else { "" };
        let _ = writeln!(
            self.svg,
            "<path d=\"{data}\" {fill} stroke=\"{colour}\" stroke-width=\"{width}\"{dash} class=\"{class} s{also}\"/>"
        );
    }

    /// Further rules for classes of [`Canvas::shape`].
    pub fn styles(&mut self, rules: &str) {
        let _ = write!(self.svg, "<style>\n{rules}</style>\n");
    }

    /// An area of one colour on white and of another by its class on dark grounds; viewers show the label under the pointer.
    pub fn shape(&mut self, data: &str, [colour, class]: [&str; 2], opacity: f64, label: &str) {
        let _ = write!(self.svg, "<path d=\"{data}\" fill=\"{colour}\" class=\"{class}\"");
        if opacity < 1.0 {
            let _ = write!(self.svg, " fill-opacity=\"{opacity}\"");
        }
        let _ = match label {
            "" => writeln!(self.svg, "/>"),
            label => writeln!(self.svg, "><title>{}</title></path>", escaped(label)),
        };
    }

    /// A dot; an empty one stands for a value that lies beyond the axis.
    pub fn dot(&mut self, [x, y]: [f64; 2], radius: f64, ink: Ink, full: bool) {
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let (colour, class) = (ink.colours()[0], ink.class());
        let drawn = match full {
            true => format!("fill=\"{colour}\" class=\"{class} a\""),
            false => format!("fill=\"none\" stroke=\"{colour}\" class=\"{class} s\""),
        };
        let _ = writeln!(self.svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" {drawn}/>");
    }

    /// The finished picture.
    pub fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }
}

/// The colours for dark grounds; those for white stand at each element, for viewers that know no style sheets.
fn dark() -> String {
    let mut css = format!("@media (prefers-color-scheme: dark) {{\n.ground {{ fill: {} }}\n", GROUND[1]);
    let _ = writeln!(css, "text[data-rim] {{ stroke: {} }}", GROUND[1]);
    for ink in Ink::all() {
        let (class, [_, colour]) = (ink.class(), ink.colours());
        let _ = writeln!(css, ".{class}.s {{ stroke: {colour} }} .{class}.t, .{class}.a {{ fill: {colour} }}");
    }
    css.push_str("}\n");
    css
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

/// As many letters of a text as there is room for.
pub fn cut(text: &str, room: f64) -> String {
    let room = room.max(4.0) as usize;
    match text.chars().count() > room {
        true => text.chars().take(room - 1).chain(['…']).collect(),
        false => text.into(),
    }
}

fn escaped(text: &str) -> String {
    plain(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
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

    #[test]
    fn every_ink_has_a_dark_colour_and_names_are_text() {
        let svg = Canvas::new(100.0, 50.0, "a<b\u{1b}", "what").finish();
        assert!(svg.contains("prefers-color-scheme: dark") && svg.contains(".k7.s"));
        assert!(svg.contains("<title>a&lt;b\u{fffd}</title>") && svg.contains("<desc>what</desc>"));
    }

    #[test]
    fn what_has_no_place_is_left_out() {
        let mut canvas = Canvas::new(100.0, 50.0, "title", "shown");
        canvas.line([0.0, f64::NAN, 1.0, 1.0], Ink::Faint);
        canvas.text(f64::INFINITY, 0.0, "start", "here");
        canvas.dot([0.0, f64::NEG_INFINITY], 3.0, Ink::Strong, true);
        let svg = canvas.finish();
        assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("here"), "{svg}");
    }

    #[test]
    fn long_texts_are_cut() {
        assert_eq!((cut("abcdef", 5.0), cut("abc", 5.0)), ("abcd…".into(), "abc".into()));
    }
}
