//! What a run leaves in its folder, and what of an earlier run stays there: logs, tables and pictures in one folder are always
//! of one run, and a certified answer does not give way to a run that was cut short.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::RunError;
use super::folder::{Folder, FolderError};
use crate::files::{Inputs, whole};
use crate::report::earlier::{self, Earlier};

/// Tables and the result, besides logs and pictures.
const TABLES: [&str; 6] = ["variables.csv", "constraints.csv", "utilisation.csv", "sizes.csv", "volumes.csv", "result.json"];

/// All pictures a run may leave.
const PICTURES: [&str; 5] = ["convergence.svg", "sections.svg", "ribs.svg", "profiles.svg", "network.svg"];

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
        if let Some(foreign) = outputs().find(|output| is_foreign(output)) {
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

    fn names(&self) -> Vec<String> {
        let name = |place: &Path| place.file_name().map(|name| name.to_string_lossy().into_owned());
        self.set.places().filter_map(name).collect()
    }
}

/// Names of the logs any of them leaves.
fn logs() -> impl Iterator<Item = String> {
    crate::problem::settings::BACKENDS.iter().map(|backend| log_name(backend))
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

/// Whether a file of this name is none that a run leaves: by how it begins.
fn is_foreign(path: &Path) -> bool {
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
        "utilisation.csv" => !begins(&[crate::report::utilisation::HEADER]),
        "sizes.csv" => !begins(&[crate::report::sizes::HEADER]),
        "volumes.csv" => !begins(&[crate::report::sizes::VOLUMES_HEADER]),
        name if name.ends_with(".svg") => !begins(&["<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "]),
        _ => !begins(&["iteration,evaluations,objective,"]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    const HASH: &str = "abc";

    fn open(place: &TempDir) -> Results {
        Results::open(place.path(), &["argmin"], &Inputs::default()).unwrap()
    }

    fn result(status: &str, file: &str) -> String {
        format!(
            "{{\"format\": \"ribopt-result/1\", \"problem\": {{\"file\": \"{file}\", \"sha256\": \"{HASH}\"}}, \"status\": \"{status}\", \"variables\": {{}}}}"
        )
    }

    /// A run that leaves a log and a result.
    fn run(place: &TempDir, status: &str, cut_short: bool) -> PathBuf {
        let results = open(place);
        fs::write(results.log("argmin"), format!("iteration,evaluations,objective,\n{status}")).unwrap();
        let text = result(status, "rib.toml");
        let ending = Ending { sha256: HASH, cut_short };
        let (_, path, written) = results.leave(ending, |writer| writer.file("result.json", |out| out.write_all(text.as_bytes())));
        written.unwrap();
        path
    }

    fn read(place: &TempDir, name: &str) -> String {
        fs::read_to_string(place.path().join(name)).unwrap_or_default()
    }

    #[test]
    fn a_certified_answer_and_its_log_outlive_a_run_cut_short() {
        let place = tempfile::tempdir().unwrap();
        run(&place, "certified", false);
        assert_eq!(run(&place, "interrupted", true), place.path().join("interrupted"));
        assert!(read(&place, "result.json").contains("certified") && read(&place, "log-argmin.csv").contains("certified"));
        assert!(read(&place, "interrupted/result.json").contains("interrupted"));
        assert!(read(&place, "interrupted/log-argmin.csv").contains("interrupted"));
        // A run that ends well takes both places.
        run(&place, "certified", false);
        assert!(!place.path().join("interrupted").exists() && !place.path().join("log-argmin.csv.earlier").exists());
    }

    #[test]
    fn an_answer_that_is_not_certified_gives_way() {
        let place = tempfile::tempdir().unwrap();
        run(&place, "uncertified", false);
        assert_eq!(run(&place, "interrupted", true), place.path());
        assert!(read(&place, "result.json").contains("interrupted"));
    }

    #[test]
    fn logs_of_a_killed_run_go_and_those_of_the_answer_stay() {
        let place = tempfile::tempdir().unwrap();
        run(&place, "certified", false);
        let killed = open(&place);
        fs::write(killed.log("argmin"), "iteration,evaluations,objective,\nkilled").unwrap();
        drop(killed);
        run(&place, "interrupted", true);
        assert!(read(&place, "log-argmin.csv").contains("certified"));
    }

    #[test]
    fn stale_pictures_go_and_files_of_others_stay() {
        let place = tempfile::tempdir().unwrap();
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\"></svg>";
        fs::write(place.path().join("sections.svg"), svg).unwrap();
        fs::write(place.path().join("log-mine.csv"), "mine").unwrap();
        fs::write(place.path().join("notes.txt"), "mine").unwrap();
        run(&place, "certified", false);
        assert!(!place.path().join("sections.svg").exists());
        assert_eq!((read(&place, "log-mine.csv"), read(&place, "notes.txt")), ("mine".into(), "mine".into()));
    }

    #[test]
    fn a_file_of_somebody_else_is_not_overwritten() {
        for (name, text) in [
            ("variables.csv", "name,kind,b\ns,rectangle,1\n"),
            ("result.json", "[sections.a]\n"),
            ("ribs.svg", "<?xml version=\"1.0\"?>"),
        ] {
            let place = tempfile::tempdir().unwrap();
            fs::write(place.path().join(name), text).unwrap();
            let error = Results::open(place.path(), &["argmin"], &Inputs::default()).unwrap_err().to_string();
            assert!(error.contains(name) && error.contains("--out"), "{error}");
            assert_eq!(read(&place, name), text);
        }
    }

    #[test]
    fn results_of_another_file_are_named() {
        let place = tempfile::tempdir().unwrap();
        fs::write(place.path().join("result.json"), result("certified", "a/rib.toml")).unwrap();
        let results = open(&place);
        assert!(results.belongs_to_another("b/rib.toml", "other").unwrap().contains("a/rib.toml"));
        assert_eq!(results.belongs_to_another("b/rib.toml", HASH), None);
        assert_eq!(results.belongs_to_another("a/rib.toml", "other"), None);
    }

    #[test]
    fn what_cannot_be_written_leaves_the_earlier_files() {
        let place = tempfile::tempdir().unwrap();
        run(&place, "certified", false);
        let results = open(&place);
        fs::write(results.log("argmin"), "iteration,evaluations,objective,\nnew").unwrap();
        let ending = Ending { sha256: HASH, cut_short: false };
        let (.., written) = results.leave(ending, |writer| {
            writer.file("variables.csv", |out| out.write_all(b"name"))?;
            writer.file("result.json", |_| Err(io::Error::other("the disk is full")))
        });
        assert!(written.unwrap_err().to_string().contains("result.json: the disk is full"));
        assert!(read(&place, "log-argmin.csv").contains("certified") && read(&place, "variables.csv").is_empty());
    }
}
