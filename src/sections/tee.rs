//! `tee`: a web tw × hw under a flange b × tf, overall height h = hw + tf.

use super::build::{monomial, radius, symmetric_modulus};
use super::defaults::{Defaults, FLANGE, FLANGE_THICKNESS, PROPORTION, WEB_AND_FLANGE, WEB_THICKNESS};
use super::rectangles::{Band, on_axis, plastic_modulus, torsion};
use super::{Form, Given, Kind, Length, evaluate};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Binary;
use crate::geometry::polygon::Ring;

/// The T section, flange on top.
pub struct Tee;

static FORMS: &[Form] = &[
    Form { kind: "tee", dimensions: &["tw", "hw", "b", "tf"] },
    Form { kind: "tee", dimensions: &["tw", "hw", "b", "h"] },
    Form { kind: "tee", dimensions: &["tw", "b", "tf", "h"] },
];

/// Web and flange of each form, in its dimensions.
static PARTS: [[[Length; 2]; 2]; 3] = [
    [[Length::of(0), Length::of(1)], [Length::of(2), Length::of(3)]],
    [[Length::of(0), Length::of(1)], [Length::of(2), Length::difference(3, 1.0, 1)]],
    [[Length::of(0), Length::difference(3, 1.0, 2)], [Length::of(1), Length::of(2)]],
];

struct Shape {
    tw: NodeId,
    hw: NodeId,
    b: NodeId,
    tf: NodeId,
    h: NodeId,
}

impl Shape {
    fn of(graph: &mut Graph, given: &Given) -> Option<Shape> {
        let find = |name| given.form.dimensions.iter().position(|known| *known == name).map(|at| given.dimensions[at]);
        let (tw, b) = (find("tw")?, find("b")?);
        Some(match (find("hw"), find("tf"), find("h")) {
            (Some(hw), Some(tf), _) => Shape { tw, hw, b, tf, h: graph.add(hw, tf) },
            (Some(hw), None, Some(h)) => Shape { tw, hw, b, tf: graph.subtract(h, hw), h },
            (None, Some(tf), Some(h)) => Shape { tw, hw: graph.subtract(h, tf), b, tf, h },
            _ => return None,
        })
    }

    fn web(&self, graph: &mut Graph) -> NodeId {
        graph.multiply(self.tw, self.hw)
    }

    fn flange(&self, graph: &mut Graph) -> NodeId {
        graph.multiply(self.b, self.tf)
    }

    fn area(&self, graph: &mut Graph) -> NodeId {
        let (web, flange) = (self.web(graph), self.flange(graph));
        graph.add(web, flange)
    }

    /// Ix = tw·hw³/12 + b·tf³/12 + web·flange/A·(h/2)²: the parts' middles are h/2 apart.
    fn ix(&self, graph: &mut Graph) -> NodeId {
        let own = [
            monomial(graph, 1.0 / 12.0, &[(self.tw, 1.0), (self.hw, 3.0)]),
            monomial(graph, 1.0 / 12.0, &[(self.b, 1.0), (self.tf, 3.0)]),
        ];
        let (web, flange, area) = (self.web(graph), self.flange(graph), self.area(graph));
        let steiner = monomial(graph, 0.25, &[(web, 1.0), (flange, 1.0), (self.h, 2.0), (area, -1.0)]);
        graph.sum(&[own[0], own[1], steiner])
    }

    /// Iy = (hw·tw³ + tf·b³)/12
    fn iy(&self, graph: &mut Graph) -> NodeId {
        let (web, flange) = (
            monomial(graph, 1.0 / 12.0, &[(self.hw, 1.0), (self.tw, 3.0)]),
            monomial(graph, 1.0 / 12.0, &[(self.tf, 1.0), (self.b, 3.0)]),
        );
        graph.add(web, flange)
    }

    /// Distance from the centroid to the flange's upper edge: (flange·tf/2 + web·(tf + hw/2))/A.
    fn to_top(&self, graph: &mut Graph) -> NodeId {
        let halves = [graph.scale(0.5, self.hw), self.tf];
        let arm = graph.sum(&halves);
        self.distance(graph, (self.tf, 0.5), (arm, 1.0))
    }

    /// Distance from the centroid to the web's lower edge: (flange·(hw + tf/2) + web·hw/2)/A.
    fn to_bottom(&self, graph: &mut Graph) -> NodeId {
        let halves = [self.hw, graph.scale(0.5, self.tf)];
        let arm = graph.sum(&halves);
        self.distance(graph, (arm, 1.0), (self.hw, 0.5))
    }

    /// (flange·arm + web·arm)/A, arms with their factors.
    fn distance(&self, graph: &mut Graph, flange_arm: (NodeId, f64), web_arm: (NodeId, f64)) -> NodeId {
        let (web, flange, area) = (self.web(graph), self.flange(graph), self.area(graph));
        let first = [
            monomial(graph, flange_arm.1, &[(flange, 1.0), (flange_arm.0, 1.0)]),
            monomial(graph, web_arm.1, &[(web, 1.0), (web_arm.0, 1.0)]),
        ];
        let moment = graph.sum(&first);
        graph.divide(moment, area)
    }

