//! Whether a new face belongs to the surface. It must have a face's shape, lie on the original as a whole, hide nothing of the
//! original's boundary, and cover nothing that is there already.

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::original::{Original, bilinear};
use crate::mesh::closest::{Surface, closest_on_triangle, on_segment};
use crate::mesh::{QuadMesh, Vector, angle};

/// The flattest corner a new quad may have; beyond, three vertices of a smooth boundary would make a sliver.
const FLATTEST: f64 = 165.0 * std::f64::consts::PI / 180.0;

/// The same for the last face of a hole, whose corners are all given: it must only be no triangle.
const FLATTEST_OF_HOLE: f64 = 179.0 * std::f64::consts::PI / 180.0;

/// A point inside a new face is at least this part of its distance to the rim away from all other faces; a neighbour folded back by
/// more than 150° (sin 30° = 1/2) counts as lying over it.
const CLEAR: f64 = 0.5;

/// Steps along a boundary segment beyond which a reach is so short that nothing is hidden to speak of.
const MOST_STEPS: f64 = 1e4;

/// The part of a segment within `radius` of a point, roughly: its ends moved to the nearest point's parameter ± the radius.
fn clip(a: &Vector, b: &Vector, centre: &Vector, radius: f64) -> [Vector; 2] {
    let (along, length) = (b - a, (b - a).norm());
    if length <= 2.0 * radius {
        return [*a, *b];
    }
    let t = along.dot(&(centre - a)) / (length * length);
    [t - radius / length, t + radius / length].map(|t| a + along * t.clamp(0.0, 1.0))
}

/// What is there: the mesh with all faces added so far.
pub(super) struct Built {
    faces: Surface,
    vertices: RTree<GeomWithData<[f64; 3], u32>>,
}

impl Built {
    pub fn new(mesh: &QuadMesh) -> Self {
        let used = (0..mesh.vertex_count() as u32).filter(|&v| mesh.spokes(v).next().is_some());
        let point = |v: u32| GeomWithData::new(mesh.positions[v as usize].into(), v);
        Built { faces: Surface::of_faces(&mesh.to_polygons()), vertices: RTree::bulk_load(used.map(point).collect()) }
    }

    /// From the nearest face.
    pub fn distance(&self, p: &Vector) -> f64 {
        self.faces.distance(p)
    }

    pub fn add_vertex(&mut self, v: u32, position: Vector) {
        self.vertices.insert(GeomWithData::new(position.into(), v));
    }

    pub fn add_face(&mut self, [a, b, c, d]: [Vector; 4]) {
        self.faces.insert([a, b, c]);
        self.faces.insert([a, c, d]);
    }
}

/// A face that may be added.
pub(super) struct Candidate {
    /// Its vertices; of a new one, its number to be.
    pub vertices: [u32; 4],
    pub points: [Vector; 4],
    /// Whether it is the last of a hole.
    pub closes: bool,
}

impl Candidate {
    /// Whether all tests are passed.
    pub fn is_accepted(&self, original: &Original, built: &Built) -> bool {
        let side = |k: usize| (self.points[(k + 1) % 4] - self.points[k]).norm();
        let shortest = (0..4).map(side).fold(f64::INFINITY, f64::min);
        let reach = original.reach(shortest);
        self.has_shape()
            && original.carries(&self.points, reach)
            && !self.hides_boundary(original, reach)
            && !self.covers(built)
            && !self.meets_vertex(built, reach)
    }

    /// Convex in the plane of its vector area, with no corner nearly straight.
    fn has_shape(&self) -> bool {
        let [a, b, c, d] = self.points;
        let area = (c - a).cross(&(d - b));
        let flattest = if self.closes { FLATTEST_OF_HOLE } else { FLATTEST };
        (0..4).all(|k| {
            let at = |by: usize| self.points[(k + by) % 4];
            let (u, v) = (at(1) - at(0), at(3) - at(0));
            let between = angle(&u, &v);
            u.cross(&v).dot(&area) > 0.0 && between < flattest && between > std::f64::consts::PI - flattest
        })
    }

    /// Whether the original's boundary runs inside the face, farther than `reach` from its rim: the original is open there.
    fn hides_boundary(&self, original: &Original, reach: f64) -> bool {
        let (low, high) = self.bounding_box(reach);
        let inside = |p: &Vector| self.distance(p) <= reach && self.rim_distance(p) > reach;
        original.boundary.pieces_in(&low, &high).any(|[a, b, _]| {
            // Steps of half the reach; a long segment is cut to the part near the face first.
            let [from, to] = clip(a, b, &((low + high) / 2.0), (high - low).norm() / 2.0);
            let steps = (2.0 * (to - from).norm() / reach).ceil().clamp(1.0, MOST_STEPS) as u32;
            (0..=steps).any(|k| inside(&from.lerp(&to, f64::from(k) / f64::from(steps))))
        })
    }

    /// Whether a face that is there lies over this one.
    fn covers(&self, built: &Built) -> bool {
        const AT: [f64; 3] = [0.25, 0.5, 0.75];
        let clear = |p: Vector| built.faces.distance(&p) >= CLEAR * self.rim_distance(&p);
        !AT.iter().all(|&u| AT.iter().all(|&v| clear(bilinear(&self.points, u, v))))
    }

    /// Whether a vertex that is there, none of its own, lies on this face.
    fn meets_vertex(&self, built: &Built, reach: f64) -> bool {
        let (low, high) = self.bounding_box(reach);
        let window = rstar::AABB::from_corners(low.into(), high.into());
        let others = built.vertices.locate_in_envelope(window).filter(|near| !self.vertices.contains(&near.data));
        others.map(|near| Vector::from(*near.geom())).any(|p| self.distance(&p) <= reach)
    }

    fn bounding_box(&self, by: f64) -> (Vector, Vector) {
        let [a, b, c, d] = self.points;
        let margin = Vector::repeat(by);
        (a.inf(&b).inf(&c).inf(&d) - margin, a.sup(&b).sup(&c).sup(&d) + margin)
    }

    fn distance(&self, p: &Vector) -> f64 {
        let [a, b, c, d] = self.points;
        let to = |triangle: [Vector; 3]| (closest_on_triangle(p, &triangle) - p).norm();
        to([a, b, c]).min(to([a, c, d]))
    }

    fn rim_distance(&self, p: &Vector) -> f64 {
        let to = |k: usize| (on_segment(p, &self.points[k], &self.points[(k + 1) % 4]) - p).norm();
        (0..4).map(to).fold(f64::INFINITY, f64::min)
    }
}
