//! Names: the item's own first, then the global ones.

mod member;

use std::f64::consts::PI;

use super::{Resolver, Stage, Value};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection};
use crate::problem::evaluate::number;
use crate::problem::formula::{End, Total};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::nearest::did_you_mean;
use crate::problem::{Cells, Dimension, Formula};
use member::property;

impl<'a> Resolver<'a, '_> {
    /// The value of a dotted name.
    pub(super) fn name(&mut self, parts: &[String], span: Span) -> Option<Value> {
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        if let [name] = parts[..]
            && let Some((_, number)) = self.indices.iter().rev().find(|(known, _)| known == name)
        {
            return Some(Value::Scalar(Formula::Constant(*number)));
        }
        if self.is_outer(&parts) {
            return self.outer_number(&parts[1..], span).map(Value::Scalar);
        }
        if self.scope.is_some()
            && let Some(formula) = self.own(&parts, span)
        {
            return formula.map(Value::Scalar);
        }
        if let Some(elements) = self.elements(&parts) {
            let list = elements.iter().map(|(collection, column, item)| self.element(*collection, *column, *item, &parts, span));
            return list.collect::<Option<Vec<_>>>().map(Value::Array);
        }
        match parts[..] {
            [name] => self.global(name, span),
            [item, name] => self.member(item, name, span).map(Value::Scalar),
            [rib, end, name] => self.rib_end(rib, end, name, span).map(Value::Scalar),
            _ => self.mistake(
                MistakeCode::Scope,
                span,
                "too many dots",
                Some("as in support.Ix, haunch.length, haunch.from.b".into()),
            ),
        }
    }

    /// The columns `M[1]`, `M[2]`, … of an array among the data, with the item they are asked of where that is not the row's own.
    fn elements(&self, parts: &[&str]) -> Option<Vec<(Collection, u32, Option<u32>)>> {
        let (name, items) = parts.split_last()?;
        let (collection, item) = match (items, self.scope) {
            ([], Some(scope)) => (scope.collection, None),
            (["from" | "to"], Some(scope)) if scope.collection == Collection::Ribs => (Collection::Sections, None),
            ([item], _) if self.world.stage == Stage::All => match self.world.names.find(self.world.problem, item)? {
                Entity::Section(s) => (Collection::Sections, Some(s)),
                Entity::Rib(r) => (Collection::Ribs, Some(r)),
                _ => return None,
            },
            _ => return None,
        };
        let columns = self.columns(collection);
        let at = |number: usize| columns.iter().position(|column| column.name == format!("{name}[{number}]"));
        let mut found = Vec::new();
        while let Some(column) = at(found.len() + 1) {
            // The item's own array is as long as its cells are filled.
            if item.is_some_and(|item| number(&columns[column], item).is_none()) {
                break;
            }
            found.push((collection, column as u32, item));
        }
        (!found.is_empty()).then_some(found)
    }

    /// One element of such an array.
    fn element(&mut self, collection: Collection, column: u32, item: Option<u32>, parts: &[&str], span: Span) -> Option<Formula> {
        self.report.used.push((collection, column));
        let column_name = &self.columns(collection)[column as usize].name;
        match (item, parts) {
            (Some(item), _) => number(&self.columns(collection)[column as usize], item).map(Formula::Constant),
            (None, ["from", _]) => Some(Formula::EndData(End::From, column)),
            (None, ["to", _]) => Some(Formula::EndData(End::To, column)),
            (None, _) if matches!(self.columns(collection)[column as usize].cells, Cells::Labels { .. }) => self.mistake(
                MistakeCode::TextAndNumber,
                span,
                format!("data `{column_name}` are text"),
                Some("only data of numbers can be reckoned with".into()),
            ),
            (None, _) => Some(Formula::OwnData(column)),
        }
    }

    /// A name of the item itself; `Some(None)` after a mistake, `None` where it has no such name.
    fn own(&mut self, parts: &[&str], span: Span) -> Option<Option<Formula>> {
        let scope = self.scope?;
        if let [name] = parts
            && scope.yields(name)
            && self.world.names.find(self.world.problem, name).is_some()
        {
            return None;
        }
        let found = match (scope.collection, parts) {
            (Collection::Ribs, ["from" | "to", _]) if self.elements(parts).is_some() => return None,
            (Collection::Ribs, [end @ ("from" | "to"), name]) => return Some(self.end(end, name, span)),
            (Collection::Ribs, ["at", name]) if self.world.problem.structure.is_some() => {
                return Some(self.at_station(name, span));
            }
            (Collection::Ribs, [word @ "material", name]) => return self.material(word, name, span),
            (Collection::Ribs, [name @ ("mass" | "weight")]) if self.is_free(name) => return Some(self.mass(name, span)),
            (Collection::Ribs, ["length"]) => Some(Formula::OwnLength),
            (Collection::Ribs, ["volume"]) => Some(Formula::OwnVolume),
            (Collection::Sections, [name]) if scope.offers(name) => Some(Formula::OwnProperty(property(name))),
            _ => None,
        };
        let found = match (found, parts) {
            (Some(found), _) => found,
            (None, [name]) => match self.own_data(scope.collection, name, span)? {
                Some(data) => data,
                None => return Some(None),
            },
            (None, _) => return None,
        };
        if let [name] = parts
            && let Some(entity) = self.world.names.find(self.world.problem, name)
            && !self.is_the_same(entity, name)
        {
            let message = format!("`{name}` is the item's own here and hides the {} of this name", entity.word());
            self.warning(MistakeCode::HiddenName, span, message, "rename one of the two");
        }
        Some(Some(found))
    }

    /// Whether every section here is linked to the variable by this very name, `tw = "tw"`: then both mean the same.
    fn is_the_same(&self, entity: Entity, name: &str) -> bool {
        let (Some(scope), Entity::Variable(entry)) = (self.scope, entity) else { return false };
        let Some(&(variable, None)) = self.world.variables.get(entry as usize) else { return false };
        let linked = |&s: &u32| self.world.problem.given_dimension(s, name) == Some(Dimension::Variable(variable));
        scope.collection == Collection::Sections && scope.members.iter().all(linked)
    }

    /// The item's data column of this name.
    fn own_data(&mut self, collection: Collection, name: &str, span: Span) -> Option<Option<Formula>> {
        let columns = self.columns(collection);
        let at = columns.iter().position(|column| column.name == name)?;
        self.report.used.push((collection, at as u32));
        if let Cells::Labels { labels, .. } = &columns[at].cells {
            let sample = labels.first().map_or("", |label| label);
            let message = format!("data `{name}` are text, such as \"{sample}\"");
            return Some(self.mistake(
                MistakeCode::TextAndNumber,
                span,
                message,
                Some("only data of numbers can be reckoned with".into()),
            ));
        }
        Some(Some(Formula::OwnData(at as u32)))
    }

    /// `from.Ix`, `to.c`: property or data of the section at an end of the item.
    fn end(&mut self, end: &str, name: &str, span: Span) -> Option<Formula> {
        let (scope, end) = (self.scope?, if end == "from" { End::From } else { End::To });
        if scope.offers(name) {
            return Some(Formula::EndProperty(end, property(name)));
        }
        match self.own_data(Collection::Sections, name, span) {
            Some(Some(Formula::OwnData(column))) => Some(Formula::EndData(end, column)),
            Some(_) => None,
            None => self.no_property(name, scope.lacking(name), scope.properties().collect(), span),
        }
    }

    /// A global name.
    fn global(&mut self, name: &str, span: Span) -> Option<Value> {
        match self.world.names.find(self.world.problem, name) {
            Some(Entity::Parameter(p)) => self.world.parameters.get(p as usize).cloned().flatten(),
            Some(entity) if self.world.stage == Stage::Constants => {
                let message = format!("`{name}` is a {}, but this must be constant", entity.word());
                self.mistake(MistakeCode::NotConstant, span, message, Some("numbers and parameters may occur here".into()))
            }
            Some(Entity::Variable(v)) => Some(self.variable(v)),
            Some(Entity::Definition(d)) => match self.world.definitions.get(d as usize).cloned().flatten() {
                None if self.world.stage == Stage::Variables => self.not_of_variables(&format!("`{name}`"), span),
                value => value,
            },
            Some(entity) => {
                let message = format!("`{name}` is a {}, not a number", entity.word());
                let what = if matches!(entity, Entity::Section(_)) { "Ix" } else { "length" };
                self.mistake(MistakeCode::Scope, span, message, Some(format!("say which property: `{name}.{what}`")))
            }
            None => match total(name) {
                _ if name == "pi" => Some(Value::Scalar(Formula::Constant(PI))),
                Some(_) if self.world.stage != Stage::All => self.not_of_variables(&format!("`{name}`"), span),
                Some(total) => self.volume(total, span).map(Value::Scalar),
                _ if self.world.stage == Stage::All && matches!(name, "mass" | "weight") && self.is_free(name) => {
                    self.mass(name, span).map(Value::Scalar)
                }
                _ => self.unknown(name, span),
            },
        }
    }

    fn moves(&self, rib: u32) -> bool {
        self.world.problem.structure.as_deref().is_some_and(|structure| structure.moves(rib))
    }

    /// Whether a word of structures is one here: there is a structure, and nothing else has this name.
    fn is_free(&self, name: &str) -> bool {
        self.world.problem.structure.is_some()
            && self.world.names.find(self.world.problem, name).is_none()
            && self.scope.is_none_or(|scope| !self.columns(scope.collection).iter().any(|column| column.name == name))
    }

    /// The mistake of what does not follow from parameters and variables alone.
    pub(super) fn not_of_variables<T>(&mut self, what: &str, span: Span) -> Option<T> {
        if self.world.stage == Stage::Constants {
            return self.mistake(
                MistakeCode::NotConstant,
                span,
                format!("{what} is not constant"),
                Some("numbers and parameters may occur here".into()),
            );
        }
        let help = "numbers, parameters, variables and definitions made of these, but no sequences, may occur here";
        self.mistake(
            MistakeCode::NotConstant,
            span,
            format!("{what} is not made of parameters and variables alone"),
            Some(help.into()),
        )
    }

    fn volume(&mut self, total: Total, span: Span) -> Option<Formula> {
        if self.world.problem.ribs.names.is_empty() {
            return self.mistake(MistakeCode::Scope, span, "there are no ribs to have a volume", Some("add [[ribs]]".into()));
        }
        Some(Formula::Volume(total))
    }

    /// The first element and the size of an array of variables, where a name alone means one.
    pub(super) fn array_of_variables(&self, base: &Ast) -> Option<(u32, usize)> {
        let AstKind::Name(parts) = &base.kind else { return None };
        let [name] = &parts[..] else { return None };
        if self.scope.is_some() || self.world.stage == Stage::Constants {
            return None;
        }
        match self.world.names.find(self.world.problem, name)? {
            Entity::Variable(v) => match self.world.variables.get(v as usize) {
                Some((first, Some(size))) => Some((*first, *size as usize)),
                _ => None,
            },
            _ => None,
        }
    }

    fn variable(&self, entry: u32) -> Value {
        match self.world.variables.get(entry as usize) {
            Some((first, Some(size))) => Value::Array((*first..first + size).map(Formula::Variable).collect()),
            Some((first, None)) => Value::Scalar(Formula::Variable(*first)),
            None => Value::Scalar(Formula::Constant(0.0)),
        }
    }

    fn unknown<T>(&mut self, name: &str, span: Span) -> Option<T> {
        let own: Vec<&str> = match self.scope {
            Some(scope) if scope.collection == Collection::Sections => scope.properties().collect(),
            Some(scope) if scope.collection == Collection::Ribs => vec!["length", "volume", "from", "to"],
            Some(_) => Vec::new(),
            None => Vec::new(),
        };
        let columns = self.scope.map_or(&[][..], |scope| self.columns(scope.collection));
        let global = self.world.names.suggestions(self.world.problem);
        let fixed = ["pi", "volume", "volume_frustum", "volume_prismatoid"];
        let known = own.into_iter().chain(columns.iter().map(|column| &*column.name)).chain(global).chain(fixed);
        let help = did_you_mean(name, known);
        if let Some(kind) = self.scope.and_then(|scope| scope.lacking(name)) {
            let message = format!("`{name}` is not a name every section here has: kind `{kind}` has none");
            return self.mistake(MistakeCode::UnknownName, span, message, Some("choose the kind: kind = \"…\"".into()));
        }
        let message = format!("unknown name `{name}`");
        let declare = "declare it among parameters, variables or definitions";
        self.mistake(MistakeCode::UnknownName, span, message, Some(help.unwrap_or_else(|| declare.into())))
    }
}

fn total(name: &str) -> Option<Total> {
    match name {
        "volume" => Some(Total::Own),
        "volume_frustum" => Some(Total::Frustum),
        "volume_prismatoid" => Some(Total::Prismatoid),
        _ => None,
    }
}
