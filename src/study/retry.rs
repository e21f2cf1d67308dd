//! Forgets chains whose points are to be tried again.

use super::layout::Layout;
use super::store::Store;
use super::{Row, Study, StudyError, Table};

/// Forgets the finished chains with a point of such a status: `failed` (nothing settled), `limit` (a limit was reached) or a status' own word.
///
/// # Errors
/// A word that is no status; a file that cannot be removed.
pub fn retry(study: &Study, store: &Store, statuses: &[String]) -> Result<(), StudyError> {
    if statuses.is_empty() {
        return Ok(());
    }
    const WORDS: [&str; 11] = [
        "failed",
        "limit",
        "certified",
        "uncertified",
        "infeasible",
        "unbounded",
        "not-attained",
        "limit-reached",
        "invalid-value",
        "mistake",
        "crashed",
    ];
    if let Some(unknown) = statuses.iter().find(|status| !WORDS.contains(&status.as_str())) {
        return Err(StudyError::Request(format!("--retry: there is no status `{unknown}`; one of {}", WORDS.join(", "))));
    }
    let is_wanted = |row: &Row| {
        statuses.iter().any(|status| match status.as_str() {
            "failed" => row.has_failed(),
            "limit" => row.status == "limit-reached",
            other => row.status == other,
        })
    };
    let undo: Vec<usize> = match &study.layout {
        Layout::Points(points) => {
            (0..points.chains.len()).filter(|&chain| store.rows(chain).is_some_and(|rows| rows.iter().any(is_wanted))).collect()
        }
        Layout::Front(_) => Table::of(study, store).rows.iter().filter(|row| is_wanted(row)).map(|row| row.point).collect(),
    };
    undo.into_iter().try_for_each(|chain| Ok(store.undo(chain)?))
}
