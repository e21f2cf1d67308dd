//! `h-beam`: a web tw × hw between two flanges b × tf, overall height h = hw + 2·tf; with fillets of radius r where it is given.
//!
//! The note's names are b1 = tw, b2 = b, h1 = hw, h2 = h, t = 2·tf = h2 − h1 (2.4).

mod fillets;
mod outline;
mod shape;

use super::build::{monomial, radius, symmetric_modulus};
use super::defaults::{Defaults, FLANGE, FLANGE_THICKNESS, PROPORTION, WEB_AND_FLANGE, WEB_THICKNESS};
use super::fibre::{CORNERS, Fibre, Points, UPRIGHT, direction, extreme};
use super::rectangles::{on_axis, plastic_between_flanges, torsion};
use super::{Form, Given, Kind, Length, QUARTER, evaluate, not_positive};
use crate::expression::display::plain;
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Binary;
use crate::geometry::polygon::Ring;
use outline::{Halves, pieces, share_of_equal_area};
use shape::Shape;

/// The doubly symmetric H (or I) beam.
pub struct HBeam;

static FORMS: &[Form] = &[
    Form { kind: "h-beam", dimensions: &["tw", "hw", "b", "tf"] },
    Form { kind: "h-beam", dimensions: &["tw", "hw", "b", "h"] },
    Form { kind: "h-beam", dimensions: &["tw", "b", "tf", "h"] },
    Form { kind: "h-beam", dimensions: &["b1", "h1", "b2", "t"] },
    Form { kind: "h-beam", dimensions: &["b1", "h1", "b2", "h2"] },
    Form { kind: "h-beam", dimensions: &["b1", "b2", "t", "h2"] },
    Form { kind: "h-beam", dimensions: &["tw", "hw", "b", "tf", "r"] },
    Form { kind: "h-beam", dimensions: &["tw", "b", "tf", "h", "r"] },
];

/// The fillets' area (4 − π)·r², as a product.
const ROUNDED: [Length; 2] = [Length { scale: 4.0 - std::f64::consts::PI, plus: 4, minus: None }, Length::of(4)];

/// Web, flanges and fillets of each form, in its dimensions.
static PARTS: [&[[Length; 2]]; 8] = [
    &[[Length::of(0), Length::of(1)], [Length::of(2), Length::twice(3)]],
    &[[Length::of(0), Length::of(1)], [Length::of(2), Length::difference(3, 1.0, 1)]],
    &[[Length::of(0), Length::difference(3, 2.0, 2)], [Length::of(1), Length::twice(2)]],
    &[[Length::of(0), Length::of(1)], [Length::of(2), Length::of(3)]],
    &[[Length::of(0), Length::of(1)], [Length::of(2), Length::difference(3, 1.0, 1)]],
    &[[Length::of(0), Length::difference(3, 1.0, 2)], [Length::of(1), Length::of(2)]],
    &[[Length::of(0), Length::of(1)], [Length::of(2), Length::twice(3)], ROUNDED],
    &[[Length::of(0), Length::difference(3, 2.0, 2)], [Length::of(1), Length::twice(2)], ROUNDED],
];

static DEFAULTS: Defaults = Defaults {
    dimensions: WEB_AND_FLANGE,
    proportions: &[("web-slenderness", "hw <= 5*slenderness*tw"), FLANGE, PROPORTION, WEB_THICKNESS, FLANGE_THICKNESS],
    thickness: 0.006,
    height: ("hw", 1.0),
};

