//! `mesh check`: what a file holds, and what is wrong with it.

use serde::Serialize;

use super::{Outcome, Source};
use crate::mesh::defects::{self, Defect, DefectKind, Defects};
use crate::mesh::edge_list::edge_uses;
use crate::mesh::graph::{self, Graph, Rule};
use crate::mesh::invariants::{Invariants, measure, measure_any};
use crate::mesh::weld::WeldReport;
use crate::mesh::{PolygonMesh, QuadMesh};

/// What `check` found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// The file.
    pub file: String,
    /// What it holds: `quad mesh`, `polygon mesh` or `lines`.
    pub kind: &'static str,
    /// Whether there are no defects.
    pub sound: bool,
    /// What a weld did, where one was asked for.
    pub weld: Option<WeldReport>,
    /// Every defect.
    pub defects: Vec<Defect>,
    /// The defects in words, as many as a person reads.
    pub message: String,
    /// What a user should know of the file.
    pub notes: Vec<String>,
    /// The numbers of the mesh, sound or not.
    pub invariants: Invariants,
}

/// `mesh check`: defects are the finding here, not an error.
///
/// # Errors
/// A file that cannot be read.
pub fn check(source: &Source) -> Outcome<CheckReport> {
    let (mesh, weld) = source.polygons()?;
    Ok(CheckReport { weld, ..check_mesh(source.path.display().to_string(), mesh, source.rule) })
}

/// The same of a mesh that was read or made; `file` is what the report calls it.
pub fn check_mesh(file: String, mesh: PolygonMesh, rule: Rule) -> CheckReport {
    let is_quads = mesh.face_count() > 0 && mesh.faces().all(|face| face.len() == 4);
    let kind = match (is_quads, mesh.is_lines()) {
        (true, _) => "quad mesh",
        (_, true) => "lines",
        _ => "polygon mesh",
    };
    let (found, invariants, notes) = if is_quads { check_quads(mesh) } else { check_others(mesh, rule) };
    CheckReport {
        file,
        kind,
        sound: found.0.is_empty(),
        weld: None,
        message: if found.0.is_empty() { "no defects".into() } else { found.to_string() },
        defects: found.0,
        notes,
        invariants,
    }
}

type Checked = (Defects, Invariants, Vec<String>);

fn check_quads(mesh: PolygonMesh) -> Checked {
    let (notes, kept) = (mesh.notes.clone(), mesh.clone());
    match QuadMesh::new(mesh) {
        Ok(mesh) => (Defects(Vec::new()), measure(&mesh), notes),
        Err(defects) => (defects, measure_any(&kept), notes),
    }
}

/// Everything but that faces are no quads; edges of more than two faces and separate fans too, though lines only end there.
fn check_others(mesh: PolygonMesh, rule: Rule) -> Checked {
    let invariants = measure_any(&mesh);
    let uses = edge_uses(&mesh);
    let mut found: Vec<Defect> =
        defects::of_edges(&uses).into_iter().filter(|defect| defect.kind == DefectKind::MoreThanTwoFaces).collect();
    found.extend(graph::broken_fans(&mesh, &uses));
    let mut notes = mesh.notes.clone();
    match Graph::new(mesh, rule) {
        Ok(graph) => notes = graph.notes,
        Err(defects) => found.splice(0..0, defects.0).for_each(drop),
    }
    (Defects(found), invariants, notes)
}
