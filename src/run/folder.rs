//! The folder a run leaves its files in: where it is, and that only one run at a time writes there.

use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::files::STANDARD_INPUT;

/// An output folder, locked for as long as this lives.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Held for its lock; the system lets go of it when the process ends, however it ends.
    _lock: File,
}

/// Why a folder cannot be used.
#[derive(Debug, Error)]
pub enum FolderError {
    /// Another run holds the lock.
    #[error("another run is writing to {0}; wait until it has ended, or choose another folder with --out")]
    Busy(PathBuf),
    /// An output would take the place of a file that is none of ours.
    #[error("{0} is no file of a ribopt run and would be overwritten; move it away, or choose another folder with --out")]
    Foreign(PathBuf),
    /// The folder or a file in it cannot be made.
    #[error("cannot write to {path}: {cause}; choose a folder that can be written to with --out")]
    Unwritable {
        /// Folder or file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
}

impl Folder {
    /// Makes the folder where it is missing and locks it.
    ///
    /// # Errors
    /// Where another run holds it or it cannot be written to.
    pub fn open(path: &Path) -> Result<Folder, FolderError> {
        let unwritable = |path: &Path, cause| FolderError::Unwritable { path: path.into(), cause };
        fs::create_dir_all(path).map_err(|cause| unwritable(path, cause))?;
        let file = path.join(".lock");
        let lock = OpenOptions::new().create(true).truncate(false).write(true).open(&file);
        let lock = lock.map_err(|cause| unwritable(&file, cause))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(FolderError::Busy(path.into())),
            // Some network file systems know no locks: going on there is better than refusing to work.
            Err(TryLockError::Error(cause)) if cause.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(cause)) => return Err(unwritable(&file, cause)),
        }
        Ok(Folder { path: path.into(), _lock: lock })
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where this file of the run stands.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }
}

/// `results/<file stem>`; for a file called `problem.toml` the name of its folder.
pub fn default_folder(problem_file: &Path) -> PathBuf {
    let mut name = problem_file.file_stem();
    if problem_file.as_os_str() == STANDARD_INPUT {
        name = Some(OsStr::new("stdin"));
    }
    let absolute = std::path::absolute(problem_file).unwrap_or_else(|_| problem_file.into());
    if problem_file.file_name() == Some(OsStr::new("problem.toml"))
        && let Some(parent) = absolute.parent().and_then(Path::file_name)
    {
        name = Some(parent);
    }
    Path::new("results").join(name.unwrap_or(OsStr::new("problem")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_named_for_the_file_or_its_folder() {
        assert_eq!(default_folder(Path::new("problems/beam.toml")), Path::new("results/beam"));
        assert_eq!(default_folder(Path::new("shell/problem.toml")), Path::new("results/shell"));
        assert_eq!(default_folder(Path::new("/problem.toml")), Path::new("results/problem"));
        assert_eq!(default_folder(Path::new("-")), Path::new("results/stdin"));
    }

    #[test]
    fn a_second_run_is_told_so() {
        let folder = tempfile::tempdir().unwrap();
        let first = Folder::open(folder.path()).unwrap();
        assert!(matches!(Folder::open(folder.path()), Err(FolderError::Busy(_))));
        drop(first);
        assert!(Folder::open(folder.path()).is_ok());
    }

    #[test]
    fn a_file_in_the_way_is_an_error_with_a_remedy() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let error = Folder::open(&file.path().join("results")).unwrap_err().to_string();
        assert!(error.starts_with("cannot write to") && error.contains("--out"), "{error}");
    }
}
