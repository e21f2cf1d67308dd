//! Bounds that do not fit the mesh: most often a mesh in other units.

use super::{Bounds, Options, Unit, span};
use crate::mesh::network::Network;
use crate::mesh::rounded;

/// A beam whose height is less than its span over this is no beam for a sag limit of span/300: steel at its strength would
/// sag more (a uniformly loaded beam: sag/S = 5/24·(f/E)·(S/h), which is 1/48 at h = S/60 with f/E = 1/600).
const SLIMMEST: f64 = 60.0;

/// In words, one per bound that is off.
pub(super) fn find(network: &Network, options: &Options, bounds: &[Bounds]) -> Vec<String> {
    let mut found = Vec::new();
    let (height, times) = options.kind.height();
    let longest = network.ribs.iter().map(span).fold(0.0, f64::max);
    if let Some(bound) = bounds.iter().find(|bound| bound.dimension == height && times * bound.upper < longest / SLIMMEST) {
        found.push(format!(
            "the upper bound of {height}, {}, is below 1/60 of the longest span, {}: no such section is stiff enough",
            bound.upper,
            rounded(longest)
        ));
    }
    let shortest = network.ribs.iter().map(|rib| rib.geometry.length()).fold(f64::INFINITY, f64::min);
    for bound in bounds.iter().filter(|bound| options.kind.is_length(&bound.dimension) && bound.lower > shortest) {
        found.push(format!(
            "the lower bound of {}, {}, is above the shortest rib, {}: the sections are longer than the ribs",
            bound.dimension,
            bound.lower,
            rounded(shortest)
        ));
    }
    if !found.is_empty() {
        let unit = options.unit.map_or("metres, which nobody said", Unit::name);
        found.push(format!(
            "bounds and loads are in {unit}; is the mesh? --unit mm, cm, m or in says so for all three, --bounds sets others"
        ));
    }
    found
}
