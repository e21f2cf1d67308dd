//! What keeps a mesh from being a clean quad mesh (note 3). All of it, with faces and vertices.

use std::fmt;

use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree};
use serde::{Serialize, Serializer};

use super::closest::on_segment;
use super::edge_list::{EdgeUse, by_edge};
use super::{PolygonMesh, Vector};

/// Kinds of defects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)]
pub enum DefectKind {
    Empty,
    Triangulated,
    NotAQuad,
    DuplicateVertices,
    ZeroEdge,
    ZeroArea,
    MoreThanTwoFaces,
    InconsistentOrientation,
    BrokenFan,
    RibOffTheEdges,
    HangingNode,
}

/// One defect and where it is. Serialised with numbers from 1.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Defect {
    /// What is wrong.
    pub kind: DefectKind,
    /// Faces concerned.
    #[serde(serialize_with = "from_one")]
    pub faces: Vec<u32>,
    /// Vertices concerned.
    #[serde(serialize_with = "from_one")]
    pub vertices: Vec<u32>,
}

/// All defects of a mesh; never empty as an error.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[serde(transparent)]
pub struct Defects(pub Vec<Defect>);

/// How many defects and how many numbers per defect a message spells out.
const SHOWN: usize = 20;

impl fmt::Display for Defects {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "the mesh has {} defect{}", self.0.len(), if self.0.len() == 1 { "" } else { "s" })?;
        for defect in self.0.iter().take(SHOWN) {
            write!(out, "\n  {defect}")?;
        }
        match self.0.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(out, "\n  … and {more} more"),
        }
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let (faces, vertices) = (list("face", &self.faces), list("vertex", &self.vertices));
        match self.kind {
            DefectKind::Empty => write!(out, "there are no faces, and no lines that carry ribs"),
            DefectKind::Triangulated => write!(
                out,
                "every face is a triangle, and this takes quads; if the mesh has been triangulated, export the quads, or join the \
                 triangles first (Blender: Face > Tris to Quads)"
            ),
            DefectKind::NotAQuad => write!(out, "{faces} ({vertices}) is no quad"),
            DefectKind::DuplicateVertices => {
                write!(out, "{vertices} share one position; weld them with a tolerance if they are one")
            }
            DefectKind::ZeroEdge => write!(out, "{faces} has an edge of no length at {vertices}"),
            DefectKind::ZeroArea => write!(out, "{faces} ({vertices}) has no area or is folded onto itself"),
            DefectKind::MoreThanTwoFaces => {
                write!(out, "the edge of {vertices} belongs to {faces}; at most two may share an edge")
            }
            DefectKind::InconsistentOrientation => {
                write!(out, "{faces} run along the edge of {vertices} in the same direction; turn one of them over")
            }
            DefectKind::BrokenFan if self.faces.is_empty() => {
                write!(out, "at {vertices} faces meet in separate fans; give each fan a vertex of its own")
            }
            DefectKind::BrokenFan => {
                write!(out, "at {vertices} {faces} meet in separate fans; give each fan a vertex of its own")
            }
            DefectKind::HangingNode => match self.vertices[..] {
                [v, a, b] => write!(
                    out,
                    "vertex {} hangs on the edge {} {} of {faces}: it lies there, but is no corner of that face; \
                     make it one, or divide the face",
                    v + 1,
                    a + 1,
                    b + 1
                ),
                _ => write!(out, "{vertices} hang on an edge of {faces}"),
            },
            DefectKind::RibOffTheEdges => write!(out, "the rib of {vertices} is no edge of any face"),
        }
    }
}

fn list(noun: &str, numbers: &[u32]) -> String {
    let shown: Vec<String> = numbers.iter().take(SHOWN).map(|n| (n + 1).to_string()).collect();
    let plural = match (noun, numbers.len()) {
        (_, 1) => noun,
        ("vertex", _) => "vertices",
        _ => "faces",
    };
    format!("{plural} {}{}", shown.join(" "), if numbers.len() > SHOWN { " …" } else { "" })
}

fn from_one<S: Serializer>(numbers: &[u32], out: S) -> Result<S::Ok, S::Error> {
    out.collect_seq(numbers.iter().map(|n| u64::from(*n) + 1))
}

/// Defects of single faces and vertices, by shape.
pub(super) fn of_faces(mesh: &PolygonMesh) -> Vec<Defect> {
    if mesh.face_count() == 0 {
        return vec![Defect { kind: DefectKind::Empty, faces: Vec::new(), vertices: Vec::new() }];
    }
    if mesh.faces().all(|face| face.len() == 3) {
        return vec![Defect { kind: DefectKind::Triangulated, faces: Vec::new(), vertices: Vec::new() }];
    }
    let tiny = 1e-12 * diagonal(&mesh.vertices);
    let quad = |f: usize| mesh.face(f).len() == 4;
    let not_a_quad = |f: usize| of_one(DefectKind::NotAQuad, f, mesh.face(f));
    (0..mesh.face_count()).filter_map(|f| if quad(f) { of_face(mesh, f, tiny) } else { Some(not_a_quad(f)) }).collect()
}

fn of_one(kind: DefectKind, f: usize, vertices: &[u32]) -> Defect {
    Defect { kind, faces: vec![f as u32], vertices: vertices.to_vec() }
}

