//! The lengths an H beam's formulas are written in, and its moments.

use super::super::Given;
use super::fillets::Fillets;
use crate::expression::graph::{Graph, NodeId};

/// The five lengths every formula is written in, and the root radius where one is given.
pub(super) struct Shape {
    pub tw: NodeId,
    pub hw: NodeId,
    pub b: NodeId,
    /// Thickness of both flanges together.
    pub t: NodeId,
    pub h: NodeId,
    pub fillets: Option<Fillets>,
}

impl Shape {
    pub fn of(graph: &mut Graph, given: &Given) -> Option<Shape> {
        let find = |names: &[&str]| {
            let at = given.form.dimensions.iter().position(|name| names.contains(name));
            at.map(|at| given.dimensions[at])
        };
        let (tw, b) = (find(&["tw", "b1"])?, find(&["b", "b2"])?);
        let t = find(&["t"]).or_else(|| find(&["tf"]).map(|tf| graph.scale(2.0, tf)));
        let fillets = find(&["r"]).map(|r| Fillets { r });
        Some(match (find(&["hw", "h1"]), t, find(&["h", "h2"])) {
            (Some(hw), Some(t), _) => Shape { tw, hw, b, t, h: graph.add(hw, t), fillets },
            (Some(hw), None, Some(h)) => Shape { tw, hw, b, t: graph.subtract(h, hw), h, fillets },
            (None, Some(t), Some(h)) => Shape { tw, hw: graph.subtract(h, t), b, t, h, fillets },
            _ => return None,
        })
    }

    /// Thickness of one flange.
    pub fn tf(&self, graph: &mut Graph) -> NodeId {
        graph.scale(0.5, self.t)
    }

    /// h − tf, between the flanges' middles: hw + tf.
    pub fn arm(&self, graph: &mut Graph) -> NodeId {
        let tf = self.tf(graph);
        graph.add(self.hw, tf)
    }

    /// With what the fillets add, where there are any.
    pub fn with_fillets(
        &self,
        graph: &mut Graph,
        plain: NodeId,
        added: impl Fn(&Fillets, &mut Graph, &Shape) -> NodeId,
    ) -> NodeId {
        match &self.fillets {
            Some(fillets) => {
                let added = added(fillets, graph, self);
                graph.add(plain, added)
            }
            None => plain,
        }
    }

    /// Ix = (tw·hw³ + b·t·(t² + 3·hw² + 3·hw·t))/12: [b·h³ − (b − tw)·hw³]/12 without its cancellation.
    pub fn ix(&self, graph: &mut Graph) -> NodeId {
        let hw3 = graph.power(self.hw, 3.0);
        let web = graph.multiply(self.tw, hw3);
        let (t2, hw2, hwt) = (graph.power(self.t, 2.0), graph.power(self.hw, 2.0), graph.multiply(self.hw, self.t));
        let (hw2, hwt) = (graph.scale(3.0, hw2), graph.scale(3.0, hwt));
        let square = graph.sum(&[t2, hw2, hwt]);
        let flange = graph.multiply(self.b, self.t);
        let flanges = graph.multiply(flange, square);
        let both = graph.add(web, flanges);
        let plain = graph.scale(1.0 / 12.0, both);
        self.with_fillets(graph, plain, |fillets, graph, shape| fillets.second_moment(graph, shape.hw, -1.0))
    }

    /// Iy = (t·b³ + hw·tw³)/12
    pub fn iy(&self, graph: &mut Graph) -> NodeId {
        let (b3, tw3) = (graph.power(self.b, 3.0), graph.power(self.tw, 3.0));
        let (flanges, web) = (graph.multiply(self.t, b3), graph.multiply(self.hw, tw3));
        let both = graph.add(flanges, web);
        let plain = graph.scale(1.0 / 12.0, both);
        self.with_fillets(graph, plain, |fillets, graph, shape| fillets.second_moment(graph, shape.tw, 1.0))
    }
}
