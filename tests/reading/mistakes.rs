//! `docs/mistakes.md`, which `ribopt explain` prints: every kind of mistake and warning, an example that has it, and one that has not.

use std::fs;
use std::path::Path;

use ribopt::problem::mistake_code::MistakeCode;
use ribopt::run::Subject;

/// The fenced blocks of a part: what stands behind the fence, and the text.
fn blocks(text: &str) -> Vec<(&str, &str)> {
    text.split("```").skip(1).step_by(2).filter_map(|block| block.split_once('\n')).collect()
}

/// What an example has: codes of its mistakes and warnings, and all of it as it is told.
struct Told {
    codes: Vec<String>,
    text: String,
}

/// Reads and assembles an example with the tables beside it, and with what it says after `--set`.
fn read(tables: &[(&str, &str)], text: &str) -> Told {
    let folder = tempfile::tempdir().unwrap();
    for (name, table) in tables {
        fs::write(folder.path().join(name), table).unwrap();
    }
    let file = folder.path().join("rib.toml");
    fs::write(&file, text).unwrap();
    let overrides: Vec<String> =
        text.lines().filter_map(|line| line.split_once("--set ")).map(|(_, set)| set.to_owned()).collect();
    let text = match Subject::read(&file, &overrides) {
        Ok(subject) => subject.warnings.concat(),
        Err(error) => error.to_string(),
    };
    let code = |line: &str| {
        let rest = line.strip_prefix("mistake[").or_else(|| line.strip_prefix("warning["))?;
        rest.split_once(']').map(|(code, _)| code.to_owned())
    };
    Told { codes: text.lines().filter_map(code).collect(), text }
}

/// What `ribopt explain` prints of a code.
fn explained(code: MistakeCode) -> String {
    ribopt::input::explain(Some(code.name())).unwrap_or_else(|message| panic!("{message}"))
}

/// Both examples of a code: what is told of the wrong one, and of the right one.
fn examples(explanation: &str) -> [Told; 2] {
    let (_, examples) = explanation.split_once("Wrong:").expect("an example that is wrong");
    let (wrong, right) = examples.split_once("Right:").expect("an example that is right");
    [wrong, right].map(|example| {
        let blocks = blocks(example);
        let tables: Vec<(&str, &str)> =
            blocks.iter().filter_map(|(kind, text)| Some((kind.strip_prefix("csv ")?, *text))).collect();
        let (_, text) = blocks.iter().find(|(kind, _)| *kind == "toml").expect("a problem file");
        read(&tables, text)
    })
}

/// Its wrong example is shown with one rib instead of a thousand.
const ABRIDGED: MistakeCode = MistakeCode::ManyRows;

#[test]
fn everything_is_explained_and_its_examples_are_wrong_and_right() {
    let mut failures = Vec::new();
    for &code in MistakeCode::ALL {
        let [wrong, right] = examples(&explained(code));
        let label = format!("{}[{code}]", if code.is_warning() { "warning" } else { "mistake" });
        let shown = code != ABRIDGED;
        if shown && !(wrong.codes.iter().any(|known| known == code.name()) && wrong.text.contains(&label)) {
            failures.push(format!("{code}: the wrong example has something else\n{}", wrong.text));
        }
        if !right.text.is_empty() {
            failures.push(format!("{code}: the right example is wrong, or warned of\n{}", right.text));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn the_page_explains_the_codes_there_are_in_their_order() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/mistakes.md")).unwrap();
    let headings: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    assert_eq!(headings, MistakeCode::ALL.iter().map(|code| code.name()).collect::<Vec<_>>());
}

#[test]
fn every_mistake_of_every_bad_file_has_a_code() {
    for entry in fs::read_dir("tests/bad").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let mistakes = ribopt::input::read(&path).expect_err("a bad file");
            assert!(mistakes.list.iter().all(|mistake| mistake.code.is_some()), "{}", path.display());
        }
    }
}
