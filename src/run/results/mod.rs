//! What a run leaves in its folder, and what of an earlier run stays there: logs, tables and pictures in one folder are always
//! of one run, and a certified answer does not give way to a run that was cut short.

mod foreign;

pub(super) use foreign::is_foreign;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::RunError;
use super::folder::{Folder, FolderError};
use crate::files::whole::Content;
use crate::files::{Inputs, whole};
use crate::report::earlier::{self, Earlier};

/// Tables and the result, besides logs and pictures.
const TABLES: [&str; 10] = [
    "variables.csv",
    "constraints.csv",
    "limits.csv",
    "utilisation.csv",
    "sizes.csv",
    "volumes.csv",
    "displacements.csv",
    "reactions.csv",
    "forces.csv",
    "result.json",
];

/// All pictures a run may leave.
const PICTURES: [&str; 10] = [
    "convergence.svg",
    "sections.svg",
    "ribs.svg",
    "profiles.svg",
    "network.svg",
    "network.json",
    "displaced.svg",
    "forces.svg",
    "structure.vtu",
    "report.html",
];

/// Where a run that was cut short leaves its files beside a certified answer.
const INTERRUPTED: &str = "interrupted";

/// The ending of a log of the earlier run while this one goes on.
const EARLIER: &str = ".earlier";

/// A folder while a run goes on.
#[derive(Debug)]
pub(super) struct Results {
    folder: Folder,
    earlier: Option<Earlier>,
    logs: Vec<String>,
}

/// How a run ended, as far as its files are concerned.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ending<'a> {
    /// Of the file and its tables.
    pub sha256: &'a str,
    /// By Ctrl-C or a limit, without a certified answer.
    pub cut_short: bool,
}

impl Results {
    /// Locks a folder for a run with these backends; sets the logs of an earlier run aside.
    ///
    /// # Errors
    /// A folder that cannot be used, an input of the run or a file of somebody else where an output would stand.
    pub fn open(path: &Path, backends: &[&str], inputs: &Inputs) -> Result<Results, RunError> {
        let logs: Vec<String> = backends.iter().map(|backend| log_name(backend)).collect();
        let outputs = || logs.iter().map(String::as_str).chain(TABLES).chain(PICTURES).map(|name| path.join(name));
        inputs.spare(outputs())?;
        if let Some(foreign) = outputs().find(|output| foreign::is_foreign(output)) {
            return Err(FolderError::Foreign(foreign).into());
        }
        let folder = Folder::open(path)?;
        let earlier = earlier::read(&folder.file("result.json"));
        let results = Results { folder, earlier, logs };
        results.set_aside().map_err(|cause| results.unwritable(cause))?;
        Ok(results)
    }

    /// Where a backend's log stands.
    pub fn log(&self, backend: &str) -> PathBuf {
        self.folder.file(&log_name(backend))
    }

    /// Says whose answer the folder holds, where it is another file's.
    pub fn belongs_to_another(&self, file: &str, sha256: &str) -> Option<String> {
        let earlier = self.earlier.as_ref().filter(|earlier| earlier.file != file && earlier.sha256 != sha256)?;
        let (folder, other) = (self.folder.path().display(), &earlier.file);
        Some(format!("{folder} held the results of another file, {other}; they are replaced (--out chooses another folder)"))
    }

    /// Puts all files of the run in place. Brings back the locked folder, and where the files are.
    ///
    /// # Errors
    /// A file that cannot be written; what was there before then stays.
    pub fn leave(
        self,
        ending: Ending<'_>,
        write: impl FnOnce(&mut Writer) -> io::Result<()>,
    ) -> (Folder, PathBuf, Result<(), RunError>) {
        let stays =
            ending.cut_short && self.earlier.as_ref().is_some_and(|earlier| earlier.certified && earlier.sha256 == ending.sha256);
        let place = if stays { self.folder.file(INTERRUPTED) } else { self.folder.path().to_path_buf() };
        let mut writer = Writer { place: place.clone(), set: whole::Set::default(), at: PathBuf::new() };
        let result = write(&mut writer).map_err(|cause| (writer.at.clone(), cause));
        let names: Vec<String> = writer.names();
        let result = result.and_then(|()| writer.set.swap());
        let moved = match (&result, stays) {
            (Ok(()), false) => self.forget_earlier(&names),
            _ => self.bring_back(),
        };
        let result = result.and_then(|()| moved.map_err(|cause| (place.clone(), cause)));
        let result = result.map_err(|(path, cause)| FolderError::Unwritable { path, cause }.into());
        (self.folder, place, result)
    }

