//! The same numbers of any polygon mesh or of lines alone, sound or not: as many as are defined.

use super::Invariants;
use crate::mesh::edge_list::{EdgeUse, by_edge, edge_uses};
use crate::mesh::quality::{Range, patch_area};
use crate::mesh::{PolygonMesh, angle};

/// Measures whatever a file holds. Vertices of separate fans count once; boundary loops are followed side by side.
///
/// ```
/// use ribopt::mesh::{formats::read_obj, invariants::measure_any};
/// let pyramid = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
/// let found = measure_any(&read_obj(pyramid.as_bytes())?);
/// assert_eq!((found.triangles, found.quads, found.euler_characteristic), (4, 1, 2));
/// assert!(found.valence_identity && found.boundary_loops.is_empty());
/// # Ok::<(), ribopt::mesh::formats::FormatError>(())
/// ```
pub fn measure_any(mesh: &PolygonMesh) -> Invariants {
    let uses = edge_uses(mesh);
    let mut edges: Vec<[u32; 2]> = by_edge(&uses).map(|uses| uses[0].edge).collect();
    let mut ribs: Vec<[u32; 2]> = mesh.ribs.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    ribs.sort_unstable();
    ribs.dedup();
    if mesh.face_count() == 0 {
        edges.clone_from(&ribs);
    }
    let corner_sum = mesh.faces().map(|face| face.len() as i64 - 4).sum();
    let [vertices, unused] = used(mesh, &edges);
    let euler = vertices as i64 - edges.len() as i64 + mesh.face_count() as i64;
    let sizes = |test: fn(usize) -> bool| mesh.faces().filter(|face| test(face.len())).count();
    let (sum, interior, rim) = valences(mesh, &edges, &uses);
    Invariants {
        vertices,
        unused_vertices: unused,
        edges: edges.len(),
        rib_edges: if ribs.is_empty() { edges.len() } else { ribs.len() },
        faces: mesh.face_count(),
        triangles: sizes(|corners| corners == 3),
        quads: sizes(|corners| corners == 4),
        larger: sizes(|corners| corners > 4),
        components: components(mesh, &edges),
        euler_characteristic: euler,
        boundary_loops: boundary_loops(mesh, &uses),
        irregular_interior: interior,
        irregular_boundary: rim,
        valence_sum: sum,
        corner_sum,
        valence_identity: sum == 4 * euler + corner_sum,
        planarity: Range::of((0..mesh.face_count()).map(|f| planarity(mesh, f))),
        angles: Range::of((0..mesh.face_count()).flat_map(|f| angles(mesh, f))),
        edge_lengths: Range::of(edges.iter().map(|edge| {
            let [a, b] = edge.map(|v| mesh.vertices[v as usize]);
            (b - a).norm()
        })),
        area: (0..mesh.face_count()).map(|f| area(mesh, f)).sum(),
    }
}

/// Vertices with and without edges.
fn used(mesh: &PolygonMesh, edges: &[[u32; 2]]) -> [usize; 2] {
    let mut used = vec![false; mesh.vertices.len()];
    edges.iter().flatten().for_each(|&v| used[v as usize] = true);
    let count = used.iter().filter(|&&used| used).count();
    [count, used.len() - count]
}

type Irregular = Vec<[u32; 2]>;

/// The valence sum, and the irregular vertices inside and on the boundary. Of lines alone there are none.
fn valences(mesh: &PolygonMesh, edges: &[[u32; 2]], uses: &[EdgeUse]) -> (i64, Irregular, Irregular) {
    if mesh.face_count() == 0 {
        return (4 * (used(mesh, edges)[0] as i64 - edges.len() as i64), Vec::new(), Vec::new());
    }
    let mut valence = vec![0u32; mesh.vertices.len()];
    edges.iter().flatten().for_each(|&v| valence[v as usize] += 1);
    let mut on_rim = vec![false; mesh.vertices.len()];
    let rim = by_edge(uses).filter(|uses| uses.len() == 1);
    rim.for_each(|uses| uses[0].edge.iter().for_each(|&v| on_rim[v as usize] = true));
    let (mut sum, mut interior, mut boundary) = (0, Vec::new(), Vec::new());
    for (v, &valence) in valence.iter().enumerate().filter(|(_, valence)| **valence > 0) {
        let regular = if on_rim[v] { 3 } else { 4 };
        sum += i64::from(regular) - i64::from(valence);
        if valence != regular {
            let irregular = if on_rim[v] { &mut boundary } else { &mut interior };
            irregular.push([v as u32 + 1, valence]);
        }
    }
    (sum, interior, boundary)
}

