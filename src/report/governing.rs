//! What governs: the active limits by what they cost.

use std::collections::BTreeMap;

use super::{Findings, Held};
use crate::certificate::Side;

/// An active limit of a row or a variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Row or variable.
    pub name: String,
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
        let mut active = active(findings);
        let all = active.len();
        active.retain(|entry| entry.held.multiplier != 0.0);
        let (with_cost, without_cost) = (active.len(), all - active.len());
        // In single precision: costs that differ by rounding only keep the order of the file.
        active.sort_by(|a, b| (a.limit == 0.0).cmp(&(b.limit == 0.0)).then((b.cost() as f32).total_cmp(&(a.cost() as f32))));
        let groups = if with_cost > most { groups(findings, &active) } else { Vec::new() };
        let costliest = active.iter().take(most).map(|entry| entry.limit(findings)).collect();
        Governing { costliest, with_cost, without_cost, groups }
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
        Limit { name: self.name(findings), side: self.held.side, limit: self.limit, held: self.held }
    }
}

fn active(findings: &Findings<'_>) -> Vec<Entry> {
    let meta = findings.model.meta();
    let rows = (0..meta.rows()).map(|i| (true, i, findings.row(i), meta.row_lower[i], meta.row_upper[i]));
    let bounds = (0..meta.variables()).map(|j| (false, j, findings.bound(j), meta.lower[j], meta.upper[j]));
    let entries = rows.chain(bounds).filter_map(|(is_row, index, held, lower, upper)| {
        let limit = match held.side {
            Side::None => return None,
            Side::Lower => lower,
            Side::Upper | Side::Equal => upper,
        };
        Some(Entry { is_row, index, limit, held })
    });
    entries.collect()
}

fn groups(findings: &Findings<'_>, active: &[Entry]) -> Vec<Group> {
    let mut groups: BTreeMap<(String, &'static str), Group> = BTreeMap::new();
    for entry in active {
        let name = group_name(&entry.name(findings), entry.is_row);
        let side = entry.held.side;
        let group = groups.entry((name.clone(), side.as_str())).or_insert(Group { name, side, count: 0, per_cent: 0.0 });
        group.count += 1;
        group.per_cent += per_cent(entry.held.sensitivity, entry.limit);
    }
    let mut groups: Vec<Group> = groups.into_values().collect();
    groups.sort_by(|a, b| b.per_cent.abs().total_cmp(&a.per_cent.abs()));
    groups
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
