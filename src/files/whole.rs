//! Files that are either the old one or the whole new one, whatever happens to the run while they are written. (Waiting for
//! the disk would guard against power cuts too, at the price of seconds for large networks: a run can be done again.)

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

/// What a file is to hold.
pub type Content<'c> = Box<dyn FnOnce(&mut dyn Write) -> io::Result<()> + Send + 'c>;

/// Writes a file beside its place, then renames it into place. Its folder is made where there is none.
///
/// # Errors
/// Whatever the writer or the file system says; the file that was there before is then still there.
pub fn write(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut set = Set::default();
    set.write(path, content)?;
    set.swap().map_err(|(_, cause)| cause)
}

/// Files of one run: all are written beside their places before the first takes its place. Dropped before that, none does.
#[derive(Debug, Default)]
pub struct Set {
    written: Vec<(PathBuf, PathBuf)>,
}

impl Set {
    /// Writes a file beside its place.
    ///
    /// # Errors
    /// Whatever the writer or the file system says.
    pub fn write(&mut self, path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        let unfinished = self.begin(path)?;
        fill(&unfinished, content)
    }

    /// Writes files beside their places, side by side.
    ///
    /// # Errors
    /// The first file whose writer, or the file system for it, says so, and what.
    pub fn write_all(&mut self, files: Vec<(PathBuf, Content<'_>)>) -> Result<(), (PathBuf, io::Error)> {
        let mut begun = Vec::with_capacity(files.len());
        for (path, content) in files {
            match self.begin(&path) {
                Ok(unfinished) => begun.push((path, unfinished, content)),
                Err(cause) => return Err((path, cause)),
            }
        }
        let filled = begun
            .into_par_iter()
            .map(|(path, unfinished, content)| fill(&unfinished, content).map_err(|cause| (path, cause)))
            .collect::<Vec<_>>();
        filled.into_iter().collect()
    }

    /// The place beside a file's own, in a folder that is there.
    fn begin(&mut self, path: &Path) -> io::Result<PathBuf> {
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder)?;
        }
        let unfinished = beside(path);
        self.written.push((unfinished.clone(), path.into()));
        Ok(unfinished)
    }

    /// The places of what was written.
    pub fn places(&self) -> impl Iterator<Item = &Path> {
        self.written.iter().map(|(_, place)| place.as_path())
    }

    /// Puts every file in its place.
    ///
    /// # Errors
    /// The first that cannot be, and why; those before it are in their places.
    pub fn swap(mut self) -> Result<(), (PathBuf, io::Error)> {
        while let Some((unfinished, place)) = self.written.first() {
            fs::rename(unfinished, place).map_err(|cause| (place.clone(), cause))?;
            self.written.remove(0);
        }
        Ok(())
    }
}

impl Drop for Set {
    fn drop(&mut self) {
        for (unfinished, _) in &self.written {
            // Never written, or a leftover that is harmless.
            let _ = fs::remove_file(unfinished);
        }
    }
}

fn beside(path: &Path) -> PathBuf {
    let mut name = OsString::from(path.as_os_str());
    name.push(".unfinished");
    name.into()
}

fn fill(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::with_capacity(1 << 16, File::create(path)?);
    content(&mut writer)?;
    writer.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.json");
        write(&path, |out| out.write_all(b"old")).unwrap();
        let failed = write(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("the disk is full"))
        });
        assert_eq!(failed.unwrap_err().to_string(), "the disk is full");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn of_files_side_by_side_the_one_that_fails_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        let text = |text: &'static str| -> Content<'static> { Box::new(move |out| out.write_all(text.as_bytes())) };
        let mut set = Set::default();
        set.write_all(vec![(place("one"), text("1")), (place("two"), text("2"))]).unwrap();
        set.swap().unwrap();
        assert_eq!((fs::read(place("one")).unwrap(), fs::read(place("two")).unwrap()), (b"1".to_vec(), b"2".to_vec()));
        let mut set = Set::default();
        let full: Content<'_> = Box::new(|_| Err(io::Error::other("the disk is full")));
        let (path, cause) = set.write_all(vec![(place("one"), text("new")), (place("two"), full)]).unwrap_err();
        drop(set);
        assert_eq!((path, cause.to_string()), (place("two"), "the disk is full".to_owned()));
        assert_eq!((fs::read(place("one")).unwrap(), fs::read_dir(folder.path()).unwrap().count()), (b"1".to_vec(), 2));
    }

    #[test]
    fn a_set_changes_nothing_before_it_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let (one, two) = (folder.path().join("one"), folder.path().join("new/two"));
        fs::write(&one, "old").unwrap();
        let mut set = Set::default();
        set.write(&one, |out| out.write_all(b"new")).unwrap();
        assert_eq!(fs::read(&one).unwrap(), b"old");
        set.write(&two, |out| out.write_all(b"new")).unwrap();
        set.swap().unwrap();
        assert_eq!((fs::read(&one).unwrap(), fs::read(&two).unwrap()), (b"new".to_vec(), b"new".to_vec()));
        let mut given_up = Set::default();
        given_up.write(&one, |out| out.write_all(b"never")).unwrap();
        drop(given_up);
        assert_eq!((fs::read(&one).unwrap(), fs::read_dir(folder.path()).unwrap().count()), (b"new".to_vec(), 2));
    }
}
