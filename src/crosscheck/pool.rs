//! Solvers run on a thread of rayon's pool. Factorisations ask for the pool; from any other thread each one would wait for a
//! sleeping thread to wake, which on a busy machine takes a hundred times as long as a small factorisation.

use std::sync::mpsc::{SyncSender, sync_channel};

use crate::backends::{Iteration, Solution};

/// Iterations a solver may be ahead of its observer.
const AHEAD: usize = 256;

/// An iteration on its way to the observer.
struct Seen {
    iteration: Iteration<'static>,
    x: Vec<f64>,
}

impl Seen {
    fn of(iteration: &Iteration<'_>) -> Self {
        Seen { iteration: Iteration { x: &[], ..*iteration }, x: iteration.x.to_vec() }
    }

    fn show(&self, observer: &mut dyn FnMut(&Iteration<'_>)) {
        observer(&Iteration { x: &self.x, ..self.iteration });
    }
}

/// Runs `solve` on a thread of the pool, while this one shows its iterations to the observer, in order and all of them before the
/// solution is handed back. A thread of the pool runs it itself: it must not wait for another one.
pub(super) fn with_observer(
    observer: &mut dyn FnMut(&Iteration<'_>),
    solve: impl FnOnce(&mut dyn FnMut(&Iteration<'_>)) -> Solution + Send,
) -> Solution {
    if rayon::current_thread_index().is_some() {
        return solve(observer);
    }
    let (sender, receiver) = sync_channel(AHEAD);
    let mut solution = None;
    rayon::in_place_scope(|scope| {
        let solution = &mut solution;
        scope.spawn(move |_| *solution = Some(sending(sender, solve)));
        receiver.iter().for_each(|seen: Seen| seen.show(observer));
    });
    // The scope has ended, and a panic in it would have come through.
    solution.unwrap_or_else(|| unreachable!("the solver ran to its end"))
}

/// The receiver lives until the sender is gone: what cannot be sent has no observer left.
fn sending(sender: SyncSender<Seen>, solve: impl FnOnce(&mut dyn FnMut(&Iteration<'_>)) -> Solution) -> Solution {
    solve(&mut |iteration| drop(sender.send(Seen::of(iteration))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backends::Termination;

    fn solution(x: Vec<f64>) -> Solution {
        Solution {
            algorithm: String::new(),
            termination: Termination::Converged,
            message: String::new(),
            x,
            multipliers: None,
            iterations: None,
            evaluations: 0,
            seconds: 0.0,
            invalid: None,
        }
    }

    fn count(observer: &mut dyn FnMut(&Iteration<'_>)) -> Solution {
        for k in 0..1000 {
            let x = [k as f64];
            observer(&Iteration {
                iteration: k,
                evaluations: k,
                objective: 0.0,
                feasibility: 0.0,
                optimality: 0.0,
                step_norm: 0.0,
                x: &x,
            });
        }
        solution(vec![7.0])
    }

    #[test]
    fn every_iteration_is_seen_in_order() {
        let mut seen = Vec::new();
        let found = with_observer(&mut |iteration| seen.push(iteration.x[0]), count);
        assert!(seen.iter().copied().eq((0..1000).map(f64::from)) && found.x == [7.0]);
        let mut inside = 0;
        rayon::scope(|_| with_observer(&mut |_| inside += 1, count));
        assert_eq!(inside, 1000);
    }
}
