//! What governs: the active limits by what they cost.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use super::{Findings, Held};
use crate::certificate::Side;

/// Limits counted by one thread at a time.
const BLOCK: usize = 1 << 14;

/// An active limit of a row or a variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Row or variable.
    pub name: String,
    /// Whether it is of a row.
    pub is_row: bool,
    /// The side it rests on.
    pub side: Side,
    /// The limit's number.
    pub limit: f64,
    /// Multiplier and sensitivity, in the user's sense.
    pub held: Held,
}

/// Limits whose names differ only in section, rib or index.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// `stress[*]`, `*.b`
    pub name: String,
    /// The side they rest on.
    pub side: Side,
    /// How many.
    pub count: usize,
    /// What one per cent of all of them changes, first order; 0 for limits of 0.
    pub per_cent: f64,
}

/// The active limits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Governing {
    /// The costliest ones, costliest first; after them those held against 0, of which there is no per cent.
    pub costliest: Vec<Limit>,
    /// How many have a multiplier in all.
    pub with_cost: usize,
    /// How many are met exactly without costing anything.
    pub without_cost: usize,
    /// All that have a multiplier, by group; empty where `costliest` shows them all.
    pub groups: Vec<Group>,
}

/// What the objective gains (first order) when this limit is raised by one per cent of itself.
pub fn per_cent(sensitivity: f64, limit: f64) -> f64 {
    sensitivity * limit.abs() / 100.0
}

impl Governing {
    /// The active limits, at most `most` of them one by one.
    pub fn of(findings: &Findings<'_>, most: usize) -> Governing {
        let rows = 0..findings.model.meta().rows() + findings.model.meta().variables();
        let starts: Vec<usize> = rows.clone().step_by(BLOCK).collect();
        // Block by block, so that the sums do not depend on the number of threads.
        let blocks: Vec<Tally> =
            starts.par_iter().map(|&first| Tally::of(findings, first..rows.end.min(first + BLOCK), most)).collect();
        let tally = blocks.into_iter().reduce(|all, next| all.with(next, most)).unwrap_or_default();
        let groups = if tally.with_cost > most { tally.groups() } else { Vec::new() };
        let costliest = tally.costliest.iter().map(|entry| entry.limit(findings)).collect();
        Governing { costliest, with_cost: tally.with_cost, without_cost: tally.without_cost, groups }
    }
}

/// What is counted over some of the limits.
#[derive(Default)]
struct Tally {
    costliest: Vec<Entry>,
    with_cost: usize,
    without_cost: usize,
    groups: BTreeMap<(String, &'static str), Group>,
}

impl Tally {
    /// Over the limits of this range: rows first, then variables.
    fn of(findings: &Findings<'_>, range: Range<usize>, most: usize) -> Tally {
        let mut tally = Tally::default();
        for entry in range.filter_map(|at| active(findings, at)) {
            if entry.held.multiplier == 0.0 {
                tally.without_cost += 1;
                continue;
            }
            tally.with_cost += 1;
            tally.join(
                group_name(&entry.name(findings), entry.is_row),
                entry.held.side,
                1,
                per_cent(entry.held.sensitivity, entry.limit),
            );
            tally.costliest.push(entry);
            if tally.costliest.len() > 2 * most {
                tally.cut(most);
            }
        }
        tally.cut(most);
        tally
    }

    fn join(&mut self, name: String, side: Side, count: usize, per_cent: f64) {
        let key = (name, side.as_str());
        let group =
            self.groups.entry(key).or_insert_with_key(|(name, _)| Group { name: name.clone(), side, count: 0, per_cent: 0.0 });
        group.count += count;
        group.per_cent += per_cent;
    }

    /// Keeps the costliest; those held against 0 come last.
    fn cut(&mut self, most: usize) {
        // In single precision: costs that differ by rounding only keep the order of the file.
        self.costliest
            .sort_by(|a, b| (a.limit == 0.0).cmp(&(b.limit == 0.0)).then((b.cost() as f32).total_cmp(&(a.cost() as f32))));
        self.costliest.truncate(most);
    }

    fn with(mut self, next: Tally, most: usize) -> Tally {
        self.with_cost += next.with_cost;
        self.without_cost += next.without_cost;
        for ((name, _), group) in next.groups {
            self.join(name, group.side, group.count, group.per_cent);
        }
        self.costliest.extend(next.costliest);
        self.cut(most);
        self
    }

    /// The groups, those of the greatest effect first.
    fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = self.groups.values().cloned().collect();
        groups.sort_by(|a, b| b.per_cent.abs().total_cmp(&a.per_cent.abs()));
        groups
    }
}

/// An active limit before it is given a name.
struct Entry {
    is_row: bool,
    index: usize,
    limit: f64,
    held: Held,
}

impl Entry {
    /// What one per cent of the limit costs, or where that is nothing (a limit of 0), one unit.
    fn cost(&self) -> f64 {
        if self.limit == 0.0 { self.held.sensitivity.abs() } else { per_cent(self.held.sensitivity, self.limit).abs() }
    }

    fn name(&self, findings: &Findings<'_>) -> String {
        if self.is_row { findings.model.row_name(self.index) } else { findings.model.variable_name(self.index) }
    }

    fn limit(&self, findings: &Findings<'_>) -> Limit {
        Limit { name: self.name(findings), is_row: self.is_row, side: self.held.side, limit: self.limit, held: self.held }
    }
}

/// Limit `at`, rows first, where it is active.
fn active(findings: &Findings<'_>, at: usize) -> Option<Entry> {
    let meta = findings.model.meta();
    let is_row = at < meta.rows();
    let (index, held, lower, upper) = if is_row {
        (at, findings.row(at), meta.row_lower[at], meta.row_upper[at])
    } else {
        let j = at - meta.rows();
        (j, findings.bound(j), meta.lower[j], meta.upper[j])
    };
    let limit = match held.side {
        Side::None => return None,
        Side::Lower => lower,
        Side::Upper | Side::Equal => upper,
    };
    Some(Entry { is_row, index, limit, held })
}

/// `stress[rib 7]` → `stress[*]`, `support.b` → `*.b`, `x[3]` → `x[*]`.
fn group_name(name: &str, is_row: bool) -> String {
    if let Some((family, _)) = name.split_once('[') {
        return format!("{family}[*]");
    }
    match name.rsplit_once('.') {
        Some((_, dimension)) if !is_row => format!("*.{dimension}"),
        _ => name.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_leave_out_the_item() {
        assert_eq!(group_name("stress[rib 7]", true), "stress[*]");
        assert_eq!(group_name("support.b", false), "*.b");
        assert_eq!(group_name("x[3]", false), "x[*]");
        assert_eq!(group_name("depth", false), "depth");
    }

    #[test]
    fn raising_a_negative_limit_is_towards_zero_or_beyond() {
        assert_eq!(per_cent(-2.0, 50.0), -1.0);
        assert_eq!(per_cent(-2.0, -50.0), -1.0);
    }
}
