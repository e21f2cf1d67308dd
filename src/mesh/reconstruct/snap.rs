//! Snapping: vertices to the nearest original vertex within the tolerance, else to the nearest point of the surface.
//!
//! Free vertices go to free ones, boundary vertices to boundary ones, corners to corners. Distance is taken from the point
//! already projected to the surface, so that a vertex snapped once finds the same target again. Two to one target: the
//! closer wins, the other goes to the surface. A move that turns a face over is taken back.

use std::collections::BTreeMap;

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::Action;
use crate::mesh::closest::Surface;
use crate::mesh::defects::diagonal;
use crate::mesh::features::{self, FeatureOptions, Role};
use crate::mesh::{PolygonMesh, QuadMesh, Vector};

type Points = RTree<GeomWithData<[f64; 3], u32>>;

/// The original, made ready for snapping.
pub(super) struct Snapper<'a> {
    original: &'a PolygonMesh,
    surface: &'a Surface,
    boundary: Surface,
    /// Original vertices by class: free, on the boundary, corners.
    vertices: [Points; 3],
    tolerance: f64,
    /// Moves shorter than this are rounding.
    tiny: f64,
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
    pub fn new(original: &'a PolygonMesh, surface: &'a Surface, tolerance: f64) -> Self {
        let features = features::find(original, FeatureOptions::default());
        let mut used = vec![false; original.vertices.len()];
        original.faces().flatten().for_each(|&v| used[v as usize] = true);
        let points = |class: usize| {
            let chosen = (0..original.vertices.len()).filter(|&v| used[v] && class_of(features.roles[v]) == class);
            RTree::bulk_load(chosen.map(|v| GeomWithData::new(original.vertices[v].into(), v as u32)).collect())
        };
        Snapper {
            boundary: Surface::of_segments(features::segments(original, &features)),
            vertices: [points(0), points(1), points(2)],
            tiny: 1e-9 * diagonal(&original.vertices),
            original,
            surface,
            tolerance,
        }
    }

    /// Moves vertices, says what it did and returns the longest move.
    pub fn snap(&self, mesh: &mut QuadMesh, actions: &mut Vec<Action>) -> f64 {
        let roles = features::find(&mesh.to_polygons(), FeatureOptions::default()).roles;
        let used = |v: usize| mesh.spokes(v as u32).next().is_some();
        let mut targets: Vec<Option<Target>> =
            (0..roles.len()).map(|v| if used(v) { self.target(&mesh.positions[v], class_of(roles[v])) } else { None }).collect();
        self.settle_conflicts(mesh, &roles, &mut targets);
        targets.iter_mut().for_each(|target| *target = target.filter(|target| target.distance > self.tiny));

        let before = mesh.positions.clone();
        for (position, target) in mesh.positions.iter_mut().zip(&targets) {
            *position = target.map_or(*position, |target| target.position);
        }
        take_back(mesh, &before, &mut targets, actions);
        let mut largest = 0.0f64;
        for (vertex, target) in (1u32..).zip(&targets) {
            let Some(Target { original, distance, .. }) = *target else { continue };
            largest = largest.max(distance);
            actions.push(match original {
                Some(original) => Action::SnappedToVertex { vertex, original: original + 1, distance },
                None => Action::SnappedToSurface { vertex, distance },
            });
        }
        largest
    }

    fn projected(&self, point: &Vector, class: usize) -> Option<Vector> {
        let on_boundary = if class == 0 { None } else { self.boundary.nearest(point) };
        on_boundary.or_else(|| self.surface.nearest(point))
    }

    fn target(&self, point: &Vector, class: usize) -> Option<Target> {
        let on_surface = self.projected(point, class)?;
        let nearest = self.vertices[class].nearest_neighbor(on_surface.into());
        let near = nearest.map(|near| near.data).filter(|&v| (self.at(v) - on_surface).norm() <= self.tolerance);
        let position = near.map_or(on_surface, |v| self.at(v));
        Some(Target { position, original: near, distance: (position - point).norm() })
    }

    fn at(&self, v: u32) -> Vector {
        self.original.vertices[v as usize]
    }

    /// Of several vertices with one target the closest keeps it (of equals, the first).
    fn settle_conflicts(&self, mesh: &QuadMesh, roles: &[Role], targets: &mut [Option<Target>]) {
        let mut winner: BTreeMap<u32, (f64, usize)> = BTreeMap::new();
        for (v, target) in targets.iter().enumerate() {
            if let Some(Target { original: Some(original), distance, .. }) = *target {
                let best = winner.entry(original).or_insert((distance, v));
                if distance < best.0 {
                    *best = (distance, v);
                }
            }
        }
        for v in 0..targets.len() {
            let lost = targets[v].and_then(|t| t.original).is_some_and(|original| winner[&original].1 != v);
            if lost {
                let point = mesh.positions[v];
                let surface = self.projected(&point, class_of(roles[v]));
                targets[v] = surface.map(|position| Target { position, original: None, distance: (position - point).norm() });
            }
        }
    }
}

fn class_of(role: Role) -> usize {
    match role {
        Role::Free => 0,
        Role::Curve(_) => 1,
        Role::Corner => 2,
    }
}

/// Takes back the moves of the corners of faces that turned over or lost an edge, until there are none.
fn take_back(mesh: &mut QuadMesh, before: &[Vector], targets: &mut [Option<Target>], actions: &mut Vec<Action>) {
    let old = PolygonMesh::from_quads(before.to_vec(), mesh.faces());
    loop {
        let mut spoiled: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for f in 0..mesh.face_count() as u32 {
            if is_spoiled(mesh, &old, f) {
                let corners = mesh.faces()[f as usize];
                corners.into_iter().filter(|&v| targets[v as usize].is_some()).for_each(|v| {
                    spoiled.entry(v).or_default().push(f + 1);
                });
            }
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

fn is_spoiled(mesh: &QuadMesh, old: &PolygonMesh, f: u32) -> bool {
    let (was, is) = (old.vector_area(f as usize), mesh.vector_area(f));
    let edge = |points: [Vector; 4]| (0..4).map(|k| (points[(k + 1) % 4] - points[k]).norm()).fold(f64::INFINITY, f64::min);
    let face = mesh.faces()[f as usize];
    let (old_edge, new_edge) = (edge(face.map(|v| old.vertices[v as usize])), edge(face.map(|v| mesh.positions[v as usize])));
    was.dot(&is) <= 1e-9 * was.norm_squared() || new_edge <= 1e-9 * old_edge
}
