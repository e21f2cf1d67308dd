//! Filling: find concave boundary vertices, add quads.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use super::acceptance::Acceptance;
use super::{Action, ReconstructError, Rule};
use crate::mesh::{NONE, QuadMesh, Vector, angle, boundary};

/// Applies the rules until none does anything, always the earliest rule that can. Unfolding: loops are read cyclically, so
/// every consecutive triple is tested, the one over the closing point too (the note appends the second point instead).
pub(super) fn fill(mesh: QuadMesh, acceptance: &Acceptance, actions: &mut Vec<Action>) -> Result<QuadMesh, ReconstructError> {
    let loops = boundary::loops(&mesh);
    if let Some(odd) = loops.iter().find(|ring| ring.len() % 2 == 1 && acceptance.covers(&mesh, ring)) {
        return Err(ReconstructError::OddLoop(odd.clone()));
    }
    let mut filler = Filler::new(&mesh, loops, acceptance);
    while let Some(quad) = filler.step() {
        actions.push(quad);
    }
    if filler.added.is_empty() {
        return Ok(mesh);
    }
    let mut polygons = mesh.to_polygons();
    polygons.vertices = filler.positions;
    for quad in &filler.added {
        polygons.push_face(quad);
    }
    if !polygons.groups.is_empty() {
        polygons.group_of.resize(polygons.face_count(), NONE);
    }
    Ok(QuadMesh::new(polygons)?)
}

struct Filler<'a> {
    acceptance: &'a Acceptance<'a>,
    positions: Vec<Vector>,
    loops: Vec<Vec<u32>>,
    /// Faces and sum of face angles at every vertex.
    corners: Vec<(u32, f64)>,
    faces: BTreeSet<[u32; 4]>,
    first_face: usize,
    added: Vec<[u32; 4]>,
    rejected: BTreeSet<[u32; 4]>,
}

impl<'a> Filler<'a> {
    fn new(mesh: &QuadMesh, loops: Vec<Vec<u32>>, acceptance: &'a Acceptance<'a>) -> Self {
        let mut filler = Filler {
            acceptance,
            positions: mesh.positions.clone(),
            loops,
            corners: vec![(0, 0.0); mesh.vertex_count()],
            faces: BTreeSet::new(),
            first_face: mesh.face_count(),
            added: Vec::new(),
            rejected: BTreeSet::new(),
        };
        mesh.faces().iter().for_each(|face| filler.count(face));
        filler
    }

    fn count(&mut self, face: &[u32; 4]) {
        for k in 0..4 {
            let at = |k: usize| self.positions[face[k % 4] as usize];
            let between = angle(&(at(k + 1) - at(k)), &(at(k + 3) - at(k)));
            let (faces, sum) = &mut self.corners[face[k] as usize];
            *faces += 1;
            *sum += between;
        }
        self.faces.insert(sorted(face));
    }

    /// Interior angles of more than π together (beyond rounding), or three or more quads.
    fn is_concave(&self, v: u32) -> bool {
        let (faces, sum) = self.corners[v as usize];
        sum > PI + 1e-6 || faces >= 3
    }

    /// Adds one quad by the first rule that can.
    fn step(&mut self) -> Option<Action> {
        self.try_loops(Self::loop_of_four, Rule::LoopOfFour)
            .or_else(|| self.try_loops(Self::two_concave, Rule::TwoConcave))
            .or_else(|| self.try_loops(Self::one_concave, Rule::OneConcave))
    }

    fn try_loops(&mut self, rule: fn(&mut Self, usize, usize) -> Option<[u32; 4]>, name: Rule) -> Option<Action> {
        for ring in 0..self.loops.len() {
            for at in 0..self.loops[ring].len() {
                if let Some(quad) = rule(self, ring, at) {
                    self.count(&quad);
                    self.added.push(quad);
                    let face = (self.first_face + self.added.len()) as u32;
                    return Some(Action::Filled { rule: name, face, vertices: quad.map(|v| v + 1) });
                }
            }
        }
        None
    }

    /// The loop's vertex `by` places on from `at`, around the end.
    fn on(&self, ring: usize, at: usize, by: usize) -> u32 {
        let ring = &self.loops[ring];
        ring[(at + by) % ring.len()]
    }

    fn loop_of_four(&mut self, ring: usize, at: usize) -> Option<[u32; 4]> {
        if self.loops[ring].len() != 4 || at != 0 {
            return None;
        }
        let quad = [3, 2, 1, 0].map(|k| self.loops[ring][k]);
        let points = quad.map(|v| self.positions[v as usize]);
        self.accept(quad, points, true)?;
        self.loops[ring].clear();
        Some(quad)
    }

    /// a, v, c, b with v and c concave: quad [b, c, v, a]; the loop goes from a straight to b.
    fn two_concave(&mut self, ring: usize, at: usize) -> Option<[u32; 4]> {
        let length = self.loops[ring].len();
        let [a, v, c, b] = [0, 1, 2, 3].map(|by| self.on(ring, at, by));
        if length < 6 || !self.is_concave(v) || !self.is_concave(c) {
            return None;
        }
        let quad = [b, c, v, a];
        self.accept(quad, quad.map(|v| self.positions[v as usize]), false)?;
        let mut gone = [(at + 1) % length, (at + 2) % length];
        gone.sort_unstable();
        for k in gone.into_iter().rev() {
            self.loops[ring].remove(k);
        }
        Some(quad)
    }

    /// a, v, c with v concave: quad [c, v, a, n] with n = a + c − v; n takes v's place in the loop.
    fn one_concave(&mut self, ring: usize, at: usize) -> Option<[u32; 4]> {
        let [a, v, c] = [0, 1, 2].map(|by| self.on(ring, at, by));
        if self.loops[ring].len() < 6 || !self.is_concave(v) {
            return None;
        }
        let [pa, pv, pc] = [a, v, c].map(|v| self.positions[v as usize]);
        let new = pa + pc - pv;
        let number = self.positions.len() as u32;
        if self.rejected.contains(&[c, v, a, NONE]) {
            return None;
        }
        let free = self.acceptance.is_on_surface(&new) && !self.is_taken(&new);
        if !free || self.accept([c, v, a, number], [pc, pv, pa, new], false).is_none() {
            self.rejected.insert([c, v, a, NONE]);
            return None;
        }
        self.positions.push(new);
        self.corners.push((0, 0.0));
        let length = self.loops[ring].len();
        self.loops[ring][(at + 1) % length] = number;
        Some([c, v, a, number])
    }

    /// Whether a boundary vertex is already there.
    fn is_taken(&self, point: &Vector) -> bool {
        let near = |&v: &u32| (self.positions[v as usize] - point).norm() <= self.acceptance.tolerance;
        self.loops.iter().flatten().any(near)
    }

    /// The acceptance test, remembered; and no face twice, which would close a lone quad upon itself.
    fn accept(&mut self, quad: [u32; 4], points: [Vector; 4], last: bool) -> Option<()> {
        if self.rejected.contains(&quad) {
            return None;
        }
        let accepted = !self.faces.contains(&sorted(&quad)) && self.acceptance.accepts(points, last);
        if !accepted {
            self.rejected.insert(quad);
        }
        accepted.then_some(())
    }
}

fn sorted(face: &[u32; 4]) -> [u32; 4] {
    let mut face = *face;
    face.sort_unstable();
    face
}
