//! Takes formulas apart: sums over items fall into summands, one item's formula at a time.

use std::collections::HashMap;

use super::dependence::Dependence;
use super::expression_graph::{Context, Item, Lowering, OwnNumber, law_of, members};
use super::template_arguments::TemplateArguments;
use super::template_key::TemplateKey;
use crate::expression::graph::NodeId;
use crate::expression::operators::{Binary, Fold, Unary};
use crate::expression::tape::TapeError;
use crate::problem::Problem;
use crate::problem::formula::{Formula, Total};
use crate::ribs::law::VolumeLaw;

/// What a summand stands for; summands of the same work and shape are alike but for their variables and numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Work<'p> {
    Formula(This<'p>),
    Volume(VolumeLaw),
}

/// One formula of the problem: equal to itself alone, however alike others are. It is borrowed, and so stays where it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct This<'p>(&'p Formula);

impl PartialEq for This<'_> {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl Eq for This<'_> {}

impl std::hash::Hash for This<'_> {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        std::ptr::hash(self.0, state);
    }
}

/// `weight · formula` of one item.
pub(super) struct Summand<'a, 'p> {
    /// What it stands for; `None` where it shares nothing with others.
    pub work: Option<Work<'a>>,
    /// The item's variables, numbers and shape, where it may share.
    pub gathered: &'p TemplateArguments,
    pub weight: f64,
    /// The rib whose volume it is.
    pub rib: Option<u32>,
    plan: &'p TemplateKey,
    item: Item,
    lower: &'p dyn Fn(&mut Lowering) -> NodeId,
}

impl Summand<'_, '_> {
    /// The summand as a graph over local slots, which are given out in the order of `gathered`.
    pub fn lower(&self, lowering: &mut Lowering) -> NodeId {
        if self.work.is_some() {
            self.plan.reserve(lowering, self.item);
        }
        (self.lower)(lowering)
    }
}

/// What is done with the summands.
pub(super) trait Sink<'a> {
    /// Takes a rib's volume in closed form; false where there is none, and its summand comes instead.
    fn volume(&mut self, rib: u32, law: VolumeLaw, weight: f64) -> bool {
        let _ = (rib, law, weight);
        false
    }

    /// Takes a summand.
    fn summand(&mut self, summand: &Summand<'a, '_>) -> Result<(), TapeError>;
}

/// Walks formulas of one problem.
pub(super) struct Walk<'a> {
    pub problem: &'a Problem,
    facts: &'a Dependence,
    plans: HashMap<Work<'a>, TemplateKey>,
    gathered: TemplateArguments,
    /// Definitions opened in the formula being visited.
    opened: usize,
}

/// Definitions of one formula taken apart at the most: they may share one another many times over. The rest is compiled whole.
const MOST_OPENED: usize = 256;

impl<'a> Walk<'a> {
    pub fn new(problem: &'a Problem, facts: &'a Dependence) -> Self {
        Walk { problem, facts, plans: HashMap::new(), gathered: TemplateArguments::default(), opened: 0 }
    }

    /// Hands the summands of `weight · formula` to the sink.
    pub fn visit(
        &mut self,
        formula: &'a Formula,
        weight: f64,
        context: Context,
        sink: &mut dyn Sink<'a>,
    ) -> Result<(), TapeError> {
        self.opened = 0;
        self.take_apart(formula, weight, context, sink)
    }

