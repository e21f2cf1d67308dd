//! What a stage reads and where it writes: no output takes the place of an input.

use std::path::{Path, PathBuf};

use super::arguments::Stage;
use ribopt::files::{Inputs, Overwrites};
use ribopt::mesh::ribs::{FILES, structure};

/// Refuses outputs that are inputs, before anything is done.
pub fn spare(stage: &Stage) -> Result<(), Overwrites> {
    let beside = |out: &Path| vec![out.to_path_buf(), out.with_extension("json")];
    let (mut inputs, outputs) = match stage {
        Stage::Check(_) | Stage::New(_) => return Ok(()),
        Stage::Reconstruct(own) => (vec![own.mesh.source().path, own.original.clone()], beside(&own.out)),
        Stage::Smooth(own) => (vec![own.mesh.source().path], beside(&own.out)),
        Stage::Trace(own) => (vec![own.mesh.source().path], beside(&own.out)),
        Stage::Slice(own) => (vec![own.mesh.source().path], beside(&own.out)),
        Stage::Ribs(own) => {
            let files = if own.structure.structure { structure::FILES.as_slice() } else { FILES.as_slice() };
            let outputs: Vec<PathBuf> = files.iter().chain(&["mesh.json"]).map(|name| own.out.join(name)).collect();
            (vec![own.mesh.source().path], outputs)
        }
    };
    if let Stage::Smooth(own) = stage {
        inputs.extend(own.project.clone());
    }
    Inputs::new(inputs).spare(outputs)
}
