//! Meshes over buffers: points, corners of the faces, how many each face has, edges that carry ribs.

use std::path::PathBuf;

use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use ribopt::mesh::closest::Surface;
use ribopt::mesh::commands::{self, CommandError, Lines};
use ribopt::mesh::features::FeatureOptions;
use ribopt::mesh::graph::Rule;
use ribopt::mesh::section::Plane;
use ribopt::mesh::stations::{self, StationLine};
use ribopt::mesh::{Defects, NONE, PolygonMesh, QuadMesh, Vector, formats, hausdorff, reconstruct, smooth};
use serde::Serialize;

use super::failure::exception;
use super::numbers::{floats, integers};

/// A mesh as Python gives it.
type Given = (PyBuffer<f64>, PyBuffer<i64>, PyBuffer<i64>, PyBuffer<i64>);

/// A mesh as it is handed back.
type Handed<'py> = [Bound<'py, PyBytes>; 4];

/// A stage's failure, with the defects that were found.
fn failed(py: Python<'_>, error: impl Into<CommandError>) -> PyErr {
    let error = error.into();
    let none = Vec::new();
    let defects = if let CommandError::Defects { cause: Defects(defects), .. } = &error { defects } else { &none };
    exception(py, "MeshError", &error.to_string(), defects)
}

fn defective(cause: Defects) -> CommandError {
    CommandError::Defects { path: "the mesh".into(), cause }
}

fn json(report: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(report).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Points within the range that the readers of files accept.
fn points(numbers: &[f64]) -> PyResult<Vec<Vector>> {
    if !numbers.len().is_multiple_of(3) || !numbers.iter().all(|number| number.abs() <= formats::LARGEST) {
        return Err(PyValueError::new_err(format!("points are numbers of at most {:e} by threes", formats::LARGEST)));
    }
    Ok(numbers.chunks_exact(3).map(Vector::from_column_slice).collect())
}

/// The mesh, its numbers checked and its faces as those of files are.
fn taken(py: Python<'_>, (vertices, corners, sizes, edges): &Given) -> PyResult<PolygonMesh> {
    let mut mesh = PolygonMesh::from_quads(points(&vertices.to_vec(py)?)?, &[]);
    let count = mesh.vertices.len();
    let vertex = |number: i64| {
        let known = u32::try_from(number).ok().filter(|&vertex| (vertex as usize) < count);
        known.ok_or_else(|| PyValueError::new_err(format!("there is no vertex {number}: the mesh has {count}, counted from 0")))
    };
    let corners: Vec<u32> = corners.to_vec(py)?.into_iter().map(vertex).collect::<PyResult<_>>()?;
    let mut rest = corners.as_slice();
    for size in sizes.to_vec(py)? {
        let face = usize::try_from(size).ok().filter(|&size| size >= 3).and_then(|size| rest.split_at_checked(size));
        let (face, others) = face.ok_or_else(|| PyValueError::new_err("a face needs three corners or more"))?;
        mesh.push_face(face);
        rest = others;
    }
    let edges: Vec<u32> = edges.to_vec(py)?.into_iter().map(vertex).collect::<PyResult<_>>()?;
    mesh.ribs = edges.as_chunks::<2>().0.to_vec();
    commands::settle(&mut mesh);
    Ok(mesh)
}

fn quads(py: Python<'_>, mesh: PolygonMesh) -> PyResult<QuadMesh> {
    QuadMesh::new(mesh).map_err(|cause| failed(py, defective(cause)))
}

fn handed<'py>(py: Python<'py>, mesh: &PolygonMesh) -> Handed<'py> {
    let coordinates: Vec<f64> = mesh.vertices.iter().flat_map(|point| [point.x, point.y, point.z]).collect();
    let vertices = |list: &mut dyn Iterator<Item = u32>| integers(py, list.map(|vertex| vertex as usize));
    [
        floats(py, &coordinates),
        vertices(&mut mesh.faces().flatten().copied()),
        integers(py, mesh.faces().map(<[u32]>::len)),
        vertices(&mut mesh.ribs.iter().flatten().copied()),
    ]
}

fn rule(name: &str) -> PyResult<Rule> {
    match name {
        "auto" => Ok(Rule::Auto),
        "topology" => Ok(Rule::Topology),
        "straight" => Ok(Rule::Straight),
        "given" => Ok(Rule::Given),
        "edges" => Ok(Rule::Edges),
        _ => Err(PyValueError::new_err("edges are joined by one of auto, topology, straight, given, edges")),
    }
}

