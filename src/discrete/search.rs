//! Branch and bound: the best choice of rows, proved.
//!
//! Open ranges are looked at from the lowest bound up, some at a time and side by side; what is found does not depend on how many threads do it.
//! Ranges whose bound is no better than the best design are closed. When none is open, that design is the best of the lists (Land and
//! Doig 1960, Econometrica 28:497–520).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::{List, Range};
use crate::model::Budget;

/// Ranges that are looked at side by side. Fixed, so that the order in which things are found is.
const BATCH: usize = 16;

/// A bound this close to the best design, relative to it, closes a range: rigorous bounds of convex problems are closer to their minima by some
/// orders, and designs that differ by less are of one value.
const PROOF: f64 = 1e-9;

/// A range this close to rows, as a share of the objective, is taken for them when the next list to branch on is chosen.
const NEAR: f64 = 1e-12;

/// A point between rows, and what is proved of all designs of the ranges.
#[derive(Debug, Clone)]
pub struct Relaxed {
    /// No design is below it.
    pub bound: f64,
    /// The point, in the user's variables.
    pub x: Vec<f64>,
    /// The objective's slopes there.
    pub slopes: Vec<f64>,
}

/// What is proved of ranges.
#[derive(Debug, Clone)]
pub enum Bounded {
    /// No design of theirs meets the limits.
    Empty,
    /// A bound below them all.
    Below(Relaxed),
    /// Nothing; the point to branch at is that of the ranges around.
    Unknown,
}

/// A design that meets the limits: a row per list, the rest as good as it can be.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Rows, in the lists' order.
    pub rows: Vec<usize>,
    /// The point, in the user's variables.
    pub x: Vec<f64>,
    /// Its objective.
    pub objective: f64,
}

/// What can be said of the designs within ranges.
pub trait Relaxation: Sync {
    /// A bound below all designs of the ranges, found from a point near them.
    fn relax(&self, ranges: &[Range], near: &[f64]) -> Bounded;

    /// The design of these rows with the rest at its best; `None` where it does not meet the limits.
    fn design(&self, rows: &[usize], near: &[f64]) -> Option<Design>;
}

/// What a search found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The best design.
    pub best: Option<Design>,
    /// No design of the lists is below it; −∞ where nothing is known.
    pub bound: f64,
    /// Nothing is open: the best design is the best of the lists, or, without one, none meets the limits.
    pub proved: bool,
    /// The bound with all numbers between rows allowed; −∞ where nothing is known.
    pub root: f64,
    /// Ranges that were bounded.
    pub relaxations: usize,
}

/// Ranges to be branched on.
struct Open {
    bound: f64,
    /// Later ones go first where bounds are equal: deeper, nearer to designs.
    number: usize,
    ranges: Vec<Range>,
    relaxed: Relaxed,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    // The heap's top is its largest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then(self.number.cmp(&other.number))
    }
}

/// The best choice of rows: from a first design, where one is known, and a point to begin at.
pub fn search(relaxation: &dyn Relaxation, lists: &[List], first: Option<Design>, start: &[f64], budget: &Budget<'_>) -> Found {
    let mut search = Search { relaxation, lists, best: first, open: BinaryHeap::new(), relaxations: 0, unproved: f64::INFINITY };
    let unknown = Relaxed { bound: f64::NEG_INFINITY, x: start.to_vec(), slopes: vec![1.0; start.len()] };
    let whole: Vec<Range> = lists.iter().map(List::whole).collect();
    let root = search.look(&whole, &unknown);
    let free = if let Bounded::Below(relaxed) = &root.bounded { relaxed.bound } else { f64::NEG_INFINITY };
    search.enter(vec![root]);
    while let Some(batch) = search.next_batch() {
        if budget.check(0).is_err() {
            search.open.extend(batch);
            break;
        }
        let children: Vec<(Vec<Range>, &Relaxed)> =
            batch.iter().flat_map(|open| search.halves(open).map(|ranges| (ranges, &open.relaxed))).collect();
        let looked: Vec<Looked> = children.par_iter().map(|(ranges, around)| search.look(ranges, around)).collect();
        search.enter(looked);
    }
    Found { root: free, ..search.found() }
}

/// What a look at ranges came to.
struct Looked {
    ranges: Vec<Range>,
    bounded: Bounded,
    around: Relaxed,
    designs: Vec<Design>,
}

struct Search<'a> {
    relaxation: &'a dyn Relaxation,
    lists: &'a [List],
    best: Option<Design>,
    open: BinaryHeap<Open>,
    relaxations: usize,
    /// The lowest bound of single designs that could neither be had nor excluded.
    unproved: f64,
}

