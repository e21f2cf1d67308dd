//! Wavefront OBJ out. Numbers read back bit for bit.

use std::io::{self, Write};

use crate::mesh::{NONE, PolygonMesh, Vector};

/// Writes vertices, faces by group, and flagged edges as `l` elements.
///
/// # Errors
/// Those of the writer.
pub fn write_obj(out: &mut impl Write, mesh: &PolygonMesh) -> io::Result<()> {
    write_vertices(out, &mesh.vertices)?;
    let mut group = NONE;
    for (f, face) in mesh.faces().enumerate() {
        let own = mesh.group_of.get(f).copied().unwrap_or(NONE);
        if own != group {
            group = own;
            writeln!(out, "g {}", mesh.groups.get(group as usize).map_or("default", String::as_str))?;
        }
        write_element(out, "f", face)?;
    }
    for rib in &mesh.ribs {
        write_element(out, "l", rib)?;
    }
    Ok(())
}

/// Writes polylines over `vertices` as named `l` elements; a closed one repeats its first vertex.
///
/// # Errors
/// Those of the writer.
pub fn write_lines<'a>(
    out: &mut impl Write,
    vertices: &[Vector],
    lines: impl Iterator<Item = (String, &'a [u32])>,
) -> io::Result<()> {
    write_vertices(out, vertices)?;
    for (name, line) in lines {
        writeln!(out, "g {name}")?;
        write_element(out, "l", line)?;
    }
    Ok(())
}

fn write_vertices(out: &mut impl Write, vertices: &[Vector]) -> io::Result<()> {
    for v in vertices {
        writeln!(out, "v {} {} {}", v.x, v.y, v.z)?;
    }
    Ok(())
}

fn write_element(out: &mut impl Write, word: &str, vertices: &[u32]) -> io::Result<()> {
    write!(out, "{word}")?;
    for v in vertices {
        write!(out, " {}", v + 1)?;
    }
    writeln!(out)
}