    fn take_apart(
        &mut self,
        formula: &'a Formula,
        weight: f64,
        context: Context,
        sink: &mut dyn Sink<'a>,
    ) -> Result<(), TapeError> {
        if !self.facts.reaches_items(formula) {
            let (work, problem) = (Work::Formula(This(formula)), self.problem);
            self.plans.entry(work).or_insert_with(|| TemplateKey::of(problem, formula));
            return self.summand(work, weight, context.item, None, sink, &|lowering| lowering.formula(formula, context));
        }
        match formula {
            Formula::Definition(definition) if self.opened < MOST_OPENED => {
                self.opened += 1;
                let problem = self.problem;
                self.take_apart(&problem.definitions[*definition as usize].1, weight, Context::GLOBAL, sink)
            }
            Formula::Unary(Unary::Negate, inner) => self.take_apart(inner, -weight, context, sink),
            Formula::Binary(Binary::Add, left, right) => {
                self.take_apart(left, weight, context, sink)?;
                self.take_apart(right, weight, context, sink)
            }
            Formula::Binary(Binary::Subtract, left, right) => {
                self.take_apart(left, weight, context, sink)?;
                self.take_apart(right, -weight, context, sink)
            }
            Formula::Binary(Binary::Multiply, factor, other) | Formula::Binary(Binary::Multiply, other, factor)
                if self.facts.is_constant(factor) =>
            {
                let factor = self.constant(factor, context);
                self.take_apart(other, weight * factor, context, sink)
            }
            Formula::Binary(Binary::Divide, other, divisor) if self.facts.is_constant(divisor) => {
                let divisor = self.constant(divisor, context);
                self.take_apart(other, weight / divisor, context, sink)
            }
            Formula::Fold(Fold::Sum, list) => list.iter().try_for_each(|one| self.take_apart(one, weight, context, sink)),
            Formula::Over { fold: Fold::Sum, collection, members: which, body } => {
                let mut items = members(self.problem, *collection, which, context).into_iter();
                items.try_for_each(|index| self.take_apart(body, weight, context.of(Item::of(*collection, index)), sink))
            }
            Formula::Volume(total) => {
                let mut ribs = 0..self.problem.ribs.names.len() as u32;
                ribs.try_for_each(|rib| self.volume(rib, *total, weight, sink))
            }
            Formula::RibVolume(rib) => self.volume(*rib, Total::Own, weight, sink),
            Formula::OwnVolume => match context.item {
                Item::Rib(rib) => self.volume(rib, Total::Own, weight, sink),
                _ => Ok(()),
            },
            whole => self.whole(whole, weight, context, sink),
        }
    }

    /// What cannot be taken apart is one summand that shares nothing.
    fn whole(&mut self, formula: &'a Formula, weight: f64, context: Context, sink: &mut dyn Sink<'a>) -> Result<(), TapeError> {
        let (plan, gathered) = (TemplateKey::default(), TemplateArguments::default());
        let lower = |lowering: &mut Lowering| lowering.formula(formula, context);
        sink.summand(&Summand {
            work: None,
            gathered: &gathered,
            weight,
            rib: None,
            plan: &plan,
            item: context.item,
            lower: &lower,
        })
    }

    /// The value of a formula without variables.
    pub fn constant(&self, formula: &Formula, context: Context) -> f64 {
        match formula {
            Formula::Constant(value) => *value,
            Formula::OwnData(column) => OwnNumber::Data(*column).of(self.problem, context.item),
            _ => {
                let mut lowering = Lowering::new(self.problem);
                let root = lowering.formula(formula, context);
                lowering.graph.evaluate(root, &[], &lowering.numbers)
            }
        }
    }

    fn volume(&mut self, rib: u32, total: Total, weight: f64, sink: &mut dyn Sink<'a>) -> Result<(), TapeError> {
        let law = law_of(self.problem, rib, total);
        if sink.volume(rib, law, weight) {
            return Ok(());
        }
        let work = Work::Volume(law);
        self.plans.entry(work).or_insert_with(TemplateKey::volume);
        self.summand(work, weight, Item::Rib(rib), Some(rib), sink, &|lowering| lowering.own_volume(rib, law))
    }

    /// Hands over a summand whose plan is known.
    fn summand(
        &mut self,
        work: Work<'a>,
        weight: f64,
        item: Item,
        rib: Option<u32>,
        sink: &mut dyn Sink<'a>,
        lower: &dyn Fn(&mut Lowering) -> NodeId,
    ) -> Result<(), TapeError> {
        let plan = &self.plans[&work];
        let shares = self.gathered.read(plan, self.problem, item);
        let work = shares.then_some(work);
        sink.summand(&Summand { work, gathered: &self.gathered, weight, rib, plan, item, lower })
    }
}
