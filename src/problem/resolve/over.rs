//! `sum(ribs where …: …)`: folds over ribs and sections.

use std::sync::Arc;

use super::condition::ItemFilter;
use super::word;
use super::{ItemScope, Resolver, Stage};
use crate::expression::Span;
use crate::expression::ast::{Ast, Collection, Condition};
use crate::expression::operators::Fold;
use crate::problem::formula::{Formula, Members};
use crate::problem::mistake_code::MistakeCode;

impl Resolver<'_, '_> {
    /// The fold; over the row's own group where the rows are groups of this collection.
    pub(super) fn over(
        &mut self,
        fold: Fold,
        collection: Collection,
        filter: Option<&Condition>,
        body: &Ast,
        span: Span,
    ) -> Option<Formula> {
        if self.world.stage == Stage::Variables {
            return self.not_of_variables("a sum over items", span);
        }
        if self.world.stage == Stage::Constants {
            return self.mistake(
                MistakeCode::NotConstant,
                span,
                "this must be constant",
                Some("numbers and parameters may occur here".into()),
            );
        }
        let mut scope = ItemScope::all(self.world.problem, collection);
        if scope.members.is_empty() {
            let (word, table) = (word(collection), if collection == Collection::Ribs { "[[ribs]]" } else { "" });
            let table = if table.is_empty() { format!("[{word}]") } else { table.to_owned() };
            return self.mistake(
                MistakeCode::Scope,
                span,
                format!("there are no {word}"),
                Some(format!("add {table} or leave this out")),
            );
        }
        let listed = match filter {
            Some(condition) => Some(self.chosen(condition, &scope, span)?),
            None => None,
        };
        if let Some(list) = &listed {
            if list.is_empty() {
                return self.nothing(fold, span);
            }
            scope = ItemScope::of(self.world.problem, collection, list.to_vec());
        }
        let listed_members = listed.as_ref().map(|list| list.as_slice());
        if let Some(one_by_one) = self.item_by_item((fold, collection), listed_members, &scope, body) {
            return one_by_one.map(|formula| self.folded(formula));
        }
        let outer = self.item;
        let body = Resolver { scope: Some(&scope), item: None, outer, ..self.reborrowed() }.scalar(body)?;
        let members = match (self.group == Some(collection), listed) {
            (true, listed) => Members::Group(listed),
            (false, Some(list)) => Members::Listed(list),
            (false, None) => Members::All,
        };
        Some(self.folded(Formula::Over { fold, collection, members, body: Arc::new(body) }))
    }

    /// The members a `where` chooses.
    fn chosen(&mut self, condition: &Condition, scope: &ItemScope, span: Span) -> Option<Arc<Vec<u32>>> {
        let outer = self.item;
        let filter = Resolver { scope: Some(scope), item: None, outer, ..self.reborrowed() }.condition(condition)?;
        match filter.choose(self.world.problem, scope) {
            Ok(list) => Some(Arc::new(list)),
            Err(message) => self.mistake(MistakeCode::EmptyCell, span, message, Some(ItemFilter::REMEDY.into())),
        }
    }

    fn nothing(&mut self, fold: Fold, span: Span) -> Option<Formula> {
        if fold != Fold::Sum {
            return self.mistake(
                MistakeCode::Scope,
                span,
                "no item is chosen, so there is none to take",
                Some("widen the `where`".into()),
            );
        }
        // Of items resolved one by one some have none: the last of a row has nothing beyond it.
        if self.item.is_none() {
            self.warning(MistakeCode::NothingChosen, span, "no item is chosen: the sum is 0".into(), "check the `where`");
        }
        Some(Formula::Constant(0.0))
    }

    /// The same resolver for a while.
    pub(super) fn reborrowed(&mut self) -> Resolver<'_, '_> {
        let (world, scope, item, outer, group) = (self.world, self.scope, self.item, self.outer, self.group);
        let indices = self.indices.clone();
        Resolver { world, scope, item, outer, group, indices, report: self.report }
    }
}
