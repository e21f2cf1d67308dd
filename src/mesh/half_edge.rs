//! The half-edge structure of a clean quad mesh.
//!
//! Half-edge h = 4f + k runs along side k of face f, with the face on its left; next and previous need no storage. A vertex
//! on the boundary points to its one outgoing half-edge without twin, so that turning counter-clockwise from there meets
//! all its faces.

use super::defects::{self, Defect, DefectKind, Defects};
use super::edge_list::{EdgeUse, by_edge, edge_uses};
use super::{NONE, PolygonMesh, Vector};

/// A quad mesh without defects: oriented, at most two faces at an edge, one fan at a vertex.
#[derive(Debug, Clone)]
pub struct QuadMesh {
    /// Positions; stages that move vertices write here.
    pub positions: Vec<Vector>,
    faces: Vec<[u32; 4]>,
    twins: Vec<u32>,
    edges: Vec<u32>,
    edge_of: Vec<u32>,
    outgoing: Vec<u32>,
    flagged: Vec<bool>,
    groups: Vec<String>,
    group_of: Vec<u32>,
}

impl QuadMesh {
    /// Checks a mesh and builds the structure.
    ///
    /// # Errors
    /// All defects at once; fans are looked at only once faces and edges are sound.
    ///
    /// ```
    /// use ribopt::mesh::{QuadMesh, generate};
    /// let mesh = QuadMesh::new(generate::grid(4, 3, 1.0))?;
    /// assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (20, 31, 12));
    /// # Ok::<(), ribopt::mesh::Defects>(())
    /// ```
    pub fn new(mesh: PolygonMesh) -> Result<QuadMesh, Defects> {
        let mut found = defects::of_faces(&mesh);
        found.extend(defects::duplicates(&mesh));
        let uses = if found.iter().any(|d| matches!(d.kind, DefectKind::Empty | DefectKind::Triangulated)) {
            Vec::new()
        } else {
            edge_uses(&mesh)
        };
        found.extend(defects::of_edges(&uses));
        if !found.is_empty() {
            return Err(Defects(found));
        }
        let hanging = defects::hanging(&mesh, &uses);
        let faces = mesh.faces().filter_map(|face| face.try_into().ok()).collect();
        let mut quads = QuadMesh {
            positions: mesh.vertices,
            faces,
            twins: Vec::new(),
            edges: Vec::new(),
            edge_of: Vec::new(),
            outgoing: Vec::new(),
            flagged: Vec::new(),
            groups: mesh.groups,
            group_of: mesh.group_of,
        };
        quads.link(&uses);
        let mut found = hanging;
        found.extend(quads.broken_fans());
        found.extend(quads.flag(&mesh.ribs, &uses));
        if found.is_empty() { Ok(quads) } else { Err(Defects(found)) }
    }

    fn link(&mut self, uses: &[EdgeUse]) {
        let sides = 4 * self.faces.len();
        self.twins = vec![NONE; sides];
        self.edge_of = vec![NONE; sides];
        for uses in by_edge(uses) {
            let edge = self.edges.len() as u32;
            self.edges.push(uses[0].side);
            uses.iter().for_each(|u| self.edge_of[u.side as usize] = edge);
            if let [a, b] = uses {
                self.twins[a.side as usize] = b.side;
                self.twins[b.side as usize] = a.side;
            }
        }
        self.outgoing = vec![NONE; self.positions.len()];
        for h in 0..sides as u32 {
            let slot = &mut self.outgoing[self.faces[h as usize / 4][h as usize % 4] as usize];
            if *slot == NONE || self.twins[h as usize] == NONE {
                *slot = h;
            }
        }
    }

    /// Vertices whose faces are not all met by turning around them once.
    fn broken_fans(&self) -> Vec<Defect> {
        let mut faces_at = vec![0u32; self.positions.len()];
        self.faces.iter().flatten().for_each(|&v| faces_at[v as usize] += 1);
        let is_broken = |&v: &u32| self.spokes(v).count() as u32 != faces_at[v as usize];
        let broken: Vec<u32> = (0..self.positions.len() as u32).filter(is_broken).collect();
        let faces_of = |v| (0..self.faces.len() as u32).filter(|&f| self.faces[f as usize].contains(&v)).collect();
        // Listing faces scans the mesh once per vertex; a hopeless mesh gets its first hundred listed.
        let defect = |(i, v)| Defect {
            kind: DefectKind::BrokenFan,
            faces: if i < 100 { faces_of(v) } else { Vec::new() },
            vertices: vec![v],
        };
        broken.into_iter().enumerate().map(defect).collect()
    }

    fn flag(&mut self, ribs: &[[u32; 2]], uses: &[EdgeUse]) -> Vec<Defect> {
        if !ribs.is_empty() {
            self.flagged = vec![false; self.edges.len()];
        }
        let mut strays = Vec::new();
        for &[a, b] in ribs {
            let edge = [a.min(b), a.max(b)];
            let at = uses.partition_point(|u| u.edge < edge);
            match uses.get(at).filter(|u| u.edge == edge) {
                Some(u) => self.flagged[self.edge_of[u.side as usize] as usize] = true,
                None => strays.push(Defect { kind: DefectKind::RibOffTheEdges, faces: Vec::new(), vertices: vec![a, b] }),
            }
        }
        strays
    }

