//! Which vertices move, and towards what.

use super::{Curves, Options};
use crate::mesh::closest::Surface;
use crate::mesh::features::{self, Role};
use crate::mesh::{PolygonMesh, QuadMesh, Vector};

/// For every vertex the neighbours whose mean draws it; none for fixed ones.
pub(super) struct Constraints {
    /// Where each vertex's neighbours begin in `neighbours`, one more than vertices.
    first: Vec<u32>,
    neighbours: Vec<u32>,
    sliding: Vec<bool>,
    /// The feature curves as they were.
    curves: Option<Surface>,
}

impl Constraints {
    pub fn new(polygons: &PolygonMesh, mesh: &QuadMesh, options: &Options) -> Self {
        let features = features::find(polygons, options.features);
        let slide = options.curves == Curves::Slide;
        let mut constraints = Constraints { first: vec![0], neighbours: Vec::new(), sliding: Vec::new(), curves: None };
        for (v, role) in features.roles.iter().enumerate() {
            match role {
                Role::Free => constraints.neighbours.extend(mesh.neighbours(v as u32)),
                Role::Curve(ends) if slide => constraints.neighbours.extend(ends),
                _ => {}
            }
            constraints.first.push(constraints.neighbours.len() as u32);
            constraints.sliding.push(slide && matches!(role, Role::Curve(_)));
        }
        if slide {
            constraints.curves = Some(Surface::of_segments(features::segments(polygons, &features)));
        }
        constraints
    }

    fn neighbours(&self, v: usize) -> &[u32] {
        &self.neighbours[self.first[v] as usize..self.first[v + 1] as usize]
    }

    /// Where vertex `v` goes by a step of `factor` towards its neighbours' mean; `None` if it stays.
    pub fn moved(&self, positions: &[Vector], v: usize, factor: f64) -> Option<Vector> {
        let moved = positions[v] + self.pull(positions, v)? * factor;
        let curve = self.curves.as_ref().filter(|_| self.sliding[v]);
        Some(curve.and_then(|curve| curve.nearest(&moved)).unwrap_or(moved))
    }

    /// From vertex `v` to the mean of its neighbours (3.3.1).
    fn pull(&self, positions: &[Vector], v: usize) -> Option<Vector> {
        let near = self.neighbours(v);
        let sum: Vector = near.iter().map(|&n| positions[n as usize]).sum();
        (!near.is_empty()).then(|| sum / near.len() as f64 - positions[v])
    }

    /// Puts free vertices onto a surface; sliding ones keep to their curves.
    pub fn project(&self, positions: &mut [Vector], surface: &Surface) {
        for (v, position) in positions.iter_mut().enumerate() {
            if !self.sliding[v] && !self.neighbours(v).is_empty() {
                *position = surface.nearest(position).unwrap_or(*position);
            }
        }
    }

    /// Root mean square of the pulls.
    pub fn roughness(&self, positions: &[Vector]) -> f64 {
        let pulls: Vec<f64> = (0..positions.len()).filter_map(|v| self.pull(positions, v)).map(|p| p.norm_squared()).collect();
        (pulls.iter().sum::<f64>() / pulls.len().max(1) as f64).sqrt()
    }

    /// Free, sliding and fixed vertices.
    pub fn counts(&self) -> [usize; 3] {
        let moving = (0..self.sliding.len()).filter(|&v| !self.neighbours(v).is_empty()).count();
        let sliding = self.sliding.iter().filter(|&&sliding| sliding).count();
        [moving - sliding, sliding, self.sliding.len() - moving]
    }
}
