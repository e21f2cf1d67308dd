//! The ribs of a sliced mesh: one per segment, joined at sections.
//!
//! Along a line neighbouring ribs share the section at their station; lines that end at the same mesh vertex share one
//! there (`v7`). A line running straight through a vertex keeps a section of its own (`L3_s2`).

use std::collections::BTreeMap;
use std::io::{Read, Write};

use super::stations::{Frame, Frames, StationLine};
use super::{NONE, Vector};

/// Where a rib lies. Its solid is straight, its ends parallel, its axes the frame.
#[derive(Debug, Clone, PartialEq)]
pub struct RibGeometry {
    /// `L3_r2`.
    pub name: String,
    /// `L3`.
    pub line: String,
    /// Its two ends.
    pub ends: [Vector; 2],
    /// x from end to end, z out of the surface.
    pub frame: Frame,
    /// Numbers of the points where ribs meet: the same number, the same point.
    pub joints: [u32; 2],
}

impl RibGeometry {
    /// The distance between the ends.
    pub fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// A rib with its sections and its place on the line.
#[derive(Debug, Clone, PartialEq)]
pub struct Rib {
    /// Where it lies.
    pub geometry: RibGeometry,
    /// Sections at its ends, into [`Network::sections`].
    pub sections: [u32; 2],
    /// Arc lengths of its ends.
    pub s: [f64; 2],
    /// Arc length of the whole line, and whether it is closed.
    pub line_length: f64,
    /// See `line_length`.
    pub closed: bool,
}

/// All ribs and the names of their sections.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Network {
    /// Names of the sections.
    pub sections: Vec<String>,
    /// The ribs, line by line.
    pub ribs: Vec<Rib>,
    /// The points where ribs meet, by their numbers in [`RibGeometry::joints`].
    pub joints: Vec<Joint>,
}

/// A point where ribs meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// `v7` at a mesh vertex, `L3_s2` at a station between two.
    pub name: String,
    /// The mesh vertex, or [`NONE`].
    pub vertex: u32,
}

/// Why ribs have no place.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum NetworkError {
    #[error("{rib} has no frame: the surface's normal runs along it; smooth the mesh or use shorter segments")]
    NoFrame { rib: String },
    #[error("geometry table, row {row}: {cause}")]
    Table { row: usize, cause: String },
}

impl Network {
    /// One rib per segment.
    ///
    /// # Errors
    /// A rib along the surface's normal.
    pub fn new(lines: &[StationLine]) -> Result<Network, NetworkError> {
        let mut builder = Builder::default();
        for line in lines {
            builder.line(line)?;
        }
        Ok(builder.network)
    }

    /// Where the joints are.
    pub fn positions(&self) -> Vec<Vector> {
        let mut positions = vec![Vector::zeros(); self.joints.len()];
        for rib in &self.ribs {
            for (joint, end) in rib.geometry.joints.into_iter().zip(rib.geometry.ends) {
                positions[joint as usize] = end;
            }
        }
        positions
    }
}

#[derive(Default)]
struct Builder {
    network: Network,
    /// Sections of line ends by mesh vertex.
    shared: BTreeMap<u32, u32>,
    /// Joints of mesh vertices.
    joints: BTreeMap<u32, u32>,
}

impl Builder {
    fn line(&mut self, line: &StationLine) -> Result<(), NetworkError> {
        let last = line.stations.len().saturating_sub(1);
        let mut at: Vec<(u32, u32)> = Vec::with_capacity(line.stations.len());
        for (k, station) in line.stations.iter().enumerate() {
            let place = if line.closed && k == last && k > 0 {
                at[0]
            } else {
                let is_end = !line.closed && (k == 0 || k == last);
                (self.section(line, k, station.vertex, is_end), self.joint(line, k, station.vertex))
            };
            at.push(place);
        }
        for (k, pair) in line.stations.windows(2).enumerate() {
            let name = format!("{}_r{}", line.name, k + 1);
            let chord = pair[1].position - pair[0].position;
            let between = Frame::new(chord, pair[0].frame.z + pair[1].frame.z);
            let frame = match line.frames {
                Frames::Smooth => between,
                Frames::Faces => between.or_else(|| Frame::upright(chord)),
                Frames::Upright => Frame::upright(chord),
            };
            let frame = frame.ok_or_else(|| NetworkError::NoFrame { rib: name.clone() })?;
            let geometry = RibGeometry {
                name,
                line: line.name.clone(),
                ends: [pair[0].position, pair[1].position],
                frame,
                joints: [at[k].1, at[k + 1].1],
            };
            let (sections, s) = ([at[k].0, at[k + 1].0], [pair[0].s, pair[1].s]);
            self.network.ribs.push(Rib { geometry, sections, s, line_length: line.length(), closed: line.closed });
        }
        Ok(())
    }

