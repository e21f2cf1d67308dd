//! Files that are there whole or not at all, also for other machines and after a power cut.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Files this process has begun: two of its threads never write the same one.
static BEGUN: AtomicU64 = AtomicU64::new(0);

/// Writes beside the place under a name nobody else has, waits for the disk, renames.
pub(super) fn write(path: &Path, own: &str, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let unfinished = folder.join(format!(".{name}.{own}-{}", BEGUN.fetch_add(1, Ordering::Relaxed)));
    let written = fill(&unfinished, content).and_then(|()| fs::rename(&unfinished, path));
    if written.is_err() {
        // Never made, or of no use to anybody.
        let _ = fs::remove_file(&unfinished);
    }
    // The name itself reaches the disk with its folder; where a system knows no such thing the file's content is safe all the same.
    written.inspect(|()| drop(File::open(folder).and_then(|folder| folder.sync_all())))
}

fn fill(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::new(File::create_new(path)?);
    content(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
}
