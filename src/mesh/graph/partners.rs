//! Which edge goes on where another ends. Partnership is mutual, so lines partition the edges.

use super::{Graph, Rule, corners_at};
use crate::mesh::edge_list::{EdgeUse, by_edge};
use crate::mesh::{NONE, PolygonMesh, Vector, angle};

/// A line goes on if it turns by at most this: 45° and rounding, the corner of a regular octagon.
const STRAIGHTEST: f64 = std::f64::consts::FRAC_PI_4 + 1e-6;

/// Where only two edges meet there is nothing to choose; the line ends at a corner (60°, as for feature curves).
const CORNER: f64 = std::f64::consts::FRAC_PI_3 + 1e-6;

/// The next straightest continuation must turn by at least so many times as much. At an inner vertex of five triangles both
/// candidates turn alike (36°), and the line ends; at the corner of an octagon (45°) an upright (90°) is clearly another.
const CLEARLY: f64 = 1.5;

/// Lines end where more edges meet than this; spread evenly, so many are 6° apart and hardly one goes on clearly.
const HUB: usize = 64;

/// For both ends of every edge the edge that goes on there, or [`NONE`].
pub(super) fn find(graph: &Graph, mesh: &PolygonMesh, uses: &[EdgeUse], wholes: &[Vec<u32>]) -> Vec<[u32; 2]> {
    let mut pairs = Pairs { ends: &graph.ends, partners: vec![[NONE; 2]; graph.ends.len()] };
    match graph.rule {
        Rule::Topology => by_topology(&mut pairs, graph, mesh, uses),
        Rule::Straight | Rule::Auto => {
            let closed_off = given(&mut pairs, wholes);
            straight_on(&mut pairs, graph, &closed_off);
        }
        Rule::Given => _ = given(&mut pairs, wholes),
        Rule::Edges => {}
    }
    pairs.partners
}

struct Pairs<'a> {
    ends: &'a [[u32; 2]],
    partners: Vec<[u32; 2]>,
}

impl Pairs<'_> {
    fn end_at(&self, e: u32, v: u32) -> usize {
        usize::from(self.ends[e as usize][0] != v)
    }

    fn join(&mut self, a: u32, b: u32, v: u32) {
        let ends = [self.end_at(a, v), self.end_at(b, v)];
        self.partners[a as usize][ends[0]] = b;
        self.partners[b as usize][ends[1]] = a;
    }

    fn is_free(&self, e: u32, v: u32) -> bool {
        self.partners[e as usize][self.end_at(e, v)] == NONE
    }

    /// The vertex two edges share, other than `not`.
    fn shared(&self, a: u32, b: u32, not: u32) -> Option<u32> {
        let other = self.ends[b as usize];
        self.ends[a as usize].into_iter().find(|v| *v != not && other.contains(v))
    }
}

/// The file's own lines. Says of every edge whether it is on one: such a line goes on nowhere else. An edge that is given twice stays
/// with the first line; a later one is cut there.
fn given(pairs: &mut Pairs, wholes: &[Vec<u32>]) -> Vec<bool> {
    let mut owner = vec![NONE; pairs.ends.len()];
    for (w, whole) in (0u32..).zip(wholes) {
        for &e in whole {
            if owner[e as usize] == NONE {
                owner[e as usize] = w;
            }
        }
    }
    for (w, whole) in (0u32..).zip(wholes) {
        let own = |e: u32| owner[e as usize] == w;
        let mut last = NONE;
        for pair in whole.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let Some(v) = pairs.shared(a, b, last) else { continue };
            if a != b && own(a) && own(b) && pairs.is_free(a, v) && pairs.is_free(b, v) {
                pairs.join(a, b, v);
            }
            last = v;
        }
        // A ring: its last edge comes back to the first.
        if let [first, second, .., end] = whole[..]
            && own(first)
            && own(end)
            && first != end
            && let Some(v) = pairs.shared(first, second, NONE).and_then(|inner| pairs.shared(first, end, inner))
            && pairs.is_free(first, v)
            && pairs.is_free(end, v)
        {
            pairs.join(first, end, v);
        }
    }
    owner.iter().map(|&owner| owner != NONE).collect()
}

