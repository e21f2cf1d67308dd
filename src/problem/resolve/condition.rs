//! `where`: which items, by data, parameters, name and kind.

use super::word;
use super::{ItemScope, Resolver};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection, Condition};
use crate::expression::operators::Comparison;
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::{Cells, Formula, Problem};
use crate::sections;

/// A `where` with its names looked up.
#[derive(Debug)]
#[allow(missing_docs)]
pub enum ItemFilter {
    Numbers(Comparison, Formula, Formula),
    /// Only equal and not equal.
    Texts(Comparison, Text, Text),
    And(Box<ItemFilter>, Box<ItemFilter>),
    Or(Box<ItemFilter>, Box<ItemFilter>),
    Not(Box<ItemFilter>),
}

/// A text of an item.
#[derive(Debug, Clone)]
#[allow(missing_docs)]
pub enum Text {
    Literal(String),
    /// A data column of text; an empty cell is the text "".
    Column(u32),
    Name,
    Kind,
}

impl Resolver<'_, '_> {
    /// Looks up the names of a condition in the resolver's scope.
    pub fn condition(&mut self, condition: &Condition) -> Option<ItemFilter> {
        Some(match condition {
            Condition::Compare(comparison, left, right) => self.comparison(*comparison, left, right)?,
            Condition::And(left, right) => {
                let (left, right) = (self.condition(left), self.condition(right));
                ItemFilter::And(Box::new(left?), Box::new(right?))
            }
            Condition::Or(left, right) => {
                let (left, right) = (self.condition(left), self.condition(right));
                ItemFilter::Or(Box::new(left?), Box::new(right?))
            }
            Condition::Not(inner) => ItemFilter::Not(Box::new(self.condition(inner)?)),
        })
    }

    fn comparison(&mut self, comparison: Comparison, left: &Ast, right: &Ast) -> Option<ItemFilter> {
        match (self.text(left), self.text(right)) {
            (Some(left_text), Some(right_text)) => match comparison {
                Comparison::Equal | Comparison::NotEqual => Some(ItemFilter::Texts(comparison, left_text, right_text)),
                _ => self.mistake(
                    MistakeCode::TextAndNumber,
                    left.span,
                    "texts are only equal or not",
                    Some("compare with == or !=".into()),
                ),
            },
            (Some(_), None) => self.mixed(right.span),
            (None, Some(_)) => self.mixed(left.span),
            (None, None) => {
                let (left, right) = (self.choice(left), self.choice(right));
                Some(ItemFilter::Numbers(comparison, left?, right?))
            }
        }
    }

    fn mixed(&mut self, span: Span) -> Option<ItemFilter> {
        self.mistake(
            MistakeCode::TextAndNumber,
            span,
            "a number is held against a text",
            Some("texts stand in quotes, numbers do not".into()),
        )
    }

    /// A number to choose by; a variable has the value it starts from, and that is said.
    fn choice(&mut self, ast: &Ast) -> Option<Formula> {
        let formula = self.scalar(ast)?;
        let scope = self.scope?;
        let varies = |&index: &u32| {
            let item = Item::of(scope.collection, index);
            let constant = Evaluation::constants(self.world.problem).value(&formula, item);
            constant.is_none() && Evaluation::at_start(self.world.problem).value(&formula, item).is_some()
        };
        if scope.members.iter().any(varies) {
            let message = "a `where` over design variables is decided once, at the start".to_owned();
            self.warning(MistakeCode::ChosenAtStart, ast.span, message, "choose by data and parameters");
        }
        Some(formula)
    }

    /// The text an expression stands for, if it is one.
    fn text(&mut self, ast: &Ast) -> Option<Text> {
        match &ast.kind {
            AstKind::Text(text) => Some(Text::Literal(text.clone())),
            AstKind::Name(parts) if parts.len() == 1 => self.text_name(&parts[0]),
            AstKind::Name(_) => Some(Text::Literal(self.outer_text(super::outer::named(ast)?)?)),
            _ => None,
        }
    }

    fn text_name(&mut self, name: &str) -> Option<Text> {
        let collection = self.scope?.collection;
        let columns = self.columns(collection);
        let at = columns.iter().position(|column| column.name == name);
        match at.map(|at| (at as u32, &columns[at].cells)) {
            Some((at, Cells::Labels { .. })) => {
                self.report.used.push((collection, at));
                Some(Text::Column(at))
            }
            Some(_) => None,
            None if name == "name" => Some(Text::Name),
            None if name == "kind" => Some(Text::Kind),
            None => None,
        }
    }
}

impl ItemFilter {
    /// Help where an item cannot be judged.
    pub const REMEDY: &'static str = "fill the cell, or leave the item out by its name or another datum first";

    /// The members for which the condition holds, ascending.
    ///
    /// # Errors
    /// The name of an item that lacks a number the condition asks for.
    pub fn choose(&self, problem: &Problem, scope: &ItemScope) -> Result<Vec<u32>, String> {
        let mut chosen = Vec::new();
        for &index in &scope.members {
            let holds = self.holds(problem, Item::of(scope.collection, index)).ok_or_else(|| {
                let name = problem.item_name(scope.collection, index);
                format!("{} `{name}` has no value for this condition", word(scope.collection).trim_end_matches('s'))
            })?;
            if holds {
                chosen.push(index);
            }
        }
        Ok(chosen)
    }

    /// Whether it holds; `None` where a number is missing. `and` and `or` look no further than they must.
    fn holds(&self, problem: &Problem, item: Item) -> Option<bool> {
        Some(match self {
            ItemFilter::Numbers(comparison, left, right) => {
                let evaluation = Evaluation::at_start(problem);
                let (left, right) = (evaluation.value(left, item)?, evaluation.value(right, item)?);
                compare(*comparison, left, right)
            }
            ItemFilter::Texts(comparison, left, right) => {
                (left.of(problem, item) == right.of(problem, item)) == (*comparison == Comparison::Equal)
            }
            ItemFilter::And(left, right) => left.holds(problem, item)? && right.holds(problem, item)?,
            ItemFilter::Or(left, right) => left.holds(problem, item)? || right.holds(problem, item)?,
            ItemFilter::Not(inner) => !inner.holds(problem, item)?,
        })
    }
}

fn compare(comparison: Comparison, left: f64, right: f64) -> bool {
    match comparison {
        Comparison::LessOrEqual => left <= right,
        Comparison::GreaterOrEqual => left >= right,
        Comparison::Equal => left == right,
        Comparison::NotEqual => left != right,
        Comparison::Less => left < right,
        Comparison::Greater => left > right,
    }
}

impl Text {
    fn of<'p>(&'p self, problem: &'p Problem, item: Item) -> &'p str {
        let (collection, index) = match item {
            Item::Section(s) => (Collection::Sections, s),
            Item::Rib(r) => (Collection::Ribs, r),
            Item::Node(n) => (Collection::Nodes, n),
            Item::None => return "",
        };
        match self {
            Text::Literal(text) => text,
            Text::Column(at) => problem.label(collection, *at, index).unwrap_or(""),
            Text::Name => problem.item_name(collection, index),
            Text::Kind => problem.kind_of(collection, index).map_or("", |number| sections::kind_of(number).name()),
        }
    }
}
