//! The edges that carry ribs, of any polygon mesh or of lines alone: what tracing and slicing need of it.
//!
//! A clean quad mesh has a structure of its own ([`super::QuadMesh`]); this is for triangles, polygons, edges of more than two
//! faces, and lines without a surface. Points of lines alone that have the same coordinates are one joint, since formats of lines
//! know no numbers.

mod partners;

use std::collections::HashMap;

use serde::Serialize;

use super::defects::{self, Defect, DefectKind, Defects, diagonal};
use super::edge_list::{EdgeUse, by_edge, edge_uses};
use super::stations::{Frame, Frames, Support};
use super::trace::{Line, lines_of};
use super::{PolygonMesh, Vector, unit};

/// How rib edges are joined to lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// By topology where there are faces of four corners or more, by straightest continuation elsewhere; lines alone: as given
    /// where the file gives whole ones.
    #[default]
    Auto,
    /// Straight on through inner vertices of four edges and boundary vertices of three (note 3.5).
    Topology,
    /// The straightest continuation, where it is straight enough and no other is nearly as straight.
    Straight,
    /// The file's own polylines; other edges are lines of their own.
    Given,
    /// Every edge is a line.
    Edges,
}

/// Rib edges with the surface they lie in, if there is one.
#[derive(Debug, Clone)]
pub struct Graph {
    positions: Vec<Vector>,
    /// Of every vertex, by its faces' areas; none where there are no faces or they cancel.
    normals: Vec<Option<Vector>>,
    /// All edges; those of faces first.
    ends: Vec<[u32; 2]>,
    ribs: Vec<bool>,
    flagged: bool,
    has_faces: bool,
    rule: Rule,
    partners: Vec<[u32; 2]>,
    /// What a user should know of the file.
    pub notes: Vec<String>,
}

impl Graph {
    /// Finds the edges and how they go on.
    ///
    /// # Errors
    /// What leaves edges without a place: no edges at all, edges without length, several vertices in one place, faces that are
    /// folded or turned over, a vertex that hangs on an edge, ribs off the edges.
    ///
    /// ```
    /// use ribopt::mesh::{formats::read_obj, graph::{Graph, Rule}, trace::report};
    /// let truss = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nl 1 2\nl 2 3\nl 1 4\nl 2 4\nl 3 4\n";
    /// let graph = Graph::new(read_obj(truss.as_bytes())?, Rule::Auto)?;
    /// assert_eq!(report(&graph, &graph.lines()).lines, 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(mut mesh: PolygonMesh, rule: Rule) -> Result<Graph, Defects> {
        let mut notes = std::mem::take(&mut mesh.notes);
        if mesh.face_count() == 0 {
            join_points(&mut mesh, &mut notes);
        }
        let uses = edge_uses(&mesh);
        let found = defects::of_network(&mesh, &uses);
        if !found.is_empty() {
            return Err(Defects(found));
        }
        let mut ends: Vec<[u32; 2]> = by_edge(&uses).map(|uses| uses[0].edge).collect();
        let flags = Flags::new(&mesh, &mut ends, &mut notes)?;
        let rule = match rule {
            Rule::Auto if mesh.faces().any(|face| face.len() > 3) => Rule::Topology,
            Rule::Auto => Rule::Straight,
            // Without faces nothing lies opposite.
            Rule::Topology if mesh.face_count() == 0 => Rule::Straight,
            other => other,
        };
        let mut graph = Graph {
            normals: normals(&mesh),
            has_faces: mesh.face_count() > 0,
            positions: mesh.vertices.clone(),
            ends,
            ribs: flags.ribs,
            flagged: flags.any,
            rule,
            partners: Vec::new(),
            notes,
        };
        graph.partners = partners::find(&graph, &mesh, &uses, &flags.wholes);
        Ok(graph)
    }

    /// The rib lines.
    pub fn lines(&self) -> Vec<Line> {
        lines_of(self.ends.len() as u32, |e| self.ends[e as usize], |e| self.ribs[e as usize], &self.partners)
    }

    /// The rule that was used.
    pub fn rule(&self) -> Rule {
        self.rule
    }

    /// All positions.
    pub fn positions(&self) -> &[Vector] {
        &self.positions
    }
}

