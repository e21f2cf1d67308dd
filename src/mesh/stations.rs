//! Slicing rib lines into stations and segments (docs/formulas.md 3.2).
//!
//! Every edge of a line is cut into equal segments no longer than asked, so mesh vertices are always stations. The frame of
//! a station: x along the line (at a vertex, the bisector of the two directions), z the surface's normal made perpendicular
//! to x, y = z × x. A section's x is the frame's y, its y the frame's z.

use serde::Serialize;

use super::trace::Line;
use super::{NONE, QuadMesh, Vector, unit};

/// A right-handed orthonormal frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Along the rib.
    pub x: Vector,
    /// Across it, in the surface.
    pub y: Vector,
    /// Out of the surface.
    pub z: Vector,
}

impl Frame {
    /// The frame with this tangent and, as nearly as possible, this normal; `None` where either is zero or they are parallel
    /// (to within 1e−6 of a radian).
    pub fn new(tangent: Vector, normal: Vector) -> Option<Frame> {
        let (x, normal) = (unit(tangent)?, unit(normal)?);
        let across = normal.cross(&x);
        let y = unit(across).filter(|_| across.norm() > 1e-6)?;
        Some(Frame { x, y, z: x.cross(&y) })
    }

    /// The frame of a line without a surface: z as near to the global z as can be; of a line that is vertical to within a
    /// thousandth, to the global x.
    pub fn upright(tangent: Vector) -> Option<Frame> {
        let x = unit(tangent)?;
        Frame::new(x, if x.x.hypot(x.y) < 1e-3 { Vector::x() } else { Vector::z() })
    }
}

/// Where the frames of a line come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frames {
    /// A smooth surface: a line without frames, or one where they turn over, is a mistake.
    Smooth,
    /// Any faces: where their normals give no frame, the line is upright.
    Faces,
    /// Nothing but the line itself: it is upright.
    Upright,
}

/// What lines run over: points, and the surface's normals there.
pub trait Support {
    /// Where vertex `v` is.
    fn position(&self, v: u32) -> Vector;
    /// The unit normal of the surface there, if there is one.
    fn normal(&self, v: u32) -> Option<Vector>;
    /// The frame of a line with this tangent, where the surface has this normal.
    fn frame(&self, tangent: Vector, normal: Option<Vector>) -> Option<Frame> {
        Frame::new(tangent, normal?)
    }
    /// Where frames come from.
    fn frames(&self) -> Frames {
        Frames::Smooth
    }
    /// Whether only flagged edges carry ribs.
    fn has_flags(&self) -> bool;
}

impl Support for QuadMesh {
    fn position(&self, v: u32) -> Vector {
        self.positions[v as usize]
    }

    fn normal(&self, v: u32) -> Option<Vector> {
        self.normal_at(v)
    }

    fn has_flags(&self) -> bool {
        QuadMesh::has_flags(self)
    }
}

/// A point on a rib line.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// The mesh vertex here, or [`NONE`].
    pub vertex: u32,
    /// Arc length from the line's beginning.
    pub s: f64,
    /// Where it is.
    pub position: Vector,
    /// The frame.
    pub frame: Frame,
}

/// The stations of one line. A closed line ends with a station at its first point.
#[derive(Debug, Clone, PartialEq)]
pub struct StationLine {
    /// `L1`, `L2`, … in the order of tracing.
    pub name: String,
    /// Whether the last station is the first again.
    pub closed: bool,
    /// The stations.
    pub stations: Vec<Station>,
    /// Where its frames come from.
    pub frames: Frames,
}

impl StationLine {
    /// Arc length of the line.
    pub fn length(&self) -> f64 {
        self.stations.last().map_or(0.0, |station| station.s)
    }
}

/// Why a line cannot be sliced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum StationError {
    #[error("the longest segment must be a positive number, not {0}")]
    Length(f64),
    #[error("{line} would need more than {most} segments of at most {length}; ask for longer ones")]
    TooMany { line: String, length: f64, most: usize },
    #[error(
        "{line} has no frame at vertex {vertex}: the surface's normal is undefined there, or runs along the line; \
         smooth the mesh or move the vertex"
    )]
    NoFrame { line: String, vertex: u32 },
    #[error("the frames of {line} turn by more than a right angle between vertices {from} and {to}; refine the mesh there")]
    Flip { line: String, from: u32, to: u32 },
}

