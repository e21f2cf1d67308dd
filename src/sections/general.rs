//! `general`: area, moments, torsion constant and moduli as numbers of their own, as rolled sections and bars of trusses have them.

use super::build::radius;
use super::fibre::{CORNERS, Fibre, Points, UPRIGHT, direction};
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// A section of which only numbers are known. It has no outline: no pictures, no solids.
pub struct General;

const fn form(dimensions: &'static [&'static str]) -> Form {
    Form { kind: "general", dimensions }
}

/// A bar has A alone; a plane frame A and Ix; a frame in space or a grillage J as well. Moduli and shear areas where one has them.
static FORMS: &[Form] = &[
    form(&["A"]),
    form(&["A", "Ix"]),
    form(&["A", "Ix", "Wx"]),
    form(&["A", "Ix", "Asy"]),
    form(&["A", "Ix", "Wx", "Asy"]),
    form(&["A", "Ix", "J"]),
    form(&["A", "Ix", "J", "Wx"]),
    form(&["A", "Ix", "Iy"]),
    form(&["A", "Ix", "Iy", "Wx"]),
    form(&["A", "Ix", "Iy", "Wx", "Wy"]),
    form(&["A", "Ix", "Iy", "J"]),
    form(&["A", "Ix", "Iy", "J", "Wx"]),
    form(&["A", "Ix", "Iy", "J", "Wx", "Wy"]),
    form(&["A", "Ix", "Iy", "J", "Asx", "Asy"]),
    form(&["A", "Ix", "Iy", "J", "Wx", "Wy", "Asx", "Asy"]),
];

impl Kind for General {
    fn name(&self) -> &'static str {
        "general"
    }

    fn example(&self) -> &'static str {
        include_str!("examples/general.toml")
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &["A", "Ix", "Iy", "J", "Wx", "Wy", "Asx", "Asy", "ix", "iy"]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        match given.form.dimensions.iter().position(|known| *known == name) {
            Some(at) => given.dimensions.get(at).copied(),
            None => radius(self, graph, given, name),
        }
    }

    fn points(&self, form: &Form) -> Points {
        let has = |name: &str| form.dimensions.contains(&name);
        match (has("Wx"), has("Wy")) {
            (true, true) => Points { normal: CORNERS, upright: UPRIGHT, shear: &[] },
            (true, false) => Points { normal: UPRIGHT, upright: UPRIGHT, shear: &[] },
            _ => Points { normal: &["centre"], upright: &["centre"], shear: &[] },
        }
    }

    /// The edges lie where the moduli say: I/W from the centroid.
    fn fibre(&self, graph: &mut Graph, given: &Given, point: &str) -> Option<Fibre> {
        let (right, up) = direction(point)?;
        let mut edge = |side: i8, moment: &str, modulus: &str| {
            if side == 0 {
                return Some(graph.constant(0.0));
            }
            let (moment, modulus) = (self.property(graph, given, moment)?, self.property(graph, given, modulus)?);
            let distance = graph.divide(moment, modulus);
            Some(graph.scale(f64::from(side), distance))
        };
        Some(Fibre::at(edge(right, "Iy", "Wy")?, edge(up, "Ix", "Wx")?))
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    fn posynomial_volume(&self, _: &Form) -> bool {
        true
    }

    fn has_rings(&self) -> bool {
        false
    }

    fn rings(&self, _: &Form, _: &[f64], _: &[Ring], _: f64) -> Vec<Ring> {
        Vec::new()
    }
}