impl Support for Graph {
    fn position(&self, v: u32) -> Vector {
        self.positions[v as usize]
    }

    fn normal(&self, v: u32) -> Option<Vector> {
        self.normals.get(v as usize).copied().flatten()
    }

    fn frame(&self, tangent: Vector, normal: Option<Vector>) -> Option<Frame> {
        normal.and_then(|normal| Frame::new(tangent, normal)).or_else(|| Frame::upright(tangent))
    }

    fn frames(&self) -> Frames {
        if self.has_faces { Frames::Faces } else { Frames::Upright }
    }

    fn has_flags(&self) -> bool {
        self.flagged && self.has_faces
    }
}

/// Joins points with the same coordinates; they keep the number of the first.
fn join_points(mesh: &mut PolygonMesh, notes: &mut Vec<String>) {
    let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(mesh.vertices.len());
    let key = |p: &Vector| -> [u64; 3] { p.map(|c| (c + 0.0).to_bits()).into() };
    let number: Vec<u32> = (0u32..).zip(&mesh.vertices).map(|(v, p)| *first.entry(key(p)).or_insert(v)).collect();
    let before = mesh.ribs.len();
    let old = std::mem::take(mesh);
    mesh.vertices.clone_from(&old.vertices);
    mesh.set_ribs(&old, |v| number[v as usize]);
    if mesh.ribs.len() < before {
        notes.push(format!("{} lines without length left out", before - mesh.ribs.len()));
    }
    note_close_points(mesh, notes);
}

/// Ends nearer to one another than this part of the drawing's size were probably meant to meet.
const CLOSE: f64 = 1e-6;

fn note_close_points(mesh: &PolygonMesh, notes: &mut Vec<String>) {
    let mut used: Vec<u32> = mesh.ribs.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let point = |&v: &u32| rstar::primitives::GeomWithData::new(mesh.vertices[v as usize].into(), v);
    let tree: rstar::RTree<rstar::primitives::GeomWithData<[f64; 3], u32>> =
        rstar::RTree::bulk_load(used.iter().map(point).collect());
    let reach = CLOSE * diagonal(&mesh.vertices);
    let near = |v: &u32| {
        let around = tree.locate_within_distance(mesh.vertices[*v as usize].into(), reach * reach);
        around.map(|near| near.data).find(|other| other > v)
    };
    let mut pairs = used.iter().filter_map(|v| near(v).map(|other| (v + 1, other + 1)));
    if let Some((a, b)) = pairs.next() {
        let more = pairs.count();
        notes.push(format!("points {a} and {b} nearly coincide ({more} more such pairs); --weld joins them"));
    }
}

/// Which edges carry ribs.
struct Flags {
    ribs: Vec<bool>,
    any: bool,
    /// Whole lines as edges, each with the vertices before and after it in the line's direction.
    wholes: Vec<Vec<u32>>,
}

impl Flags {
    /// Of lines alone the edges are made here; flags of faces must lie on edges, by number or by position.
    fn new(mesh: &PolygonMesh, ends: &mut Vec<[u32; 2]>, notes: &mut Vec<String>) -> Result<Flags, Defects> {
        let mut number: HashMap<[u32; 2], u32> = ends.iter().zip(0..).map(|(edge, e)| (*edge, e)).collect();
        let has_faces = !ends.is_empty();
        let at = if has_faces && !mesh.ribs.is_empty() { on_faces(mesh) } else { HashMap::new() };
        let corner = |v: u32| at.get(&v).copied().unwrap_or(v);
        let (mut of_rib, mut strays, mut twice) = (Vec::with_capacity(mesh.ribs.len()), Vec::new(), 0);
        let mut ribs = vec![mesh.ribs.is_empty(); ends.len()];
        for rib in &mesh.ribs {
            let [a, b] = rib.map(corner);
            let edge = [a.min(b), a.max(b)];
            match number.get(&edge) {
                Some(&e) => {
                    twice += usize::from(std::mem::replace(&mut ribs[e as usize], true));
                    of_rib.push(e);
                }
                None if has_faces => {
                    strays.push(Defect { kind: DefectKind::RibOffTheEdges, faces: Vec::new(), vertices: rib.to_vec() });
                }
                None => {
                    let e = ends.len() as u32;
                    number.insert(edge, e);
                    // As given, so that lines run the way the file has them.
                    ends.push([a, b]);
                    ribs.push(true);
                    of_rib.push(e);
                }
            }
        }
        if !strays.is_empty() {
            return Err(Defects(strays));
        }
        if twice > 0 {
            notes.push(format!("{twice} edges given more than once count once"));
        }
        let whole = |&[first, end]: &[u32; 2]| of_rib[first as usize..end as usize].to_vec();
        Ok(Flags { any: !mesh.ribs.is_empty(), wholes: mesh.wholes.iter().map(whole).collect(), ribs })
    }
}

