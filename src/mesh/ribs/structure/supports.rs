//! What holds the structure.

use super::super::RibsError;
use crate::mesh::edge_list::{by_edge, edge_uses};
use crate::mesh::network::Network;
use crate::mesh::{NONE, PolygonMesh};

/// Which nodes are held.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Held {
    /// Those on the surface's boundary; without a surface, ends where no other rib meets.
    #[default]
    Boundary,
    /// Those as low as the lowest.
    Lowest,
    /// These: names or patterns.
    Named(Vec<String>),
}

/// Heights nearer than this part of the structure's height are the same.
const SAME: f64 = 1e-6;

/// Names of the nodes that are held, or patterns of them.
///
/// # Errors
/// None at all, or a name that no node has.
pub fn held(network: &Network, mesh: &PolygonMesh, held: &Held) -> Result<Vec<String>, RibsError> {
    let names = |chosen: Vec<bool>| {
        let named = network.joints.iter().zip(chosen).filter(|(_, chosen)| *chosen).map(|(joint, _)| joint.name.clone());
        named.collect::<Vec<String>>()
    };
    let found = match held {
        Held::Boundary => names(on_boundary(network, mesh)),
        Held::Lowest => names(lowest(network)),
        Held::Named(list) => {
            let is_pattern = |name: &str| name.contains(['*', '?']);
            let known = |name: &&String| network.joints.iter().any(|joint| joint.name == **name) || is_pattern(name);
            if let Some(unknown) = list.iter().find(|name| !known(name)) {
                let some = network.joints.iter().take(3).map(|joint| joint.name.as_str()).collect::<Vec<_>>().join(", ");
                return Err(RibsError::UnknownNode { name: unknown.clone(), some });
            }
            list.clone()
        }
    };
    if found.is_empty() { Err(RibsError::NoSupports) } else { Ok(found) }
}

fn on_boundary(network: &Network, mesh: &PolygonMesh) -> Vec<bool> {
    if mesh.face_count() == 0 {
        let mut ends = vec![0; network.joints.len()];
        network.ribs.iter().flat_map(|rib| rib.geometry.joints).for_each(|joint| ends[joint as usize] += 1);
        return ends.into_iter().map(|ends| ends == 1).collect();
    }
    let mut boundary = vec![false; mesh.vertices.len()];
    for uses in by_edge(&edge_uses(mesh)) {
        if let [once] = uses {
            once.edge.into_iter().for_each(|vertex| boundary[vertex as usize] = true);
        }
    }
    network.joints.iter().map(|joint| joint.vertex != NONE && boundary[joint.vertex as usize]).collect()
}

fn lowest(network: &Network) -> Vec<bool> {
    let heights = network.positions().into_iter().map(|place| place.z).collect::<Vec<f64>>();
    let (low, high) = heights.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(*z), high.max(*z)));
    heights.into_iter().map(|z| z - low <= SAME * (high - low)).collect()
}
