//! Adds summands to the objective or a row, each shape compiled once.

use std::collections::HashMap;

use super::expression_graph::{Lowering, end_section};
use super::kernel_groups::{Groups, Kernels};
use super::template::{Target, Template};
use super::walk::{Sink, Summand, Work};
use crate::expression::tape::TapeError;
use crate::model::affine::Affine;
use crate::model::elements::Label;
use crate::problem::formula::End;
use crate::problem::{Dimension, Problem};
use crate::ribs::law::VolumeLaw;
use crate::sections::{self, Length};

/// Templates by what they stand for and by shape.
#[derive(Default)]
pub(super) struct Templates<'a>(HashMap<(Work<'a>, Vec<u32>), Template>);

/// The objective or one row while it is added up.
pub(super) struct Summation<'a, 's> {
    pub problem: &'a Problem,
    pub kernels: &'s mut Kernels,
    pub templates: &'s mut Templates<'a>,
    pub groups: &'s mut Groups,
    pub affine: Affine,
    /// The row; `None` in the objective.
    pub row: Option<u32>,
    /// Elements added so far.
    pub elements: usize,
}

impl Summation<'_, '_> {
    fn label(&self, rib: Option<u32>) -> Label {
        match (self.row, rib) {
            (Some(row), _) => Label::Row(row),
            (None, Some(rib)) => Label::RibVolume(rib),
            (None, None) => Label::Objective,
        }
    }
}

impl<'a> Sink<'a> for Summation<'a, '_> {
    /// Closed forms where the ends' dimensions are variables of their own.
    fn volume(&mut self, rib: u32, law: VolumeLaw, weight: f64) -> bool {
        let problem = self.problem;
        let ends = [End::From, End::To].map(|end| end_section(problem, rib, end) as usize);
        let form = problem.sections.form[ends[0]];
        let moves = problem.structure.as_deref().is_some_and(|structure| structure.moves(rib));
        if moves || ends[0] == ends[1] || form != problem.sections.form[ends[1]] {
            return false;
        }
        let factors = sections::kind_of(form).part_factors(sections::form(form));
        let inputs: Option<Vec<_>> = factors.iter().map(|part| part_inputs(problem, ends, part)).collect();
        let Some(inputs) = inputs.filter(|inputs| !inputs.is_empty()) else { return false };
        let weight = weight * problem.ribs.length[rib as usize];
        for ([width, height], inputs) in factors.iter().zip(inputs) {
            let kernel = self.kernels.part(law, height.minus.is_some());
            let factor = height.minus.map(|(factor, _)| factor);
            let group = self.groups.of(kernel, self.kernels);
            let label = match self.row {
                Some(row) => Label::Row(row),
                None => Label::RibVolume(rib),
            };
            group.push(&inputs, factor.as_slice(), weight * width.scale * height.scale, label, self.row);
            self.elements += 1;
        }
        true
    }

    fn summand(&mut self, summand: &Summand<'a, '_>) -> Result<(), TapeError> {
        let label = self.label(summand.rib);
        let mut compile = |lowering: &mut Lowering| {
            let root = summand.lower(lowering);
            Template::compile(&mut lowering.graph, root, self.kernels)
        };
        let mut target = Target { affine: &mut self.affine, groups: self.groups, row: self.row, label };
        let Some(work) = summand.work else {
            let mut lowering = Lowering::new(self.problem);
            let template = compile(&mut lowering)?;
            self.elements += template.elements();
            template.add(&lowering.variables, &lowering.numbers, summand.weight, self.kernels, &mut target);
            return Ok(());
        };
        let key = (work, summand.gathered.shape.clone());
        let template = match self.templates.0.entry(key) {
            std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
            std::collections::hash_map::Entry::Vacant(place) => place.insert(compile(&mut Lowering::new(self.problem))?),
        };
        self.elements += template.elements();
        template.add(&summand.gathered.variables, &summand.gathered.numbers, summand.weight, self.kernels, &mut target);
        Ok(())
    }
}

/// The variables of a part at both ends, if all its dimensions are variables and no two the same.
fn part_inputs(problem: &Problem, ends: [usize; 2], part: &[Length; 2]) -> Option<Vec<u32>> {
    let [width, height] = part;
    let positions = [Some(width.plus), Some(height.plus), height.minus.map(|(_, at)| at)];
    let mut inputs = Vec::with_capacity(6);
    for end in ends {
        for at in positions.into_iter().flatten() {
            match problem.dimensions(end)[at] {
                Dimension::Variable(variable) if !inputs.contains(&variable) => inputs.push(variable),
                _ => return None,
            }
        }
    }
    Some(inputs)
}
