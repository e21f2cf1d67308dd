//! Which edges of some rings meet where they should not: a sweep over edges sorted by x, signs by exact predicates.

use robust::{Coord, orient2d};

/// Edge `at` of ring `ring`, from `from` to `to`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub ring: usize,
    pub at: usize,
    /// Position among the ring's edges that have a length, and how many those are.
    order: usize,
    count: usize,
    from: [f64; 2],
    to: [f64; 2],
}

/// The edges of all rings, zero-length ones left out.
pub(super) fn edges(rings: &[Vec<[f64; 2]>]) -> Vec<Edge> {
    let of_ring = |(ring, points): (usize, &Vec<[f64; 2]>)| {
        let ends = points.iter().zip(points.iter().cycle().skip(1)).enumerate();
        let edge =
            |(at, (from, to)): (usize, (&[f64; 2], &[f64; 2]))| Edge { ring, at, order: 0, count: 0, from: *from, to: *to };
        let mut long: Vec<Edge> = ends.filter(|(_, (from, to))| from != to).map(edge).collect();
        let count = long.len();
        long.iter_mut().enumerate().for_each(|(order, edge)| (edge.order, edge.count) = (order, count));
        long
    };
    rings.iter().enumerate().flat_map(of_ring).collect()
}

/// Pairs of edges that cross, touch or overlap, neighbours only where they fold back on one another.
pub(super) fn crossings(mut edges: Vec<Edge>) -> Vec<(Edge, Edge)> {
    let left = |edge: &Edge| edge.from[0].min(edge.to[0]);
    let right = |edge: &Edge| edge.from[0].max(edge.to[0]);
    edges.sort_by(|a, b| left(a).total_cmp(&left(b)).then((a.ring, a.at).cmp(&(b.ring, b.at))));
    let mut found = Vec::new();
    let mut open: Vec<Edge> = Vec::new();
    for edge in edges {
        open.retain(|earlier| right(earlier) >= left(&edge));
        found.extend(open.iter().filter(|earlier| meet(earlier, &edge)).map(|earlier| ordered(*earlier, edge)));
        open.push(edge);
    }
    found.sort_by_key(|(a, b)| (a.ring, b.ring, a.at, b.at));
    found
}

fn ordered(a: Edge, b: Edge) -> (Edge, Edge) {
    if (a.ring, a.at) <= (b.ring, b.at) { (a, b) } else { (b, a) }
}

fn meet(a: &Edge, b: &Edge) -> bool {
    if a.ring == b.ring {
        if (a.order + 1) % a.count == b.order {
            return folds_back(a.from, a.to, b.to);
        }
        if (b.order + 1) % b.count == a.order {
            return folds_back(b.from, b.to, a.to);
        }
    }
    let (a_from, a_to) = (side(b, a.from), side(b, a.to));
    let (b_from, b_to) = (side(a, b.from), side(a, b.to));
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    !apart(a_from, a_to) && !apart(b_from, b_to) && boxes_meet(a, b)
}

/// Positive where the point lies left of the edge; exact in its sign.
fn side(edge: &Edge, point: [f64; 2]) -> f64 {
    orientation(edge.from, edge.to, point)
}

pub(super) fn orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coord = |[x, y]: [f64; 2]| Coord { x, y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Neighbours share a point; more only if the second runs straight back over the first.
fn folds_back(from: [f64; 2], through: [f64; 2], to: [f64; 2]) -> bool {
    let (d, e) = ([through[0] - from[0], through[1] - from[1]], [to[0] - through[0], to[1] - through[1]]);
    orientation(from, through, to) == 0.0 && d[0] * e[0] + d[1] * e[1] < 0.0
}

fn boxes_meet(a: &Edge, b: &Edge) -> bool {
    (0..2).all(|d| a.from[d].min(a.to[d]) <= b.from[d].max(b.to[d]) && b.from[d].min(b.to[d]) <= a.from[d].max(a.to[d]))
}
