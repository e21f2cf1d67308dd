//! `polygon`: any simple polygon, with or without holes, its points times a `scale`, or times `scale_x` across and `scale_y` upwards; note 2.5.

use super::build::monomial;
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::Polygon as Shape;
use crate::geometry::polygon::{PolygonError, Ring};

/// A polygon given by the points of its rings, scaled.
pub struct Polygon;

static FORMS: &[Form] =
    &[Form { kind: "polygon", dimensions: &["scale"] }, Form { kind: "polygon", dimensions: &["scale_x", "scale_y"] }];

/// The polygon at scale 1.
fn shape(outline: &[Ring]) -> Result<Shape, PolygonError> {
    let outer = outline.first().cloned().unwrap_or_default();
    Shape::new(outer, outline.iter().skip(1).cloned().collect())
}

impl Kind for Polygon {
    fn name(&self) -> &'static str {
        "polygon"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/polygon.toml")
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "scale",
            "scale_x",
            "scale_y",
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
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "width",
            "height",
        ]
    }

    /// Every property is its value at scale 1 times powers of the scales. `scale` of two scales is their geometric mean.
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let (x, y) = match *given.dimensions {
            [scale] => (scale, scale),
            [x, y] => (x, y),
            _ => return None,
        };
        match name {
            "scale_x" => return Some(x),
            "scale_y" => return Some(y),
            "scale" if given.dimensions.len() == 1 => return Some(x),
            "scale" => return Some(monomial(graph, 1.0, &[(x, 0.5), (y, 0.5)])),
            _ => {}
        }
        let shape = shape(given.outline).ok()?;
        let own = shape.properties();
        let extent = |d: usize| {
            let reach = |sign: f64| shape.outer().iter().map(|v| sign * (v[d] - own.centroid[d])).fold(0.0, f64::max);
            reach(1.0) + reach(-1.0)
        };
        let (factor, x_power, y_power) = match name {
            "A" => (own.area, 1.0, 1.0),
            "Ix" => (own.ix, 1.0, 3.0),
            "Iy" => (own.iy, 3.0, 1.0),
            "Ixy" => (own.ixy, 2.0, 2.0),
            "Wx" => (own.wx(), 1.0, 2.0),
            "Wx_top" => (own.wx_top, 1.0, 2.0),
            "Wx_bottom" => (own.wx_bottom, 1.0, 2.0),
            "Wy" => (own.wy(), 2.0, 1.0),
            "Wy_left" => (own.wy_left, 2.0, 1.0),
            "Wy_right" => (own.wy_right, 2.0, 1.0),
            "Wplx" => (shape.plastic_modulus(1), 1.0, 2.0),
            "Wply" => (shape.plastic_modulus(0), 2.0, 1.0),
            "ix" => ((own.ix / own.area).sqrt(), 0.0, 1.0),
            "iy" => ((own.iy / own.area).sqrt(), 1.0, 0.0),
            "width" => (extent(0), 1.0, 0.0),
            "height" => (extent(1), 0.0, 1.0),
            _ => return None,
        };
        let powers: Vec<_> = [(x, x_power), (y, y_power)].into_iter().filter(|(_, power)| *power > 0.0).collect();
        Some(monomial(graph, factor, &powers))
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    fn posynomial_volume(&self, _: &Form) -> bool {
        true
    }

    fn has_outline(&self) -> bool {
        true
    }

    fn takes_holes(&self) -> bool {
        true
    }

    fn outline_defect(&self, _: &Form, outline: &[Ring]) -> Option<String> {
        shape(outline).err().map(|error| error.to_string())
    }

    fn rings(&self, _: &Form, given: &[f64], outline: &[Ring], _: f64) -> Vec<Ring> {
        let (Some(x), Some(y)) = (given.first(), given.last()) else { return Vec::new() };
        let Ok(shape) = shape(outline) else { return Vec::new() };
        let [cx, cy] = shape.properties().centroid;
        let scaled = |ring: &Ring| ring.iter().map(|v| [x * (v[0] - cx), y * (v[1] - cy)]).collect();
        shape.rings().iter().map(scaled).collect()
    }
}
