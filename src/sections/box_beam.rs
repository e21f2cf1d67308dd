//! `box`: outer width b and height h, wall thicknesses tw (webs, upright) and tf (flanges, level).

use super::build::{monomial, radius, symmetric_modulus};
use super::defaults::{Defaults, PROPORTION, WEB_THICKNESS, length};
use super::rectangles::plastic_between_flanges;
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// The rectangular hollow section.
pub struct BoxBeam;

static FORMS: &[Form] = &[Form { kind: "box", dimensions: &["b", "h", "tw", "tf"] }];

/// One direction's lengths: the walls that bend as webs (thickness `web`, along `depth`) and as flanges.
struct Shape {
    width: NodeId,
    depth: NodeId,
    web: NodeId,
    flange: NodeId,
    /// Clear inner width and depth.
    inner_width: NodeId,
    inner_depth: NodeId,
}

impl Shape {
    fn of(graph: &mut Graph, width: NodeId, depth: NodeId, web: NodeId, flange: NodeId) -> Self {
        let mut clear = |outer, wall| {
            let walls = graph.scale(2.0, wall);
            graph.subtract(outer, walls)
        };
        let (inner_width, inner_depth) = (clear(width, web), clear(depth, flange));
        Shape { width, depth, web, flange, inner_width, inner_depth }
    }

    /// A = 2·b·tf + 2·tw·(h − 2tf)
    fn area(&self, graph: &mut Graph) -> NodeId {
        let flanges = monomial(graph, 2.0, &[(self.width, 1.0), (self.flange, 1.0)]);
        let webs = monomial(graph, 2.0, &[(self.web, 1.0), (self.inner_depth, 1.0)]);
        graph.add(flanges, webs)
    }

    /// I = tw·hi³/6 + b·tf·(tf² + 3·(h − tf)²)/6, hi = h − 2tf: (b·h³ − bi·hi³)/12 without its cancellation.
    fn moment(&self, graph: &mut Graph) -> NodeId {
        let webs = monomial(graph, 1.0 / 6.0, &[(self.web, 1.0), (self.inner_depth, 3.0)]);
        let arm = graph.subtract(self.depth, self.flange);
        let (own, steiner) = (graph.power(self.flange, 2.0), monomial(graph, 3.0, &[(arm, 2.0)]));
        let square = graph.add(own, steiner);
        let flanges = monomial(graph, 1.0 / 6.0, &[(self.width, 1.0), (self.flange, 1.0), (square, 1.0)]);
        graph.add(webs, flanges)
    }

    fn plastic(&self, graph: &mut Graph) -> NodeId {
        let arm = graph.subtract(self.depth, self.flange);
        plastic_between_flanges(graph, [self.width, self.flange, arm], [self.web, self.inner_depth], 2.0)
    }

    /// Width and depth between the walls' middles.
    fn middle_line(&self, graph: &mut Graph) -> (NodeId, NodeId) {
        (graph.subtract(self.width, self.web), graph.subtract(self.depth, self.flange))
    }

    /// Bredt: 4·Am²/∮ds/t along the middle line. Low by 2 % for thin walls, by 10 % for walls of a quarter of the width.
    fn torsion(&self, graph: &mut Graph) -> NodeId {
        let (width, depth) = self.middle_line(graph);
        let (level, upright) = (graph.divide(width, self.flange), graph.divide(depth, self.web));
        let half_way = graph.add(level, upright);
        monomial(graph, 2.0, &[(width, 2.0), (depth, 2.0), (half_way, -1.0)])
    }

    /// Cowper's thin-walled box (*J. Appl. Mech.* 33, 1966) at ν = 0, middle-line width b and depth h, m = b·tf/(h·tw), n = b/h:
    /// A·10(1 + 3m)²/(12 + 72m + 150m² + 90m³ + 30n²(m + m²)). Low by up to 4 % of sectionproperties' value for thin walls,
    /// by 19 % where the walls are a fifth of the width.
    fn shear_area(&self, graph: &mut Graph) -> NodeId {
        let (width, depth) = self.middle_line(graph);
        let n = graph.divide(width, depth);
        let walls = graph.divide(self.flange, self.web);
        let m = graph.multiply(n, walls);
        let (one, threefold) = (graph.constant(1.0), graph.scale(3.0, m));
        let sum = graph.add(one, threefold);
        let bending =
            [graph.constant(12.0), graph.scale(72.0, m), monomial(graph, 150.0, &[(m, 2.0)]), monomial(graph, 90.0, &[(m, 3.0)])];
        let wide = [monomial(graph, 30.0, &[(n, 2.0), (m, 1.0)]), monomial(graph, 30.0, &[(n, 2.0), (m, 2.0)])];
        let divisor = graph.sum(&[bending.as_slice(), wide.as_slice()].concat());
        let area = self.area(graph);
        monomial(graph, 10.0, &[(area, 1.0), (sum, 2.0), (divisor, -1.0)])
    }
}

static DEFAULTS: Defaults = Defaults {
    dimensions: &[
        length("b", 0.05, 0.5, 0.15),
        length("h", 0.06, 1.5, 0.3),
        length("tw", 0.004, 0.02, 0.008),
        length("tf", 0.004, 0.02, 0.008),
    ],
    proportions: &[
        ("web-slenderness", "h <= 5*slenderness*tw"),
        ("flange-slenderness", "b <= 5*slenderness*tf"),
        PROPORTION,
        WEB_THICKNESS,
        ("flange-thickness", "tf >= thickness"),
    ],
    thickness: 0.005,
    height: ("h", 1.0),
};

impl Kind for BoxBeam {
    fn name(&self) -> &'static str {
        "box"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/box.toml")
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "b",
            "h",
            "tw",
            "tf",
            "bi",
            "hi",
            "A",
            "Ix",
            "Iy",
            "Wx",
            "Wy",
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "J",
            "Asx",
            "Asy",
            "perimeter",
            "width",
            "height",
        ]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let [b, h, tw, tf] = *given.dimensions else { return None };
        let (upright, level) = (Shape::of(graph, b, h, tw, tf), Shape::of(graph, h, b, tf, tw));
        Some(match name {
            "b" | "width" => b,
            "h" | "height" => h,
            "tw" => tw,
            "tf" => tf,
            "bi" => upright.inner_width,
            "hi" => upright.inner_depth,
            "A" => upright.area(graph),
            "Ix" => upright.moment(graph),
            "Iy" => level.moment(graph),
            "Wx" => {
                let moment = upright.moment(graph);
                symmetric_modulus(graph, moment, h)
            }
            "Wy" => {
                let moment = level.moment(graph);
                symmetric_modulus(graph, moment, b)
            }
            "J" => upright.torsion(graph),
            "Asx" => level.shear_area(graph),
            "Asy" => upright.shear_area(graph),
            "Wplx" => upright.plastic(graph),
            "Wply" => level.plastic(graph),
            // The outer one, which is painted.
            "perimeter" => {
                let sum = graph.add(b, h);
                graph.scale(2.0, sum)
            }
            _ => return radius(self, graph, given, name),
        })
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    fn positive(&self) -> &'static [&'static str] {
        &["bi", "hi"]
    }

    fn rings(&self, _: &Form, given: &[f64], _: &[Ring], _: f64) -> Vec<Ring> {
        let [b, h, tw, tf] = *given else { return Vec::new() };
        let (x, y) = (b / 2.0, h / 2.0);
        let (xi, yi) = (x - tw, y - tf);
        vec![vec![[-x, -y], [x, -y], [x, y], [-x, y]], vec![[-xi, -yi], [-xi, yi], [xi, yi], [xi, -yi]]]
    }
}