/// Opposite edges of inner vertices of valence 4, the two boundary edges of boundary vertices of valence 3 (note 3.5). Everywhere
/// else lines end: at poles, at caps, where more than two faces meet.
fn by_topology(pairs: &mut Pairs, graph: &Graph, mesh: &PolygonMesh, uses: &[EdgeUse]) {
    let faces: Vec<usize> = by_edge(uses).map(<[EdgeUse]>::len).collect();
    let mut edges: Vec<u32> = Vec::new();
    for (v, corners) in (0u32..).zip(corners_at(mesh, uses)) {
        edges.clear();
        edges.extend(corners.iter().flatten());
        edges.sort_unstable();
        edges.dedup();
        let rim: Vec<u32> = edges.iter().copied().filter(|&e| faces[e as usize] == 1).collect();
        let opposite = |e: u32| {
            let touches = |other: u32| corners.iter().any(|corner| corner.contains(&e) && corner.contains(&other));
            let mut far = edges.iter().copied().filter(|&other| other != e && !touches(other));
            far.next().filter(|_| far.next().is_none())
        };
        let is_manifold = edges.iter().all(|&e| faces[e as usize] <= 2);
        match (edges.len(), corners.len(), rim.len()) {
            (4, 4, 0) if is_manifold => {
                let first = edges[0];
                let Some(across) = opposite(first) else { continue };
                let others: Vec<u32> = edges.iter().copied().filter(|&e| e != first && e != across).collect();
                for [a, b] in [[first, across], [others[0], others[1]]] {
                    join_ribs(pairs, graph, [a, b], v);
                }
            }
            (3, 2, 2) if is_manifold => join_ribs(pairs, graph, [rim[0], rim[1]], v),
            _ => {}
        }
    }
}

fn join_ribs(pairs: &mut Pairs, graph: &Graph, [a, b]: [u32; 2], v: u32) {
    if graph.ribs[a as usize] && graph.ribs[b as usize] {
        pairs.join(a, b, v);
    }
}

/// Pairs of edges that are each other's straightest continuation, clearly.
fn straight_on(pairs: &mut Pairs, graph: &Graph, taken: &[bool]) {
    let mut edges_at: Vec<Vec<u32>> = vec![Vec::new(); graph.positions.len()];
    for e in (0..graph.ends.len() as u32).filter(|&e| graph.ribs[e as usize] && !taken.get(e as usize).is_some_and(|&t| t)) {
        graph.ends[e as usize].iter().for_each(|&v| edges_at[v as usize].push(e));
    }
    for (v, edges) in (0u32..).zip(&edges_at).filter(|(_, edges)| edges.len() <= HUB) {
        let directions: Vec<Vector> = edges.iter().map(|&e| outward(graph, e, v)).collect();
        let turn = |i: usize, j: usize| std::f64::consts::PI - angle(&directions[i], &directions[j]);
        let most = if edges.len() == 2 { CORNER } else { STRAIGHTEST };
        let best = |i: usize| {
            let mut turns: Vec<(f64, usize)> = (0..edges.len()).filter(|&j| j != i).map(|j| (turn(i, j), j)).collect();
            turns.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (least, first) = *turns.first()?;
            let clear = turns.get(1).is_none_or(|&(next, _)| next >= CLEARLY * least.max(1e-3));
            (least <= most && clear).then_some(first)
        };
        for i in 0..edges.len() {
            if let Some(j) = best(i).filter(|&j| j > i && best(j) == Some(i)) {
                pairs.join(edges[i], edges[j], v);
            }
        }
    }
}

/// The direction of edge `e` away from `v`; on a surface in its tangent plane, so that a line that follows a coarse curved
/// surface counts as straight.
fn outward(graph: &Graph, e: u32, v: u32) -> Vector {
    let [a, b] = graph.ends[e as usize];
    let other = if a == v { b } else { a };
    let along = graph.positions[other as usize] - graph.positions[v as usize];
    match graph.normals.get(v as usize).copied().flatten() {
        Some(normal) => along - normal * normal.dot(&along),
        None => along,
    }
}
