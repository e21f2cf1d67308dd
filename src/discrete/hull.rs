//! What the rows of a catalogue have in common: for every two of its columns the edges of the convex hull of their points, as inequalities
//! that all rows meet and few other points do.

/// a·u + b·v ≤ c for columns `first` (u) and `second` (v).
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs)]
pub struct Facet {
    pub first: usize,
    pub second: usize,
    pub a: f64,
    pub b: f64,
    pub c: f64,
}

impl Facet {
    /// The least c that the rows of a range meet, rounded outwards.
    pub fn reach<'r>(&self, rows: impl Iterator<Item = &'r Vec<f64>>) -> f64 {
        let one = |row: &Vec<f64>| {
            let (u, v) = (self.a * row[self.first], self.b * row[self.second]);
            u + v + 64.0 * f64::EPSILON * (u.abs() + v.abs())
        };
        rows.map(one).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Beyond so many columns pairs would be too many.
const MOST_COLUMNS: usize = 8;

/// The facets over all pairs of columns, rounded outwards so that every row meets them.
///
/// ```
/// use ribopt::discrete::hull::facets;
/// // A square of points with its middle: four edges.
/// let rows = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]].map(Vec::from);
/// assert_eq!(facets(&rows).len(), 4);
/// ```
pub fn facets(rows: &[Vec<f64>]) -> Vec<Facet> {
    let columns = rows.first().map_or(0, Vec::len).min(MOST_COLUMNS);
    let pairs = (0..columns).flat_map(|first| (first + 1..columns).map(move |second| (first, second)));
    pairs.flat_map(|(first, second)| of_pair(rows, first, second)).collect()
}

fn of_pair(rows: &[Vec<f64>], first: usize, second: usize) -> Vec<Facet> {
    let points: Vec<[f64; 2]> = rows.iter().map(|row| [row[first], row[second]]).collect();
    let corners = hull(points.clone());
    if corners.len() < 2 || points.iter().flatten().any(|value| !value.is_finite()) {
        return Vec::new();
    }
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let facet = |(from, to): (&[f64; 2], &[f64; 2])| {
        // The outer normal of a counter-clockwise edge, its larger component 1.
        let (a, b) = (to[1] - from[1], from[0] - to[0]);
        let size = a.abs().max(b.abs());
        let (a, b) = (a / size, b / size);
        let facet = Facet { first, second, a, b, c: f64::INFINITY };
        Facet { c: facet.reach(rows.iter()), ..facet }
    };
    edges.map(facet).collect()
}

/// The corners of the convex hull, counter-clockwise (Andrew's monotone chain, 1979).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    points.dedup();
    let turn = |o: [f64; 2], p: [f64; 2], q: [f64; 2]| (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., o, p] = chain[..]
                && turn(o, p, point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop(); // the other chain begins there
        chain
    };
    let mut corners = chain(&mut points.iter().copied());
    corners.extend(chain(&mut points.iter().rev().copied()));
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_row_meets_every_facet(rows in prop::collection::vec(prop::collection::vec(-10.0..10.0_f64, 3), 1..30)) {
            for facet in facets(&rows) {
                for row in &rows {
                    prop_assert!(facet.a * row[facet.first] + facet.b * row[facet.second] <= facet.c);
                }
            }
        }
    }

    #[test]
    fn points_on_a_line_have_two_facets_and_one_point_none() {
        let line: Vec<Vec<f64>> = (0..5).map(|k| vec![f64::from(k), 2.0 * f64::from(k)]).collect();
        assert_eq!(facets(&line).len(), 2);
        assert!(facets(&line[..1]).is_empty());
    }
}
