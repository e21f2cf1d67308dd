//! `report`: the page about a run, from what it left in its folder.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::RunError;
use crate::files::{Inputs, whole};
use crate::input;
use crate::report::page::{Left, StudyLeft, page, study_page};
use crate::report::result::FORMAT;

/// The page's file beside a run's other files.
pub const PAGE: &str = "report.html";

/// The ribs in space, for the page.
pub const NETWORK: &str = "network.json";

/// Tables the page shows.
const TABLES: [&str; 5] = ["variables.csv", "sizes.csv", "volumes.csv", "limits.csv", "utilisation.csv"];

/// Writes the page about the runs in some folders (or whose `result.json` are given) to `out`, or beside the files of the one run; brings
/// back where it is.
///
/// # Errors
/// No result there, several runs and no place for their page, an input where the page would stand, or a file that cannot be written.
pub fn report(given: &[PathBuf], out: Option<&Path>) -> Result<PathBuf, RunError> {
    if let [folder] = given
        && let Some(study) = Study::in_folder(folder)
    {
        let out = out.map_or_else(|| folder.join(PAGE), Path::to_path_buf);
        Inputs::new(study.read).spare([out.clone()])?;
        return written(&out, &study_page(&study.left)).map(|()| out);
    }
    let places: Vec<(PathBuf, PathBuf)> = given.iter().map(|given| folder_and_file(given)).collect();
    let out = match (out, &places[..]) {
        (Some(out), _) => out.to_path_buf(),
        (None, [(folder, _)]) => folder.join(PAGE),
        (None, _) => return Err(RunError::Choice("a page about several runs needs a place: add -o report.html".into())),
    };
    let (mut lefts, mut read) = (Vec::new(), Vec::new());
    for (folder, file) in &places {
        let (left, files) = left(folder, file)?;
        lefts.push(left);
        read.extend(files);
    }
    Inputs::new(read).spare([out.clone()])?;
    written(&out, &page(&lefts)).map(|()| out)
}

fn written(out: &Path, html: &str) -> Result<(), RunError> {
    let mut set = whole::Set::default();
    let unwritable = |path: &Path, cause: std::io::Error| RunError::Choice(format!("cannot write {}: {cause}", path.display()));
    set.write(out, |to| to.write_all(html.as_bytes())).map_err(|cause| unwritable(out, cause))?;
    set.swap().map_err(|(path, cause)| unwritable(&path, cause))
}

/// What the folder of a study holds, and every file that was read.
struct Study {
    left: StudyLeft,
    read: Vec<PathBuf>,
}

impl Study {
    /// `None` where the folder is none of a study that was merged.
    fn in_folder(folder: &Path) -> Option<Study> {
        let mark: Value = serde_json::from_str(&fs::read_to_string(folder.join("study.json")).ok()?).ok()?;
        let table = fs::read_to_string(folder.join("table.csv")).ok()?;
        let (pictures, text) = (pictures(folder), |key: &str| mark.get(key).and_then(Value::as_str).unwrap_or_default());
        let with_text = |name: &str| Some((name.to_owned(), fs::read_to_string(name).ok()?));
        let inputs: Vec<_> = ["study", "problem"].iter().filter_map(|key| with_text(text(key))).collect();
        let read = inputs.iter().map(|(name, _)| name.clone()).chain(["study.json", "table.csv"].map(String::from));
        let read = read.chain(pictures.iter().map(|(name, _)| name.clone())).map(|name| folder.join(name)).collect();
        let points = mark.get("points").and_then(Value::as_u64).unwrap_or_default() as usize;
        let left = StudyLeft { title: text("title").into(), table, pictures, inputs, points };
        Some(Study { left, read })
    }
}

/// The pictures of a folder, with their texts.
fn pictures(folder: &Path) -> Vec<(String, String)> {
    let names = fs::read_dir(folder).map(|entries| entries.flatten().map(|entry| entry.file_name()).collect::<Vec<_>>());
    let names = names.unwrap_or_default().into_iter().filter_map(|name| name.into_string().ok());
    let with_text = |name: String| Some((name.clone(), fs::read_to_string(folder.join(name)).ok()?));
    names.filter(|name| name.ends_with(".svg")).filter_map(with_text).collect()
}

fn folder_and_file(given: &Path) -> (PathBuf, PathBuf) {
    match given.is_dir() {
        true => (given.to_path_buf(), given.join("result.json")),
        false => (given.parent().unwrap_or(Path::new("")).to_path_buf(), given.to_path_buf()),
    }
}

/// What the folder holds, and every file that was read.
fn left(folder: &Path, file: &Path) -> Result<(Left, Vec<PathBuf>), RunError> {
    let refused = |cause: String| {
        RunError::Choice(format!("{}: {cause}; give the folder of a run of `ribopt solve`, or its result.json", file.display()))
    };
    let text = fs::read_to_string(file).map_err(|error| refused(error.to_string()))?;
    let result: Value = serde_json::from_str(&text).map_err(|error| refused(error.to_string()))?;
    if result.get("format").and_then(Value::as_str) != Some(FORMAT) {
        return Err(refused(format!("this is no result of format {FORMAT}")));
    }
    let beside = |name: &str| Some((name.to_owned(), fs::read_to_string(folder.join(name)).ok()?));
    let pictures = pictures(folder);
    let network = beside(NETWORK).map(|(_, text)| text);
    let tables = TABLES.iter().filter_map(|name| beside(name)).collect();
    let (inputs, unchanged) = inputs(&result);
    let shown = TABLES.iter().map(|name| folder.join(name)).chain(pictures.iter().map(|(name, _)| folder.join(name)));
    let read =
        inputs.iter().map(|(name, _)| name.into()).chain(shown).chain([file.to_path_buf(), folder.join(NETWORK)]).collect();
    Ok((Left { result, tables, pictures, network, inputs, unchanged }, read))
}

/// The problem file and its tables, and whether they are those that were solved.
fn inputs(result: &Value) -> (Vec<(String, String)>, Option<bool>) {
    let text = |pointer: &str| result.pointer(pointer).and_then(Value::as_str).unwrap_or_default();
    let file = Path::new(text("/problem/file"));
    let with_text = |path: &Path| Some((path.display().to_string(), fs::read_to_string(path).ok()?));
    match input::read(file) {
        Ok(input) => {
            let unchanged = input.sha256 == text("/problem/sha256");
            (input.files.iter().filter_map(|path| with_text(path)).collect(), Some(unchanged))
        }
        Err(_) => (with_text(file).into_iter().collect(), None),
    }
}