/// Most segments of one line.
const MOST: usize = 10_000_000;

/// Cuts all lines.
///
/// # Errors
/// A length that is no positive number; a station without frame; frames that flip between neighbours.
///
/// ```
/// use ribopt::mesh::{QuadMesh, generate, stations::slice, trace::trace};
/// let mesh = QuadMesh::new(generate::grid(2, 1, 3.0))?;
/// let lines = slice(&mesh, &trace(&mesh), 2.0)?;
/// assert_eq!(lines.iter().map(|line| line.stations.len()).sum::<usize>(), 2 * 5 + 3 * 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn slice(support: &dyn Support, lines: &[Line], longest: f64) -> Result<Vec<StationLine>, StationError> {
    if longest.is_nan() || longest <= 0.0 {
        return Err(StationError::Length(longest));
    }
    lines.iter().enumerate().map(|(at, line)| slice_line(support, line, format!("L{}", at + 1), longest)).collect()
}

fn slice_line(support: &dyn Support, line: &Line, name: String, longest: f64) -> Result<StationLine, StationError> {
    let position = |v: u32| support.position(v);
    let tangents = tangents(line, position);
    let frames = support.frames();
    let strict = frames == Frames::Smooth;
    let no_frame = |vertex: u32| StationError::NoFrame { line: name.clone(), vertex: vertex + 1 };
    let mut sliced = StationLine { name: name.clone(), closed: line.closed, stations: Vec::new(), frames };
    let normal = |v: u32| match support.normal(v) {
        None if strict => Err(no_frame(v)),
        normal => Ok(normal),
    };
    let mut s = 0.0;
    for (k, pair) in line.vertices.windows(2).enumerate() {
        let (a, b) = (pair[0], pair[1]);
        let (from, to) = (normal(a)?, normal(b)?);
        let chord = position(b) - position(a);
        let length = chord.norm();
        let parts = (length / longest).ceil().max(1.0);
        if sliced.stations.len() as f64 + parts > MOST as f64 {
            return Err(StationError::TooMany { line: name, length: longest, most: MOST });
        }
        for part in 0..parts as u64 {
            let t = part as f64 / parts;
            let (vertex, tangent) = if part == 0 { (a, tangents[k]) } else { (NONE, chord) };
            let between = from.zip(to).map(|(from, to)| from * (1.0 - t) + to * t);
            let frame = support.frame(tangent, between).or_else(|| support.frame(chord, None)).ok_or_else(|| no_frame(a))?;
            sliced.stations.push(Station { vertex, s: s + t * length, position: position(a) + chord * t, frame });
        }
        s += length;
    }
    if let (Some(&last), Some(&tangent)) = (line.vertices.last(), tangents.last()) {
        let frame = support.frame(tangent, normal(last)?);
        let before = || sliced.stations.last().map(|station| station.frame).filter(|_| !strict);
        let frame = frame.or_else(before).ok_or_else(|| no_frame(last))?;
        sliced.stations.push(Station { vertex: last, s, position: position(last), frame });
    }
    if strict {
        check_continuity(&sliced)?;
    }
    Ok(sliced)
}

/// Tangents at the vertices of a line: the bisector of the unit directions of the edges before and after.
fn tangents(line: &Line, position: impl Fn(u32) -> Vector) -> Vec<Vector> {
    let along = |pair: &[u32]| unit(position(pair[1]) - position(pair[0])).unwrap_or_default();
    let edges: Vec<Vector> = line.vertices.windows(2).map(along).collect();
    let mut tangents = vec![Vector::zeros(); line.vertices.len()];
    for (k, edge) in edges.iter().enumerate() {
        tangents[k] += edge;
        tangents[k + 1] += edge;
    }
    if line.closed
        && let [first, .., last] = tangents.as_mut_slice()
    {
        *first += *last;
        *last = *first;
    }
    tangents
}

/// The cosine of a right angle, less rounding: at the rim of a square tube of one cell neighbouring normals stand at a right angle.
const RIGHT_ANGLE: f64 = -1e-9;

