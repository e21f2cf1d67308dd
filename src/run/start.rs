//! Where a run begins: the file's start or an earlier answer, moved into the domain where a term has no value there.

use crate::model::{Model, domain};
use crate::report::text::listing;

/// Moved variables named at the most.
const SHOWN: usize = 5;

/// `start`, or a point near it where the model has values, and what was done, in a sentence. Where no such point is found the
/// start stays as it is: the run will tell the term that has no value.
pub fn in_domain(model: &dyn Model, start: Vec<f64>) -> (Vec<f64>, Option<String>) {
    let Err(error) = model.gradient(&start, &mut vec![0.0; start.len()]).and_then(|_| rows(model, &start)) else {
        return (start, None);
    };
    let Ok(x) = domain::valid_near(model, &start) else { return (start, None) };
    let moved: Vec<usize> = (0..x.len()).filter(|&j| x[j] != start[j]).collect();
    let words = moved.iter().map(|&j| format!("{} from {} to {:.6}", model.variable_name(j), start[j], x[j]));
    let remark = format!(
        "the start is outside the domain ({error}); it was moved to a point where everything has a value: {}",
        listing(words, SHOWN)
    );
    (x, Some(remark))
}

fn rows(model: &dyn Model, x: &[f64]) -> Result<(), crate::model::EvaluationError> {
    let meta = model.meta();
    model.constraints(x, &mut vec![0.0; meta.rows()])?;
    model.jacobian(x, &mut vec![0.0; meta.jacobian.len()])
}