    fn wx_top(&self, graph: &mut Graph) -> NodeId {
        let (ix, distance) = (self.ix(graph), self.to_top(graph));
        graph.divide(ix, distance)
    }

    fn wx_bottom(&self, graph: &mut Graph) -> NodeId {
        let (ix, distance) = (self.ix(graph), self.to_bottom(graph));
        graph.divide(ix, distance)
    }
}

static DEFAULTS: Defaults = Defaults {
    dimensions: WEB_AND_FLANGE,
    proportions: &[("web-slenderness", "hw <= 2*slenderness*tw"), FLANGE, PROPORTION, WEB_THICKNESS, FLANGE_THICKNESS],
    thickness: 0.006,
    height: ("hw", 1.0),
};

impl Kind for Tee {
    fn name(&self) -> &'static str {
        "tee"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/tee.toml")
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &[
            "tw",
            "hw",
            "b",
            "tf",
            "h",
            "A",
            "Ix",
            "Iy",
            "Wx",
            "Wx_top",
            "Wx_bottom",
            "Wy",
            "Wplx",
            "Wply",
            "ix",
            "iy",
            "perimeter",
            "J",
            "Asx",
            "Asy",
            "y_top",
            "y_bottom",
            "width",
            "height",
        ]
    }

    /// `y_top` and `y_bottom` are the centroid's distances from the edges. J = (b·tf³ + hw·tw³)/3 (thin walls; within 6 % of sectionproperties),
    /// shear areas 5/6·tw·(hw + tf/2) (within 8 %) and 5/6·b·tf (within 5 %).
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let shape = Shape::of(graph, given)?;
        Some(match name {
            "tw" => shape.tw,
            "hw" => shape.hw,
            "b" => shape.b,
            "tf" => shape.tf,
            "h" | "height" => shape.h,
            "width" => graph.binary(Binary::Max, shape.tw, shape.b),
            "A" => shape.area(graph),
            "Ix" => shape.ix(graph),
            "Iy" => shape.iy(graph),
            "y_top" => shape.to_top(graph),
            "y_bottom" => shape.to_bottom(graph),
            "Wx_top" => shape.wx_top(graph),
            "Wx_bottom" => shape.wx_bottom(graph),
            "Wx" => {
                let (top, bottom) = (shape.wx_top(graph), shape.wx_bottom(graph));
                graph.binary(Binary::Min, top, bottom)
            }
            "Wy" => {
                let (iy, width) = (shape.iy(graph), graph.binary(Binary::Max, shape.tw, shape.b));
                symmetric_modulus(graph, iy, width)
            }
            "J" => torsion(graph, &[(shape.b, shape.tf), (shape.hw, shape.tw)]),
            "Asx" => monomial(graph, 5.0 / 6.0, &[(shape.b, 1.0), (shape.tf, 1.0)]),
            "Asy" => {
                let half = graph.scale(0.5, shape.tf);
                let depth = graph.add(shape.hw, half);
                monomial(graph, 5.0 / 6.0, &[(shape.tw, 1.0), (depth, 1.0)])
            }
            "Wplx" => {
                let (web, flange) = (Band { width: shape.tw, thickness: shape.hw }, Band { width: shape.b, thickness: shape.tf });
                plastic_modulus(graph, &[web, flange])
            }
            "Wply" => on_axis(graph, &[(shape.b, shape.tf), (shape.tw, shape.hw)]),
            "perimeter" => {
                let sum = graph.add(shape.b, shape.h);
                graph.scale(2.0, sum)
            }
            _ => return radius(self, graph, given, name),
        })
    }

    /// Web and flange.
    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        let Some(shape) = Shape::of(graph, given) else { return Vec::new() };
        vec![shape.web(graph), shape.flange(graph)]
    }

    fn part_factors(&self, form: &Form) -> &'static [[Length; 2]] {
        FORMS.iter().position(|known| known == form).map_or(&[], |at| &PARTS[at])
    }

    fn positive(&self) -> &'static [&'static str] {
        &["hw", "tf"]
    }

    fn posynomial_volume(&self, form: &Form) -> bool {
        !form.dimensions.contains(&"h")
    }

    fn rings(&self, form: &Form, given: &[f64], outline: &[Ring], _: f64) -> Vec<Ring> {
        let of = |name| evaluate(self, form, given, outline, name);
        let names = [of("tw"), of("b"), of("tf"), of("y_top"), of("y_bottom")];
        let [Some(tw), Some(b), Some(tf), Some(top), Some(bottom)] = names else { return Vec::new() };
        let (w, x, under) = (tw / 2.0, b / 2.0, top - tf);
        vec![vec![[-w, -bottom], [w, -bottom], [w, under], [x, under], [x, top], [-x, top], [-x, under], [-w, under]]]
    }
}
