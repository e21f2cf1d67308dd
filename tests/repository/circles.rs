//! Inside a folder of `src` the files form no circle: of two files one is read first.
//!
//! A folder's parts are its files and its subfolders. A part that names an item of another part points to it, by `super::other::…`,
//! by `crate::room::other::…`, or by a name that the folder's own page (`mod.rs`, or `folder.rs`) imports from there. The page itself
//! belongs to all: parts may use what it declares, and it may use all parts. Tests count for nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Circles that stay, by a part of each, with the reason.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("expression/parse/condition", "the grammar is recursive: conditions hold expressions, which hold `where` conditions"),
    ("expression/structure/curvature", "the rules of products, norms and logarithms ask for the curvature of what stands inside"),
    ("recession/floor", "the floor of a valley is found along the valley, and the valley ends on it"),
    ("certificate/point", "a point's scales are computed from its derivatives and kept with them"),
    ("crosscheck/session", "the session is what every step of the verdict works on"),
    ("cli/failure", "a failure is shown as output, and output may fail"),
    ("run/network", "sizing fails as reading the network does"),
    ("mesh/formats/off", "the binary form shares the header's reader"),
    ("mesh/graph", "lines are traced on the graph, and stations walk the lines"),
];

/// One source file.
struct File {
    /// `["model", "views", "scaled"]`; a folder's page has the folder's path.
    module: Vec<String>,
    code: String,
    is_page: bool,
}

/// The paths a piece of code names, absolute (from `crate`), each as far as it goes.
fn named_paths(file: &File) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for start in ["crate::", "super::", "self::"] {
        for (at, _) in file.code.match_indices(start) {
            let before = file.code[..at].chars().next_back();
            if before.is_none_or(|c| !(c.is_alphanumeric() || c == '_' || c == ':')) {
                expand(&file.code[at..], Vec::new(), &mut found);
            }
        }
    }
    found.into_iter().filter_map(|path| absolute(path, &file.module)).collect()
}

/// All paths of a `use` tree or of a plain path that begins here.
fn expand(text: &str, mut prefix: Vec<String>, found: &mut Vec<Vec<String>>) -> usize {
    let mut at = 0;
    loop {
        let rest = &text[at..];
        if let Some(inner) = rest.strip_prefix('{') {
            let mut inside = 0;
            loop {
                inside += inner[inside..].len() - inner[inside..].trim_start_matches([' ', '\n', ',']).len();
                if inner[inside..].starts_with('}') || inner[inside..].is_empty() {
                    return at + inside + 2;
                }
                let taken = expand(&inner[inside..], prefix.clone(), found);
                inside += taken.max(1);
            }
        }
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        if end == 0 {
            found.push(prefix);
            return at;
        }
        prefix.push(rest[..end].to_owned());
        at += end;
        if !text[at..].starts_with("::") {
            found.push(prefix);
            return at;
        }
        at += 2;
    }
}

/// `super` and `self` resolved.
fn absolute(path: Vec<String>, module: &[String]) -> Option<Vec<String>> {
    let mut base = module.to_vec();
    let mut rest = path.into_iter().peekable();
    match rest.peek().map(String::as_str) {
        Some("crate") => {
            rest.next();
            base.clear();
        }
        Some("self") => {
            rest.next();
        }
        _ => {}
    }
    while rest.next_if(|word| word == "super").is_some() {
        base.pop()?;
    }
    base.extend(rest.filter(|word| word != "self"));
    Some(base)
}

/// What a folder's page imports from its parts: name → part.
fn imported(page: &File) -> BTreeMap<String, String> {
    let mut names = BTreeMap::new();
    for line in statements(&page.code, "use ") {
        let mut paths = Vec::new();
        expand(line.trim_start(), Vec::new(), &mut paths);
        for path in paths.into_iter().filter(|path| path.len() > 1) {
            let path = if path[0] == "self" { path[1..].to_vec() } else { path };
            if !["crate", "super", "std"].contains(&path[0].as_str()) && path.len() > 1 {
                names.insert(path[path.len() - 1].clone(), path[0].clone());
            }
        }
    }
    names
}

/// What stands between a keyword at the beginning of a statement and its semicolon.
fn statements<'t>(code: &'t str, keyword: &str) -> Vec<&'t str> {
    let begins = code.match_indices(keyword).filter(|(at, _)| {
        let line = code[..*at].rsplit('\n').next().unwrap().trim();
        line.is_empty() || line.starts_with("pub")
    });
    begins.map(|(at, _)| code[at + keyword.len()..].split(';').next().unwrap()).collect()
}

