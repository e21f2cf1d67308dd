//! Snapping: vertices to the nearest original vertex within the tolerance, else to the nearest point of the surface.
//!
//! Interior vertices go to interior ones, boundary vertices to boundary ones, corners to corners where one is in reach. A vertex
//! that lies on an original one stays, and none goes farther from where it began than the tolerance. Two to one target: the
//! closer wins. A vertex goes to a point of the surface only where it would not see an original vertex from there, so that a
//! second run finds nothing to do. A move that turns a face over is taken back.

use std::collections::BTreeMap;
use std::collections::HashMap;

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::Action;
use super::original::Original;
use crate::mesh::defects::diagonal;
use crate::mesh::features::{self, FeatureOptions, Role};
use crate::mesh::{PolygonMesh, QuadMesh, Vector};

type Points = RTree<GeomWithData<[f64; 3], u32>>;

/// The original, made ready for snapping.
pub(super) struct Snapper<'a> {
    mesh: &'a PolygonMesh,
    original: &'a Original,
    all: Points,
    /// Original vertices by class.
    classes: [Points; 3],
    /// Moves shorter than this are rounding.
    tiny: f64,
}

/// What a vertex may be snapped to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Class {
    Interior,
    Boundary,
    Corner,
}

/// Where a vertex lies in its mesh, which no move changes.
#[derive(Debug, Clone, Copy)]
enum Place {
    Inside,
    /// On the boundary; a corner by its valence.
    Rim {
        corner: bool,
    },
}

impl Place {
    fn of(mesh: &QuadMesh, v: u32) -> Place {
        if mesh.is_boundary(v) { Place::Rim { corner: mesh.edges_at(v).count() != 3 } } else { Place::Inside }
    }
}

/// Where a vertex wants to go.
#[derive(Clone, Copy)]
struct Target {
    position: Vector,
    /// The original vertex there.
    original: Option<u32>,
    distance: f64,
}

impl<'a> Snapper<'a> {
    pub fn new(mesh: &'a PolygonMesh, original: &'a Original) -> Self {
        let roles = features::find(mesh, FeatureOptions::default()).roles;
        let mut used = vec![false; mesh.vertices.len()];
        mesh.faces().flatten().for_each(|&v| used[v as usize] = true);
        let points = |is_in: &dyn Fn(Role) -> bool| {
            let chosen = (0..mesh.vertices.len()).filter(|&v| used[v] && is_in(roles[v]));
            RTree::bulk_load(chosen.map(|v| GeomWithData::new(mesh.vertices[v].into(), v as u32)).collect())
        };
        let classes =
            [points(&|role| role == Role::Free), points(&|role| role != Role::Free), points(&|role| role == Role::Corner)];
        Snapper { all: points(&|_| true), classes, tiny: 1e-9 * diagonal(&mesh.vertices), mesh, original }
    }

    /// Moves vertices, says what it did and returns whether any moved. `began` is where the vertices were at first.
    pub fn snap(&self, mesh: &mut QuadMesh, began: &[Vector], actions: &mut Vec<Action>) -> bool {
        let used = |v: usize| mesh.spokes(v as u32).next().is_some();
        let target = |v: usize| self.target(&mesh.positions[v], Place::of(mesh, v as u32));
        let mut targets: Vec<Option<Target>> = (0..mesh.vertex_count()).map(|v| if used(v) { target(v) } else { None }).collect();
        self.settle_conflicts(mesh, &mut targets);
        for (target, began) in targets.iter_mut().zip(began) {
            let stays = |t: &Target| t.distance <= self.tiny || (t.position - began).norm() > self.original.tolerance;
            *target = target.filter(|t| !stays(t));
        }
        if targets.iter().all(Option::is_none) {
            return false;
        }
        let before = mesh.positions.clone();
        for (position, target) in mesh.positions.iter_mut().zip(&targets) {
            *position = target.map_or(*position, |target| target.position);
        }
        take_back(mesh, &before, &mut targets, actions);
        if QuadMesh::new(mesh.to_polygons()).is_err() {
            // Two vertices far apart along the mesh came to lie on one another; rare, and told vertex by vertex.
            mesh.positions = before;
            let moved = (1u32..).zip(&targets).filter(|(_, target)| target.is_some());
            actions.extend(moved.map(|(vertex, _)| Action::Undone { vertex, faces: Vec::new() }));
            return false;
        }
        for (vertex, target) in (1u32..).zip(&targets) {
            let Some(Target { original, distance, .. }) = *target else { continue };
            actions.push(match original {
                Some(original) => Action::SnappedToVertex { vertex, original: original + 1, distance },
                None => Action::SnappedToSurface { vertex, distance },
            });
        }
        targets.iter().any(Option::is_some)
    }

    /// A vertex of the mesh's boundary counts as one only where the original's boundary is in reach; elsewhere the mesh is
    /// merely torn.
    fn class_at(&self, p: &Vector, place: Place) -> Class {
        let in_reach = || self.original.boundary.distance(p) <= self.original.tolerance;
        match place {
            Place::Rim { corner } if in_reach() => {
                if corner {
                    Class::Corner
                } else {
                    Class::Boundary
                }
            }
            _ => Class::Interior,
        }
    }

    fn nearest(&self, points: &Points, p: &Vector) -> Option<(u32, f64)> {
        let near = points.nearest_neighbor((*p).into())?;
        Some((near.data, (self.at(near.data) - p).norm()))
    }

