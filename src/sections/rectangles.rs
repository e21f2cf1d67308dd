//! Formulas of sections made of upright rectangles, whichever the kind.

use super::build::monomial;
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Binary;

/// Σ length·thickness³/3: the torsion constant of thin walls without fillets.
pub(super) fn torsion(graph: &mut Graph, walls: &[(NodeId, NodeId)]) -> NodeId {
    let terms: Vec<NodeId> =
        walls.iter().map(|(length, thickness)| monomial(graph, 1.0 / 3.0, &[(*length, 1.0), (*thickness, 3.0)])).collect();
    graph.sum(&terms)
}

/// Σ thickness·extent²/4 over (extent across the axis, thickness along it): the plastic modulus about an axis through the middles of all.
pub(super) fn on_axis(graph: &mut Graph, rectangles: &[(NodeId, NodeId)]) -> NodeId {
    let quarters: Vec<NodeId> =
        rectangles.iter().map(|(extent, thickness)| monomial(graph, 0.25, &[(*thickness, 1.0), (*extent, 2.0)])).collect();
    graph.sum(&quarters)
}

/// b·tf·arm + webs·tw·hw²/4: the plastic modulus of two like flanges whose middles are `arm` apart, with webs between them.
pub(super) fn plastic_between_flanges(graph: &mut Graph, [b, tf, arm]: [NodeId; 3], [tw, hw]: [NodeId; 2], webs: f64) -> NodeId {
    let flanges = monomial(graph, 1.0, &[(b, 1.0), (tf, 1.0), (arm, 1.0)]);
    let web = monomial(graph, 0.25 * webs, &[(tw, 1.0), (hw, 2.0)]);
    graph.add(flanges, web)
}

/// A layer of a section: as wide all through.
#[derive(Clone, Copy)]
pub(super) struct Band {
    pub width: NodeId,
    pub thickness: NodeId,
}

/// ∫|y − c| dA over layers from one edge to the other, c the level with half the area on either side: the plastic modulus.
///
/// p_k is what of layer k lies before c: (A/2 − the areas before it)/width, from 0 to its thickness. Where c passes from one
/// layer to the next the modulus has a first derivative (it is the least of ∫|y − c| dA over c), but the second one jumps.
pub(super) fn plastic_modulus(graph: &mut Graph, bands: &[Band]) -> NodeId {
    let before = parts_before(graph, bands);
    let after: Vec<NodeId> = bands.iter().zip(&before).map(|(band, p)| graph.subtract(band.thickness, *p)).collect();
    let mut terms = Vec::new();
    for (k, band) in bands.iter().enumerate() {
        // The own halves squared, and whole distances to c beyond the layer.
        let (p, q) = (before[k], after[k]);
        terms.push(monomial(graph, 0.5, &[(band.width, 1.0), (p, 2.0)]));
        terms.push(monomial(graph, 0.5, &[(band.width, 1.0), (q, 2.0)]));
        for later in &before[k + 1..] {
            terms.push(monomial(graph, 1.0, &[(band.width, 1.0), (p, 1.0), (*later, 1.0)]));
        }
        for earlier in &after[..k] {
            terms.push(monomial(graph, 1.0, &[(band.width, 1.0), (q, 1.0), (*earlier, 1.0)]));
        }
    }
    graph.sum(&terms)
}

fn parts_before(graph: &mut Graph, bands: &[Band]) -> Vec<NodeId> {
    let areas: Vec<NodeId> = bands.iter().map(|band| graph.multiply(band.width, band.thickness)).collect();
    let zero = graph.constant(0.0);
    let part = |(k, band): (usize, &Band)| {
        // A/2 less the areas before, without the cancellation of A: half of what comes from here on less half of what was.
        let (earlier, rest) = (graph.sum(&areas[..k]), graph.sum(&areas[k..]));
        let difference = graph.subtract(rest, earlier);
        let half = graph.scale(0.5, difference);
        let depth = graph.divide(half, band.width);
        let from = if k == 0 { depth } else { graph.binary(Binary::Max, depth, zero) };
        // Of the last one never more than half remains.
        if k + 1 == bands.len() { from } else { graph.binary(Binary::Min, from, band.thickness) }
    };
    bands.iter().enumerate().map(part).collect()
}
