//! Adds a formula to the objective or a row: sums over items are taken apart, the rest goes through a template.

use std::collections::HashMap;

use super::facts::Facts;
use super::groups::Kernels;
use super::lower::{Context, Item, Lowering, end_section, item_of, law_of, members};
use super::plan::{Gathered, Plan};
use super::template::{Target, Template};
use crate::expression::graph::NodeId;
use crate::expression::operators::{Binary, Fold, Unary};
use crate::expression::tape::TapeError;
use crate::model::elements::Label;
use crate::problem::formula::{End, Formula, Total};
use crate::problem::{Dimension, Problem};
use crate::ribs::law::Law;
use crate::sections::{self, Length};

/// Adds formulas that belong together (the objective, or one constraint's rows) and remembers their templates.
pub(super) struct Summation<'a> {
    problem: &'a Problem,
    facts: &'a Facts,
    kernels: &'a mut Kernels,
    plans: HashMap<Work, Plan>,
    templates: HashMap<(Work, Vec<u32>), Template>,
    gathered: Gathered,
    /// Elements added so far.
    pub elements: usize,
}

/// What a template stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Work {
    /// A formula, known by its address: formulas stay where they are while the problem is borrowed.
    Formula(usize),
    Volume(Law),
}

impl<'a> Summation<'a> {
    pub fn new(problem: &'a Problem, facts: &'a Facts, kernels: &'a mut Kernels) -> Self {
        let (plans, templates) = (HashMap::new(), HashMap::new());
        Summation { problem, facts, kernels, plans, templates, gathered: Gathered::default(), elements: 0 }
    }

    /// Adds `weight · formula`.
    pub fn add(&mut self, formula: &Formula, weight: f64, context: Context, target: &mut Target) -> Result<(), TapeError> {
        if !self.facts.reaches_items(formula) {
            let (work, problem) = (Work::Formula(std::ptr::from_ref(formula) as usize), self.problem);
            self.plans.entry(work).or_insert_with(|| Plan::of(problem, formula));
            return self.add_template(work, weight, context, target, |lowering| lowering.formula(formula, context));
        }
        match formula {
            Formula::Definition(definition) => {
                let problem = self.problem;
                self.add(&problem.definitions[*definition as usize].1, weight, Context::GLOBAL, target)
            }
            Formula::Unary(Unary::Negate, inner) => self.add(inner, -weight, context, target),
            Formula::Binary(Binary::Add, left, right) => {
                self.add(left, weight, context, target)?;
                self.add(right, weight, context, target)
            }
            Formula::Binary(Binary::Subtract, left, right) => {
                self.add(left, weight, context, target)?;
                self.add(right, -weight, context, target)
            }
            Formula::Binary(Binary::Multiply, left, right) if self.facts.is_constant(left) => {
                let factor = self.constant(left, context);
                self.add(right, weight * factor, context, target)
            }
            Formula::Binary(Binary::Multiply, left, right) if self.facts.is_constant(right) => {
                let factor = self.constant(right, context);
                self.add(left, weight * factor, context, target)
            }
            Formula::Binary(Binary::Divide, left, right) if self.facts.is_constant(right) => {
                let divisor = self.constant(right, context);
                self.add(left, weight / divisor, context, target)
            }
            Formula::Fold(Fold::Sum, list) => list.iter().try_for_each(|one| self.add(one, weight, context, target)),
            Formula::Over { fold: Fold::Sum, collection, members: which, body } => {
                let mut items = members(self.problem, *collection, which, context).into_iter();
                items.try_for_each(|index| self.add(body, weight, context.of(item_of(*collection, index)), target))
            }
            Formula::Volume(total) => {
                let mut ribs = 0..self.problem.ribs.names.len() as u32;
                ribs.try_for_each(|rib| self.add_volume(rib, *total, weight, target))
            }
            Formula::RibVolume(rib) => self.add_volume(*rib, Total::Own, weight, target),
            Formula::OwnVolume => match context.item {
                Item::Rib(rib) => self.add_volume(rib, Total::Own, weight, target),
                _ => Ok(()),
            },
            whole => self.add_whole(weight, target, |lowering| lowering.formula(whole, context)),
        }
    }

