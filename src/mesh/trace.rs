//! Tracing edges to rib lines (note 3.5).
//!
//! At a vertex two edges are partners where a line runs straight on: opposite edges of an interior vertex of valence 4, the
//! two boundary edges of a boundary vertex of valence 3. Partnership is mutual, so the lines partition the edges.

use serde::Serialize;

use super::graph::Rule;
use super::stations::Support;
use super::{NONE, QuadMesh};

/// A rib line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// Vertices in order; a closed line repeats its first at the end, so that there is one more than edges.
    pub vertices: Vec<u32>,
    /// Edges in order.
    pub edges: Vec<u32>,
    /// Whether the line ends where it begins, running straight on there.
    pub closed: bool,
}

/// What tracing found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TraceReport {
    /// Lines.
    pub lines: usize,
    /// Those that close.
    pub closed: usize,
    /// Edges on them; the number of rib edges.
    pub edges: usize,
    /// Whether only flagged edges were traced.
    pub flagged_only: bool,
    /// How edges were joined to lines.
    pub rule: Rule,
    /// Vertices where lines end.
    pub ends: usize,
    /// Length of all lines.
    pub length: f64,
    /// Lines that meet themselves, by number from 1, with the vertices (from 1) where they do.
    pub self_crossings: Vec<SelfCrossing>,
    /// What a user should know of the file.
    pub notes: Vec<String>,
}

/// A line that passes a vertex more than once.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SelfCrossing {
    /// The line, from 1.
    pub line: usize,
    /// The vertices, from 1.
    pub vertices: Vec<u32>,
}

/// Traces all rib edges: open lines first, each from its end with the smaller edge number, then the closed ones.
///
/// ```
/// use ribopt::mesh::{QuadMesh, generate, trace::{report, trace}};
/// let cube = QuadMesh::new(generate::cube(3))?;
/// let found = report(&cube, &trace(&cube));
/// assert_eq!((found.lines, found.closed, found.edges), (18, 6, 108));
/// # Ok::<(), ribopt::mesh::Defects>(())
/// ```
pub fn trace(mesh: &QuadMesh) -> Vec<Line> {
    lines_of(mesh.edge_count() as u32, |e| mesh.ends(e), |e| mesh.is_rib(e), &partners(mesh))
}

/// The lines of edges that know their partners.
pub(super) fn lines_of(
    count: u32,
    ends: impl Fn(u32) -> [u32; 2],
    is_rib: impl Fn(u32) -> bool,
    partners: &[[u32; 2]],
) -> Vec<Line> {
    let mut seen = vec![false; count as usize];
    let mut lines = Vec::new();
    let ribs = || (0..count).filter(|&e| is_rib(e));
    for edge in ribs() {
        for end in 0..2 {
            if partners[edge as usize][end] == NONE && !seen[edge as usize] {
                lines.push(follow(&ends, partners, &mut seen, edge, end));
            }
        }
    }
    for edge in ribs() {
        if !seen[edge as usize] {
            lines.push(follow(&ends, partners, &mut seen, edge, 0));
        }
    }
    lines
}

/// For both ends of every edge the edge that goes on there, or [`NONE`].
fn partners(mesh: &QuadMesh) -> Vec<[u32; 2]> {
    let mut partners = vec![[NONE; 2]; mesh.edge_count()];
    let mut edges = Vec::new();
    for v in 0..mesh.vertex_count() as u32 {
        edges.clear();
        edges.extend(mesh.edges_at(v));
        let pairs: &[[usize; 2]] = match (mesh.is_boundary(v), edges.len()) {
            (false, 4) => &[[0, 2], [1, 3]],
            (true, 3) => &[[0, 2]],
            _ => &[],
        };
        for &[i, j] in pairs {
            let (a, b) = (edges[i], edges[j]);
            if mesh.is_rib(a) && mesh.is_rib(b) {
                partners[a as usize][end_at(mesh, a, v)] = b;
                partners[b as usize][end_at(mesh, b, v)] = a;
            }
        }
    }
    partners
}

/// Which end of edge `e` vertex `v` is: 0 or 1.
fn end_at(mesh: &QuadMesh, e: u32, v: u32) -> usize {
    usize::from(mesh.ends(e)[0] != v)
}

/// Walks from end `end` of `edge` away over the edge until the line ends or comes back to `edge`.
fn follow(ends: impl Fn(u32) -> [u32; 2], partners: &[[u32; 2]], seen: &mut [bool], edge: u32, end: usize) -> Line {
    let mut line = Line { vertices: vec![ends(edge)[end]], edges: Vec::new(), closed: false };
    let (mut edge, mut end) = (edge, end);
    loop {
        seen[edge as usize] = true;
        line.edges.push(edge);
        let far = ends(edge)[1 - end];
        line.vertices.push(far);
        let onward = partners[edge as usize][1 - end];
        if onward == NONE {
            return line;
        }
        if seen[onward as usize] {
            line.closed = true;
            return line;
        }
        (edge, end) = (onward, usize::from(ends(onward)[0] != far));
    }
}

