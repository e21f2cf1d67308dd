//! Differences along a direction in which a group of variables moves, each by its own size.

use std::collections::BTreeMap;

/// Halvings of the step.
const LEVELS: usize = 6;
/// The first step, in sizes.
const FIRST: f64 = 0.02;

/// A point and the variables that move.
pub(super) struct Along<'x> {
    x: &'x [f64],
    direction: BTreeMap<usize, f64>,
}

/// Derivatives of all components, their estimated errors, and the components' sizes.
type Differences = (Vec<f64>, Vec<f64>, Vec<f64>);

impl<'x> Along<'x> {
    /// Variables move by their sizes.
    pub fn new(x: &'x [f64], group: Vec<u32>) -> Self {
        let way = |j: u32| (j as usize, x[j as usize].abs().max(1e-2));
        Along { x, direction: group.into_iter().map(way).collect() }
    }

    /// The variables.
    pub fn variables(&self) -> impl Iterator<Item = u32> {
        self.direction.keys().map(|&j| j as u32)
    }

    /// The variable, where it is one.
    pub fn only(&self) -> Option<u32> {
        self.variables().next().filter(|_| self.direction.len() == 1)
    }

    /// By how much variable j moves per step; 0 where it stays.
    pub fn direction(&self, j: usize) -> f64 {
        self.direction.get(&j).copied().unwrap_or(0.0)
    }

    /// The size of variable j.
    pub fn reach(&self, j: usize) -> f64 {
        self.x[j].abs().max(1e-3)
    }

    /// Differences of f, extrapolated. Steps shrink until it has values on both sides; `None` where it never has.
    pub fn ridders(&self, f: impl Fn(&[f64]) -> Option<Vec<f64>> + Sync) -> Option<Differences> {
        let shifted = |by: f64| {
            let mut point = self.x.to_vec();
            self.direction.iter().for_each(|(&j, way)| point[j] += by * way);
            f(&point)
        };
        // On both sides at once.
        let beside = |step: f64| match rayon::join(|| shifted(-step), || shifted(step)) {
            (Some(left), Some(right)) => Some((left, right)),
            _ => None,
        };
        let (mut step, mut left, mut right) = first_step(&beside)?;
        let size: Vec<f64> = left.iter().zip(&right).map(|(l, r)| l.abs().max(r.abs())).collect();
        let mut best = vec![f64::NAN; left.len()];
        let mut noise = vec![f64::INFINITY; left.len()];
        let mut previous: Vec<Vec<f64>> = Vec::new();
        for level in 0..LEVELS {
            let mut row = vec![left.iter().zip(&right).map(|(l, r)| (r - l) / (2.0 * step)).collect::<Vec<f64>>()];
            let mut factor = 1.0;
            for order in 0..level {
                factor *= 4.0;
                let refined: Vec<f64> = row[order]
                    .iter()
                    .zip(&previous[order])
                    .map(|(fine, coarse)| fine + (fine - coarse) / (factor - 1.0))
                    .collect();
                for at in 0..refined.len() {
                    let error = (refined[at] - row[order][at]).abs().max((refined[at] - previous[order][at]).abs());
                    if error <= noise[at] {
                        (best[at], noise[at]) = (refined[at], error);
                    }
                }
                row.push(refined);
            }
            previous = row;
            step /= 2.0;
            (left, right) = beside(step)?;
        }
        // What cancellation in the differences can hide.
        for (noise, size) in noise.iter_mut().zip(&size) {
            *noise += 8.0 * f64::EPSILON * size / step;
        }
        Some((best, noise, size))
    }
}

/// The largest first step or quarter of it that has values on both sides, and these values.
fn first_step(beside: &impl Fn(f64) -> Option<(Vec<f64>, Vec<f64>)>) -> Option<(f64, Vec<f64>, Vec<f64>)> {
    let steps = std::iter::successors(Some(FIRST), |step| Some(step / 4.0)).take(21);
    steps.into_iter().find_map(|step| beside(step).map(|(left, right)| (step, left, right)))
}
