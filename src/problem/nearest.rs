//! The nearest known name, for misspelt ones.

/// ``did you mean `lower`?`` where a known name is near enough.
pub(crate) fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    nearest(name, known).map(|best| format!("did you mean `{best}`?"))
}

/// The known name with the fewest edits, if at most a third of the letters differ (one in short names, of single letters only their case).
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let letters = name.chars().count();
    let allowed = if letters < 2 { 0 } else { (letters / 3).max(1) };
    let (lower, length) = (name.to_lowercase(), name.len());
    known
        .filter(|candidate| candidate.len().abs_diff(length) <= 4 * allowed)
        .map(|candidate| (edits(name, &lower, candidate), candidate))
        .filter(|&(edits, _)| edits <= allowed)
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, candidate)| candidate)
}

/// Edits between two names; letter case counts for nothing, so that `ix` finds `Ix`.
fn edits(name: &str, lower: &str, candidate: &str) -> usize {
    if lower == candidate.to_lowercase() {
        return 0;
    }
    let exact = strsim::damerau_levenshtein(name, candidate);
    if exact <= 1 { exact } else { strsim::damerau_levenshtein(lower, &candidate.to_lowercase()) }
}
