//! Large models evaluated side by side: every result falls into stretches, each summed by one thread in the order of the
//! elements. An element that reaches two stretches is evaluated for both, so that nothing is shared and nothing depends on the
//! number of threads.

use std::ops::Range;

use rayon::prelude::*;

use super::Pattern;
use super::elements::Group;
use crate::expression::tape::Workspace;

/// Variables or rows in a stretch.
const STRETCH: usize = 1 << 12;
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

/// Which elements reach each stretch, group by group.
#[derive(Debug)]
struct Reach(Vec<Vec<Run>>);

impl Reach {
    fn of(count: usize, groups: &[&Group], reached: impl Fn(&Group, usize) -> &[u32]) -> Reach {
        let mut runs: Vec<Vec<Run>> = vec![Vec::new(); count.div_ceil(STRETCH)];
        for (number, group) in groups.iter().enumerate() {
            for index in 0..group.len() {
                for &place in reached(group, index) {
                    add(&mut runs[place as usize / STRETCH], number as u32, index as u32);
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
pub(super) struct Stretches {
    /// Variables by elements of the objective, rows by elements of the rows, variables by all elements.
    objective: Reach,
    rows: Reach,
    all: Reach,
}

impl Stretches {
    /// `None` where the model is too small to be worth it.
    pub fn of(variables: usize, rows: usize, objective_groups: &[Group], row_groups: &[Group]) -> Option<Stretches> {
        let (objective, of_rows): (Vec<&Group>, Vec<&Group>) = (objective_groups.iter().collect(), row_groups.iter().collect());
        let all: Vec<&Group> = objective_groups.iter().chain(row_groups).collect();
        if all.iter().map(|group| group.len()).sum::<usize>() < FEWEST {
            return None;
        }
        Some(Stretches {
            objective: Reach::of(variables, &objective, Group::inputs),
            rows: Reach::of(rows, &of_rows, Group::row),
            all: Reach::of(variables, &all, Group::inputs),
        })
    }

    /// Adds the objective's gradient; returns the sum of its elements.
    pub fn add_gradient(&self, groups: &[Group], x: &[f64], gradient: &mut [f64]) -> f64 {
        let sums: Vec<f64> = gradient
            .par_chunks_mut(STRETCH)
            .zip(&self.objective.0)
            .enumerate()
            .map_init(Workspace::default, |workspace, (number, (target, runs))| {
                let add =
                    |run: &Run| groups[run.group as usize].add_gradients(run.range(), x, number * STRETCH, target, workspace);
                runs.iter().map(add).sum::<f64>()
            })
            .collect();
        sums.iter().sum()
    }

    /// Adds the elements of the rows to their rows.
    pub fn add_rows(&self, groups: &[Group], x: &[f64], values: &mut [f64]) {
        values.par_chunks_mut(STRETCH).zip(&self.rows.0).enumerate().for_each(|(number, (target, runs))| {
            for run in runs {
                groups[run.group as usize].add_rows(run.range(), x, number * STRETCH, target);
            }
        });
    }

    /// Adds the gradients of the rows' elements to the Jacobian.
    pub fn add_jacobian(&self, groups: &[Group], pattern: &Pattern, x: &[f64], values: &mut [f64]) {
        cut(pattern, values).into_par_iter().zip(&self.rows.0).for_each(|((first, target), runs)| {
            for run in runs {
                groups[run.group as usize].add_jacobian(run.range(), x, first, target);
            }
        });
    }

    /// Adds the second derivatives of all elements, groups of the objective first.
    pub fn add_hessian(&self, groups: &[&Group], pattern: &Pattern, x: &[f64], (weight, y): (f64, &[f64]), values: &mut [f64]) {
        cut(pattern, values).into_par_iter().zip(&self.all.0).for_each(|((first, target), runs)| {
            for run in runs {
                groups[run.group as usize].add_hessian(run.range(), x, weight, y, first, target);
            }
        });
    }
}

/// The values along a pattern, stretch by stretch of its rows, with the position each begins at.
fn cut<'v>(pattern: &Pattern, mut values: &'v mut [f64]) -> Vec<(usize, &'v mut [f64])> {
    let mut pieces = Vec::new();
    for first in (0..pattern.rows()).step_by(STRETCH) {
        let last = pattern.rows().min(first + STRETCH);
        let (begin, end) = (pattern.offsets[first], pattern.offsets[last]);
        let (piece, rest) = values.split_at_mut(end - begin);
        pieces.push((begin, piece));
        values = rest;
    }
    pieces
}
