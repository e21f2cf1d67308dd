//! A kind for tests: a diamond with diagonals p (level) and q (upright). Nothing but this file and its line in [`super::KINDS`] knows it;
//! `run::toy_kind` uses it everywhere.

use super::build::{monomial, radius};
use super::defaults::{Defaults, length};
use super::{Form, Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// The diamond p × q.
pub struct Diamond;

static FORMS: &[Form] = &[Form { kind: "diamond", dimensions: &["p", "q"] }];

static DEFAULTS: Defaults = Defaults {
    dimensions: &[length("p", 0.02, 0.5, 0.1), length("q", 0.04, 1.5, 0.3)],
    proportions: &[("slenderness", "q <= slenderness*p"), ("thickness", "p >= thickness")],
    thickness: 0.03,
    height: ("q", 1.0),
};

impl Kind for Diamond {
    fn name(&self) -> &'static str {
        "diamond"
    }

    fn example(&self) -> &'static str {
        "[sections.s]\nkind = \"diamond\"\np = { lower = 0.02, upper = 0.5 }\nq = { lower = 0.05, upper = 1.0 }\n\
         [[ribs]]\nname = \"r\"\nsection = \"s\"\nlength = 3\n\
         [[constraints]]\nname = \"stiff\"\nrequire = \"s.Ix >= 1e-5\"\n\
         [[constraints]]\nname = \"upright\"\nrequire = \"s.q <= 5*s.p\"\n"
    }

    fn defaults(&self) -> Option<&'static Defaults> {
        Some(&DEFAULTS)
    }

    fn explain_upper_bound(&self, _: &Form, dimension: &str, section: &str) -> Option<String> {
        Some(format!("{section}.{dimension} cuts like a diamond"))
    }

    fn forms(&self) -> &'static [Form] {
        FORMS
    }

    fn properties(&self) -> &'static [&'static str] {
        &["p", "q", "A", "Ix", "Iy", "Wx", "Wy", "ix", "iy", "width", "height"]
    }

    fn property(&self, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
        let (p, q) = (given.dimensions[0], given.dimensions[1]);
        let mut product = |factor, p_power, q_power| monomial(graph, factor, &[(p, p_power), (q, q_power)]);
        Some(match name {
            "p" | "width" => p,
            "q" | "height" => q,
            "A" => product(0.5, 1.0, 1.0),
            "Ix" => product(1.0 / 48.0, 1.0, 3.0),
            "Iy" => product(1.0 / 48.0, 3.0, 1.0),
            "Wx" => product(1.0 / 24.0, 1.0, 2.0),
            "Wy" => product(1.0 / 24.0, 2.0, 1.0),
            _ => return radius(self, graph, given, name),
        })
    }

    fn parts(&self, graph: &mut Graph, given: &Given) -> Vec<NodeId> {
        self.property(graph, given, "A").into_iter().collect()
    }

    fn posynomial_volume(&self, _: &Form) -> bool {
        true
    }

    fn rings(&self, _: &Form, given: &[f64], _: &[Ring], _: f64) -> Vec<Ring> {
        let (p, q) = (given[0] / 2.0, given[1] / 2.0);
        vec![vec![[p, 0.0], [0.0, q], [-p, 0.0], [0.0, -q]]]
    }
}
