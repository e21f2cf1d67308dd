//! After the solve: sized ribs as solids.

use std::path::Path;

use super::{Outcome, write_file, write_report};
use crate::mesh::formats::{self, DxfLine, Node, ending, write_dxf, write_glb};
use crate::mesh::shade::{GREY, shade};
use crate::mesh::solids::{Report, SizedRib, SolidError, build, loft, write_tags};

/// `solve --solids OUT`: builds and writes the solids, their report beside them, and for formats without cell data the tags
/// as `OUT.csv`. DXF holds the ribs as lines, GLB a node per rib; both with the tags.
///
/// # Errors
/// Ends that cannot be lofted, files that cannot be written.
pub fn solids(ribs: &[SizedRib], tag_names: &[String], out: &Path) -> Outcome<Report> {
    formats::check_ribs_writable(out)?;
    let solids = build(ribs, tag_names)?;
    match ending(out).as_str() {
        "glb" => {
            let nodes = ribs.iter().map(|rib| node(rib, tag_names)).collect::<Result<Vec<_>, _>>()?;
            write_file(out, |mut file| write_glb(&mut file, &nodes))?;
        }
        "dxf" => write_file(out, |mut file| write_dxf(&mut file, ribs.iter().map(|rib| line(rib, tag_names))))?,
        _ => formats::write(out, &solids.mesh, &solids.data)?,
    }
    if matches!(ending(out).as_str(), "obj" | "stl") {
        write_file(&out.with_extension("csv"), |file| write_tags(file, &solids).map_err(std::io::Error::other))?;
    }
    write_report(&out.with_extension("json"), &solids.report)?;
    Ok(solids.report)
}

/// Utilisation, mean area and the tags.
fn numbers(rib: &SizedRib, tag_names: &[String]) -> Vec<(String, f64)> {
    let own = [("utilisation".to_string(), rib.utilisation.unwrap_or(f64::NAN)), ("area".to_string(), rib.mean_area())];
    own.into_iter().chain(tag_names.iter().cloned().zip(rib.tags.iter().copied())).collect()
}

fn node(rib: &SizedRib, tag_names: &[String]) -> Result<Node, SolidError> {
    Ok(Node {
        name: rib.geometry.name.clone(),
        origin: rib.geometry.ends[0],
        mesh: loft(rib)?,
        colour: rib.utilisation.map_or(GREY, shade),
        numbers: numbers(rib, tag_names),
    })
}

/// AutoCAD's colours by utilisation: blue, cyan, green, yellow from half, four fifths and 95 % on, red above 1; grey: unknown.
fn line(rib: &SizedRib, tag_names: &[String]) -> DxfLine {
    let colour = match rib.utilisation {
        Some(u) if u > 1.0 + 1e-6 => 1,
        Some(u) if u > 0.95 => 2,
        Some(u) if u > 0.8 => 3,
        Some(u) if u > 0.5 => 4,
        Some(_) => 5,
        None => 8,
    };
    let name = (rib.geometry.name.clone(), f64::NAN);
    let finite = numbers(rib, tag_names).into_iter().filter(|(_, value)| value.is_finite());
    let data = std::iter::once(name).chain(finite).collect();
    DxfLine { layer: rib.geometry.line.clone(), colour, ends: rib.geometry.ends, data }
}
