//! From the edges that carry ribs to lines, stations and a problem folder.

use std::path::Path;

use serde::Serialize;

use super::{Outcome, Source, tables, write_file, write_report};
use crate::mesh::defects::{DefectKind, Defects};
use crate::mesh::formats::{self, DxfLine, ending};
use crate::mesh::graph::{Graph, Rule};
use crate::mesh::network::Network;
use crate::mesh::stations::{self, Support};
use crate::mesh::trace::{self, Line};
use crate::mesh::{PolygonMesh, QuadMesh, Vector, ribs};

/// Rib lines, and what they run over.
pub struct Lines {
    /// Where vertices are, and the surface's normals there.
    pub support: Box<dyn Support>,
    positions: Vec<Vector>,
    /// The lines.
    pub lines: Vec<Line>,
    /// What tracing found.
    pub report: trace::TraceReport,
}

impl Lines {
    /// Those of a mesh: a quad mesh by its own structure; anything else, and quads around edges of several faces, as edges.
    ///
    /// # Errors
    /// What leaves edges without a place.
    pub fn of(mesh: PolygonMesh, rule: Rule) -> Result<Lines, Defects> {
        let is_quads = mesh.face_count() > 0 && mesh.faces().all(|face| face.len() == 4);
        if is_quads && matches!(rule, Rule::Auto | Rule::Topology) {
            let only_junctions = |kind| matches!(kind, DefectKind::MoreThanTwoFaces | DefectKind::BrokenFan);
            match QuadMesh::new(mesh.clone()) {
                Ok(quads) => return Ok(Lines::of_quads(quads, mesh.notes)),
                Err(found) if found.0.iter().all(|defect| only_junctions(defect.kind)) => {}
                Err(found) => return Err(found),
            }
        }
        Ok(Lines::of_graph(Graph::new(mesh, rule)?))
    }

    fn of_quads(mesh: QuadMesh, notes: Vec<String>) -> Self {
        let lines = trace::trace(&mesh);
        let report = trace::TraceReport { notes, ..trace::report(&mesh, &lines) };
        Lines { positions: mesh.positions.clone(), support: Box::new(mesh), lines, report }
    }

    fn of_graph(graph: Graph) -> Self {
        let lines = graph.lines();
        let report = trace::report(&graph, &lines);
        let report = trace::TraceReport { rule: graph.rule(), notes: graph.notes.clone(), ..report };
        Lines { positions: graph.positions().to_vec(), support: Box::new(graph), lines, report }
    }
}

impl Source {
    fn lines(&self) -> Outcome<Lines> {
        Lines::of(self.polygons()?.0, self.rule).map_err(|cause| self.defects(cause))
    }
}

/// `mesh trace`: lines as OBJ `l` elements, as DXF lines, or as CSV `line,closed,point,vertex,x,y,z`.
///
/// # Errors
/// Bad files, defects.
pub fn trace_file(source: &Source, out: &Path) -> Outcome<trace::TraceReport> {
    let Lines { positions, lines, report, .. } = source.lines()?;
    write_file(out, |mut file| match ending(out).as_str() {
        "obj" => {
            let named = lines.iter().enumerate().map(|(k, line)| (tables::line_name(k, line), line.vertices.as_slice()));
            formats::write_lines(&mut file, &positions, named)
        }
        "dxf" => {
            let place = |v: &u32| positions[*v as usize];
            let edges = |(k, line): (usize, &Line)| {
                let name = tables::line_name(k, line);
                let ends: Vec<[Vector; 2]> = line.vertices.windows(2).map(|pair| [place(&pair[0]), place(&pair[1])]).collect();
                ends.into_iter().map(move |ends| DxfLine { layer: name.clone(), colour: 7, ends, data: Vec::new() })
            };
            formats::write_dxf(&mut file, lines.iter().enumerate().flat_map(edges))
        }
        _ => tables::lines(file, &positions, &lines).map_err(std::io::Error::other),
    })?;
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// `mesh slice MESH`: stations as CSV `line,closed,station,vertex,s,x,y,z,tx,ty,tz,nx,ny,nz`.
///
/// # Errors
/// Bad files, defects, undefined frames.
pub fn slice_file(source: &Source, longest: f64, out: &Path) -> Outcome<stations::StationReport> {
    let found = source.lines()?;
    let lines = stations::slice(&*found.support, &found.lines, longest)?;
    write_file(out, |file| tables::stations(file, &lines).map_err(std::io::Error::other))?;
    let report = stations::report(&lines);
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// What `ribs_folder` made.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RibsReport {
    /// The lines.
    pub trace: trace::TraceReport,
    /// The segments.
    pub stations: stations::StationReport,
    /// The problem.
    pub problem: ribs::Report,
}

/// `mesh ribs`: a problem folder; the report goes to its `mesh.json`.
///
/// # Errors
/// Bad files, defects, undefined frames, senseless limits.
pub fn ribs_folder(source: &Source, longest: f64, options: &ribs::Options, folder: &Path) -> Outcome<RibsReport> {
    let found = source.lines()?;
    let sliced = stations::slice(&*found.support, &found.lines, longest)?;
    // Vertices have the same numbers in the file and in what was made of it.
    let mesh = if options.structure.is_some() { source.polygons()?.0 } else { PolygonMesh::default() };
    let problem = ribs::write_problem(&Network::new(&sliced)?, &mesh, options, folder)?;
    let report = RibsReport { trace: found.report, stations: stations::report(&sliced), problem };
    write_report(&folder.join("mesh.json"), &report)?;
    Ok(report)
}
