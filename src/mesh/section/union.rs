//! What pieces of a section cover together: solids that run through one another are counted once.

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::Piece;

/// The area of the union, where pieces overlap; `None` where they do not, or where their outlines cannot be brought into one
/// triangulation (points out of the numbers). Outlines are cut where they cross; every triangle lies inside or outside every
/// piece.
pub(super) fn area(pieces: &[Piece]) -> Option<f64> {
    let boxes: Vec<[[f64; 2]; 2]> = pieces.iter().map(bounding_box).collect();
    let meets = |a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]| (0..2).all(|c| a[0][c] < b[1][c] && b[0][c] < a[1][c]);
    let touched = (0..pieces.len()).any(|i| (0..i).any(|j| meets(&boxes[i], &boxes[j])));
    if !touched {
        return None;
    }
    let mut triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    for ring in pieces.iter().flat_map(|piece| piece.polygon.rings()) {
        let mut handles = Vec::with_capacity(ring.len());
        for p in ring {
            handles.push(triangulation.insert(Point2::new(p[0], p[1])).ok()?);
        }
        for k in 0..handles.len() {
            let (a, b) = (handles[k], handles[(k + 1) % handles.len()]);
            if a != b {
                triangulation.add_constraint_and_split(a, b, |point| point);
            }
        }
    }
    let (mut once, mut often) = (0.0, 0.0);
    for face in triangulation.inner_faces() {
        let [a, b, c] = face.positions();
        let centre = [(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0];
        let over = (0..pieces.len()).filter(|&k| is_in_box(&boxes[k], centre) && is_inside(&pieces[k], centre)).count();
        if over > 0 {
            once += face.area();
            often += face.area() * (over - 1) as f64;
        }
    }
    (often > 1e-9 * once).then_some(once)
}

fn bounding_box(piece: &Piece) -> [[f64; 2]; 2] {
    let points = piece.polygon.rings().iter().flatten();
    points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    })
}

fn is_in_box([low, high]: &[[f64; 2]; 2], p: [f64; 2]) -> bool {
    (0..2).all(|c| low[c] <= p[c] && p[c] <= high[c])
}

/// Even–odd over the outline and the holes.
fn is_inside(piece: &Piece, p: [f64; 2]) -> bool {
    piece.polygon.rings().iter().filter(|ring| super::contains(ring, p)).count() % 2 == 1
}
