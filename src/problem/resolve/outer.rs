//! `outer.…`: inside a sum over items, the item outside it: the row's own, or that of the sum around.
//!
//! What a sum runs over may depend on that item (`sum(ribs where x > outer.x: weight)`), so a formula that names it belongs to one item: rows
//! are then resolved one by one, sums become a list of sums over one item each.

use std::sync::Arc;

use super::{ItemScope, Resolver};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection, Requirement};
use crate::expression::operators::Fold;
use crate::problem::formula::{Formula, Members};
use crate::problem::mentions::mentions;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Names;
use crate::problem::{Cells, Problem};
use crate::sections;

/// The word.
pub const OUTER: &str = "outer";

/// Whether a requirement has a sum that names the item outside it.
pub fn names_outer(requirement: &Requirement, names: &Names, problem: &Problem) -> bool {
    let sides = match requirement {
        Requirement::Two { left, right, .. } => vec![left, right],
        Requirement::Range { lower, middle, upper } => vec![lower, middle, upper],
    };
    is_free(names, problem) && sides.into_iter().any(in_a_sum)
}

/// Whether nothing of the file has this name: what is declared goes before.
fn is_free(names: &Names, problem: &Problem) -> bool {
    names.find(problem, OUTER).is_none()
}

/// Whether it occurs inside a sum over items.
fn in_a_sum(ast: &Ast) -> bool {
    let (found, folds) = mentions(ast);
    folds && found.iter().any(|mention| mention.in_fold && mention.parts.first().is_some_and(|first| first == OUTER))
}

impl Resolver<'_, '_> {
    /// Whether this is `outer.…`.
    pub(super) fn is_outer(&self, parts: &[&str]) -> bool {
        parts.len() > 1 && parts[0] == OUTER && is_free(self.world.names, self.world.problem)
    }

    /// The number that the item outside the sum has by this name.
    pub(super) fn outer_number(&mut self, rest: &[&str], span: Span) -> Option<Formula> {
        let Some((collection, item)) = self.outer else { return self.no_outer(span) };
        let ends = |end: &str| {
            let ribs = &self.world.problem.ribs;
            let list = if end == "from" { &ribs.from } else { &ribs.to };
            list.get(item as usize).copied()
        };
        match (collection, rest) {
            (Collection::Sections, [name]) => self.section(item, name, span),
            (Collection::Ribs, [name]) => self.rib(item, name, span),
            (Collection::Ribs, [end @ ("from" | "to"), name]) => self.section(ends(end)?, name, span),
            (Collection::Nodes, [name]) => match self.cell(collection, item, name, span) {
                Some(value) => value,
                None => self.mistake(
                    MistakeCode::UnknownName,
                    span,
                    format!("a node has no `{name}`"),
                    Some("a node offers its data".into()),
                ),
            },
            _ => {
                self.mistake(MistakeCode::Scope, span, "too many dots", Some("as in outer.length, outer.from.b, outer.x".into()))
            }
        }
    }

    /// Its text by this name: a data column of text, `name` or `kind`; `None` where it has no such text.
    pub(super) fn outer_text(&mut self, name: &str) -> Option<String> {
        let (collection, item) = self.outer?;
        let columns = self.world.problem.columns(collection);
        if let Some(at) = columns.iter().position(|column| column.name == name) {
            let Cells::Labels { .. } = columns[at].cells else { return None };
            self.report.used.push((collection, at as u32));
            return Some(self.world.problem.label(collection, at as u32, item).unwrap_or("").to_owned());
        }
        match name {
            "name" => Some(self.world.problem.item_name(collection, item).to_owned()),
            "kind" => Some(sections::kind_of(self.world.problem.kind_of(collection, item)?).name().to_owned()),
            _ => None,
        }
    }

    fn no_outer<T>(&mut self, span: Span) -> Option<T> {
        let help = "it is the item outside a sum: of the row (for = \"ribs\", without `by`), or of the sum around this one";
        self.mistake(MistakeCode::Scope, span, "there is no item outside this", Some(help.into()))
    }

    /// A sum whose items are named by sums inside it: one item after the other. `None` where they are not.
    pub(super) fn item_by_item(
        &mut self,
        (fold, collection): (Fold, Collection),
        listed: Option<&[u32]>,
        scope: &ItemScope,
        body: &Ast,
    ) -> Option<Option<Formula>> {
        if !(is_free(self.world.names, self.world.problem) && in_a_sum(body)) {
            return None;
        }
        let grouped = self.group == Some(collection);
        let one = |index: u32| {
            let own = ItemScope::of(self.world.problem, collection, vec![index]);
            let outer = self.item;
            let inner = Resolver { scope: Some(&own), item: Some((collection, index)), outer, ..self.reborrowed() };
            let body = Arc::new({ inner }.scalar(body)?);
            let alone = Arc::new(vec![index]);
            let members = if grouped { Members::Group(Some(alone)) } else { Members::Listed(alone) };
            Some(Formula::Over { fold, collection, members, body })
        };
        let list: Option<Vec<Formula>> = listed.unwrap_or(&scope.members).iter().copied().map(one).collect();
        Some(list.map(|list| Formula::Fold(fold, list)))
    }
}

/// Whether a name is `outer.NAME`; the name then.
pub(super) fn named(ast: &Ast) -> Option<&str> {
    match &ast.kind {
        AstKind::Name(parts) => match &parts[..] {
            [first, name] if first == OUTER => Some(name),
            _ => None,
        },
        _ => None,
    }
}