/// For vertices of ribs that no face has, the vertex of a face at the same place: curves are often exported with points of their
/// own.
fn on_faces(mesh: &PolygonMesh) -> HashMap<u32, u32> {
    let mut used = vec![false; mesh.vertices.len()];
    mesh.faces().flatten().for_each(|&v| used[v as usize] = true);
    let key = |v: u32| -> [u64; 3] { mesh.vertices[v as usize].map(|c| (c + 0.0).to_bits()).into() };
    let alone: Vec<u32> = mesh.ribs.iter().flatten().copied().filter(|&v| !used[v as usize]).collect();
    if alone.is_empty() {
        return HashMap::new();
    }
    let at: HashMap<[u64; 3], u32> = (0..mesh.vertices.len() as u32).filter(|&v| used[v as usize]).map(|v| (key(v), v)).collect();
    alone.into_iter().filter_map(|v| at.get(&key(v)).map(|&corner| (v, corner))).collect()
}

/// Flags of ribs moved onto the faces' vertices at the same place.
pub(super) fn settle_flags(mesh: &mut PolygonMesh) {
    if mesh.face_count() > 0 && !mesh.ribs.is_empty() {
        let at = on_faces(mesh);
        mesh.ribs.iter_mut().flatten().for_each(|v| *v = at.get(v).copied().unwrap_or(*v));
    }
}

fn normals(mesh: &PolygonMesh) -> Vec<Option<Vector>> {
    if mesh.face_count() == 0 {
        return Vec::new();
    }
    let mut sums = vec![(Vector::zeros(), 0.0); mesh.vertices.len()];
    for (f, face) in mesh.faces().enumerate() {
        let area = mesh.vector_area(f);
        for &v in face {
            let (sum, size) = &mut sums[v as usize];
            *sum += area;
            *size += area.norm();
        }
    }
    sums.into_iter().map(|(sum, size)| unit(sum).filter(|_| sum.norm() > 1e-9 * size)).collect()
}

/// The faces' sides at every vertex: two edges of each face there.
pub(super) fn corners_at(mesh: &PolygonMesh, uses: &[EdgeUse]) -> Vec<Vec<[u32; 2]>> {
    let mut edge_of_side = vec![0; uses.len()];
    for (e, uses) in (0u32..).zip(by_edge(uses)) {
        uses.iter().for_each(|u| edge_of_side[u.side as usize] = e);
    }
    let mut corners: Vec<Vec<[u32; 2]>> = vec![Vec::new(); mesh.vertices.len()];
    let mut first = 0;
    for face in mesh.faces() {
        let count = face.len();
        for (k, &v) in face.iter().enumerate() {
            corners[v as usize].push([edge_of_side[first + (k + count - 1) % count], edge_of_side[first + k]]);
        }
        first += count;
    }
    corners
}

/// Vertices whose faces do not hang together through edges.
pub(super) fn broken_fans(mesh: &PolygonMesh, uses: &[EdgeUse]) -> Vec<Defect> {
    let mut found = Vec::new();
    for (v, corners) in (0u32..).zip(corners_at(mesh, uses)) {
        let Some(&first) = corners.first() else { continue };
        let (mut reached, mut left) = (first.to_vec(), corners);
        while let Some(at) = left.iter().position(|corner| corner.iter().any(|e| reached.contains(e))) {
            reached.extend(left.swap_remove(at));
        }
        if !left.is_empty() {
            found.push(Defect { kind: DefectKind::BrokenFan, faces: Vec::new(), vertices: vec![v] });
        }
    }
    found
}

#[cfg(test)]
mod tests;
