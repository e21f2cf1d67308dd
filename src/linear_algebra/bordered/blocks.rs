//! The blocks of the diagonal and their couplings.

use super::super::{Partition, Pattern};
use std::ops::Range;

pub(super) struct Block {
    pub(super) unknowns: Range<usize>,
    /// Its part of the border, ascending.
    pub(super) touched: Range<usize>,
    /// Where its entries begin, and those of its part of C.
    pub(super) matrix: usize,
    pub(super) coupling: usize,
}

impl Block {
    pub(super) fn size(&self) -> usize {
        self.unknowns.len()
    }

    pub(super) fn entries(&self) -> Range<usize> {
        self.matrix..self.coupling
    }

    /// Row k of its part of C.
    pub(super) fn coupling(&self, k: usize) -> Range<usize> {
        let first = self.coupling + k * self.size();
        first..first + self.size()
    }
}

/// Component and place in the border of all entries between the two, sorted, each once.
pub(super) fn couplings(pattern: &Pattern, partition: &Partition, in_border: impl Fn(usize) -> Option<usize>) -> Vec<(u32, u32)> {
    let pair = |(i, j): (usize, usize)| match (in_border(i), in_border(j)) {
        (Some(row), None) => Some((partition.component(j as u32), row as u32)),
        (None, Some(row)) => Some((partition.component(i as u32), row as u32)),
        _ => None,
    };
    let mut pairs: Vec<(u32, u32)> = pattern.iter().filter_map(pair).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

pub(super) fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| if value.is_nan() { f64::NAN } else { most.max(value.abs()) })
}
