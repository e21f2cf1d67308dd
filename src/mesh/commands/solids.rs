//! After the solve: sized ribs as solids and pictures.

use std::path::Path;

use super::{Outcome, write_file, write_report};
use crate::mesh::formats::{self, ending};
use crate::mesh::plot::{Stroke, svg};
use crate::mesh::solids::{Report, SizedRib, build, write_tags};

/// `solve --solids OUT`: builds and writes the solids, their report beside them, and for formats without cell data the tags
/// as `OUT.csv`.
///
/// # Errors
/// Ends that cannot be lofted, files that cannot be written.
pub fn solids(ribs: &[SizedRib], tag_names: &[String], out: &Path) -> Outcome<Report> {
    let solids = build(ribs, tag_names)?;
    formats::write(out, &solids.mesh, &solids.data)?;
    if ending(out) != "vtu" {
        write_file(&out.with_extension("csv"), |file| write_tags(file, &solids).map_err(std::io::Error::other))?;
    }
    write_report(&out.with_extension("json"), &solids.report)?;
    Ok(solids.report)
}

/// `solve --plot OUT.svg`: the rib network, drawn with the heights of its rings.
///
/// # Errors
/// A file that cannot be written.
pub fn plot(ribs: &[SizedRib], title: &str, out: &Path) -> Outcome<()> {
    let strokes: Vec<Stroke> = ribs.iter().map(stroke).collect();
    write_file(out, |file| file.write_all(svg(&strokes, title).as_bytes()))
}

fn stroke(rib: &SizedRib) -> Stroke {
    let height = |end: usize| {
        let heights = || rib.rings[end].iter().flatten().map(|p| p[1]);
        heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
    };
    let heights = [height(0), height(1)];
    let label = match rib.utilisation {
        Some(u) => format!("{}: heights {:.4}, {:.4}, utilisation {u:.3}", rib.geometry.name, heights[0], heights[1]),
        None => format!("{}: heights {:.4}, {:.4}", rib.geometry.name, heights[0], heights[1]),
    };
    Stroke { ends: rib.geometry.ends, heights, utilisation: rib.utilisation, label }
}