fn components(mesh: &PolygonMesh, edges: &[[u32; 2]]) -> usize {
    let mut root: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    fn find(root: &mut [u32], mut v: u32) -> u32 {
        while root[v as usize] != v {
            root[v as usize] = root[root[v as usize] as usize];
            v = root[v as usize];
        }
        v
    }
    let mut pieces = used(mesh, edges)[0];
    for &[a, b] in edges {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        if a != b {
            root[a.max(b) as usize] = a.min(b);
            pieces -= 1;
        }
    }
    pieces
}

/// Lengths of the loops that the sides of one face form, each followed from its end to a side that begins there.
fn boundary_loops(mesh: &PolygonMesh, uses: &[EdgeUse]) -> Vec<usize> {
    let mut onward: Vec<Vec<u32>> = vec![Vec::new(); mesh.vertices.len()];
    let mut starts = Vec::new();
    for side in by_edge(uses).filter(|uses| uses.len() == 1).map(|uses| uses[0]) {
        let [from, to] = if side.forward { side.edge } else { [side.edge[1], side.edge[0]] };
        onward[from as usize].push(to);
        starts.push(from);
    }
    starts.sort_unstable();
    let mut loops = Vec::new();
    for start in starts {
        let (mut at, mut length) = (start, 0);
        while let Some(to) = onward[at as usize].pop() {
            (at, length) = (to, length + 1);
            if at == start {
                break;
            }
        }
        if length > 0 {
            loops.push(length);
        }
    }
    loops
}

/// The distance between the diagonals of a quad, of larger faces the farthest of a corner from the mean plane, over the mean diagonal.
fn planarity(mesh: &PolygonMesh, f: usize) -> f64 {
    let (centre, area) = (mesh.centre(f), mesh.vector_area(f));
    if mesh.face(f).len() == 3 || area.norm() == 0.0 {
        return if area.norm() == 0.0 { 1.0 } else { 0.0 };
    }
    let normal = area / area.norm();
    let off = mesh.points(f).map(|p| (p - centre).dot(&normal).abs()).fold(0.0, f64::max);
    let size = mesh.points(f).map(|p| (p - centre).norm()).sum::<f64>() / mesh.face(f).len() as f64;
    off / size
}

/// Corner angles in degrees.
fn angles(mesh: &PolygonMesh, f: usize) -> Vec<f64> {
    let (points, area) = (mesh.points(f).collect::<Vec<_>>(), mesh.vector_area(f));
    let count = points.len();
    let corner = |k: usize| {
        let (u, v) = (points[(k + 1) % count] - points[k], points[(k + count - 1) % count] - points[k]);
        let between = angle(&u, &v).to_degrees();
        if u.cross(&v).dot(&area) < 0.0 { 360.0 - between } else { between }
    };
    (0..count).map(corner).collect()
}

/// Triangles exactly, quads as bilinear patches, larger faces as fans about their centre.
fn area(mesh: &PolygonMesh, f: usize) -> f64 {
    let points: Vec<_> = mesh.points(f).collect();
    match points[..] {
        [a, b, c] => (b - a).cross(&(c - a)).norm() / 2.0,
        [a, b, c, d] => patch_area(&[a, b, c, d]),
        _ => {
            let centre = mesh.centre(f);
            let next = |k: usize| points[(k + 1) % points.len()];
            (0..points.len()).map(|k| (points[k] - centre).cross(&(next(k) - centre)).norm() / 2.0).sum()
        }
    }
}
