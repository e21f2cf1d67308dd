//! Slicing rib lines into stations and segments (note 3.2).
//!
//! Every edge of a line is cut into equal segments no longer than asked, so mesh vertices are always stations. The frame of
//! a station: x along the line (at a vertex, the bisector of the two directions), z the surface's normal made perpendicular
//! to x, y = z × x. A section's x is the frame's y, its y the frame's z.

mod frame;

use serde::Serialize;

pub use frame::{Frame, Frames, Support};

use super::trace::Line;
use super::{NONE, Vector, unit};

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
mod tests;