impl Search<'_> {
    /// What a bound must be below, to be worth a look.
    fn target(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |best| best.objective - PROOF * best.objective.abs())
    }

    /// The lowest open ranges; those that are closed by now are left out.
    fn next_batch(&mut self) -> Option<Vec<Open>> {
        let mut batch = Vec::with_capacity(BATCH);
        while batch.len() < BATCH
            && let Some(open) = self.open.pop()
        {
            if open.bound < self.target() {
                batch.push(open);
            }
        }
        (!batch.is_empty()).then_some(batch)
    }

    /// Bounds ranges, and tries the designs nearest to the point found.
    fn look(&self, ranges: &[Range], around: &Relaxed) -> Looked {
        let bounded = self.relaxation.relax(ranges, &around.x);
        let mut designs = Vec::new();
        let promising = match &bounded {
            Bounded::Empty => false,
            Bounded::Below(relaxed) => relaxed.bound < self.target(),
            Bounded::Unknown => true,
        };
        if promising {
            let x = if let Bounded::Below(relaxed) = &bounded { &relaxed.x } else { &around.x };
            let nearest: Vec<usize> = self.lists.iter().zip(ranges).map(|(list, range)| list.nearest(*range, x)).collect();
            let above: Vec<usize> = self.lists.iter().zip(ranges).map(|(list, range)| list.above(*range, x)).collect();
            designs.extend(self.relaxation.design(&nearest, x));
            if above != nearest {
                designs.extend(self.relaxation.design(&above, x));
            }
        }
        Looked { ranges: ranges.to_vec(), bounded, around: around.clone(), designs }
    }

    /// Keeps what was found: better designs first, then the ranges that are still open.
    fn enter(&mut self, looked: Vec<Looked>) {
        for design in looked.iter().flat_map(|look| &look.designs) {
            if self.best.as_ref().is_none_or(|best| design.objective < best.objective) {
                self.best = Some(design.clone());
            }
        }
        for look in looked {
            self.relaxations += 1;
            let relaxed = match look.bounded {
                Bounded::Empty => continue,
                // A child is no better than its parent.
                Bounded::Below(relaxed) => Relaxed { bound: relaxed.bound.max(look.around.bound), ..relaxed },
                Bounded::Unknown => look.around,
            };
            if relaxed.bound >= self.target() {
                continue;
            }
            if look.ranges.iter().all(|range| range.is_single()) {
                // Its design was tried and is no better, or does not meet the limits: with nothing else to choose, that decides it.
                let tried = look.designs.iter().any(|design| design.objective <= relaxed.bound + PROOF * relaxed.bound.abs());
                if !tried {
                    self.unproved = self.unproved.min(relaxed.bound);
                }
                continue;
            }
            self.open.push(Open { bound: relaxed.bound, number: self.relaxations, ranges: look.ranges, relaxed });
        }
    }

    /// Ranges in two: of the list whose point is farthest from its rows, in the objective; else of the longest one.
    fn halves(&self, open: &Open) -> [Vec<Range>; 2] {
        let Relaxed { x, slopes, .. } = &open.relaxed;
        let away = |at: usize| {
            let (list, range) = (&self.lists[at], open.ranges[at]);
            list.distance(list.nearest(range, x), x, slopes)
        };
        let several = || (0..self.lists.len()).filter(|&at| !open.ranges[at].is_single());
        let farthest = several().map(|at| (away(at), at)).max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        let longest = several().max_by_key(|&at| (open.ranges[at].last - open.ranges[at].first, std::cmp::Reverse(at)));
        let level = NEAR * open.bound.abs().max(f64::MIN_POSITIVE);
        let at = farthest.filter(|(away, _)| *away > level).map(|(_, at)| at).or(longest).unwrap_or(0);
        self.lists[at].halves(open.ranges[at], x).map(|half| {
            let mut ranges = open.ranges.clone();
            ranges[at] = half;
            ranges
        })
    }

    fn found(self) -> Found {
        let target = self.target();
        let open = self.open.iter().map(|open| open.bound).filter(|bound| *bound < target);
        let lowest = open.fold(self.unproved, f64::min);
        let proved = lowest >= target || (lowest == f64::INFINITY && self.best.is_none());
        let top = self.best.as_ref().map_or(f64::INFINITY, |best| best.objective);
        Found {
            bound: if proved { target.min(top) } else { lowest.min(top) },
            best: self.best,
            root: f64::NEG_INFINITY,
            proved,
            relaxations: self.relaxations,
        }
    }
}

#[cfg(test)]
mod tests;
