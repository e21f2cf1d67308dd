//! The four fillets of radius r between an H beam's web and flanges: each a square r × r less a quarter of a circle.
//!
//! About either side of the square such a fillet has
//! area (1 − π/4)·r², first moment (5/6 − π/4)·r³, second moment (1 − 5π/16)·r⁴.

use std::f64::consts::{FRAC_PI_4, PI};

use super::super::build::monomial;
use crate::expression::graph::{Graph, NodeId};

const AREA: f64 = 1.0 - FRAC_PI_4;
const FIRST: f64 = 5.0 / 6.0 - FRAC_PI_4;
const SECOND: f64 = 1.0 - 5.0 * PI / 16.0;

/// All four.
pub(super) struct Fillets {
    pub r: NodeId,
}

impl Fillets {
    /// 4·(1 − π/4)·r²
    pub fn area(&self, graph: &mut Graph) -> NodeId {
        monomial(graph, 4.0 * AREA, &[(self.r, 2.0)])
    }

    /// ∫d² dA about the axis half of `clear` away from the square's sides, the fillets lying towards it (`away` −1: of Ix, `clear` the
    /// web's height) or beyond (+1: of Iy, `clear` the web's thickness).
    pub fn second_moment(&self, graph: &mut Graph, clear: NodeId, away: f64) -> NodeId {
        let terms = [
            monomial(graph, AREA, &[(self.r, 2.0), (clear, 2.0)]),
            monomial(graph, 4.0 * away * FIRST, &[(self.r, 3.0), (clear, 1.0)]),
            monomial(graph, 4.0 * SECOND, &[(self.r, 4.0)]),
        ];
        graph.sum(&terms)
    }

    /// ∫|d| dA about the same axis.
    pub fn first_moment(&self, graph: &mut Graph, clear: NodeId, away: f64) -> NodeId {
        let terms =
            [monomial(graph, 2.0 * AREA, &[(self.r, 2.0), (clear, 1.0)]), monomial(graph, 4.0 * away * FIRST, &[(self.r, 3.0)])];
        graph.sum(&terms)
    }

    /// What they take off the outline's length: each two sides r for a quarter of a circle.
    pub fn shortened(&self, graph: &mut Graph) -> NodeId {
        graph.scale(2.0 * PI - 8.0, self.r)
    }

    /// J = 2/3·(b − 0.63·tf)·tf³ + hw·tw³/3 + 2·α·D⁴, D = ((r + tw/2)² + (r + tf)² − r²)/(2r + tf) the circle inscribed where web and flange
    /// meet, α = (0.145 + 0.1·r/tf)·tw/tf (El Darwish and Johnston, *Torsion of structural shapes*, J. Struct. Div. ASCE 91, 1965): what
    /// tables of rolled profiles print.
    pub fn torsion(&self, graph: &mut Graph, [b, tf]: [NodeId; 2], [hw, tw]: [NodeId; 2]) -> NodeId {
        let r = self.r;
        let flanges = [
            monomial(graph, 2.0 / 3.0, &[(b, 1.0), (tf, 3.0)]),
            monomial(graph, -0.42, &[(tf, 4.0)]),
            monomial(graph, 1.0 / 3.0, &[(hw, 1.0), (tw, 3.0)]),
        ];
        let half_web = graph.scale(0.5, tw);
        let (beside, above) = (graph.add(r, half_web), graph.add(r, tf));
        let squares =
            [monomial(graph, 1.0, &[(beside, 2.0)]), monomial(graph, 1.0, &[(above, 2.0)]), monomial(graph, -1.0, &[(r, 2.0)])];
        let (double, square) = (graph.scale(2.0, r), graph.sum(&squares));
        let depth = graph.add(double, tf);
        let circle = graph.divide(square, depth);
        let junctions = [
            monomial(graph, 0.29, &[(tw, 1.0), (tf, -1.0), (circle, 4.0)]),
            monomial(graph, 0.2, &[(tw, 1.0), (r, 1.0), (tf, -2.0), (circle, 4.0)]),
        ];
        graph.sum(&[flanges.as_slice(), junctions.as_slice()].concat())
    }
}