impl Kind for HBeam {
    fn name(&self) -> &'static str {
        "h-beam"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/h-beam.toml")
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn explain_upper_bound(&self, form: &Form, dimension: &str, section: &str) -> Option<String> {
        let given = |name: &str| form.dimensions.contains(&name);
        let height = ["h", "h2"].into_iter().find(|name| given(name)).filter(|_| matches!(dimension, "hw" | "h1"))?;
        Some(format!(
            "with the overall height {section}.{height} given, a taller web takes the place of flange, which is wider: less volume"
        ))
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
            "b1",
            "h1",
            "b2",
            "h2",
            "t",
            "r",
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
            "Iw",
            "Asx",
            "Asy",
            "perimeter",
            "width",
            "height",
        ]
    }

    /// J, Asx = 5/6·2·b·tf and Asy = tw·(h − tf) are those of thin walls: within 4 %, 4 % and 5 % of sectionproperties' finite elements;
    /// with a root radius J is what tables of rolled profiles print. Iw = tf·b³·(h − tf)²/24 with or without.
    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let shape = Shape::of(graph, given)?;
        Some(match name {
            "tw" | "b1" => shape.tw,
            "hw" | "h1" => shape.hw,
            "b" | "b2" => shape.b,
            "t" => shape.t,
            "tf" => shape.tf(graph),
            "r" => shape.fillets.map_or_else(|| graph.constant(0.0), |fillets| fillets.r),
            "h" | "h2" | "height" => shape.h,
            // An H whose web is wider than its flanges is allowed: the wider one counts.
            "width" => graph.binary(Binary::Max, shape.tw, shape.b),
            "A" => {
                let parts = self.parts(graph, given);
                graph.sum(&parts)
            }
            "Ix" => shape.ix(graph),
            "Iy" => shape.iy(graph),
            "Wx" => {
                let ix = shape.ix(graph);
                symmetric_modulus(graph, ix, shape.h)
            }
            "Wy" => {
                let (iy, width) = (shape.iy(graph), graph.binary(Binary::Max, shape.tw, shape.b));
                symmetric_modulus(graph, iy, width)
            }
            "J" => torsion_constant(graph, &shape),
            "Asx" => monomial(graph, 5.0 / 6.0, &[(shape.b, 1.0), (shape.t, 1.0)]),
            "Asy" => {
                let tf = graph.scale(0.5, shape.t);
                let middle = graph.add(shape.hw, tf);
                graph.multiply(shape.tw, middle)
            }
            "Wplx" => {
                let (tf, arm) = (shape.tf(graph), shape.arm(graph));
                let plain = plastic_between_flanges(graph, [shape.b, tf, arm], [shape.tw, shape.hw], 1.0);
                shape.with_fillets(graph, plain, |fillets, graph, shape| fillets.first_moment(graph, shape.hw, -1.0))
            }
            "Wply" => {
                let plain = on_axis(graph, &[(shape.b, shape.t), (shape.tw, shape.hw)]);
                shape.with_fillets(graph, plain, |fillets, graph, shape| fillets.first_moment(graph, shape.tw, 1.0))
            }
            "Iw" => {
                let arm = shape.arm(graph);
                monomial(graph, 1.0 / 48.0, &[(shape.t, 1.0), (shape.b, 3.0), (arm, 2.0)])
            }
            // 4·b + 2·h − 2·tw
            "perimeter" => {
                let double = graph.scale(2.0, shape.b);
                let sum = graph.add(double, shape.h);
                let open = graph.subtract(sum, shape.tw);
                let plain = graph.scale(2.0, open);
                shape.with_fillets(graph, plain, |fillets, graph, _| fillets.shortened(graph))
            }
            _ => return radius(self, graph, given, name),
        })
    }

    fn points(&self, _: &Form) -> Points {
        Points { normal: CORNERS, upright: UPRIGHT, shear: &["junction-top", "junction-bottom", "web-centre"] }
    }

    /// Flange tips carry torsion T·tf/J (in the flange's middle: top, bottom); where web and flange meet shear is Vz·b·tf·(hw + tf)/2/(Ix·tw),
    /// in the web's centre tw·hw²/8 more; torsion T·tw/J there. Against sectionproperties' finite elements: 3 % low at the junction, 1 % at the centre.
    fn fibre(&self, graph: &mut Graph, given: &Given, point: &str) -> Option<Fibre> {
        let shape = Shape::of(graph, given)?;
        let (inertia, torsion) = (shape.ix(graph), self.property(graph, given, "J")?);
        let half_web = graph.scale(0.5, shape.hw);
        let y = match point {
            "junction-top" => half_web,
            "junction-bottom" => graph.scale(-1.0, half_web),
            "web-centre" => graph.constant(0.0),
            _ => {
                let mut fibre = extreme(self, graph, given, point)?;
                if direction(point).is_some_and(|(_, up)| up != 0) {
                    let tf = graph.scale(0.5, shape.t);
                    fibre.per_torque = Some(graph.divide(tf, torsion));
                }
                return Some(fibre);
            }
        };
        let arm = shape.arm(graph);
        let mut statical = monomial(graph, 0.25, &[(shape.b, 1.0), (shape.t, 1.0), (arm, 1.0)]);
        if point == "web-centre" {
            let web = monomial(graph, 0.125, &[(shape.tw, 1.0), (shape.hw, 2.0)]);
            statical = graph.add(statical, web);
            statical = shape.with_fillets(graph, statical, |fillets, graph, shape| {
                let both_sides = fillets.first_moment(graph, shape.hw, -1.0);
                graph.scale(0.5, both_sides)
            });
        }
        let mut fibre = Fibre::at(graph.constant(0.0), y);
        fibre.per_vz = Some(monomial(graph, 1.0, &[(statical, 1.0), (inertia, -1.0), (shape.tw, -1.0)]));
        fibre.per_torque = Some(graph.divide(shape.tw, torsion));
        Some(fibre)
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        let Some(shape) = Shape::of(graph, given) else { return Vec::new() };
        let mut parts = vec![graph.multiply(shape.tw, shape.hw), graph.multiply(shape.b, shape.t)];
        parts.extend(shape.fillets.map(|fillets| fillets.area(graph)));
        parts
    }

    fn part_factors(&self, form: &Form) -> &'static [[Length; 2]] {
        FORMS.iter().position(|known| known == form).map_or(&[], |at| PARTS[at])
    }

    fn positive(&self) -> &'static [&'static str] {
        &["hw", "tf"]
    }

    fn absent(&self, dimension: &str) -> bool {
        dimension == "r"
    }

    /// Fillets that do not fit between the flanges, or beside the web.
    fn defect(&self, form: &Form, given: &[f64], outline: &[Ring]) -> Option<String> {
        let of = |name| evaluate(self, form, given, outline, name);
        let too_large = || {
            let (r, hw, b, tw) = (of("r")?, of("hw")?, of("b")?, of("tw")?);
            let most = (hw / 2.0).min((b - tw) / 2.0);
            (r > most)
                .then(|| format!("r is {}; between the flanges and beside the web there is room for {}", plain(r), plain(most)))
        };
        let rounded = form.dimensions.contains(&"r");
        not_positive(self.name(), form, given, outline).or_else(|| rounded.then(too_large).flatten())
    }

    fn posynomial_volume(&self, form: &Form) -> bool {
        !form.dimensions.iter().any(|name| ["h", "h2"].contains(name))
    }

    fn rings(&self, form: &Form, given: &[f64], outline: &[Ring], tolerance: f64) -> Vec<Ring> {
        let drawn = |(halves, r): (Halves, f64)| match r > 0.0 {
            true => halves.rounded(r, pieces(r, tolerance), 1.0),
            false => halves.sharp(),
        };
        halves(form, given, outline).map(drawn).into_iter().collect()
    }

    fn matching_rings(&self, form: &Form, given: &[f64], outline: &[Ring]) -> Vec<Ring> {
        let drawn = |(halves, r): (Halves, f64)| match r > 0.0 {
            true => halves.rounded(r, QUARTER, share_of_equal_area(QUARTER)),
            false => halves.sharp(),
        };
        halves(form, given, outline).map(drawn).into_iter().collect()
    }
}

/// Of thin walls, or with the fillets.
fn torsion_constant(graph: &mut Graph, shape: &Shape) -> NodeId {
    let tf = shape.tf(graph);
    match &shape.fillets {
        Some(fillets) => fillets.torsion(graph, [shape.b, tf], [shape.hw, shape.tw]),
        None => torsion(graph, &[(shape.b, tf), (shape.b, tf), (shape.hw, shape.tw)]),
    }
}

/// Half lengths and the root radius at numeric dimensions.
fn halves(form: &Form, given: &[f64], outline: &[Ring]) -> Option<(Halves, f64)> {
    let of = |name| evaluate(&HBeam, form, given, outline, name);
    let half = |name| of(name).map(|value| value / 2.0);
    Some((Halves { web: half("tw")?, clear: half("hw")?, flange: half("b")?, height: half("h")? }, of("r")?))
}