    fn section(&mut self, line: &StationLine, k: usize, vertex: u32, is_end: bool) -> u32 {
        let sections = &mut self.network.sections;
        let mut add = |name: String| {
            sections.push(name);
            sections.len() as u32 - 1
        };
        if is_end && vertex != NONE {
            *self.shared.entry(vertex).or_insert_with(|| add(format!("v{}", vertex + 1)))
        } else {
            add(format!("{}_s{}", line.name, k + 1))
        }
    }

    fn joint(&mut self, line: &StationLine, k: usize, vertex: u32) -> u32 {
        let joints = &mut self.network.joints;
        let mut add = |name: String| {
            joints.push(Joint { name, vertex });
            joints.len() as u32 - 1
        };
        if vertex == NONE {
            return add(format!("{}_s{}", line.name, k + 1));
        }
        *self.joints.entry(vertex).or_insert_with(|| add(format!("v{}", vertex + 1)))
    }
}

const HEADER: [&str; 13] = ["rib", "line", "x0", "y0", "z0", "x1", "y1", "z1", "nx", "ny", "nz", "joint0", "joint1"];

/// Writes where ribs lie: ends, the frame's z axis, joints.
///
/// # Errors
/// Those of the writer.
pub fn write_geometry<'a>(out: impl Write, ribs: impl Iterator<Item = &'a RibGeometry>) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(HEADER)?;
    for rib in ribs {
        let numbers = rib.ends.iter().chain([&rib.frame.z]).flat_map(|v| v.iter()).map(f64::to_string);
        let joints = rib.joints.iter().map(u32::to_string);
        table.write_record([rib.name.clone(), rib.line.clone()].into_iter().chain(numbers).chain(joints))?;
    }
    Ok(table.flush()?)
}

/// Reads what [`write_geometry`] wrote.
///
/// # Errors
/// With the row: missing cells, words for numbers, a rib without length or frame.
pub fn read_geometry(source: impl Read) -> Result<Vec<RibGeometry>, NetworkError> {
    let mut table = csv::Reader::from_reader(source);
    let rows = table.records().enumerate();
    rows.map(|(row, record)| {
        let read = record.map_err(|cause| cause.to_string()).and_then(|record| geometry(&record));
        read.map_err(|cause| NetworkError::Table { row: row + 1, cause })
    })
    .collect()
}

fn geometry(record: &csv::StringRecord) -> Result<RibGeometry, String> {
    let cell = |k: usize| record.get(k).ok_or_else(|| format!("there is no column '{}'", HEADER[k]));
    let number = |k: usize| {
        let value: f64 = cell(k)?.trim().parse().map_err(|_| format!("'{}' is no number: {}", HEADER[k], &record[k]))?;
        if value.is_finite() { Ok(value) } else { Err(format!("'{}' is not finite", HEADER[k])) }
    };
    let joint = |k: usize| cell(k)?.trim().parse().map_err(|_| format!("'{}' is no joint's number", HEADER[k]));
    let vector = |k: usize| Ok::<_, String>(Vector::new(number(k)?, number(k + 1)?, number(k + 2)?));
    let (ends, normal) = ([vector(2)?, vector(5)?], vector(8)?);
    let frame = Frame::new(ends[1] - ends[0], normal).ok_or("the ends coincide, or the normal runs along the rib")?;
    let joints = [joint(11)?, joint(12)?];
    Ok(RibGeometry { name: cell(0)?.into(), line: cell(1)?.into(), ends, frame, joints })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{QuadMesh, generate, stations, trace};

    #[test]
    fn ends_share_and_passing_lines_do_not() {
        let mesh = QuadMesh::new(generate::grid(2, 1, 1.0)).unwrap();
        let lines = stations::slice(&mesh, &trace::trace(&mesh), 0.5).unwrap();
        let network = Network::new(&lines).unwrap();
        assert_eq!(network.ribs.len(), 14);
        // Four corners and two middle ends are shared or lone ends; the two long lines pass the middle with their own.
        let ends = network.sections.iter().filter(|name| name.starts_with('v')).count();
        assert_eq!((ends, network.sections.len()), (6, 6 + 2 * 3 + 3));
        let joints = network.ribs.iter().flat_map(|rib| rib.geometry.joints).max().unwrap() + 1;
        assert_eq!(joints, 6 + 7);
    }

    #[test]
    fn geometry_reads_back() {
        let mesh = QuadMesh::new(generate::dome(4, 6.0, 4.0)).unwrap();
        let lines = stations::slice(&mesh, &trace::trace(&mesh), 9.0).unwrap();
        let network = Network::new(&lines).unwrap();
        let ribs: Vec<RibGeometry> = network.ribs.into_iter().map(|rib| rib.geometry).collect();
        let mut text = Vec::new();
        write_geometry(&mut text, ribs.iter()).unwrap();
        let back = read_geometry(text.as_slice()).unwrap();
        assert!(back.iter().zip(&ribs).all(|(a, b)| a.ends == b.ends && (a.frame.y - b.frame.y).norm() < 1e-14));
        assert_eq!(read_geometry(&b"a,b\n1,2\n"[..]).unwrap_err().to_string(), "geometry table, row 1: there is no column 'x0'");
    }
}