    /// Number of vertices, those without faces included.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The faces, counter-clockwise seen from outside.
    pub fn faces(&self) -> &[[u32; 4]] {
        &self.faces
    }

    /// The vertex half-edge `h` starts at.
    pub fn origin(&self, h: u32) -> u32 {
        self.faces[h as usize / 4][h as usize % 4]
    }

    /// The vertex half-edge `h` ends at.
    pub fn target(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    /// The half-edge on the other side, if there is a face.
    pub fn twin(&self, h: u32) -> Option<u32> {
        Some(self.twins[h as usize]).filter(|&twin| twin != NONE)
    }

    /// The edge of half-edge `h`.
    pub fn edge_of(&self, h: u32) -> u32 {
        self.edge_of[h as usize]
    }

    /// The first half-edge of edge `e`; `e` is below [`Self::edge_count`].
    pub fn half_edge(&self, e: u32) -> u32 {
        self.edges[e as usize]
    }

    /// The two vertices of edge `e`.
    pub fn ends(&self, e: u32) -> [u32; 2] {
        let h = self.half_edge(e);
        [self.origin(h), self.target(h)]
    }

    /// The length of edge `e`.
    pub fn edge_length(&self, e: u32) -> f64 {
        let [a, b] = self.ends(e);
        (self.positions[b as usize] - self.positions[a as usize]).norm()
    }

    /// Whether edge `e` carries a rib: it is flagged, or no edge is.
    pub fn is_rib(&self, e: u32) -> bool {
        self.flagged.get(e as usize).copied().unwrap_or(true)
    }

    /// Whether any edge is flagged.
    pub fn has_flags(&self) -> bool {
        self.flagged.contains(&true)
    }

    /// Whether `v` lies on the boundary.
    pub fn is_boundary(&self, v: u32) -> bool {
        let h = self.outgoing[v as usize];
        h != NONE && self.twins[h as usize] == NONE
    }

    /// The outgoing half-edges of `v`, counter-clockwise, one per face. A boundary vertex has one more edge: the one before
    /// the last spoke's (`previous`).
    pub fn spokes(&self, v: u32) -> impl Iterator<Item = u32> {
        let first = self.outgoing[v as usize];
        let turn = move |&h: &u32| self.twin(previous(h)).filter(|&h| h != first);
        std::iter::successors(Some(first).filter(|&h| h != NONE), turn)
    }

    /// The edges at `v`, counter-clockwise; of a boundary vertex, from boundary to boundary.
    pub fn edges_at(&self, v: u32) -> impl Iterator<Item = u32> {
        let last = self.spokes(v).last().map(previous).filter(|&h| self.twin(h).is_none());
        self.spokes(v).chain(last).map(|h| self.edge_of(h))
    }

    /// The neighbours of `v`, in the order of [`Self::edges_at`].
    pub fn neighbours(&self, v: u32) -> impl Iterator<Item = u32> {
        self.edges_at(v).map(move |e| {
            let [a, b] = self.ends(e);
            if a == v { b } else { a }
        })
    }

    /// The unit normal at `v`, the mean of its faces' by area; `None` where they cancel (to 1e−9) or there are none.
    pub fn normal_at(&self, v: u32) -> Option<Vector> {
        let areas = self.spokes(v).map(|h| self.vector_area(h / 4));
        let (sum, size) = areas.fold((Vector::zeros(), 0.0), |(sum, size), area| (sum + area, size + area.norm()));
        super::unit(sum).filter(|_| sum.norm() > 1e-9 * size)
    }

    /// The vector area of face `f`: half the cross product of its diagonals.
    pub fn vector_area(&self, f: u32) -> Vector {
        let [a, b, c, d] = self.faces[f as usize].map(|v| self.positions[v as usize]);
        (c - a).cross(&(d - b)) / 2.0
    }

    /// The mesh as written to files.
    pub fn to_polygons(&self) -> PolygonMesh {
        let mut mesh = PolygonMesh::from_quads(self.positions.clone(), &self.faces);
        mesh.groups = self.groups.clone();
        mesh.group_of = self.group_of.clone();
        if self.has_flags() {
            mesh.ribs = (0..self.edge_count() as u32).filter(|&e| self.is_rib(e)).map(|e| self.ends(e)).collect();
        }
        mesh
    }
}

/// The next half-edge around the face.
pub fn next(h: u32) -> u32 {
    if h % 4 == 3 { h - 3 } else { h + 1 }
}

/// The previous half-edge around the face.
pub fn previous(h: u32) -> u32 {
    if h.is_multiple_of(4) { h + 3 } else { h - 1 }
}

#[cfg(test)]
mod tests;
