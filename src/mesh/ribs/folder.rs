//! The problem folder: whole files, and none that was edited is overwritten.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

use serde::Deserialize;

use super::RibsError;
use crate::files::{self, whole};
use crate::mesh::formats::FormatError;

/// The file that keeps what was written.
const REPORT: &str = "mesh.json";

/// SHA-256 of files by name.
pub(super) type Sums = BTreeMap<String, String>;

#[derive(Deserialize, Default)]
struct Kept {
    #[serde(default)]
    problem: Problem,
}

#[derive(Deserialize, Default)]
struct Problem {
    #[serde(default)]
    written: Sums,
}

/// Puts files into the folder, all or none; unless `force`, only over files that are as `mesh ribs` wrote them.
pub(super) fn leave(folder: &Path, all: &[(&str, Vec<u8>)], force: bool) -> Result<Sums, RibsError> {
    let known = kept(folder);
    for (name, content) in all.iter().filter(|_| !force) {
        let path = folder.join(name);
        let Some(there) = content_of(&path).map_err(|cause| FormatError::io(&path, cause))? else { continue };
        if there != *content && known.get(*name) != Some(&files::sha256(&there)) {
            return Err(RibsError::Edited(path.display().to_string()));
        }
    }
    let mut set = whole::Set::default();
    for (name, content) in all {
        let path = folder.join(name);
        set.write(&path, |out| out.write_all(content)).map_err(|cause| FormatError::io(&path, cause))?;
    }
    set.swap().map_err(|(path, cause)| FormatError::io(&path, cause))?;
    Ok(all.iter().map(|(name, content)| ((*name).to_owned(), files::sha256(content))).collect())
}

fn kept(folder: &Path) -> Sums {
    let text = content_of(&folder.join(REPORT)).ok().flatten().unwrap_or_default();
    serde_json::from_slice::<Kept>(&text).unwrap_or_default().problem.written
}

/// What a file holds; `None` where there is none.
fn content_of(path: &Path) -> io::Result<Option<Vec<u8>>> {
    match fs::symlink_metadata(path) {
        Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(cause) => Err(cause),
        Ok(_) => files::read(path).map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Path, text: &str, force: bool) -> Result<(), RibsError> {
        let sums = leave(folder, &[("problem.toml", text.into())], force)?;
        let report = serde_json::json!({ "problem": { "written": sums } });
        fs::write(folder.join(REPORT), report.to_string()).unwrap();
        Ok(())
    }

    #[test]
    fn what_was_edited_stays_and_what_was_not_is_written_anew() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("problem.toml");
        write(folder.path(), "one", false).unwrap();
        write(folder.path(), "two", false).unwrap();
        fs::write(&path, "mine").unwrap();
        let message = write(folder.path(), "three", false).unwrap_err().to_string();
        assert!(message.contains("problem.toml") && message.contains("--force"), "{message}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
        write(folder.path(), "three", true).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "three");
    }

    #[test]
    fn without_a_report_only_the_same_content_is_known() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "one", false).unwrap();
        fs::remove_file(folder.path().join(REPORT)).unwrap();
        assert!(write(folder.path(), "two", false).is_err());
        write(folder.path(), "one", false).unwrap();
    }
}
