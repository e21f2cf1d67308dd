//! Commented example files to start from.

use crate::problem::nearest::did_you_mean;

/// Examples by name, the default first.
const EXAMPLES: &[(&str, &str)] = &[
    ("ribs", include_str!("examples/ribs.toml")),
    ("rectangle", include_str!("examples/rectangle.toml")),
    ("h-beam", include_str!("examples/h-beam.toml")),
    ("superellipse", include_str!("examples/superellipse.toml")),
    ("tee", include_str!("examples/tee.toml")),
    ("box", include_str!("examples/box.toml")),
    ("circle", include_str!("examples/circle.toml")),
    ("tube", include_str!("examples/tube.toml")),
    ("i-section", include_str!("examples/i-section.toml")),
    ("channel", include_str!("examples/channel.toml")),
    ("angle", include_str!("examples/angle.toml")),
    ("polygon", include_str!("examples/polygon.toml")),
    ("polyline", include_str!("examples/polyline.toml")),
    ("profile", include_str!("examples/profile.toml")),
    ("expressions", include_str!("examples/expressions.toml")),
    ("load-cases", include_str!("examples/load-cases.toml")),
    ("truss", include_str!("examples/truss.toml")),
    ("frame", include_str!("examples/frame.toml")),
    ("grillage", include_str!("examples/grillage.toml")),
];

/// The names [`example`] knows.
pub fn examples() -> impl Iterator<Item = &'static str> {
    EXAMPLES.iter().map(|(name, _)| *name)
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
    let wanted = kind.unwrap_or(EXAMPLES[0].0);
    match EXAMPLES.iter().find(|(name, _)| *name == wanted) {
        Some((_, text)) => Ok((*text).to_owned()),
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
        for kind in crate::sections::KINDS {
            let named = format!("kind = \"{}\"", kind.name());
            assert!(EXAMPLES.iter().any(|(_, text)| text.contains(&named)), "no example of {}", kind.name());
        }
    }
}
