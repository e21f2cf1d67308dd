//! Feature curves: boundaries and, where asked, creases; and the corners on them.

use super::edge_list::{by_edge, edge_uses};
use super::{PolygonMesh, Vector, angle};

/// What a vertex is for snapping and smoothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// On no feature edge.
    Free,
    /// On a feature curve, between these neighbours along it.
    Curve([u32; 2]),
    /// Where a curve turns sharply, ends or branches.
    Corner,
}

/// Which edges are features, and what that makes of the vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureOptions {
    /// Edges whose faces' normals differ by more than this (radians) are creases; `None`: only boundaries count.
    pub crease: Option<f64>,
    /// A curve that turns by more than this (radians) has a corner there.
    pub corner: f64,
}

impl Default for FeatureOptions {
    fn default() -> Self {
        FeatureOptions { crease: None, corner: std::f64::consts::FRAC_PI_3 }
    }
}

/// Feature edges and roles of a mesh.
#[derive(Debug, Clone)]
pub struct Features {
    /// Feature edges.
    pub edges: Vec<[u32; 2]>,
    /// One role per vertex.
    pub roles: Vec<Role>,
}

/// Finds the features of any polygon mesh.
pub fn find(mesh: &PolygonMesh, options: FeatureOptions) -> Features {
    let edges = feature_edges(mesh, options.crease);
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); mesh.vertices.len()];
    for &[a, b] in &edges {
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    let role = |(v, near): (usize, &Vec<u32>)| match near[..] {
        [] => Role::Free,
        [a, b] if turn(mesh, v as u32, [a, b]) <= options.corner => Role::Curve([a, b]),
        _ => Role::Corner,
    };
    let roles = neighbours.iter().enumerate().map(role).collect();
    Features { edges, roles }
}

fn feature_edges(mesh: &PolygonMesh, crease: Option<f64>) -> Vec<[u32; 2]> {
    let uses = edge_uses(mesh);
    let normal = |f: u32| mesh.vector_area(f as usize);
    let is_feature = |faces: &[u32]| match (faces, crease) {
        ([_], _) => true,
        ([f, g], Some(crease)) => angle(&normal(*f), &normal(*g)) > crease,
        ([_, _], None) => false,
        _ => true,
    };
    let chosen = by_edge(&uses).filter(|uses| is_feature(&uses.iter().map(|u| u.face).collect::<Vec<_>>()));
    chosen.map(|uses| uses[0].edge).collect()
}

/// By how much a curve a–v–b turns at v.
fn turn(mesh: &PolygonMesh, v: u32, [a, b]: [u32; 2]) -> f64 {
    let at = |v: u32| mesh.vertices[v as usize];
    angle(&(at(v) - at(a)), &(at(b) - at(v)))
}

/// The segments of feature edges, for nearest-point queries.
pub fn segments<'a>(mesh: &'a PolygonMesh, features: &'a Features) -> impl Iterator<Item = [Vector; 2]> + 'a {
    features.edges.iter().map(|edge| edge.map(|v| mesh.vertices[v as usize]))
}