    /// The value of a formula without variables.
    pub fn constant(&self, formula: &Formula, context: Context) -> f64 {
        let mut lowering = Lowering::new(self.problem);
        let root = lowering.formula(formula, context);
        lowering.graph.evaluate(root, &[], &lowering.numbers)
    }

    /// A rib's volume: closed forms where its ends are variables of their own, its area's expression otherwise.
    fn add_volume(&mut self, rib: u32, total: Total, weight: f64, target: &mut Target) -> Result<(), TapeError> {
        let law = law_of(self.problem, rib, total);
        let label = target.label;
        target.label = volume_label(label, rib);
        let mut done = Ok(());
        if !self.add_parts(rib, law, weight, target) {
            let context = Context::GLOBAL.of(Item::Rib(rib));
            self.plans.entry(Work::Volume(law)).or_insert_with(Plan::volume);
            done = self.add_template(Work::Volume(law), weight, context, target, |lowering| lowering.own_volume(rib, law));
        }
        target.label = label;
        done
    }

    fn add_parts(&mut self, rib: u32, law: Law, weight: f64, target: &mut Target) -> bool {
        let ends = [End::From, End::To].map(|end| end_section(self.problem, rib, end) as usize);
        let form = self.problem.sections.form[ends[0]];
        if ends[0] == ends[1] || form != self.problem.sections.form[ends[1]] {
            return false;
        }
        let factors = sections::kind_of(form).part_factors(sections::form(form));
        let inputs: Option<Vec<Vec<u32>>> = factors.iter().map(|part| part_inputs(self.problem, ends, part)).collect();
        let Some(inputs) = inputs.filter(|inputs| !inputs.is_empty()) else { return false };
        let length = self.problem.ribs.length[rib as usize];
        for ([width, height], inputs) in factors.iter().zip(inputs) {
            let kernel = self.kernels.part(law, height.minus.is_some());
            let data = height.minus.map(|(factor, _)| factor / height.scale);
            let weight = weight * length * width.scale * height.scale;
            target.groups.of(kernel, self.kernels).push(&inputs, data.as_slice(), weight, target.label, target.row);
            self.elements += 1;
        }
        true
    }

    fn add_template(
        &mut self,
        work: Work,
        weight: f64,
        context: Context,
        target: &mut Target,
        lower: impl FnOnce(&mut Lowering) -> NodeId,
    ) -> Result<(), TapeError> {
        let problem = self.problem;
        let plan = &self.plans[&work];
        if !self.gathered.read(plan, problem, context.item) {
            return self.add_whole(weight, target, lower);
        }
        let key = (work, self.gathered.shape.clone());
        if !self.templates.contains_key(&key) {
            let mut lowering = Lowering::new(problem);
            plan.reserve(&mut lowering, context.item);
            let root = lower(&mut lowering);
            let template = Template::compile(&mut lowering.graph, root, self.kernels)?;
            self.templates.insert(key.clone(), template);
        }
        let template = &self.templates[&key];
        self.elements += template.elements();
        template.add(&self.gathered.variables, &self.gathered.numbers, weight, self.kernels, target);
        Ok(())
    }

    /// Compiles a formula for itself.
    fn add_whole(
        &mut self,
        weight: f64,
        target: &mut Target,
        lower: impl FnOnce(&mut Lowering) -> NodeId,
    ) -> Result<(), TapeError> {
        let mut lowering = Lowering::new(self.problem);
        let root = lower(&mut lowering);
        let template = Template::compile(&mut lowering.graph, root, self.kernels)?;
        self.elements += template.elements();
        template.add(&lowering.variables, &lowering.numbers, weight, self.kernels, target);
        Ok(())
    }
}

/// How errors call a rib's volume in this place.
fn volume_label(label: Label, rib: u32) -> Label {
    match label {
        Label::Row(_) => label,
        _ => Label::RibVolume(rib),
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