    /// The original vertex of its class a point would be snapped to.
    fn vertex(&self, p: &Vector, class: Class) -> Option<u32> {
        let within = |points: &Points| self.nearest(points, p).filter(|near| near.1 <= self.original.tolerance);
        let found = match class {
            Class::Interior => within(&self.classes[0]),
            Class::Boundary => within(&self.classes[1]),
            Class::Corner => within(&self.classes[2]).or_else(|| within(&self.classes[1])),
        };
        found.map(|near| near.0)
    }

    fn target(&self, p: &Vector, place: Place) -> Option<Target> {
        if let Some((v, distance)) = self.nearest(&self.all, p)
            && distance <= self.tiny
        {
            return Some(Target { position: *p, original: Some(v), distance: 0.0 });
        }
        match self.vertex(p, self.class_at(p, place)) {
            Some(v) => Some(Target { position: self.at(v), original: Some(v), distance: (self.at(v) - p).norm() }),
            None => self.on_surface(p, place, None),
        }
    }

    /// The nearest point of the surface (of the boundary, for its vertices), if from there nothing else would be chosen: the same
    /// point again, and no original vertex but `lost`.
    fn on_surface(&self, p: &Vector, place: Place, lost: Option<u32>) -> Option<Target> {
        let position = self.projected(p, self.class_at(p, place))?;
        let distance = (position - p).norm();
        let alone = self.nearest(&self.all, &position).is_none_or(|near| near.1 > self.tiny);
        let class = self.class_at(&position, place);
        let again = self.projected(&position, class).is_some_and(|again| (again - position).norm() <= self.tiny);
        let settled = again && self.vertex(&position, class).is_none_or(|seen| Some(seen) == lost);
        let target = Target { position, original: None, distance };
        (distance <= self.original.tolerance && alone && settled).then_some(target)
    }

    fn projected(&self, p: &Vector, class: Class) -> Option<Vector> {
        let surface = if class == Class::Interior { &self.original.surface } else { &self.original.boundary };
        surface.nearest(p)
    }

    fn at(&self, v: u32) -> Vector {
        self.mesh.vertices[v as usize]
    }

    /// Of several vertices with one target the closest keeps it (of equals, the first).
    fn settle_conflicts(&self, mesh: &QuadMesh, targets: &mut [Option<Target>]) {
        let mut winner: HashMap<u32, (f64, usize)> = HashMap::new();
        for (v, target) in targets.iter().enumerate() {
            if let Some(Target { original: Some(original), distance, .. }) = *target {
                let best = winner.entry(original).or_insert((distance, v));
                if distance < best.0 {
                    *best = (distance, v);
                }
            }
        }
        for (v, target) in targets.iter_mut().enumerate() {
            let Some(original) = target.and_then(|target| target.original) else { continue };
            if winner[&original].1 != v {
                *target = self.on_surface(&mesh.positions[v], Place::of(mesh, v as u32), Some(original));
            }
        }
    }
}

/// Takes back the moves of the corners of faces that turned over or lost an edge, and moves onto other vertices, until there
/// are none.
fn take_back(mesh: &mut QuadMesh, before: &[Vector], targets: &mut [Option<Target>], actions: &mut Vec<Action>) {
    let old = PolygonMesh::from_quads(before.to_vec(), mesh.faces());
    loop {
        let mut spoiled: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for f in 0..mesh.face_count() as u32 {
            let corners = mesh.faces()[f as usize];
            if corners.iter().any(|&v| targets[v as usize].is_some()) && is_spoiled(mesh, &old, f) {
                corners.into_iter().filter(|&v| targets[v as usize].is_some()).for_each(|v| {
                    spoiled.entry(v).or_default().push(f + 1);
                });
            }
        }
        for v in stacked(mesh).filter(|&v| targets[v as usize].is_some()) {
            spoiled.entry(v).or_default();
        }
        if spoiled.is_empty() {
            return;
        }
        for (v, faces) in spoiled {
            mesh.positions[v as usize] = before[v as usize];
            targets[v as usize] = None;
            actions.push(Action::Undone { vertex: v + 1, faces });
        }
    }
}

/// Vertices that share their position with another.
fn stacked(mesh: &QuadMesh) -> impl Iterator<Item = u32> {
    let mut at: HashMap<[u64; 3], Vec<u32>> = HashMap::with_capacity(mesh.vertex_count());
    for v in (0..mesh.vertex_count() as u32).filter(|&v| mesh.spokes(v).next().is_some()) {
        // Adding 0 makes one of the two zeros.
        let key = mesh.positions[v as usize].map(|c| (c + 0.0).to_bits());
        at.entry(key.into()).or_default().push(v);
    }
    at.into_values().filter(|vertices| vertices.len() > 1).flatten()
}

fn is_spoiled(mesh: &QuadMesh, old: &PolygonMesh, f: u32) -> bool {
    let (was, is) = (old.vector_area(f as usize), mesh.vector_area(f));
    let edge = |points: [Vector; 4]| (0..4).map(|k| (points[(k + 1) % 4] - points[k]).norm()).fold(f64::INFINITY, f64::min);
    let face = mesh.faces()[f as usize];
    let (old_edge, new_edge) = (edge(face.map(|v| old.vertices[v as usize])), edge(face.map(|v| mesh.positions[v as usize])));
    was.dot(&is) <= 1e-9 * was.norm_squared() || new_edge <= 1e-9 * old_edge
}
