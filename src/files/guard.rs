//! No output of a run takes the place of one of its inputs.

use std::path::{Path, PathBuf};

/// The files a run reads.
#[derive(Debug, Clone, Default)]
pub struct Inputs(Vec<PathBuf>);

/// An output that would destroy an input.
#[derive(Debug, thiserror::Error)]
#[error("{output} would be overwritten, but this run reads it{}; choose another name or folder for the output", known_as(.output, .input))]
pub struct Overwrites {
    output: String,
    input: String,
}

fn known_as(output: &str, input: &str) -> String {
    if output == input { String::new() } else { format!(" as {input}") }
}

impl Inputs {
    /// These files.
    pub fn new(files: impl IntoIterator<Item = PathBuf>) -> Inputs {
        Inputs(files.into_iter().collect())
    }

    /// One more.
    pub fn add(&mut self, file: &Path) {
        self.0.push(file.into());
    }

    /// All of them.
    pub fn files(&self) -> &[PathBuf] {
        &self.0
    }

    /// Refuses outputs that are inputs, by whatever path they are named.
    ///
    /// # Errors
    /// The first of them, with both names.
    ///
    /// ```
    /// let folder = tempfile::tempdir()?;
    /// let (input, same) = (folder.path().join("rib.toml"), folder.path().join("./rib.toml"));
    /// std::fs::write(&input, "title = \"rib\"")?;
    /// let inputs = ribopt::files::Inputs::new([input]);
    /// assert!(inputs.spare([&same]).is_err());
    /// assert!(inputs.spare([&folder.path().join("rib.svg")]).is_ok());
    /// # Ok::<(), std::io::Error>(())
    /// ```
    pub fn spare<P: AsRef<Path>>(&self, outputs: impl IntoIterator<Item = P>) -> Result<(), Overwrites> {
        let known: Vec<(&PathBuf, Vec<PathBuf>)> = self.0.iter().map(|input| (input, places(input))).collect();
        for output in outputs {
            let wanted = places(output.as_ref());
            if let Some((input, _)) = known.iter().find(|(_, own)| own.iter().any(|place| wanted.contains(place))) {
                let (output, input) = (output.as_ref().display().to_string(), input.display().to_string());
                return Err(Overwrites { output, input });
            }
        }
        Ok(())
    }
}

/// Where a path leads, and where it stands itself: the two differ for a symbolic link, and neither may be lost.
fn places(path: &Path) -> Vec<PathBuf> {
    let target = path.canonicalize().ok();
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entry = parent.canonicalize().ok().zip(path.file_name()).map(|(parent, name)| parent.join(name));
    target.into_iter().chain(entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[cfg(unix)]
    #[test]
    fn links_are_seen_through_from_either_end() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("real.csv"), "name").unwrap();
        std::os::unix::fs::symlink(at("real.csv"), at("link.csv")).unwrap();
        for (input, output) in [("real.csv", "link.csv"), ("link.csv", "real.csv"), ("link.csv", "link.csv")] {
            let message = Inputs::new([at(input)]).spare([at(output)]).unwrap_err().to_string();
            assert!(message.contains(output) && message.contains("choose another"), "{message}");
        }
    }

    #[test]
    fn both_names_are_told() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.toml"), "").unwrap();
        fs::create_dir(folder.path().join("b")).unwrap();
        let message = Inputs::new([folder.path().join("a.toml")]).spare([folder.path().join("b/../a.toml")]).unwrap_err();
        assert!(message.to_string().contains("b/../a.toml would be overwritten, but this run reads it as"), "{message}");
    }
}