/// Which parts of a folder point to which others.
fn arrows(folder: &[String], files: &[File]) -> BTreeMap<String, BTreeSet<String>> {
    let depth = folder.len();
    let parts: BTreeSet<&str> = files
        .iter()
        .filter(|file| file.module.len() > depth && file.module[..depth] == *folder)
        .map(|file| file.module[depth].as_str())
        .collect();
    let page = files.iter().find(|file| file.module == folder);
    let imported = page.map(imported).unwrap_or_default();
    let mut arrows = BTreeMap::<String, BTreeSet<String>>::new();
    for file in files.iter().filter(|file| file.module.len() > depth && file.module[..depth] == *folder) {
        let own = &file.module[depth];
        for path in named_paths(file).into_iter().filter(|path| path.len() > depth && path[..depth] == *folder) {
            let name = &path[depth];
            let other = if parts.contains(name.as_str()) { Some(name) } else { imported.get(name) };
            if let Some(other) = other.filter(|other| *other != own) {
                arrows.entry(own.clone()).or_default().insert(other.clone());
            }
        }
    }
    arrows
}

/// Groups of parts that reach one another.
fn circles(arrows: &BTreeMap<String, BTreeSet<String>>) -> Vec<BTreeSet<String>> {
    let reached = |from: &String| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(part) = open.pop() {
            for next in arrows.get(part).into_iter().flatten() {
                if seen.insert(next.clone()) {
                    open.push(next);
                }
            }
        }
        seen
    };
    let reach: BTreeMap<&String, BTreeSet<String>> = arrows.keys().map(|part| (part, reached(part))).collect();
    let circle = |part: &String| -> BTreeSet<String> {
        reach[part].iter().filter(|other| reach.get(other).is_some_and(|back| back.contains(part))).cloned().collect()
    };
    let all: BTreeSet<BTreeSet<String>> = arrows.keys().map(circle).filter(|circle| circle.len() > 1).collect();
    all.into_iter().collect()
}

fn read(folder: &Path, module: &[String], files: &mut Vec<File>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path: PathBuf = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if name == "tests" || name.ends_with("_tests") {
            continue;
        }
        let inner: Vec<String> = module.iter().cloned().chain([name.clone()]).collect();
        if path.is_dir() {
            read(&path, &inner, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") && name != "lib" && name != "main" {
            let text = fs::read_to_string(&path).unwrap();
            let without_tests = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
            let code: String = without_tests.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n");
            let is_page = name == "mod" || path.with_extension("").is_dir();
            files.push(File { module: if name == "mod" { module.to_vec() } else { inner }, code, is_page });
        }
    }
}

#[test]
fn files_of_a_folder_form_no_circle() {
    let mut files = Vec::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &[], &mut files);
    let mut wrong = Vec::new();
    for folder in files.iter().filter(|file| file.is_page).map(|file| &file.module) {
        for circle in circles(&arrows(folder, &files)) {
            let names: Vec<String> = circle.iter().map(|part| format!("{}/{part}", folder.join("/"))).collect();
            if !names.iter().any(|name| EXCEPTIONS.iter().any(|(excepted, _)| excepted == name)) {
                wrong.push(names.join(", "));
            }
        }
    }
    assert!(wrong.is_empty(), "circles:\n{}", wrong.join("\n"));
}

#[test]
fn every_exception_is_still_a_circle() {
    let mut files = Vec::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &[], &mut files);
    for (excepted, _) in EXCEPTIONS {
        let (folder, part) = excepted.rsplit_once('/').unwrap();
        let folder: Vec<String> = folder.split('/').map(str::to_owned).collect();
        assert!(
            circles(&arrows(&folder, &files)).iter().any(|circle| circle.contains(part)),
            "{excepted} is in no circle any more"
        );
    }
}

#[test]
fn paths_are_taken_from_use_trees() {
    let file = File {
        module: ["room", "part"].map(String::from).to_vec(),
        code: "use super::{one::{A, B}, two};\nuse crate::room::three::C;\nlet x = super::four();".into(),
        is_page: false,
    };
    let named: Vec<String> = named_paths(&file).iter().map(|path| path.join("::")).collect();
    for path in ["room::one::A", "room::one::B", "room::two", "room::three::C", "room::four"] {
        assert!(named.iter().any(|found| found == path), "{path} is not among {named:?}");
    }
}
