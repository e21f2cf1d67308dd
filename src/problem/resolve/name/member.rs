//! Names of an item: `support.Ix`, `haunch.length`, `haunch.from.b`.

use super::super::{Resolver, Stage, Value};
use crate::expression::Span;
use crate::expression::ast::{Ast, Collection};
use crate::problem::evaluate::number;
use crate::problem::formula::{Response, Subject, What};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::nearest::did_you_mean;
use crate::problem::{Column, Dimension, Formula, Property};
use crate::sections;
use std::sync::Arc;

impl<'a> Resolver<'a, '_> {
    /// `support.Ix`, `support.c`, `haunch.length`, `haunch.c`.
    pub(super) fn member(&mut self, item: &str, name: &str, span: Span) -> Option<Formula> {
        if self.world.stage != Stage::All {
            return self.not_of_variables(&format!("`{item}.{name}`"), span);
        }
        match self.world.names.find(self.world.problem, item) {
            Some(Entity::Section(s)) => self.section(s, name, span),
            Some(Entity::Rib(r)) => self.rib(r, name, span),
            Some(entity) => {
                let message = format!("`{item}` is a {} and has no `{name}`", entity.word());
                self.mistake(
                    MistakeCode::UnknownName,
                    span,
                    message,
                    Some("only sections and ribs have names of their own".into()),
                )
            }
            None if matches!(item, "from" | "to") => {
                let help = "these are the ends of a rib: use it with for = \"ribs\" or in sum(ribs: …)";
                self.mistake(MistakeCode::Scope, span, format!("`{item}.{name}` outside a rib"), Some(help.into()))
            }
            None => self.unknown(item, Span { start: span.start, end: span.start + item.len() }),
        }
    }

    pub(in crate::problem::resolve) fn section(&mut self, s: u32, name: &str, span: Span) -> Option<Formula> {
        let problem = self.world.problem;
        let number = *problem.sections.form.get(s as usize)?;
        if let Some(at) = sections::form(number).dimensions.iter().position(|given| *given == name) {
            match problem.dimensions(s as usize).get(at) {
                Some(Dimension::Variable(j)) => return Some(Formula::Variable(*j)),
                Some(Dimension::Constant(value)) => return Some(Formula::Constant(*value)),
                _ => {}
            }
        }
        let kind = sections::kind_of(number);
        if sections::offers(sections::form(number), name) {
            return Some(self.folded(Formula::SectionProperty(s, property(name))));
        }
        match self.cell(Collection::Sections, s, name, span) {
            Some(value) => value,
            None => {
                let offered = kind.properties().iter().copied().filter(|name| sections::offers(sections::form(number), name));
                self.no_property(name, Some(kind.name()), offered.collect(), span)
            }
        }
    }

    /// True for the name of a list of dimensions: `thickness` of a polyline, in `wall.thickness[2]`.
    pub(in super::super) fn lists_dimensions(&self, parts: &[String]) -> bool {
        let Some((last, item)) = parts.split_last() else { return false };
        let first = format!("{last}[1]");
        let own = || self.scope.is_some_and(|scope| scope.offers(&first));
        (!item.is_empty() || own()) && sections::is_dimension(&first)
    }

    /// `wall.thickness[2]`
    pub(in super::super) fn listed_dimension(&mut self, parts: &[String], index: &Ast, span: Span) -> Option<Value> {
        let Formula::Constant(position) = self.scalar(index)? else {
            let help = "an index is a number or an expression in parameters";
            return self.mistake(MistakeCode::NotConstant, index.span, "this index is not constant", Some(help.into()));
        };
        let mut parts = parts.to_vec();
        if let Some(last) = parts.last_mut() {
            *last = format!("{last}[{position}]");
        }
        self.name(&parts, span)
    }

    pub(in crate::problem::resolve) fn rib(&mut self, r: u32, name: &str, span: Span) -> Option<Formula> {
        match name {
            "length" if self.moves(r) => {
                Some(Formula::Response(Arc::new(Response { set: 0, subject: Subject::Rib(r), what: What::Length })))
            }
            "length" => self.world.problem.ribs.length.get(r as usize).map(|&length| Formula::Constant(length)),
            "volume" => Some(Formula::RibVolume(r)),
            _ => match self.cell(Collection::Ribs, r, name, span) {
                Some(value) => value,
                None => {
                    let help = "a rib offers length, volume, from.…, to.… and its data";
                    self.mistake(MistakeCode::UnknownName, span, format!("a rib has no `{name}`"), Some(help.into()))
                }
            },
        }
    }

    /// `haunch.from.b`
    pub(super) fn rib_end(&mut self, rib: &str, end: &str, name: &str, span: Span) -> Option<Formula> {
        if self.world.stage != Stage::All {
            return self.not_of_variables(&format!("`{rib}.{end}.{name}`"), span);
        }
        let found = self.world.names.find(self.world.problem, rib);
        let ribs = &self.world.problem.ribs;
        let section = match (found, end) {
            (Some(Entity::Rib(r)), "from") => ribs.from.get(r as usize),
            (Some(Entity::Rib(r)), "to") => ribs.to.get(r as usize),
            (None, _) => return self.unknown(rib, Span { start: span.start, end: span.start + rib.len() }),
            _ => {
                return self.mistake(
                    MistakeCode::UnknownName,
                    span,
                    format!("`{rib}.{end}` has no `{name}`"),
                    Some("as in haunch.from.b".into()),
                );
            }
        };
        self.section(*section?, name, span)
    }

    /// The number in a data cell of one item; `None` where there is no such column.
    pub(in crate::problem::resolve) fn cell(
        &mut self,
        collection: Collection,
        item: u32,
        name: &str,
        span: Span,
    ) -> Option<Option<Formula>> {
        let columns = self.columns(collection);
        let at = columns.iter().position(|column| column.name == name)?;
        self.report.used.push((collection, at as u32));
        Some(match number(&columns[at], item) {
            Some(value) => Some(Formula::Constant(value)),
            None => self.mistake(
                MistakeCode::TextAndNumber,
                span,
                format!("this item's data `{name}` is no number"),
                Some("give it one".into()),
            ),
        })
    }

    pub(super) fn no_property<T>(&mut self, name: &str, kind: Option<&str>, known: Vec<&'static str>, span: Span) -> Option<T> {
        let help = did_you_mean(name, known.iter().copied());
        let of = kind.map_or("the sections here have".to_owned(), |kind| format!("a section of kind {kind} has"));
        self.mistake(
            MistakeCode::UnknownName,
            span,
            format!("{of} no `{name}`"),
            Some(help.unwrap_or_else(|| format!("known: {} and its data", known.join(", ")))),
        )
    }

    /// Data columns of a collection.
    pub(in super::super) fn columns(&self, collection: Collection) -> &'a [Column] {
        self.world.problem.columns(collection)
    }
}

pub(super) fn property(name: &str) -> Property {
    Property(Arc::from(name))
}
