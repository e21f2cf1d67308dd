//! Files of somebody else that have the name of one a run leaves.

use std::fs;
use std::io::Read;
use std::path::Path;

/// Whether a file of this name is none that a run leaves: by how it begins.
pub(in crate::run) fn is_foreign(path: &Path) -> bool {
    let is_file = fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_file() && metadata.len() > 0);
    let mut head = Vec::new();
    let mut read = || fs::File::open(path).and_then(|file| file.take(400).read_to_end(&mut head));
    if !is_file || read().is_err() {
        return false;
    }
    let head = String::from_utf8_lossy(&head);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let begins = |beginnings: &[&str]| beginnings.iter().any(|beginning| head.starts_with(beginning));
    match &*name {
        "result.json" => !head.contains("\"ribopt-result/1\""),
        "variables.csv" => !begins(&["name,lower,start,upper,"]),
        "constraints.csv" => !begins(&["name,value,lower,upper,active,"]),
        // Earlier versions wrote what `limits.csv` holds under the other name.
        "utilisation.csv" => !begins(&[crate::report::utilisation::HEADER, crate::report::utilisation::LIMITS_HEADER]),
        "limits.csv" => !begins(&[crate::report::utilisation::LIMITS_HEADER]),
        "displacements.csv" | "reactions.csv" => !begins(&[crate::report::structure::NODES_HEADER]),
        "forces.csv" => !begins(&[crate::report::structure::FORCES_HEADER]),
        "structure.vtu" => !begins(&["<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\""]),
        "sizes.csv" => !begins(&[crate::report::sizes::HEADER]),
        "volumes.csv" => !begins(&[crate::report::sizes::VOLUMES_HEADER]),
        // By its policy, which no other page is likely to begin with.
        "report.html" => !head.contains("content=\"default-src 'none'; style-src 'unsafe-inline'; script-src"),
        "network.json" => !head.contains("\"ribopt-network/1\""),
        name if name.ends_with(".svg") => !begins(&["<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "]),
        _ => !begins(&["iteration,evaluations,objective,"]),
    }
}