/// Edges without length, faces without area; of any polygon.
fn of_face(mesh: &PolygonMesh, f: usize, tiny: f64) -> Option<Defect> {
    let face = mesh.face(f);
    let count = face.len();
    let at = |k: usize| mesh.vertices[face[k % count] as usize];
    let longest = (0..count).map(|k| (at(k + 1) - at(k)).norm()).fold(0.0, f64::max);
    if let Some(k) = (0..count).find(|&k| (at(k + 1) - at(k)).norm() <= tiny) {
        return Some(of_one(DefectKind::ZeroEdge, f, &[face[k], face[(k + 1) % count]]));
    }
    (mesh.vector_area(f).norm() <= 1e-12 * longest * longest).then(|| of_one(DefectKind::ZeroArea, f, face))
}

/// What keeps edges from being a network of ribs, of any polygon mesh or of lines alone. Edges of more than two faces and separate
/// fans do not: lines end there.
pub(super) fn of_network(mesh: &PolygonMesh, uses: &[EdgeUse]) -> Vec<Defect> {
    if mesh.face_count() == 0 {
        return of_lines(mesh);
    }
    let tiny = 1e-12 * diagonal(&mesh.vertices);
    let mut found: Vec<Defect> = (0..mesh.face_count()).filter_map(|f| of_face(mesh, f, tiny)).collect();
    found.extend(duplicates(mesh));
    found.extend(of_edges(uses).into_iter().filter(|defect| defect.kind == DefectKind::InconsistentOrientation));
    if found.is_empty() {
        found.extend(hanging(mesh, uses));
    }
    found
}

fn of_lines(mesh: &PolygonMesh) -> Vec<Defect> {
    if mesh.ribs.is_empty() {
        return vec![Defect { kind: DefectKind::Empty, faces: Vec::new(), vertices: Vec::new() }];
    }
    Vec::new()
}

/// A vertex counts as lying on an edge within this part of its length: coordinates written with five digits.
const ON_EDGE: f64 = 1e-4;

/// Boundary vertices that lie inside the boundary edges of other faces.
pub(super) fn hanging(mesh: &PolygonMesh, uses: &[EdgeUse]) -> Vec<Defect> {
    let rim: Vec<&EdgeUse> = by_edge(uses).filter(|uses| uses.len() == 1).map(|uses| &uses[0]).collect();
    let mut ends: Vec<u32> = rim.iter().flat_map(|side| side.edge).collect();
    ends.sort_unstable();
    ends.dedup();
    let place = |v: u32| mesh.vertices[v as usize];
    let tree = RTree::bulk_load(ends.iter().map(|&v| GeomWithData::new(<[f64; 3]>::from(place(v)), v)).collect());
    let mut found = Vec::new();
    for side in rim {
        let [a, b] = side.edge.map(place);
        let reach = ON_EDGE * (b - a).norm();
        let window = AABB::from_corners((a.inf(&b) - Vector::repeat(reach)).into(), (a.sup(&b) + Vector::repeat(reach)).into());
        let is_on = |v: u32| {
            let p = place(v);
            let apart = |q: Vector| (q - p).norm();
            apart(on_segment(&p, &a, &b)) <= reach && apart(a) > reach && apart(b) > reach
        };
        let on = tree.locate_in_envelope(window).map(|near| near.data).filter(|&v| is_on(v));
        let mut on: Vec<u32> = on.collect();
        on.sort_unstable();
        let defect = |v: u32| Defect {
            kind: DefectKind::HangingNode,
            faces: vec![side.face],
            vertices: vec![v, side.edge[0], side.edge[1]],
        };
        found.extend(on.into_iter().map(defect));
    }
    found
}

/// Vertices at exactly the same place, group by group. Vertices without faces do not count.
pub(super) fn duplicates(mesh: &PolygonMesh) -> Vec<Defect> {
    let mut used = vec![false; mesh.vertices.len()];
    mesh.faces().flatten().for_each(|&v| used[v as usize] = true);
    let key = |v: u32| mesh.vertices[v as usize].map(|c| if c == 0.0 { 0.0 } else { c });
    let compare = |a: &u32, b: &u32| {
        let (a, b) = (key(*a), key(*b));
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
    };
    let mut order: Vec<u32> = (0..mesh.vertices.len() as u32).filter(|&v| used[v as usize]).collect();
    order.sort_by(compare);
    let groups = order.chunk_by(|&a, &b| key(a) == key(b)).filter(|group| group.len() > 1);
    let defect = |group: &[u32]| Defect { kind: DefectKind::DuplicateVertices, faces: Vec::new(), vertices: group.to_vec() };
    groups.map(defect).collect()
}

/// Edges with more than two faces, or with two that run along them in the same direction.
pub(super) fn of_edges(uses: &[EdgeUse]) -> Vec<Defect> {
    let defect = |uses: &[EdgeUse]| {
        let kind = match uses {
            [_] => return None,
            [a, b] if a.forward != b.forward => return None,
            [_, _] => DefectKind::InconsistentOrientation,
            _ => DefectKind::MoreThanTwoFaces,
        };
        Some(Defect { kind, faces: uses.iter().map(|u| u.face).collect(), vertices: uses[0].edge.to_vec() })
    };
    by_edge(uses).filter_map(defect).collect()
}

/// The diagonal of the box around points.
pub(crate) fn diagonal(points: &[Vector]) -> f64 {
    let Some(first) = points.first() else { return 0.0 };
    let (low, high) = points.iter().fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
    (high - low).norm()
}
