//! The folder of a study: what workers on one machine or many share.
//!
//! | file | what it is |
//! |---|---|
//! | `study.json` | which study this is: its fingerprint |
//! | `chains/000012.json` | the rows of a finished chain; there whole or not at all |
//! | `claims/000012` | who is at work on it; spares double work, decides nothing |
//! | `deaths/000012` | the points at which workers ended that did not let go of it |
//! | `table.csv` | all rows, after a merge |

mod claims;
mod durable;

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Point, Row, Study};
pub use claims::BEAT;

/// The `format` of `study.json`.
const FORMAT: &str = "ribopt-study/1";

/// Folders and files that are the study's own.
const OWN_FOLDERS: [&str; 3] = ["chains", "claims", "deaths"];
const MARK: &str = "study.json";
/// The merged table.
pub const TABLE: &str = "table.csv";

/// Why a study's folder cannot be used.
#[derive(Debug, Error)]
pub enum StoreError {
    /// It belongs to another study, or to an earlier version of this one.
    #[error(
        "{0} holds another study, or this one before it or its problem was changed; begin anew with --fresh, or choose another folder with --out"
    )]
    Other(PathBuf),
    /// There are files in it that no study left.
    #[error("{0} is the folder of no study and not empty; choose another one with --out")]
    Foreign(PathBuf),
    /// Nothing was begun there.
    #[error("{0} is the folder of no study: nothing has been begun there")]
    Missing(PathBuf),
    /// It cannot be read or written.
    #[error("cannot write to {path}: {cause}; what is finished stays, and the same command goes on from there")]
    Unwritable {
        /// Folder or file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
}

/// The folder, and what this process holds of it.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    fingerprint: String,
    /// This process, among all that share the folder.
    host: String,
    own: String,
    /// Claims that are kept alive.
    held: Mutex<BTreeSet<PathBuf>>,
}

#[derive(Serialize, Deserialize)]
struct Mark {
    format: String,
    fingerprint: String,
    title: String,
    study: String,
    problem: String,
    points: usize,
}

#[derive(Serialize, Deserialize)]
struct Chain {
    format: String,
    study: String,
    chain: usize,
    rows: Vec<Row>,
}

impl Store {
    /// Opens the folder, makes it where there is none. `fresh` forgets what an earlier study left there.
    ///
    /// # Errors
    /// Another study's folder, one with other files, one that cannot be written to.
    pub fn open(study: &Study, folder: &Path, fresh: bool) -> Result<Store, StoreError> {
        let store = Store::at(study, folder);
        match store.mark()? {
            Some(mark) if mark.fingerprint == store.fingerprint && !fresh => {}
            Some(_) if !fresh => return Err(StoreError::Other(folder.into())),
            Some(_) => store.forget()?,
            None if !store.is_empty() => return Err(StoreError::Foreign(folder.into())),
            None => {}
        }
        for name in OWN_FOLDERS {
            let path = folder.join(name);
            fs::create_dir_all(&path).map_err(|cause| StoreError::Unwritable { path, cause })?;
        }
        let mark = Mark {
            format: FORMAT.into(),
            fingerprint: study.fingerprint.clone(),
            title: study.title.clone(),
            study: study.file.display().to_string(),
            problem: study.problem.display().to_string(),
            // How many a front will have is known at its end.
            points: if study.objectives().is_some() { 0 } else { study.points() },
        };
        if store.mark()?.is_none() {
            store.put(MARK, |out| Ok(serde_json::to_writer_pretty(out, &mark)?))?;
        }
        Ok(store)
    }

    /// The folder of a study that was begun.
    ///
    /// # Errors
    /// Nothing was begun there, or another study.
    pub fn existing(study: &Study, folder: &Path) -> Result<Store, StoreError> {
        let store = Store::at(study, folder);
        match store.mark()? {
            Some(mark) if mark.fingerprint == store.fingerprint => Ok(store),
            Some(_) => Err(StoreError::Other(folder.into())),
            None => Err(StoreError::Missing(folder.into())),
        }
    }

