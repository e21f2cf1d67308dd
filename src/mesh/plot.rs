//! Pictures of rib networks: SVG, isometric; height of section as width of line, utilisation as colour. Where all ribs are used alike, as where
//! every line governs, colour shows the area of their sections instead.

use std::fmt::Write;

use super::Vector;
use super::defects::diagonal;

/// One rib as drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Ends.
    pub ends: [Vector; 2],
    /// Section heights at the ends.
    pub heights: [f64; 2],
    /// The mean area of its sections.
    pub area: f64,
    /// 0 to 1, or `None`: grey.
    pub utilisation: Option<f64>,
    /// What a viewer shows under the pointer.
    pub label: String,
}

/// Width of the drawing in pixels, and of the strip for the legend below it.
const SIZE: f64 = 1000.0;
const MARGIN: f64 = 30.0;
const LEGEND: f64 = 60.0;
/// Width of the tallest section at most, and at most this part of the mean rib, so that a dense network stays legible.
const WIDEST: f64 = 9.0;
const WIDEST_PART: f64 = 0.3;

/// Draws ribs seen from (1, 1, 1), far ones first. Widths are in one scale throughout, given in the legend.
///
/// ```
/// use ribopt::mesh::{Vector, plot::{Stroke, svg}};
/// let rib = Stroke { ends: [Vector::zeros(), Vector::x()], heights: [0.2, 0.3], area: 0.05, utilisation: Some(0.9), label: "L1_r1".into() };
/// assert!(svg(&[rib], "One rib").contains("<title>L1_r1</title>"));
/// ```
pub fn svg(strokes: &[Stroke], title: &str) -> String {
    let view = View::of(strokes);
    let tallest = strokes.iter().flat_map(|stroke| stroke.heights).filter(|h| h.is_finite()).fold(0.0, f64::max);
    let widest = WIDEST.min(WIDEST_PART * view.mean_length(strokes));
    let thickness = if tallest > 0.0 { widest / tallest } else { 1.0 };
    let shown = Shown::of(strokes);
    let mut order: Vec<&Stroke> = strokes.iter().collect();
    let nearness = |stroke: &Stroke| (stroke.ends[0] + stroke.ends[1]).sum();
    order.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));

    let mut text = String::new();
    let (width, height) = (view.width, view.height + LEGEND);
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"14\">"
    );
    let _ = writeln!(text, "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>");
    for stroke in order {
        draw(&mut text, &view, stroke, thickness, &shown.colour(stroke));
    }
    legend(&mut text, &view, title, tallest, thickness, &shown);
    text.push_str("</svg>\n");
    text
}

/// What colours show.
enum Shown {
    Utilisation,
    /// Areas between these two.
    Area([f64; 2]),
}

/// Utilisations within this range of one another look the same.
const ALIKE: f64 = 0.05;

impl Shown {
    fn of(strokes: &[Stroke]) -> Shown {
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values
                .filter(|value| value.is_finite())
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        };
        let [least, most] = range(&mut strokes.iter().filter_map(|stroke| stroke.utilisation));
        // Above 1 something is wrong, and red must show it.
        if most - least > ALIKE || most > 1.0 + 1e-6 {
            return Shown::Utilisation;
        }
        let areas = range(&mut strokes.iter().map(|stroke| stroke.area));
        if areas[1] > areas[0] * (1.0 + 1e-9) { Shown::Area(areas) } else { Shown::Utilisation }
    }

    fn colour(&self, stroke: &Stroke) -> String {
        match self {
            Shown::Utilisation => stroke.utilisation.map_or("#999999".into(), colour),
            Shown::Area([low, high]) => colour(((stroke.area - low) / (high - low)).min(1.0)),
        }
    }

    fn words(&self) -> String {
        match self {
            Shown::Utilisation => "utilisation 0 to 1".into(),
            Shown::Area([low, high]) => format!("section area {low:.3e} to {high:.3e}; all are used alike"),
        }
    }
}

/// From space to paper.
struct View {
    scale: f64,
    shift: [f64; 2],
    width: f64,
    height: f64,
}

impl View {
    fn of(strokes: &[Stroke]) -> View {
        let points: Vec<[f64; 2]> = strokes.iter().flat_map(|stroke| stroke.ends).map(isometric).collect();
        let flat: Vec<Vector> = points.iter().map(|p| Vector::new(p[0], p[1], 0.0)).collect();
        let low = flat.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = flat.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let size = high - low;
        let largest = size.x.max(size.y);
        let scale = if largest > 0.0 && diagonal(&flat).is_finite() { (SIZE - 2.0 * MARGIN) / largest } else { 1.0 };
        let shift = [MARGIN - low.x * scale, MARGIN - low.y * scale];
        View { scale, shift, width: (size.x * scale + 2.0 * MARGIN).max(420.0), height: size.y * scale + 2.0 * MARGIN }
    }

