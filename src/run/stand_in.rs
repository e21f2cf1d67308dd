//! Lower bounds that stand for "positive" and govern: a hint after the run.

use super::Subject;
use crate::certificate::Side;
use crate::crosscheck::Outcome;
use crate::report::number::short;

/// A bound this part of the start is no size that anybody wants: it was written to keep a variable positive. Sizes that are meant lie within
/// a factor of a hundred of the start in all of `problems/` and `tests/extra`.
const TINY: f64 = 1e-3;

/// Variables named one by one.
const NAMED: usize = 5;

/// What to say of them, in one sentence at the most.
pub(super) fn remark(subject: &Subject, outcome: &Outcome) -> Option<String> {
    let (certificate, variables) = (outcome.certificate.as_ref()?, &subject.problem().variables);
    let governs = |&j: &usize| {
        let (lower, start) = (variables.lower[j], variables.start[j]);
        let rests = certificate.bound_sides.get(j) == Some(&Side::Lower);
        let costs = certificate.bound_multipliers.get(j).is_some_and(|multiplier| *multiplier != 0.0);
        rests && costs && lower > 0.0 && variables.upper[j] > lower && lower <= TINY * start.abs()
    };
    let found: Vec<usize> = (0..variables.lower.len()).filter(governs).collect();
    let named = |&j: &usize| format!("{} ({})", subject.problem().variable_name(j), short(variables.lower[j]));
    let names: Vec<String> = found.iter().take(NAMED).map(named).collect();
    let more = if found.len() > NAMED { format!(" and {} more", found.len() - NAMED) } else { String::new() };
    let (rest, bound) =
        if found.len() == 1 { ("rests on its lower bound", "it") } else { ("rest on their lower bounds", "they") };
    (!found.is_empty()).then(|| {
        format!(
            "{}{more} {rest}, tiny beside the start: if {bound} only stood for \"positive\", the design wants these gone; give the least sizes that can be built",
            names.join(", ")
        )
    })
}