#[pyfunction]
pub fn mesh_read(py: Python<'_>, path: PathBuf) -> PyResult<Handed<'_>> {
    let mesh = py.detach(|| formats::read(&path)).map_err(|error| failed(py, error))?;
    Ok(handed(py, &mesh))
}

#[pyfunction]
pub fn mesh_write(py: Python<'_>, mesh: Given, path: PathBuf) -> PyResult<()> {
    let mesh = taken(py, &mesh)?;
    py.detach(|| formats::write(&path, &mesh, &[])).map_err(|error| failed(py, error))
}

#[pyfunction]
pub fn mesh_new<'py>(py: Python<'py>, name: &str) -> PyResult<Handed<'py>> {
    Ok(handed(py, &commands::by_formula(name).map_err(|error| failed(py, error))?))
}

#[pyfunction]
#[pyo3(signature = (mesh, rule))]
pub fn mesh_check(py: Python<'_>, mesh: Given, rule: &str) -> PyResult<String> {
    let (mesh, rule) = (taken(py, &mesh)?, self::rule(rule)?);
    json(&py.detach(|| commands::check_mesh("the mesh".into(), mesh, rule)))
}

#[pyfunction]
pub fn mesh_weld(py: Python<'_>, mesh: Given, tolerance: f64) -> PyResult<(Handed<'_>, String)> {
    let mesh = taken(py, &mesh)?;
    let (mesh, report) = py.detach(|| commands::welded(mesh, tolerance)).map_err(|error| failed(py, error))?;
    Ok((handed(py, &mesh), json(&report)?))
}

#[pyfunction]
#[pyo3(signature = (mesh, original, tolerance, fill, snap))]
pub fn mesh_reconstruct(
    py: Python<'_>,
    mesh: Given,
    original: Given,
    tolerance: Option<f64>,
    fill: bool,
    snap: bool,
) -> PyResult<(Handed<'_>, String)> {
    let (mesh, original) = (quads(py, taken(py, &mesh)?)?, taken(py, &original)?);
    let options = reconstruct::Options { tolerance, fill, snap };
    let done = py.detach(|| reconstruct::reconstruct(mesh, &original, options));
    let (mesh, report) = done.map_err(|error| failed(py, error))?;
    Ok((handed(py, &mesh.to_polygons()), json(&report)?))
}

#[pyfunction]
#[pyo3(signature = (mesh, method, relaxation, mu, iterations, slide, features, project))]
#[allow(clippy::too_many_arguments)] // the options of the stage, one by one
pub fn mesh_smooth<'py>(
    py: Python<'py>,
    mesh: Given,
    method: &str,
    relaxation: f64,
    mu: Option<f64>,
    iterations: usize,
    slide: bool,
    features: Option<f64>,
    project: Option<Given>,
) -> PyResult<(Handed<'py>, String)> {
    let method = match method {
        "laplacian" => smooth::Method::Laplacian,
        "gauss-seidel" => smooth::Method::GaussSeidel,
        "taubin" => smooth::Method::taubin(relaxation, mu),
        _ => return Err(PyValueError::new_err("vertices are moved by one of laplacian, gauss-seidel, taubin")),
    };
    let options = smooth::Options {
        method,
        relaxation,
        iterations,
        curves: if slide { smooth::Curves::Slide } else { smooth::Curves::Keep },
        features: FeatureOptions { crease: features.map(f64::to_radians), ..FeatureOptions::default() },
    };
    let mut mesh = quads(py, taken(py, &mesh)?)?;
    let project = project.map(|project| taken(py, &project)).transpose()?;
    let done = py.detach(|| {
        let surface = project.map(|project| Surface::of_faces(&project));
        smooth::smooth(&mut mesh, options, surface.as_ref())
    });
    let report = done.map_err(|error| failed(py, error))?;
    Ok((handed(py, &mesh.to_polygons()), json(&report)?))
}

/// Lengths of the lines, their vertices, whether they close, the report.
type Traced<'py> = (Bound<'py, PyBytes>, Bound<'py, PyBytes>, Vec<bool>, String);

fn lines(py: Python<'_>, mesh: &Given, rule: &str) -> PyResult<Lines> {
    let (mesh, rule) = (taken(py, mesh)?, self::rule(rule)?);
    Lines::of(mesh, rule).map_err(|cause| failed(py, defective(cause)))
}

