//! Where a run begins: the start it is given, moved into the domain where a term has no value there.

use super::Task;
use super::messages;
use crate::model::domain;

/// A start outside the domain, and where the run began instead.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedStart {
    /// Where everything has a value.
    pub x: Vec<f64>,
    /// What was wrong and what was done, in a sentence.
    pub remark: String,
}

/// A point near the task's start where the model has values; `None` where it has them at the start. Where no such point is found
/// the start stays as it is, too: the run will tell the term that has no value.
pub(super) fn in_domain(task: &Task<'_>) -> Option<MovedStart> {
    let (model, start) = (task.model, task.start);
    let error = domain::values(model, start).err()?;
    let mut x = domain::valid_near(model, start).ok()?;
    model.complete(&mut x);
    let moved = (0..model.own().variables).filter(|&j| x[j] != start[j]);
    let moves: Vec<String> = moved.map(|j| format!("{} from {} to {:.6}", model.variable_name(j), start[j], x[j])).collect();
    let remark = format!(
        "the start is outside the domain ({error}); it was moved to a point where everything has a value: {}",
        messages::list(&moves)
    );
    Some(MovedStart { x, remark })
}
