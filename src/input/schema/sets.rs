//! Sets of keys of which one must be whole.

use serde_json::{Value, json};

/// All keys of one of the sets must be there: a tree of questions, so that a missing key is missed once, in the first set that what is
/// given fits into.
pub(super) fn one_of_sets(mut sets: Vec<Vec<&str>>) -> Value {
    let Some(first) = sets.first() else { return json!({ "required": [] }) };
    let common: Vec<&str> = first.iter().copied().filter(|key| sets.iter().all(|set| set.contains(key))).collect();
    sets.iter_mut().for_each(|set| set.retain(|key| !common.contains(key)));
    let mut rule = json!({ "required": common });
    let asked = sets.first().and_then(|set| set.first()).copied();
    if let (Some(key), true) = (asked, sets.iter().all(|set| !set.is_empty())) {
        let (with, without) = sets.into_iter().partition(|set| set.contains(&key));
        rule["if"] = json!({ "required": [key] });
        rule["then"] = one_of_sets(with);
        rule["else"] = one_of_sets(without);
    }
    rule
}
