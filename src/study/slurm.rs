//! Hands a study to Slurm: one array of workers, and a job after it that merges.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::Command;

use super::StudyError;

/// What Slurm was asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Submission {
    /// The array of workers.
    pub array: String,
    /// The job that merges when the array has ended.
    pub merge: String,
}

/// Submits `shards` workers and a merge by `sbatch`, which gets the other arguments as they are.
///
/// # Errors
/// No `sbatch`, or its own words.
pub fn submit(study: &Path, folder: &Path, shards: usize, others: &[String]) -> Result<Submission, StudyError> {
    let program =
        std::env::current_exe().map_err(|error| StudyError::Request(format!("this program's own path is not known: {error}")))?;
    let (study, folder) = (absolute(study)?, absolute(folder)?);
    let [program, file, out] = [&program, &study, &folder].map(|path| quoted(&path.to_string_lossy()));
    let command = |last: &str| format!("{program} sweep {file} --out {out} {last}");
    let name = format!("ribopt {}", study.file_stem().unwrap_or_default().to_string_lossy());
    let log = folder.join("slurm-%A_%a.log");
    let array = sbatch(
        &[
            "--job-name".into(),
            name.clone().into(),
            format!("--array=0-{}", shards.saturating_sub(1)).into(),
            "--output".into(),
            log.into(),
        ],
        others,
        &command("--worker --quiet"),
    )?;
    let merge = sbatch(
        &[
            "--job-name".into(),
            format!("{name} merge").into(),
            format!("--dependency=afterany:{array}").into(),
            "--output".into(),
            folder.join("slurm-merge-%j.log").into(),
        ],
        others,
        &command("--merge"),
    )?;
    Ok(Submission { array, merge })
}

fn absolute(path: &Path) -> Result<std::path::PathBuf, StudyError> {
    std::path::absolute(path).map_err(|error| StudyError::Request(format!("{}: {error}", path.display())))
}

/// A word of a shell's command line.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// The job's number.
fn sbatch(arguments: &[OsString], others: &[String], command: &str) -> Result<String, StudyError> {
    let output = Command::new("sbatch").arg("--parsable").args(arguments).args(others).arg("--wrap").arg(command).output();
    let output = output.map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => StudyError::Request(
            "there is no `sbatch` here: run this where Slurm is, or let workers run by hand: ribopt sweep STUDY --shard 1/4"
                .into(),
        ),
        _ => StudyError::Request(format!("sbatch cannot be run: {error}")),
    })?;
    let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    if !output.status.success() {
        return Err(StudyError::Request(format!("sbatch refused: {}", said(&output.stderr))));
    }
    // `number` or `number;cluster`.
    Ok(said(&output.stdout).split(';').next().unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_of_a_shell_stay_whole() {
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
