//! A mesh as a file gives it: points, faces of any size, flagged edges, groups. Nothing is checked but the numbering.

use super::Vector;

/// Points and polygons, with the edges that carry ribs and the groups of faces.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PolygonMesh {
    /// Positions of the vertices.
    pub vertices: Vec<Vector>,
    /// Vertex numbers of all faces, one face after the other.
    corners: Vec<u32>,
    /// Where each face ends in `corners`.
    ends: Vec<u32>,
    /// Edges flagged as ribs (OBJ `l` elements), as pairs of vertices.
    pub ribs: Vec<[u32; 2]>,
    /// Runs of `ribs`, as first and end, that the file gives as whole lines: polylines, and edges with a name of their own.
    pub wholes: Vec<[u32; 2]>,
    /// What the file holds and was not read, in words.
    pub notes: Vec<String>,
    /// Names of face groups.
    pub groups: Vec<String>,
    /// The group of each face, an index into `groups`; empty where the file has none.
    pub group_of: Vec<u32>,
}

impl PolygonMesh {
    /// A mesh of these quads.
    pub fn from_quads(vertices: Vec<Vector>, quads: &[[u32; 4]]) -> Self {
        let mut mesh = PolygonMesh { vertices, ..Default::default() };
        for quad in quads {
            mesh.push_face(quad);
        }
        mesh
    }

    /// Appends a face. Vertices are numbered from 0.
    pub fn push_face(&mut self, face: &[u32]) {
        self.corners.extend_from_slice(face);
        self.ends.push(self.corners.len() as u32);
    }

    /// Appends a polyline as a whole line that carries ribs.
    pub fn push_line(&mut self, vertices: &[u32]) {
        let first = self.ribs.len() as u32;
        self.ribs.extend(vertices.windows(2).map(|pair| [pair[0], pair[1]]));
        self.wholes.push([first, self.ribs.len() as u32]);
    }

    /// The ribs of another mesh with its vertices numbered anew; those that lose their length are left out.
    pub fn set_ribs(&mut self, other: &PolygonMesh, number: impl Fn(u32) -> u32) {
        let ribs: Vec<[u32; 2]> = other.ribs.iter().map(|rib| rib.map(&number)).collect();
        let kept: Vec<u32> = std::iter::once(0)
            .chain(ribs.iter().scan(0, |kept, [a, b]| {
                *kept += u32::from(a != b);
                Some(*kept)
            }))
            .collect();
        self.wholes = other.wholes.iter().map(|whole| whole.map(|at| kept[at as usize])).collect();
        self.ribs = ribs.into_iter().filter(|[a, b]| a != b).collect();
    }

    /// Leaves out corners that repeat their neighbour, where three or more are left, and says of how many faces: a triangle is
    /// often written as a quad.
    pub fn drop_repeated_corners(&mut self) -> usize {
        let repeats = |face: &[u32]| (0..face.len()).any(|k| face[k] == face[(k + 1) % face.len()]);
        if !self.faces().any(repeats) {
            return 0;
        }
        let mut count = 0;
        let old = std::mem::take(self);
        for face in old.faces() {
            let mut kept = face.to_vec();
            kept.dedup();
            while kept.len() > 1 && kept.first() == kept.last() {
                kept.pop();
            }
            let fits = kept.len() >= 3;
            count += usize::from(fits && kept.len() < face.len());
            self.push_face(if fits { &kept } else { face });
        }
        *self = PolygonMesh { corners: std::mem::take(&mut self.corners), ends: std::mem::take(&mut self.ends), ..old };
        count
    }

    /// Whether there are lines and no faces.
    pub fn is_lines(&self) -> bool {
        self.ends.is_empty() && !self.ribs.is_empty()
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.ends.len()
    }

    /// The vertices of face `f`; empty past the last face.
    pub fn face(&self, f: usize) -> &[u32] {
        let start = if f == 0 { 0 } else { self.ends.get(f - 1).map_or(0, |&end| end as usize) };
        self.ends.get(f).and_then(|&end| self.corners.get(start..end as usize)).unwrap_or(&[])
    }

    /// All faces in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        (0..self.face_count()).map(|f| self.face(f))
    }

    /// The points of face `f`.
    pub fn points(&self, f: usize) -> impl Iterator<Item = Vector> {
        self.face(f).iter().map(|&v| self.vertices[v as usize])
    }

    /// The mean of the corners of face `f`.
    pub fn centre(&self, f: usize) -> Vector {
        let count = self.face(f).len().max(1) as f64;
        self.points(f).sum::<Vector>() / count
    }

    /// The vector area of face `f` (Newell): along the normal, as long as the area of a planar face.
    pub fn vector_area(&self, f: usize) -> Vector {
        let centre = self.centre(f);
        self.rim(f).map(|(p, q)| (p - centre).cross(&(q - centre)) / 2.0).sum()
    }

    /// The enclosed volume, by the divergence theorem over fans about each face's centre: exact for planar faces, and for a
    /// quad exactly the volume under the bilinear patch. Meaningful for closed, outward oriented meshes.
    pub fn volume(&self) -> f64 {
        let origin = self.vertices.first().copied().unwrap_or_default();
        let under = |f| {
            let centre = self.centre(f) - origin;
            self.rim(f).map(|(p, q)| centre.dot(&(p - origin).cross(&(q - origin)))).sum::<f64>()
        };
        (0..self.face_count()).map(under).sum::<f64>() / 6.0
    }

    /// The sides of face `f` as pairs of points.
    fn rim(&self, f: usize) -> impl Iterator<Item = (Vector, Vector)> {
        let face = self.face(f);
        let at = |k: usize| self.vertices[face[k % face.len()] as usize];
        (0..face.len()).map(move |k| (at(k), at(k + 1)))
    }

    /// Every face as a fan of triangles, with the face's number: quads from an end of their shorter diagonal, so that the
    /// triangles do not depend on where the file begins a face; larger faces from their first corner.
    pub fn fans(&self) -> impl Iterator<Item = (usize, [u32; 3])> {
        let fan = |f: usize| {
            let mut face = self.face(f).to_vec();
            face.rotate_left(self.fan_start(f));
            let triangles: Vec<[u32; 3]> = face.windows(2).skip(1).map(|pair| [face[0], pair[0], pair[1]]).collect();
            triangles.into_iter().map(move |triangle| (f, triangle))
        };
        (0..self.face_count()).flat_map(fan)
    }

    fn fan_start(&self, f: usize) -> usize {
        let points: Vec<Vector> = self.points(f).collect();
        match points[..] {
            [a, b, c, d] => usize::from((d - b).norm_squared() < (c - a).norm_squared()),
            _ => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volume_of_a_twisted_quad_is_that_of_the_bilinear_patch() {
        // A unit cube whose top has one corner raised by 1: ∫ uv over the unit square adds 1/4.
        let p = |x, y, z| Vector::new(x, y, z);
        let top = [p(0., 0., 1.), p(1., 0., 1.), p(1., 1., 2.), p(0., 1., 1.)];
        let vertices = [[p(0., 0., 0.), p(1., 0., 0.), p(1., 1., 0.), p(0., 1., 0.)], top].concat();
        let faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        let mesh = PolygonMesh::from_quads(vertices, &faces);
        assert!((mesh.volume() - 1.25).abs() < 1e-15);
    }
}
