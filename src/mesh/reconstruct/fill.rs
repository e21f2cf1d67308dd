//! Filling: find concave boundary vertices, add quads.

use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

use super::acceptance::{Built, Candidate};
use super::original::{OWN_SCALE, Original};
use super::{Action, ReconstructError, Rule};
use crate::mesh::{NONE, PolygonMesh, QuadMesh, Vector, angle, boundary};

/// Applies the rules until none does anything, always the earliest rule that can. Unfolding: loops are read cyclically, so
/// every consecutive triple is tested, the one over the closing point too (the note appends the second point instead).
/// `None` where nothing was added.
pub(super) fn fill(
    mesh: &QuadMesh,
    original: &Original,
    vertices: &Corners,
    actions: &mut Vec<Action>,
) -> Result<Option<QuadMesh>, ReconstructError> {
    let loops = boundary::loops(mesh);
    let is_hole = |ring: &Vec<u32>| ring.iter().all(|&v| mesh.spokes(v).next().is_some_and(|h| original.is_open(mesh, h)));
    if let Some(odd) = loops.iter().find(|ring| ring.len() % 2 == 1 && is_hole(ring)) {
        return Err(ReconstructError::OddLoop(odd.clone()));
    }
    let goes_on = |ring: &Vec<u32>, k: usize| {
        let [a, b] = [k, k + 1].map(|k| mesh.positions[ring[k % ring.len()] as usize]);
        !original.ends_along(&a, &b)
    };
    // Every rule needs two edges in a row that a face may be attached to.
    if !loops.iter().any(|ring| (0..ring.len()).any(|k| goes_on(ring, k) && goes_on(ring, k + 1))) {
        return Ok(None);
    }
    let mut filler = Filler::new(mesh, loops, original, vertices);
    let mut added = Vec::new();
    // Loops share no vertices, and what one was refused stays refused when another is filled: one after the other will do.
    for ring in 0..filler.loops.len() {
        while let Some(quad) = filler.step(ring) {
            added.push(quad);
        }
    }
    if filler.added.is_empty() {
        return Ok(None);
    }
    let mut polygons = mesh.to_polygons();
    polygons.vertices = filler.positions;
    for quad in &filler.added {
        polygons.push_face(quad);
    }
    if !polygons.groups.is_empty() {
        polygons.group_of.resize(polygons.face_count(), NONE);
    }
    // The acceptance tests are local; what they cannot see is seen here, and then nothing is added at all.
    let Ok(filled) = QuadMesh::new(polygons) else { return Ok(None) };
    actions.extend(added);
    Ok(Some(filled))
}

/// The original's vertices, where a new one may be placed.
pub(super) type Corners = rstar::RTree<rstar::primitives::GeomWithData<[f64; 3], u32>>;

/// All vertices of the original that have faces.
pub(super) fn corners(original: &PolygonMesh) -> Corners {
    let mut used = vec![false; original.vertices.len()];
    original.faces().flatten().for_each(|&v| used[v as usize] = true);
    let chosen = (0..original.vertices.len()).filter(|&v| used[v]);
    Corners::bulk_load(chosen.map(|v| rstar::primitives::GeomWithData::new(original.vertices[v].into(), v as u32)).collect())
}

struct Filler<'a> {
    original: &'a Original,
    vertices: &'a Corners,
    built: Built,
    positions: Vec<Vector>,
    loops: Vec<Vec<u32>>,
    /// Faces and sum of face angles at every vertex.
    corners: Vec<(u32, f64)>,
    faces: HashSet<[u32; 4]>,
    edges: HashSet<[u32; 2]>,
    /// Boundary edges along which the original ends.
    ends_along: HashMap<[u32; 2], bool>,
    first_face: usize,
    added: Vec<[u32; 4]>,
    rejected: HashSet<[u32; 4]>,
}

impl<'a> Filler<'a> {
    fn new(mesh: &QuadMesh, loops: Vec<Vec<u32>>, original: &'a Original, vertices: &'a Corners) -> Self {
        let mut filler = Filler {
            original,
            vertices,
            built: Built::new(mesh),
            positions: mesh.positions.clone(),
            loops,
            corners: vec![(0, 0.0); mesh.vertex_count()],
            faces: HashSet::new(),
            edges: HashSet::new(),
            ends_along: HashMap::new(),
            first_face: mesh.face_count(),
            added: Vec::new(),
            rejected: HashSet::new(),
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
            self.edges.insert(edge(face[k], face[(k + 1) % 4]));
        }
        self.faces.insert(sorted(face));
    }

    /// Interior angles of more than π together (beyond rounding), or three or more quads.
    fn is_concave(&self, v: u32) -> bool {
        let (faces, sum) = self.corners[v as usize];
        sum > PI + 1e-6 || faces >= 3
    }

    /// Whether a face may be attached to all these edges of the boundary.
    fn may_attach(&mut self, chain: &[u32]) -> bool {
        let (original, positions) = (self.original, &self.positions);
        let ends_along = &mut self.ends_along;
        chain.windows(2).all(|pair| {
            let test = || original.ends_along(&positions[pair[0] as usize], &positions[pair[1] as usize]);
            !*ends_along.entry(edge(pair[0], pair[1])).or_insert_with(test)
        })
    }