#[pyfunction]
#[pyo3(signature = (mesh, rule))]
pub fn mesh_trace<'py>(py: Python<'py>, mesh: Given, rule: &str) -> PyResult<Traced<'py>> {
    let found = lines(py, &mesh, rule)?;
    let sizes = integers(py, found.lines.iter().map(|line| line.vertices.len()));
    let vertices = integers(py, found.lines.iter().flat_map(|line| &line.vertices).map(|&vertex| vertex as usize));
    Ok((sizes, vertices, found.lines.iter().map(|line| line.closed).collect(), json(&found.report)?))
}

/// Name, whether it closes, the vertices, and s, position and frame of every station.
type Sliced<'py> = (String, bool, Bound<'py, PyBytes>, Bound<'py, PyBytes>);

#[pyfunction]
#[pyo3(signature = (mesh, rule, segments))]
pub fn mesh_slice<'py>(py: Python<'py>, mesh: Given, rule: &str, segments: f64) -> PyResult<(Vec<Sliced<'py>>, String)> {
    let found = lines(py, &mesh, rule)?;
    let sliced = stations::slice(&*found.support, &found.lines, segments).map_err(|error| failed(py, error))?;
    Ok((sliced.iter().map(|line| line_of_stations(py, line)).collect(), json(&stations::report(&sliced))?))
}

fn line_of_stations<'py>(py: Python<'py>, line: &StationLine) -> Sliced<'py> {
    let vertices: Vec<u8> = line.stations.iter().flat_map(|station| number(station.vertex).to_ne_bytes()).collect();
    let numbers = line.stations.iter().flat_map(|station| {
        let frame = station.frame;
        let places = [station.position, frame.x, frame.y, frame.z].into_iter().flat_map(|place| [place.x, place.y, place.z]);
        std::iter::once(station.s).chain(places)
    });
    (line.name.clone(), line.closed, PyBytes::new(py, &vertices), floats(py, &numbers.collect::<Vec<f64>>()))
}

/// −1 for no vertex.
fn number(vertex: u32) -> i64 {
    if vertex == NONE { -1 } else { i64::from(vertex) }
}

#[pyfunction]
pub fn mesh_section<'py>(
    py: Python<'py>,
    mesh: Given,
    origin: PyBuffer<f64>,
    normal: PyBuffer<f64>,
) -> PyResult<(Vec<Vec<Bound<'py, PyBytes>>>, String)> {
    let (mesh, plane) = (taken(py, &mesh)?, [points(&origin.to_vec(py)?)?, points(&normal.to_vec(py)?)?]);
    let plane = match (plane[0].as_slice(), plane[1].as_slice()) {
        ([origin], [normal]) => Plane::facing(*origin, *normal),
        _ => None,
    };
    let plane = plane.ok_or_else(|| PyValueError::new_err("a plane needs a point and a normal that is not zero"))?;
    let cut = py.detach(|| commands::section(&mesh, &plane)).map_err(|error| failed(py, error))?;
    let (pieces, report) = cut;
    let ring = |ring: &Vec<[f64; 2]>| floats(py, ring.as_flattened());
    Ok((pieces.iter().map(|piece| piece.polygon.rings().iter().map(ring).collect()).collect(), json(&report)?))
}

#[pyfunction]
pub fn mesh_closest<'py>(py: Python<'py>, mesh: Given, points: PyBuffer<f64>) -> PyResult<Bound<'py, PyBytes>> {
    let (mesh, points) = (taken(py, &mesh)?, self::points(&points.to_vec(py)?)?);
    let found = py.detach(|| {
        let surface = Surface::of_faces(&mesh);
        points.iter().map(|point| surface.nearest(point)).collect::<Option<Vec<Vector>>>()
    });
    let found = found.ok_or_else(|| PyValueError::new_err("a mesh without faces has no nearest points"))?;
    Ok(floats(py, &found.iter().flat_map(|point| [point.x, point.y, point.z]).collect::<Vec<f64>>()))
}

#[pyfunction]
pub fn mesh_hausdorff(py: Python<'_>, first: Given, second: Given) -> PyResult<String> {
    let (first, second) = (taken(py, &first)?, taken(py, &second)?);
    if first.face_count() == 0 || second.face_count() == 0 {
        return Err(PyValueError::new_err("a mesh without faces lies nowhere"));
    }
    json(&py.detach(|| hausdorff::hausdorff(&first, &second)))
}
