//! `polyline`: a thin-walled section along points, with one `thickness` or one per segment, `thickness[1]`, …; note 3.6.
//!
//! A form must name its dimensions, so that there is one form per number of segments: up to [`MOST_SEGMENTS`] thicknesses of their own, and any number
//! of segments of one thickness. The line is closed where its last point repeats its first.
//!
//! The outline's vertices are linear in the thicknesses ([`Centreline::outline`]), so that every property is an exact expression in them. Which corners
//! are mitred or cut depends on the points alone, never on the thicknesses.

use super::build::{extreme, monomial};
use super::outline::Outline;
use super::{Form, Given, Kind, not_positive};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Binary;
use crate::geometry::polygon::Ring;
use crate::geometry::{Centreline, Polygon, PolylineError};

/// A strip along a line.
pub struct Polyline;

/// Most segments with a thickness each.
pub const MOST_SEGMENTS: usize = 16;

const EACH: &[&str; MOST_SEGMENTS] = &[
    "thickness[1]",
    "thickness[2]",
    "thickness[3]",
    "thickness[4]",
    "thickness[5]",
    "thickness[6]",
    "thickness[7]",
    "thickness[8]",
    "thickness[9]",
    "thickness[10]",
    "thickness[11]",
    "thickness[12]",
    "thickness[13]",
    "thickness[14]",
    "thickness[15]",
    "thickness[16]",
];

static FORMS: [Form; MOST_SEGMENTS + 1] = forms();

const fn forms() -> [Form; MOST_SEGMENTS + 1] {
    let mut forms = [const { Form { kind: "polyline", dimensions: &["thickness"] } }; MOST_SEGMENTS + 1];
    let mut segments = 1;
    while segments <= MOST_SEGMENTS {
        forms[segments] = Form { kind: "polyline", dimensions: EACH.split_at(segments).0 };
        segments += 1;
    }
    forms
}

/// What every line offers besides the thickness of each segment.
const COMMON: [&str; 15] = [
    "thickness",
    "A",
    "Ix",
    "Iy",
    "Ixy",
    "Wx",
    "Wx_top",
    "Wx_bottom",
    "Wy",
    "Wy_left",
    "Wy_right",
    "J",
    "width",
    "height",
    "clear",
];

static PROPERTIES: [&str; COMMON.len() + MOST_SEGMENTS] = properties();

const fn properties() -> [&'static str; COMMON.len() + MOST_SEGMENTS] {
    let mut all = [""; COMMON.len() + MOST_SEGMENTS];
    let mut at = 0;
    while at < all.len() {
        all[at] = if at < COMMON.len() { COMMON[at] } else { EACH[at - COMMON.len()] };
        at += 1;
    }
    all
}

/// One thickness for all segments?
fn uniform(form: &Form) -> bool {
    form.dimensions == ["thickness"]
}

fn centreline(outline: &[Ring]) -> Result<Centreline, PolylineError> {
    Centreline::new(outline.first().cloned().unwrap_or_default(), false)
}

/// The thickness of a segment.
fn thickness(given: &Given, segment: usize) -> Option<NodeId> {
    given.dimensions.get(if uniform(given.form) { 0 } else { segment }).copied()
}

/// One thickness each: Σ length·t³/3 for an open line; for a closed one Bredt's 4·Am²/Σ(length/t), Am the area inside the line.
fn torsion(graph: &mut Graph, given: &Given, line: &Centreline) -> Option<NodeId> {
    let (factor, power) = if line.is_closed() { (1.0, -1.0) } else { (1.0 / 3.0, 3.0) };
    let mut terms = Vec::with_capacity(line.segments());
    for segment in 0..line.segments() {
        let thickness = thickness(given, segment)?;
        terms.push(monomial(graph, factor * line.segment_length(segment), &[(thickness, power)]));
    }
    let sum = graph.sum(&terms);
    if !line.is_closed() {
        return Some(sum);
    }
    let enclosed = Polygon::new(line.points().to_vec(), Vec::new()).ok()?.area();
    Some(monomial(graph, 4.0 * enclosed * enclosed, &[(sum, -1.0)]))
}

