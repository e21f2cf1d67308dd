//! Points of a section at which stresses are looked at: where they lie, and the shear stress that a unit force makes there.
//!
//! Names say where a point lies: `top` is +y of the section (the member's +z), `right` is +x (the member's +y).

use super::build::monomial;
use super::{Given, Kind};
use crate::expression::graph::{Graph, NodeId};

/// One point. Coordinates are taken from the centroid.
#[derive(Debug, Clone, Copy)]
pub struct Fibre {
    /// X, along the width.
    pub x: NodeId,
    /// Y, along the height.
    pub y: NodeId,
    /// Shear stress per unit of the shear force along the width.
    pub per_vy: Option<NodeId>,
    /// Shear stress per unit of the shear force along the height.
    pub per_vz: Option<NodeId>,
    /// Shear stress per unit of torque.
    pub per_torque: Option<NodeId>,
}

impl Fibre {
    /// A point without shear stress.
    pub(super) fn at(x: NodeId, y: NodeId) -> Fibre {
        Fibre { x, y, per_vy: None, per_vz: None, per_torque: None }
    }
}

/// The critical points of a kind.
#[derive(Debug, Clone, Copy)]
pub struct Points {
    /// Where normal stress has its extremes in bending about both axes.
    pub normal: &'static [&'static str],
    /// Where it has them in bending about the horizontal axis alone.
    pub upright: &'static [&'static str],
    /// Further points where shear stress counts; empty where the kind knows no shear stresses.
    pub shear: &'static [&'static str],
}

/// Corners.
pub(super) const CORNERS: &[&str] = &["top-left", "top-right", "bottom-left", "bottom-right"];

/// Top and bottom.
pub(super) const UPRIGHT: &[&str] = &["top", "bottom"];

/// How far a named place lies to the right and up, −1, 0 or 1; `None` for another name.
pub(super) fn direction(point: &str) -> Option<(i8, i8)> {
    Some(match point {
        "centre" => (0, 0),
        "top" => (0, 1),
        "bottom" => (0, -1),
        "left" => (-1, 0),
        "right" => (1, 0),
        "top-left" => (-1, 1),
        "top-right" => (1, 1),
        "bottom-left" => (-1, -1),
        "bottom-right" => (1, -1),
        _ => return None,
    })
}

/// A named place on the rectangle around the section: by the distances of its edges from the centroid where the kind tells them, else by
/// half its width and height.
pub(super) fn extreme<K: Kind + ?Sized>(kind: &K, graph: &mut Graph, given: &Given, point: &str) -> Option<Fibre> {
    let (right, up) = direction(point)?;
    let mut edge = |side: i8, names: [&str; 2], extent: &str| -> Option<NodeId> {
        let name = match side {
            0 => return Some(graph.constant(0.0)),
            1 => names[1],
            _ => names[0],
        };
        let distance = match kind.property(graph, given, name) {
            Some(distance) => distance,
            None => {
                let extent = kind.property(graph, given, extent)?;
                graph.scale(0.5, extent)
            }
        };
        Some(graph.scale(f64::from(side), distance))
    };
    let x = edge(right, ["x_left", "x_right"], "width")?;
    let y = edge(up, ["y_bottom", "y_top"], "height")?;
    Some(Fibre::at(x, y))
}

/// Eight points of a circle.
pub(super) const AROUND: &[&str] = &["top", "top-right", "right", "bottom-right", "bottom", "bottom-left", "left", "top-left"];

/// A named point on a circle. `factor`/A is the shear stress per force at the ends of the diameter across it (Timoshenko, Strength of
/// Materials I, §26: 4/3 of the mean in a full circle, twice the mean in a thin tube); elsewhere it falls off with the cosine. In the
/// centre there is neither bending nor torsion.
pub(super) fn around<K: Kind + ?Sized>(kind: &K, graph: &mut Graph, given: &Given, factor: f64, point: &str) -> Option<Fibre> {
    let (diameter, area) = (kind.property(graph, given, "width")?, kind.property(graph, given, "A")?);
    let torsion = kind.property(graph, given, "J")?;
    let per_force = monomial(graph, factor, &[(area, -1.0)]);
    let (right, up) = direction(point)?;
    let size = f64::from(right).hypot(f64::from(up));
    if size == 0.0 {
        let zero = graph.constant(0.0);
        return Some(Fibre { per_vy: Some(per_force), per_vz: Some(per_force), ..Fibre::at(zero, zero) });
    }
    let (cosine, sine) = (f64::from(right) / size, f64::from(up) / size);
    let mut fibre = Fibre::at(graph.scale(0.5 * cosine, diameter), graph.scale(0.5 * sine, diameter));
    // Both are tangential: anticlockwise is positive.
    fibre.per_vz = (right != 0).then(|| graph.scale(cosine, per_force));
    fibre.per_vy = (up != 0).then(|| graph.scale(-sine, per_force));
    let radius = graph.scale(0.5, diameter);
    fibre.per_torque = Some(graph.divide(radius, torsion));
    Some(fibre)
}
