//! Second opinions: from other starts a small nonlinear problem may have a better minimum than the one found.

use super::interior_point::{InteriorPoint, towards_middle};
use super::{Finished, run};
use crate::backends::Job;
use crate::math::split_mix::SplitMix;
use crate::model::{Evaluator, Meta, Model};

/// Variables and rows up to which second opinions cost next to nothing.
const SMALL: usize = 50;
/// Iterations of one second opinion at the most.
const ITERATIONS: u64 = 300;
/// Seeds of the random starts.
const SEEDS: [u64; 2] = [1, 2];

/// The better of `found` and what other starts lead to, as far as the stop test passes there. Nothing is tried where `found`
/// does not pass itself: that is for second tries to mend.
pub(super) fn better<'a>(evaluator: &'a Evaluator<'a>, job: &mut Job<'_>, mut found: Finished) -> Finished {
    let meta = evaluator.meta();
    let linear = meta.objective_is_linear && meta.row_is_linear.iter().all(|&linear| linear);
    let Some(passes) = job.stop_test else { return found };
    if linear || meta.variables().max(meta.rows()) > SMALL || !passes(&found.x) {
        return found;
    }
    let Ok(mut lowest) = evaluator.objective(&found.x) else { return found };
    for start in starts(meta, job.start) {
        let observer = &mut *job.observer;
        let mut aside = Job { start: &start, start_multipliers: None, max_iterations: ITERATIONS, observer, ..*job };
        let other = run(InteriorPoint::new(start.clone(), None), evaluator, &mut aside);
        let Ok(objective) = evaluator.objective(&other.x) else { continue };
        if objective < lowest - 1e-9 * lowest.abs() && passes(&other.x) {
            let message = format!("{}; found by a second opinion from another start", other.message);
            found = Finished { iterations: found.iterations + other.iterations, message, ..other };
            lowest = objective;
        }
    }
    found
}

/// The middle of the bounds, and points spread over them.
fn starts(meta: &Meta, start: &[f64]) -> Vec<Vec<f64>> {
    let spread = |seed: u64| {
        let mut random = SplitMix::new(seed);
        let one = |j: usize| {
            let (lower, upper, start, u) = (meta.lower[j], meta.upper[j], start[j], random.uniform());
            match (lower.is_finite(), upper.is_finite()) {
                (true, true) => lower + u * (upper - lower),
                (true, false) => lower + 2.0 * u * (start - lower).max(1.0),
                (false, true) => upper - 2.0 * u * (upper - start).max(1.0),
                (false, false) => start + (2.0 * u - 1.0) * 3.0 * start.abs().max(1.0),
            }
        };
        (0..start.len()).map(one).collect()
    };
    std::iter::once(towards_middle(meta, start, 1.0)).chain(SEEDS.map(spread)).collect()
}
