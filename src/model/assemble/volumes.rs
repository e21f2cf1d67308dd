//! Total volumes at a point by the closed forms, without a model.

use super::expression_graph::law_of;
use crate::problem::formula::Total;
use crate::problem::{Dimension, Problem};
use crate::ribs::Part;
use crate::sections::{self, Length};

/// The totals at x. `None` where a rib's sections are not made of products of given dimensions, or a volume is no number.
pub fn volumes<const N: usize>(problem: &Problem, x: &[f64], totals: [Total; N]) -> Option<[f64; N]> {
    let mut sums = [0.0; N];
    for rib in 0..problem.ribs.names.len() {
        let ends = [problem.ribs.from[rib], problem.ribs.to[rib]].map(|end| end as usize);
        let form = problem.sections.form[ends[0]];
        if form != problem.sections.form[ends[1]] {
            return None;
        }
        let parts = sections::kind_of(form).part_factors(sections::form(form));
        if parts.is_empty() {
            return None;
        }
        for part in parts {
            let [from, to] = ends.map(|end| [extent(problem, x, end, &part[0]), extent(problem, x, end, &part[1])]);
            let lengths = [from[0]?, from[1]?, to[0]?, to[1]?];
            for (sum, &total) in sums.iter_mut().zip(&totals) {
                let law = law_of(problem, rib as u32, total);
                *sum += problem.ribs.length[rib] * Part::volume_per_length(law, lengths);
            }
        }
    }
    sums.iter().all(|sum| sum.is_finite()).then_some(sums)
}

/// A width or height of a section.
fn extent(problem: &Problem, x: &[f64], section: usize, length: &Length) -> Option<f64> {
    let value = |at: usize| match *problem.dimensions(section).get(at)? {
        Dimension::Constant(value) => Some(value),
        Dimension::Variable(j) => x.get(j as usize).copied(),
        Dimension::Formula(_) => None,
    };
    let less = length.minus.map_or(Some(0.0), |(factor, at)| Some(factor * value(at)?))?;
    Some(length.scale * (value(length.plus)? - less))
}
