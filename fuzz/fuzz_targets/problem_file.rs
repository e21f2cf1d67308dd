//! Any bytes as a problem file; after lines of `%%` come its tables `sections.csv` and `ribs.csv`.
#![no_main]

mod exercise;

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;

static FOLDER: LazyLock<PathBuf> = LazyLock::new(exercise::folder);

fuzz_target!(|bytes: &[u8]| {
    let mut rest = bytes;
    for name in ["problem.toml", "sections.csv", "ribs.csv"] {
        let (part, after) = split(rest);
        fs::write(FOLDER.join(name), part).expect("a writable folder");
        rest = after;
    }
    exercise::exercise(&FOLDER.join("problem.toml"));
});

/// What stands before the next line of `%%`, and what stands after it.
fn split(bytes: &[u8]) -> (&[u8], &[u8]) {
    const MARK: &[u8] = b"\n%%\n";
    match bytes.windows(MARK.len()).position(|window| window == MARK) {
        Some(at) => (&bytes[..at + 1], &bytes[at + MARK.len()..]),
        None => (bytes, &[]),
    }
}
