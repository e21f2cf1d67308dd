//! Commented example files to start from.

use crate::problem::nearest::did_you_mean;
use crate::sections::KINDS;

/// The first example, and those that show something else than a kind of section.
const FIRST: (&str, &str) = ("ribs", include_str!("examples/ribs.toml"));
const FURTHER: &[(&str, &str)] = &[
    ("profile", include_str!("examples/profile.toml")),
    ("expressions", include_str!("examples/expressions.toml")),
    ("load-cases", include_str!("examples/load-cases.toml")),
];

/// Examples by name, the default first.
fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    let of_kinds = KINDS.iter().map(|kind| (kind.name(), kind.example()));
    std::iter::once(FIRST).chain(of_kinds).chain(FURTHER.iter().copied())
}

/// The names [`example`] knows.
pub fn examples() -> impl Iterator<Item = &'static str> {
    all().map(|(name, _)| name)
}

/// A commented example file: the one of this name, or the first.
///
/// # Errors
/// A sentence naming the known examples.
///
/// ```
/// assert!(ribopt::input::example(None)?.contains("[[ribs]]"));
/// assert!(ribopt::input::example(Some("rectangel")).unwrap_err().contains("did you mean `rectangle`?"));
/// # Ok::<(), String>(())
/// ```
pub fn example(kind: Option<&str>) -> Result<String, String> {
    let wanted = kind.unwrap_or(FIRST.0);
    match all().find(|(name, _)| *name == wanted) {
        Some((_, text)) => Ok(text.to_owned()),
        None => {
            let known = || format!("known: {}", examples().collect::<Vec<_>>().join(", "));
            Err(format!("there is no example `{wanted}`; {}", did_you_mean(wanted, examples()).unwrap_or_else(known)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_reads_without_a_mistake_or_warning() {
        let folder = tempfile::tempdir().unwrap();
        for name in examples() {
            let path = folder.path().join(format!("{name}.toml"));
            std::fs::write(&path, example(Some(name)).unwrap()).unwrap();
            let input = crate::input::read(&path).unwrap_or_else(|mistakes| panic!("{name}:\n{mistakes}"));
            assert!(input.warnings.is_empty(), "{name}: {:?}", input.warnings);
        }
    }

    #[test]
    fn every_kind_of_section_has_an_example() {
        for kind in KINDS {
            let named = format!("kind = \"{}\"", kind.name());
            assert!(kind.example().contains(&named), "no example of {}", kind.name());
        }
    }
}
