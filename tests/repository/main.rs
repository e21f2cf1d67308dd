//! The repository's own order: arrows between rooms, sizes of files and functions, references, the documentation as a book.

mod arrows;
mod book;
mod circles;
mod documentation;
mod sizes;

use std::fs;
use std::path::PathBuf;

/// The Rust files below these folders, in a fixed order.
fn rust_files(folders: impl Into<Vec<PathBuf>>) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), folders.into());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