    fn unwritable(&self, cause: io::Error) -> RunError {
        FolderError::Unwritable { path: self.folder.path().into(), cause }.into()
    }

    /// Logs of an earlier run keep its company under another name. Where such are there already, a run was killed: the logs
    /// beside them are its own.
    fn set_aside(&self) -> io::Result<()> {
        let killed = self.all_logs().any(|log| aside(&log).exists());
        for log in self.all_logs().filter(|log| fs::symlink_metadata(log).is_ok()) {
            if killed { fs::remove_file(&log)? } else { fs::rename(&log, aside(&log))? }
        }
        Ok(())
    }

    /// The run's files are in place: what else the earlier run left goes.
    fn forget_earlier(&self, written: &[String]) -> io::Result<()> {
        let stale = TABLES.into_iter().chain(PICTURES).filter(|name| !written.iter().any(|own| own == name));
        for path in stale.map(|name| self.folder.file(name)).chain(self.all_logs().map(|log| aside(&log))) {
            remove(&path)?;
        }
        for name in TABLES.into_iter().chain(PICTURES).map(String::from).chain(logs()) {
            remove(&self.folder.file(INTERRUPTED).join(name))?;
        }
        // Only if nothing of anybody else's is in it.
        let _ = fs::remove_dir(self.folder.file(INTERRUPTED));
        Ok(())
    }

    /// The earlier files stay: its logs come back, this run's go with its other files.
    fn bring_back(&self) -> io::Result<()> {
        let other = self.folder.file(INTERRUPTED);
        for log in self.logs.iter() {
            fs::create_dir_all(&other)?;
            fs::rename(self.folder.file(log), other.join(log))?;
        }
        for log in self.all_logs().filter(|log| aside(log).exists()) {
            fs::rename(aside(&log), &log)?;
        }
        Ok(())
    }

    fn all_logs(&self) -> impl Iterator<Item = PathBuf> + '_ {
        logs().map(|name| self.folder.file(&name))
    }
}

/// Writes the files of a run beside their places.
pub(super) struct Writer {
    place: PathBuf,
    set: whole::Set,
    at: PathBuf,
}

impl Writer {
    /// One file.
    ///
    /// # Errors
    /// Whatever the content or the file system says.
    pub fn file(&mut self, name: &str, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        self.at = self.place.join(name);
        self.set.write(&self.at, content)
    }

    /// Files that are written side by side.
    ///
    /// # Errors
    /// Whatever the content or the file system says of the first that cannot be written.
    pub fn files(&mut self, files: Vec<(&str, Content<'_>)>) -> io::Result<()> {
        let placed = files.into_iter().map(|(name, content)| (self.place.join(name), content)).collect();
        self.set.write_all(placed).map_err(|(path, cause)| {
            self.at = path;
            cause
        })
    }

    fn names(&self) -> Vec<String> {
        let name = |place: &Path| place.file_name().map(|name| name.to_string_lossy().into_owned());
        self.set.places().filter_map(name).collect()
    }
}

/// Names of the logs any of them leaves.
fn logs() -> impl Iterator<Item = String> {
    crate::problem::settings::BACKENDS.iter().map(|backend| log_name(backend.name))
}

/// `log-nlopt.csv`
pub(super) fn log_name(backend: &str) -> String {
    format!("log-{backend}.csv")
}

fn aside(log: &Path) -> PathBuf {
    let mut name = log.as_os_str().to_owned();
    name.push(EARLIER);
    name.into()
}

fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(cause) if !matches!(cause.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => Err(cause),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests;