    /// Adds one quad to a loop by the first rule that can.
    fn step(&mut self, ring: usize) -> Option<Action> {
        self.try_loop(ring, Self::loop_of_four, Rule::LoopOfFour)
            .or_else(|| self.try_loop(ring, Self::two_concave, Rule::TwoConcave))
            .or_else(|| self.try_loop(ring, Self::one_concave, Rule::OneConcave))
    }

    fn try_loop(&mut self, ring: usize, rule: fn(&mut Self, usize, usize) -> Option<[u32; 4]>, name: Rule) -> Option<Action> {
        let quad = (0..self.loops[ring].len()).find_map(|at| rule(self, ring, at))?;
        self.count(&quad);
        self.built.add_face(quad.map(|v| self.positions[v as usize]));
        self.added.push(quad);
        let face = (self.first_face + self.added.len()) as u32;
        Some(Action::Filled { rule: name, face, vertices: quad.map(|v| v + 1) })
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
        let rim = [3, 2, 1, 0, 3].map(|k| self.loops[ring][k]);
        self.accept(quad, &rim, true)?;
        self.loops[ring].clear();
        Some(quad)
    }

    /// a, v, c, b with v and c concave: quad [b, c, v, a]; the loop goes from a straight to b.
    fn two_concave(&mut self, ring: usize, at: usize) -> Option<[u32; 4]> {
        let length = self.loops[ring].len();
        let [a, v, c, b] = [0, 1, 2, 3].map(|by| self.on(ring, at, by));
        if length < 6 || !self.is_concave(v) || !self.is_concave(c) || self.edges.contains(&edge(a, b)) {
            return None;
        }
        let quad = [b, c, v, a];
        self.accept(quad, &[a, v, c, b], false)?;
        let mut gone = [(at + 1) % length, (at + 2) % length];
        gone.sort_unstable();
        for k in gone.into_iter().rev() {
            self.loops[ring].remove(k);
        }
        Some(quad)
    }

    /// a, v, c with v concave: quad [c, v, a, n] with n near a + c − v; n takes v's place in the loop.
    fn one_concave(&mut self, ring: usize, at: usize) -> Option<[u32; 4]> {
        let [a, v, c] = [0, 1, 2].map(|by| self.on(ring, at, by));
        if self.loops[ring].len() < 6 || !self.is_concave(v) || self.rejected.contains(&[c, v, a, NONE]) {
            return None;
        }
        let number = self.positions.len() as u32;
        let quad = [c, v, a, number];
        let new = self.may_attach(&[a, v, c]).then(|| self.new_vertex([a, v, c], quad)).flatten();
        let Some(new) = new else {
            self.rejected.insert([c, v, a, NONE]);
            return None;
        };
        self.positions.push(new);
        self.corners.push((0, 0.0));
        self.built.add_vertex(number, new);
        let length = self.loops[ring].len();
        self.loops[ring][(at + 1) % length] = number;
        Some(quad)
    }

    /// Where the fourth corner goes, the first that fits: the original vertex within a quarter of the shorter edge of
    /// a + c − v, the nearest point of the surface within the tolerance, the original vertex within half the shorter edge. On
    /// the original from the start, corners of a large hole do not drift off it.
    fn new_vertex(&self, [a, v, c]: [u32; 3], quad: [u32; 4]) -> Option<Vector> {
        let [pa, pv, pc] = [a, v, c].map(|v| self.positions[v as usize]);
        let guess = pa + pc - pv;
        let shorter = (pa - pv).norm().min((pc - pv).norm());
        let reach = self.original.reach(shorter);
        let known = self.vertices.nearest_neighbor(guess.into()).map(|known| Vector::from(*known.geom()));
        let within = |point: Option<Vector>, by: f64| point.filter(|point| (point - guess).norm() <= by);
        let places = [
            within(known, OWN_SCALE * shorter),
            within(self.original.surface.nearest(&guess), reach),
            within(known, 0.5 * shorter),
        ];
        let fits = |&new: &Vector| {
            // Elsewhere it would come to lie on an edge that is there.
            if self.built.distance(&new) < 0.5 * reach {
                return false;
            }
            let points = [pc, pv, pa, new];
            Candidate { vertices: quad, points, closes: false }.is_accepted(self.original, &self.built)
        };
        places.into_iter().flatten().find(fits)
    }

    /// The acceptance test, remembered; and no face twice, which would close a lone quad upon itself. `chain` are the edges of
    /// the boundary the face is attached to.
    fn accept(&mut self, quad: [u32; 4], chain: &[u32], closes: bool) -> Option<()> {
        if self.rejected.contains(&quad) {
            return None;
        }
        let candidate = Candidate { vertices: quad, points: quad.map(|v| self.positions[v as usize]), closes };
        let accepted =
            !self.faces.contains(&sorted(&quad)) && self.may_attach(chain) && candidate.is_accepted(self.original, &self.built);
        if !accepted {
            self.rejected.insert(quad);
        }
        accepted.then_some(())
    }
}

fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn sorted(face: &[u32; 4]) -> [u32; 4] {
    let mut face = *face;
    face.sort_unstable();
    face
}