    fn mean_length(&self, strokes: &[Stroke]) -> f64 {
        let length = |stroke: &Stroke| {
            let [p, q] = stroke.ends.map(isometric);
            (q[0] - p[0]).hypot(q[1] - p[1]) * self.scale
        };
        strokes.iter().map(length).sum::<f64>() / strokes.len().max(1) as f64
    }

    fn place(&self, point: Vector) -> [f64; 2] {
        let p = isometric(point);
        [p[0] * self.scale + self.shift[0], p[1] * self.scale + self.shift[1]]
    }
}

/// The isometric projection, y downwards as on screens.
fn isometric(p: Vector) -> [f64; 2] {
    [(p.y - p.x) * 3f64.sqrt() / 2.0, (p.x + p.y) / 2.0 - p.z]
}

/// A rib as a quadrilateral, so that tapers show.
fn draw(text: &mut String, view: &View, stroke: &Stroke, thickness: f64, colour: &str) {
    let (p, q) = (view.place(stroke.ends[0]), view.place(stroke.ends[1]));
    let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
    let length = dx.hypot(dy).max(1e-9);
    let half = stroke.heights.map(|h| if h.is_finite() { (h * thickness / 2.0).max(0.3) } else { 0.3 });
    let (nx, ny) = (-dy / length, dx / length);
    let corner = |at: [f64; 2], by: f64| format!("{:.1},{:.1}", at[0] + nx * by, at[1] + ny * by);
    let corners = [corner(p, half[0]), corner(q, half[1]), corner(q, -half[1]), corner(p, -half[0])].join(" ");
    let label = escape(&stroke.label);
    let _ = writeln!(
        text,
        "<polygon points=\"{corners}\" fill=\"{colour}\" stroke=\"white\" stroke-width=\"0.2\"><title>{label}</title></polygon>"
    );
}

fn legend(text: &mut String, view: &View, title: &str, tallest: f64, thickness: f64, shown: &Shown) {
    let y = view.height + 12.0;
    let _ = writeln!(text, "<text x=\"{MARGIN}\" y=\"{:.0}\" font-weight=\"bold\">{}</text>", y, escape(title));
    let half = tallest * thickness / 2.0;
    let (right, middle) = (MARGIN + 30.0, y + 22.0);
    let _ = writeln!(
        text,
        "<rect x=\"{MARGIN}\" y=\"{:.1}\" width=\"30\" height=\"{:.1}\" fill=\"#999999\"/>\
         <text x=\"{:.0}\" y=\"{:.0}\">height {tallest:.3}</text>",
        middle - half,
        2.0 * half,
        right + 8.0,
        middle + 5.0
    );
    let left = right + 130.0;
    for k in 0..20 {
        let (x, fill) = (left + 6.0 * f64::from(k), colour((f64::from(k) + 0.5) / 20.0));
        let _ = writeln!(text, "<rect x=\"{x:.0}\" y=\"{:.0}\" width=\"6.5\" height=\"12\" fill=\"{fill}\"/>", middle - 6.0);
    }
    let _ = writeln!(text, "<text x=\"{:.0}\" y=\"{:.0}\">{}</text>", left + 128.0, middle + 5.0, shown.words());
}

/// Viridis (matplotlib, CC0) from its light end, linear between nine of its colours: what is used fully stands out on white; red above 1.
/// Grey where it is no number.
pub fn shade(value: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 9] = [
        [68., 1., 84.],
        [71., 44., 122.],
        [59., 81., 139.],
        [44., 113., 142.],
        [33., 144., 141.],
        [39., 173., 129.],
        [92., 200., 99.],
        [170., 220., 50.],
        [253., 231., 37.],
    ];
    if value.is_nan() {
        return GREY;
    }
    if value > 1.0 + 1e-6 {
        return [0xd6, 0x27, 0x28];
    }
    let at = (1.0 - value.clamp(0.0, 1.0)) * 8.0;
    let k = (at as usize).min(7);
    let t = at - k as f64;
    std::array::from_fn(|c| (STOPS[k][c] * (1.0 - t) + STOPS[k + 1][c] * t).round() as u8)
}

/// What has no utilisation.
pub const GREY: [u8; 3] = [0x99; 3];

fn colour(value: f64) -> String {
    let [r, g, b] = shade(value);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