    fn at(study: &Study, folder: &Path) -> Store {
        let host = gethostname::gethostname().to_string_lossy().into_owned();
        let own = format!("{host}-{}", std::process::id());
        Store { folder: folder.into(), fingerprint: study.fingerprint.clone(), host, own, held: Mutex::default() }
    }

    /// Where it is.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn mark(&self) -> Result<Option<Mark>, StoreError> {
        let path = self.folder.join(MARK);
        match fs::read(&path) {
            // What cannot be understood is another program's, or another version's.
            Ok(bytes) => match serde_json::from_slice::<Mark>(&bytes) {
                Ok(mark) if mark.format == FORMAT => Ok(Some(mark)),
                _ => Err(StoreError::Foreign(self.folder.clone())),
            },
            Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(cause) => Err(StoreError::Unwritable { path, cause }),
        }
    }

    fn is_empty(&self) -> bool {
        // Another worker may have made its folders a moment ago.
        let own = |name: &std::ffi::OsStr| OWN_FOLDERS.iter().any(|own| name == *own) || name.to_string_lossy().starts_with('.');
        fs::read_dir(&self.folder)
            .map_or(true, |mut entries| entries.all(|entry| entry.is_ok_and(|entry| own(&entry.file_name()))))
    }

    /// Takes away what an earlier study left, and nothing else.
    fn forget(&self) -> Result<(), StoreError> {
        let gone = |result: io::Result<()>, path: PathBuf| match result {
            Err(cause) if cause.kind() != io::ErrorKind::NotFound => Err(StoreError::Unwritable { path, cause }),
            _ => Ok(()),
        };
        for name in OWN_FOLDERS {
            gone(fs::remove_dir_all(self.folder.join(name)), self.folder.join(name))?;
        }
        for name in [TABLE, MARK] {
            gone(fs::remove_file(self.folder.join(name)), self.folder.join(name))?;
        }
        Ok(())
    }

    /// Puts a file into the folder, whole.
    ///
    /// # Errors
    /// Whatever the writer or the file system says.
    pub fn put(&self, name: &str, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), StoreError> {
        let path = self.folder.join(name);
        durable::write(&path, &self.own, content).map_err(|cause| StoreError::Unwritable { path, cause })
    }

    fn chain_name(chain: usize) -> String {
        format!("chains/{chain:06}.json")
    }

    /// The rows of a finished chain, where they are of these points.
    pub fn rows_of(&self, chain: usize, points: &[Point]) -> Option<Vec<Row>> {
        let rows = self.rows(chain)?;
        let same = |(row, point): (&Row, &Point)| row.point == point.number && row.varied == point.values;
        (rows.len() == points.len() && rows.iter().zip(points).all(same)).then_some(rows)
    }

    /// The rows of a finished chain; `None` where it is not finished, or its file is none of this study's.
    pub fn rows(&self, chain: usize) -> Option<Vec<Row>> {
        let bytes = fs::read(self.folder.join(Store::chain_name(chain))).ok()?;
        let found: Chain = serde_json::from_slice(&bytes).ok()?;
        (found.study == self.fingerprint && found.chain == chain).then_some(found.rows)
    }

    /// Leaves the rows of a chain.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn finish(&self, chain: usize, rows: Vec<Row>) -> Result<(), StoreError> {
        let content = Chain { format: FORMAT.into(), study: self.fingerprint.clone(), chain, rows };
        self.put(&Store::chain_name(chain), |out| Ok(serde_json::to_writer(out, &content)?))?;
        // Nobody asks any more how often it failed.
        let _ = fs::remove_file(self.death_file(chain));
        Ok(())
    }

    /// Forgets a finished chain, so that it is worked on anew.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn undo(&self, chain: usize) -> Result<(), StoreError> {
        let path = self.folder.join(Store::chain_name(chain));
        fs::remove_file(&path).map_err(|cause| StoreError::Unwritable { path, cause })
    }
}

#[cfg(test)]
mod tests;
