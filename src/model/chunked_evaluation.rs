//! Large models evaluated side by side: every result falls into chunks, each summed by one thread in the order of the
//! elements. An element that reaches two chunks is evaluated for both, so that nothing is shared and nothing depends on the
//! number of threads.

use std::ops::Range;

use rayon::prelude::*;

use super::affine::Affine;
use super::elements::KernelGroup;
use super::{Pattern, all_finite};
use crate::expression::tape::Workspace;

/// Variables or rows in a chunk.
const CHUNK: usize = 1 << 12;
/// With fewer elements one thread does.
const FEWEST: usize = 20_000;

/// Consecutive elements of a group.
#[derive(Debug, Clone, Copy)]
struct Run {
    group: u32,
    first: u32,
    end: u32,
}

impl Run {
    fn range(self) -> Range<usize> {
        self.first as usize..self.end as usize
    }
}

/// Which elements reach each chunk, group by group.
#[derive(Debug)]
struct Reach(Vec<Vec<Run>>);

impl Reach {
    fn of(count: usize, groups: &[&KernelGroup], reached: impl Fn(&KernelGroup, usize) -> &[u32]) -> Reach {
        let mut runs: Vec<Vec<Run>> = vec![Vec::new(); count.div_ceil(CHUNK)];
        for (number, group) in groups.iter().enumerate() {
            for index in 0..group.len() {
                for &place in reached(group, index) {
                    add(&mut runs[place as usize / CHUNK], number as u32, index as u32);
                }
            }
        }
        Reach(runs)
    }
}

fn add(runs: &mut Vec<Run>, group: u32, index: u32) {
    match runs.last_mut() {
        Some(run) if run.group == group && run.end == index + 1 => {}
        Some(run) if run.group == group && run.end == index => run.end += 1,
        _ => runs.push(Run { group, first: index, end: index + 1 }),
    }
}

/// What is known of a large model.
#[derive(Debug)]
pub(super) struct Chunks {
    /// Variables by elements of the objective, rows by elements of the rows, variables by all elements.
    objective: Reach,
    rows: Reach,
    all: Reach,
}

impl Chunks {
    /// `None` where the model is too small to be worth it.
    pub fn of(variables: usize, rows: usize, objective_groups: &[KernelGroup], row_groups: &[KernelGroup]) -> Option<Chunks> {
        let (objective, of_rows): (Vec<&KernelGroup>, Vec<&KernelGroup>) =
            (objective_groups.iter().collect(), row_groups.iter().collect());
        let all: Vec<&KernelGroup> = objective_groups.iter().chain(row_groups).collect();
        if all.iter().map(|group| group.len()).sum::<usize>() < FEWEST {
            return None;
        }
        Some(Chunks {
            objective: Reach::of(variables, &objective, KernelGroup::inputs),
            rows: Reach::of(rows, &of_rows, KernelGroup::row),
            all: Reach::of(variables, &all, KernelGroup::inputs),
        })
    }

    /// The objective's gradient, overwritten: affine part and elements. Returns the sum of the elements, NaN where a derivative
    /// is not finite: what a thread has just written it also clears and checks, while it is near.
    pub fn gradient(&self, affine: &Affine, groups: &[KernelGroup], x: &[f64], gradient: &mut [f64]) -> f64 {
        let sums: Vec<f64> = gradient
            .par_chunks_mut(CHUNK)
            .zip(&self.objective.0)
            .enumerate()
            .map_init(Workspace::default, |workspace, (number, (target, runs))| {
                let first = number * CHUNK;
                affine.gradient(first, target);
                let add = |run: &Run| groups[run.group as usize].add_gradients(run.range(), x, first, target, workspace);
                let sum = runs.iter().map(add).sum::<f64>();
                if all_finite(target) { sum } else { f64::NAN }
            })
            .collect();
        sums.iter().sum()
    }

    /// Adds the elements of the rows to their rows; says whether the sums are finite.
    pub fn add_rows(&self, groups: &[KernelGroup], x: &[f64], values: &mut [f64]) -> bool {
        let add = |(number, (target, runs)): (usize, (&mut [f64], &Vec<Run>))| {
            for run in runs {
                groups[run.group as usize].add_rows(run.range(), x, number * CHUNK, target);
            }
            all_finite(target)
        };
        values.par_chunks_mut(CHUNK).zip(&self.rows.0).enumerate().map(add).reduce(|| true, |a, b| a && b)
    }

    /// The Jacobian's values, overwritten: those of the linear parts and the gradients of the rows' elements; says whether they
    /// are finite.
    pub fn jacobian(&self, linear: &[f64], groups: &[KernelGroup], pattern: &Pattern, x: &[f64], values: &mut [f64]) -> bool {
        each(pattern, &self.rows, values, |first, target, runs| {
            target.copy_from_slice(&linear[first..first + target.len()]);
            for run in runs {
                groups[run.group as usize].add_jacobian(run.range(), x, first, target);
            }
        })
    }

    /// The second derivatives of all elements, overwritten, groups of the objective first; says whether they are finite.
    pub fn hessian(
        &self,
        groups: &[&KernelGroup],
        pattern: &Pattern,
        x: &[f64],
        (weight, y): (f64, &[f64]),
        values: &mut [f64],
    ) -> bool {
        each(pattern, &self.all, values, |first, target, runs| {
            target.fill(0.0);
            for run in runs {
                groups[run.group as usize].add_hessian(run.range(), x, weight, y, first, target);
            }
        })
    }
}

/// Fills the values along a pattern, chunk by chunk of its rows, by the position each begins at and the elements that reach
/// it; says whether all are finite.
fn each(pattern: &Pattern, reach: &Reach, values: &mut [f64], fill: impl Fn(usize, &mut [f64], &[Run]) + Sync) -> bool {
    let filled = |((first, target), runs): ((usize, &mut [f64]), &Vec<Run>)| {
        fill(first, target, runs);
        all_finite(target)
    };
    cut(pattern, values).into_par_iter().zip(&reach.0).map(filled).reduce(|| true, |a, b| a && b)
}

/// The values along a pattern, chunk by chunk of its rows, with the position each begins at.
fn cut<'v>(pattern: &Pattern, mut values: &'v mut [f64]) -> Vec<(usize, &'v mut [f64])> {
    let mut pieces = Vec::new();
    for first in (0..pattern.rows()).step_by(CHUNK) {
        let last = pattern.rows().min(first + CHUNK);
        let (begin, end) = (pattern.offsets[first], pattern.offsets[last]);
        let (piece, rest) = values.split_at_mut(end - begin);
        pieces.push((begin, piece));
        values = rest;
    }
    pieces
}
