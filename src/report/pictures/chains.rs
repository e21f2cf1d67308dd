//! Ribs end to end: those that share their line, or follow one another in the file from section to section.

use std::collections::HashMap;

use crate::expression::ast::Collection;
use crate::problem::{Cells, Problem};

/// The datum that says which line a rib is of.
const LINE: &str = "line";

/// Ribs in a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    /// What it is called.
    pub name: String,
    /// The ribs.
    pub ribs: Vec<usize>,
}

impl Chain {
    /// Positions along the chain and the section there; where neighbours do not share their section, both stand at one place.
    pub fn stations(&self, problem: &Problem) -> Vec<(f64, u32)> {
        let ribs = &problem.ribs;
        let mut stations: Vec<(f64, u32)> = Vec::with_capacity(2 * self.ribs.len());
        for &r in &self.ribs {
            let at = stations.last().map_or(0.0, |&(at, _)| at);
            if stations.last().is_none_or(|&(_, section)| section != ribs.from[r]) {
                stations.push((at, ribs.from[r]));
            }
            stations.push((at + ribs.length[r], ribs.to[r]));
        }
        stations
    }
}

/// All chains, in the order of the file.
pub(super) fn chains(problem: &Problem) -> Vec<Chain> {
    by_line(problem).unwrap_or_else(|| by_sections(problem))
}

/// The length of the longest chain, by the file's own lengths.
pub fn longest_line(problem: &Problem) -> Option<f64> {
    let length = |chain: &Chain| chain.ribs.iter().map(|&r| problem.ribs.length[r]).sum::<f64>();
    chains(problem).iter().map(length).reduce(f64::max)
}

/// By the datum `line`, where every rib has one.
fn by_line(problem: &Problem) -> Option<Vec<Chain>> {
    let column = problem.ribs.data.iter().position(|column| column.name == LINE)?;
    let label = |r: usize| match &problem.ribs.data[column].cells {
        Cells::Labels { .. } => problem.label(Collection::Ribs, column as u32, r as u32).map(str::to_owned),
        Cells::Numbers(numbers) => numbers.get(r).filter(|value| !value.is_nan()).map(f64::to_string),
    };
    let (mut numbers, mut chains) = (HashMap::new(), Vec::<Chain>::new());
    for r in 0..problem.ribs.from.len() {
        let name = label(r)?;
        let number = *numbers.entry(name.clone()).or_insert(chains.len());
        if number == chains.len() {
            chains.push(Chain { name, ribs: Vec::new() });
        }
        chains[number].ribs.push(r);
    }
    (!chains.is_empty()).then_some(chains)
}

fn by_sections(problem: &Problem) -> Vec<Chain> {
    let ribs = &problem.ribs;
    let mut chains: Vec<Chain> = Vec::new();
    for r in 0..ribs.from.len() {
        match chains.last_mut() {
            Some(chain) if chain.ribs.last().is_some_and(|&last| ribs.to[last] == ribs.from[r]) => chain.ribs.push(r),
            _ => chains.push(Chain { name: String::new(), ribs: vec![r] }),
        }
    }
    for chain in &mut chains {
        let name = |r: Option<&usize>| r.map_or("", |&r| problem.item_name(Collection::Ribs, r as u32)).to_owned();
        let (first, last) = (name(chain.ribs.first()), name(chain.ribs.last()));
        chain.name = if first == last { first } else { format!("{first} to {last}") };
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Column;

    fn problem() -> Problem {
        let mut problem = Problem::default();
        (problem.ribs.from, problem.ribs.to, problem.ribs.length) = (vec![0, 1, 5], vec![1, 2, 6], vec![2.0, 3.0, 4.0]);
        ["a", "b", "c"].into_iter().for_each(|name| problem.ribs.names.push(name));
        problem
    }

    #[test]
    fn without_lines_ribs_that_meet_make_a_chain() {
        let chains = chains(&problem());
        assert_eq!(chains.iter().map(|chain| chain.name.as_str()).collect::<Vec<_>>(), ["a to b", "c"]);
        assert_eq!(chains[0].stations(&problem()), [(0.0, 0), (2.0, 1), (5.0, 2)]);
    }

    #[test]
    fn ribs_of_one_line_stand_end_to_end_though_they_share_no_section() {
        let mut problem = problem();
        problem.ribs.data = vec![Column { name: "line".into(), cells: Cells::Numbers(vec![1.0, 1.0, 1.0]) }];
        let chains = chains(&problem);
        assert_eq!(chains.len(), 1);
        assert_eq!(chains[0].stations(&problem), [(0.0, 0), (2.0, 1), (5.0, 2), (5.0, 5), (9.0, 6)]);
    }
}