fn check_continuity(line: &StationLine) -> Result<(), StationError> {
    let mut vertex = NONE;
    for pair in line.stations.windows(2) {
        vertex = if pair[0].vertex == NONE { vertex } else { pair[0].vertex };
        let (a, b) = (&pair[0].frame, &pair[1].frame);
        if a.z.dot(&b.z) < RIGHT_ANGLE || a.y.dot(&b.y) < RIGHT_ANGLE {
            let after = line.stations.iter().find(|station| station.s > pair[0].s && station.vertex != NONE);
            let to = after.map_or(vertex, |station| station.vertex);
            return Err(StationError::Flip { line: line.name.clone(), from: vertex + 1, to: to + 1 });
        }
    }
    Ok(())
}

/// What slicing made.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StationReport {
    /// Lines.
    pub lines: usize,
    /// Stations; those of a closed line's end are counted once.
    pub stations: usize,
    /// Segments.
    pub segments: usize,
    /// Length of all segments.
    pub length: f64,
    /// The longest segment.
    pub longest: f64,
    /// The largest angle between frames of neighbouring stations, in degrees (of their normals or their tangents).
    pub largest_turn: f64,
}

/// Counts and measures.
pub fn report(lines: &[StationLine]) -> StationReport {
    let pairs = || lines.iter().flat_map(|line| line.stations.windows(2));
    let turn = |pair: &[Station]| {
        let (a, b) = (&pair[0].frame, &pair[1].frame);
        super::angle(&a.z, &b.z).max(super::angle(&a.x, &b.x)).to_degrees()
    };
    StationReport {
        lines: lines.len(),
        stations: lines.iter().map(|line| line.stations.len() - usize::from(line.closed)).sum(),
        segments: pairs().count(),
        length: pairs().map(|pair| (pair[1].position - pair[0].position).norm()).sum(),
        longest: pairs().map(|pair| (pair[1].position - pair[0].position).norm()).fold(0.0, f64::max),
        largest_turn: pairs().map(turn).fold(0.0, f64::max),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{generate, trace::trace};

    fn sliced(mesh: crate::mesh::PolygonMesh, longest: f64) -> (QuadMesh, Vec<StationLine>) {
        let mesh = QuadMesh::new(mesh).unwrap();
        let lines = slice(&mesh, &trace(&mesh), longest).unwrap();
        (mesh, lines)
    }

    #[test]
    fn segments_cover_the_edges_and_keep_their_vertices() {
        let (mesh, lines) = sliced(generate::dome(8, 6.0, 4.0), 0.4);
        let report = report(&lines);
        let total: f64 = (0..mesh.edge_count() as u32).map(|e| mesh.edge_length(e)).sum();
        assert!((report.length / total - 1.0).abs() < 1e-13);
        assert!(report.longest <= 0.4 && report.largest_turn < 45.0, "{report:?}");
        let mut kept: Vec<u32> = lines.iter().flat_map(|line| &line.stations).map(|s| s.vertex).filter(|&v| v != NONE).collect();
        kept.sort_unstable();
        kept.dedup();
        assert_eq!(kept.len(), mesh.vertex_count());
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        let (_, lines) = sliced(generate::shell(4, 6), 0.5);
        for station in lines.iter().flat_map(|line| &line.stations) {
            let Frame { x, y, z } = station.frame;
            assert!((x.cross(&y) - z).norm() < 1e-14 && x.dot(&y).abs() < 1e-14 && (z.norm() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_closed_line_ends_in_its_first_frame() {
        let (_, lines) = sliced(generate::cube(3), 1.0);
        let closed = lines.iter().find(|line| line.closed).unwrap();
        let (first, last) = (closed.stations.first().unwrap(), closed.stations.last().unwrap());
        assert_eq!((first.position, first.frame), (last.position, last.frame));
    }

    #[test]
    fn a_normal_that_cancels_is_an_error() {
        // Two faces folded flat onto one another: their vector areas cancel along the common edge.
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 2 1 6 5\n";
        let mesh = crate::mesh::formats::read_obj(text.as_bytes());
        let mut mesh = mesh.unwrap();
        mesh.vertices[4].z = 1e-17;
        mesh.vertices[5].z = 1e-17;
        let mesh = QuadMesh::new(mesh).unwrap();
        let error = slice(&mesh, &trace(&mesh), 1.0).unwrap_err();
        assert!(matches!(error, StationError::NoFrame { .. }), "{error}");
    }
}
