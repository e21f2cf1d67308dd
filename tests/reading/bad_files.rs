//! Every file in `tests/bad` is refused with exactly the message beside it (`NAME.expected`).
//! `UPDATE_EXPECTED=1 cargo test --test reading bad_files` writes the messages anew; read the difference before keeping it.

use std::fs;
use std::path::{Path, PathBuf};

fn bad_files() -> Vec<PathBuf> {
    let entries = fs::read_dir("tests/bad").expect("the folder of bad files");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}

#[test]
fn each_bad_file_says_what_is_wrong() {
    let mut differing = Vec::new();
    let files = bad_files();
    assert!(files.len() >= 40, "only {} bad files", files.len());
    for path in &files {
        let message = match ribopt::input::read(path) {
            Ok(_) => "it was read without a mistake\n".to_owned(),
            Err(mistakes) => mistakes.to_string(),
        };
        let expected = path.with_extension("expected");
        if std::env::var_os("UPDATE_EXPECTED").is_some() {
            fs::write(&expected, &message).expect("a writable folder");
        }
        let known = fs::read_to_string(&expected).unwrap_or_default();
        if known != message {
            differing.push(format!("{}:\n{message}\ninstead of\n{known}", path.display()));
        }
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

#[test]
fn no_file_and_no_file_at_all() {
    for (path, cause) in [("tests/bad/missing.toml", "there is no such file"), ("tests/bad", "is a directory")] {
        let mistakes = ribopt::input::read(Path::new(path)).expect_err("no file to read");
        assert_eq!(mistakes.list.len(), 1);
        assert!(mistakes.to_string().contains(cause), "{mistakes}");
        assert!(mistakes.list[0].help.is_some());
    }
}
