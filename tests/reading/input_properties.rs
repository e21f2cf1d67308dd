//! Whatever the bytes are: a problem or mistakes, never a panic, and every mistake lies inside its line.

use proptest::prelude::*;
use ribopt::input::{Input, Mistakes, read};

/// Reads `bytes` as a problem file.
fn read_bytes(bytes: &[u8]) -> Result<Input, Mistakes> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("problem.toml");
    std::fs::write(&path, bytes).expect("a writable folder");
    std::fs::copy("problems/rib-of-uniform-strength/sections.csv", folder.path().join("s.csv")).expect("a table");
    read(&path)
}

fn is_sound(outcome: &Result<Input, Mistakes>) {
    match outcome {
        Ok(input) => {
            let variables = &input.problem.variables;
            for j in 0..variables.start.len() {
                assert!(variables.lower[j] <= variables.start[j] && variables.start[j] <= variables.upper[j]);
            }
        }
        Err(mistakes) => {
            assert!(!mistakes.list.is_empty());
            for mistake in &mistakes.list {
                assert!(mistake.caret.end <= mistake.text.chars().count().max(mistake.caret.start), "{mistake:?}");
            }
            assert!(!mistakes.to_string().is_empty());
        }
    }
}

const WHOLE: &str = include_str!("../../problems/h-beam-row.toml");
const RIBS: &str = include_str!("../../problems/haunched-floor-rib.toml");

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        is_sound(&read_bytes(&bytes));
    }

    #[test]
    fn random_text(text in "[\\[\\]a-z=\"'{}0-9.\n, #*+^()<>-]{0,300}") {
        is_sound(&read_bytes(text.as_bytes()));
    }

    #[test]
    fn truncated_files(cut in 0..WHOLE.len().max(RIBS.len()), which in any::<bool>()) {
        let whole = if which { WHOLE } else { RIBS };
        let cut = (0..=cut.min(whole.len())).rev().find(|&at| whole.is_char_boundary(at)).unwrap_or(0);
        is_sound(&read_bytes(&whole.as_bytes()[..cut]));
    }

    #[test]
    fn files_with_one_byte_changed(at in 0..WHOLE.len(), byte in any::<u8>()) {
        let mut bytes = WHOLE.as_bytes().to_vec();
        bytes[at] = byte;
        is_sound(&read_bytes(&bytes));
    }

    #[test]
    fn random_expressions(text in "[a-d.0-9+*/^()<=> \\[\\],:-]{0,40}", name in "(sum|max|x|ribs|sections|volume|pi|s1|from)") {
        let file = format!(
            "minimize = \"x + {name}{text}\"\nvariables.x = {{ lower = \"{text}\" }}\n[definitions]\na = \"{text}\"\n\
             [tables]\nsections = \"s.csv\"\n[[constraints]]\nfor = \"sections\"\nwhere = \"{text}\"\nrequire = \"{text}\"\n"
        );
        is_sound(&read_bytes(file.as_bytes()));
    }

    #[test]
    fn numbers_of_every_size(mantissa in -10.0..10.0f64, exponents in proptest::array::uniform4(-300..=300i32)) {
        let number = |at: usize| format!("{mantissa}e{}", exponents[at]);
        let file = format!(
            "minimize = \"x + volume*{0}\"\n[parameters]\np = \"{0}^3*{1}/{2}\"\n[variables]\nx = {{ lower = {0}, upper = \"p\" }}\n\
             y = {{ upper = {1} }}\nz = {{ lower = {2}, start = {3} }}\n[sections.a]\nkind = \"rectangle\"\nb = {{ lower = {1}, \
             upper = {2} }}\nh = \"{3}*y\"\n[[ribs]]\nname = \"r\"\nsection = \"a\"\nlength = {3}\n[[constraints]]\nrequire = \"{0} <= x*y*a.Ix <= {1}\"\n",
            number(0), number(1), number(2), number(3)
        );
        is_sound(&read_bytes(file.as_bytes()));
    }
}