/// Σ length·thickness/Σ length
fn mean_thickness(graph: &mut Graph, given: &Given, line: &Centreline) -> Option<NodeId> {
    let mut terms = Vec::with_capacity(line.segments());
    for segment in 0..line.segments() {
        terms.push(graph.scale(line.segment_length(segment) / line.length(), thickness(given, segment)?));
    }
    Some(graph.sum(&terms))
}

impl Kind for Polyline {
    fn name(&self) -> &'static str {
        "polyline"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/polyline.toml")
    }

    fn forms(&self) -> &'static [Form] {
        &FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &PROPERTIES
    }

    /// `clear` is the shortest side of the outline along a segment: the outline folds over where it is not positive.
    /// J neglects the corners (thin walls). `thickness` of several is their mean over the length.
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        if let Some(at) = given.form.dimensions.iter().position(|known| *known == name) {
            return Some(given.dimensions[at]);
        }
        let line = centreline(given.outline).ok()?;
        if !uniform(given.form) && line.segments() != given.form.dimensions.len() {
            return None;
        }
        if let Some(segment) = EACH.iter().position(|known| *known == name) {
            return (segment < line.segments()).then(|| thickness(given, segment)).flatten();
        }
        if name == "thickness" {
            return mean_thickness(graph, given, &line);
        }
        if name == "J" {
            return torsion(graph, given, &line);
        }
        let outline = Outline::new(graph, &line, !uniform(given.form), |segment| thickness(given, segment))?;
        match name {
            "A" => Some(outline.area(graph)),
            "Ix" => Some(outline.moment(graph, 1)),
            "Iy" => Some(outline.moment(graph, 0)),
            "Ixy" => Some(outline.product_moment(graph)),
            "Wx_top" => outline.modulus(graph, 1, 1.0),
            "Wx_bottom" => outline.modulus(graph, 1, -1.0),
            "Wy_right" => outline.modulus(graph, 0, 1.0),
            "Wy_left" => outline.modulus(graph, 0, -1.0),
            "Wx" | "Wy" => {
                let axis = usize::from(name == "Wx");
                let both = [outline.modulus(graph, axis, 1.0)?, outline.modulus(graph, axis, -1.0)?];
                extreme(graph, Binary::Min, &both)
            }
            "width" => outline.extent(graph, 0),
            "height" => outline.extent(graph, 1),
            "clear" => outline.clear(graph),
            _ => None,
        }
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    fn positive(&self) -> &'static [&'static str] {
        &["clear"]
    }

    fn has_outline(&self) -> bool {
        true
    }

    fn outline_defect(&self, form: &Form, outline: &[Ring]) -> Option<String> {
        let line = match centreline(outline) {
            Ok(line) => line,
            Err(error) => return Some(error.to_string()),
        };
        let (segments, given) = (line.segments(), form.dimensions.len());
        let fits = uniform(form) || segments == given;
        (!fits).then(|| format!("{given} thicknesses for {segments} segments; give one each, or one for all"))
    }

    fn defect(&self, form: &Form, given: &[f64], outline: &[Ring]) -> Option<String> {
        let defect = self.outline_defect(form, outline).or_else(|| not_positive(self.name(), form, given, outline));
        defect.or_else(|| {
            let mut rings = self.rings(form, given, outline, 0.0).into_iter();
            let outer = rings.next()?;
            Polygon::new(outer, rings.collect()).err().map(|error| error.to_string())
        })
    }

    fn rings(&self, form: &Form, given: &[f64], outline: &[Ring], _: f64) -> Vec<Ring> {
        let Ok(line) = centreline(outline) else { return Vec::new() };
        let thickness = |segment: usize| given.get(if uniform(form) { 0 } else { segment }).copied().unwrap_or(f64::NAN);
        let at = |ring: Vec<crate::geometry::polyline::OffsetVertex>| ring.iter().map(|vertex| vertex.at(thickness)).collect();
        let mut rings: Vec<Ring> = line.outline(!uniform(form)).into_iter().map(at).collect();
        let sums = rings.iter().map(|ring| crate::geometry::polygon::ring_moments(ring, [0.0; 2])).reduce(|a, b| a + b);
        let Some(sums) = sums else { return rings };
        let centroid = [sums.sy / sums.area, sums.sx / sums.area];
        for vertex in rings.iter_mut().flatten() {
            *vertex = [vertex[0] - centroid[0], vertex[1] - centroid[1]];
        }
        rings
    }
}