/// Counts lines, sums their length and finds where they meet themselves.
pub fn report(support: &dyn Support, lines: &[Line]) -> TraceReport {
    let crossing = |(at, line): (usize, &Line)| {
        let vertices = repeated(line);
        (!vertices.is_empty()).then_some(SelfCrossing { line: at + 1, vertices })
    };
    let chord = |pair: &[u32]| (support.position(pair[1]) - support.position(pair[0])).norm();
    TraceReport {
        lines: lines.len(),
        closed: lines.iter().filter(|line| line.closed).count(),
        edges: lines.iter().map(|line| line.edges.len()).sum(),
        flagged_only: support.has_flags(),
        rule: Rule::Topology,
        ends: ends(lines),
        length: lines.iter().flat_map(|line| line.vertices.windows(2)).map(chord).sum(),
        self_crossings: lines.iter().enumerate().filter_map(crossing).collect(),
        notes: Vec::new(),
    }
}

fn ends(lines: &[Line]) -> usize {
    let open = lines.iter().filter(|line| !line.closed);
    let mut ends: Vec<u32> =
        open.flat_map(|line| line.vertices.first().into_iter().chain(line.vertices.last())).copied().collect();
    ends.sort_unstable();
    ends.dedup();
    ends.len()
}

/// Vertices (from 1) a line passes more than once. Ends that meet, closed or at a corner, are no crossing.
fn repeated(line: &Line) -> Vec<u32> {
    let ends_meet = line.vertices.first() == line.vertices.last();
    let mut passed = line.vertices[usize::from(ends_meet)..].to_vec();
    passed.sort_unstable();
    passed.chunk_by(|a, b| a == b).filter(|same| same.len() > 1).map(|same| same[0] + 1).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::mesh::{PolygonMesh, Vector, generate};

    fn traced(mesh: PolygonMesh) -> TraceReport {
        let mesh = QuadMesh::new(mesh).unwrap();
        report(&mesh, &trace(&mesh))
    }

    #[test]
    fn a_grid_of_4_by_3_has_nine_lines() {
        let report = traced(generate::grid(4, 3, 1.0));
        assert_eq!((report.lines, report.closed, report.edges, report.length), (9, 0, 31, 31.0));
    }

    #[test]
    fn cubes_have_closed_lines_between_their_edges() {
        for n in 1..6 {
            let report = traced(generate::cube(n));
            let n = n as usize;
            assert_eq!((report.lines, report.closed, report.edges), (12 + 3 * (n - 1), 3 * (n - 1), 12 * n * n));
            assert!(report.self_crossings.is_empty());
        }
    }

    #[test]
    fn flags_hide_the_other_edges() {
        let mut mesh = generate::grid(4, 3, 1.0);
        mesh.ribs = vec![[5, 6], [6, 7], [7, 8], [8, 9], [2, 7]];
        let report = traced(mesh);
        assert_eq!((report.lines, report.edges, report.flagged_only), (2, 5, true));
    }

    #[test]
    fn a_line_that_crosses_itself_is_reported() {
        // A quarter plane closed to a cone, its tip cut off: the line x = 3 comes back as y = 3 and meets itself at (3, 3).
        let mut plane = generate::grid(4, 4, 1.0);
        for p in &mut plane.vertices {
            let (r, turn) = (p.x.hypot(p.y), 4.0 * p.y.atan2(p.x));
            *p = Vector::new(r * turn.cos(), r * turn.sin(), 0.0);
        }
        let mut cone = PolygonMesh::default();
        cone.vertices = plane.vertices.clone();
        plane.faces().enumerate().filter(|(f, _)| ![0, 1, 4, 5].contains(f)).for_each(|(_, face)| cone.push_face(face));
        let report = traced(crate::mesh::weld::weld(cone, 1e-9).0);
        assert_eq!(report.self_crossings.len(), 1, "{report:?}");
        assert_eq!(report.self_crossings[0].vertices.len(), 1);
    }

    proptest! {
        /// Random connected sets of cells of a grid: boundaries of every valence, holes, notches.
        #[test]
        fn lines_partition_the_edges(cells in prop::collection::vec(any::<bool>(), 36)) {
            let mesh = generate::grid(6, 6, 1.0);
            let kept: Vec<[u32; 4]> = mesh.faces().zip(&cells).filter(|(_, keep)| **keep).filter_map(|(f, _)| f.try_into().ok()).collect();
            if let Ok(mesh) = QuadMesh::new(PolygonMesh::from_quads(mesh.vertices, &kept)) {
                let lines = trace(&mesh);
                let mut edges: Vec<u32> = lines.iter().flat_map(|line| line.edges.clone()).collect();
                edges.sort_unstable();
                prop_assert_eq!(edges, (0..mesh.edge_count() as u32).collect::<Vec<_>>());
                for line in &lines {
                    prop_assert_eq!(line.vertices.len(), line.edges.len() + 1);
                }
            }
        }
    }
}
