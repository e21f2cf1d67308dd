//! Definitions and computed dimensions: they need one another, in any order but not in circles.

use super::Assembly;
use super::sequences::{DEEPEST, together};
use crate::expression::ast::{Ast, Collection};
use crate::expression::parse::parse;
use crate::input::declaration::{DefinitionEntry, Name};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::mentions::{Mention, mentions};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::resolve::{ItemScope, Stage, Value};
use crate::problem::{Dimension, Formula, sections_form};
use crate::sections;

/// A dimension given by an expression.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub section: u32,
    pub position: u8,
    /// Its text, among [`Assembly::texts`].
    pub text: u32,
    pub place: Place,
    pub inside: Option<u32>,
}

/// The formula last met for a text, so that a table's column of equal expressions is stored once.
type Shared = Vec<Option<(Formula, u32)>>;

/// What definitions and links say, parsed.
struct Trees {
    /// The texts of each definition; `None` after a syntax mistake.
    definitions: Vec<Vec<Option<Ast>>>,
    /// Texts of links.
    texts: Vec<Option<Ast>>,
}

/// The parts of a name, an index taken in where it makes a dimension: `wall`, `thickness[2]`.
fn full_name(mention: &Mention) -> Vec<String> {
    let mut parts = mention.parts.to_vec();
    if let (Some(index), Some(last)) = (mention.index, parts.last_mut()) {
        let numbered = format!("{last}[{index}]");
        if sections::is_dimension(&numbered) {
            *last = numbered;
        }
    }
    parts
}

impl Assembly<'_> {
    /// Resolves `[definitions]` and computed dimensions. Nodes of the order: definitions, links, and one for "all links".
    pub(super) fn links(&mut self, definitions: &[(Name, DefinitionEntry)]) {
        self.definitions = vec![None; definitions.len()];
        let trees = self.trees(definitions);
        let (first_link, all) = (definitions.len(), definitions.len() + self.links.len());
        let ranges = self.sequence_ranges(definitions);
        let needs = |node: u32| self.needs(node as usize, first_link, all, &trees);
        let deepest = DEEPEST - ranges.iter().flatten().map(|range| range.last).sum::<u32>().min(DEEPEST);
        let (found, leaders) = together(all + 1, |node| ranges.get(node as usize).is_some_and(Option::is_some), needs);
        let mut broken = vec![false; all + 1];
        for circle in &found.circles {
            self.say_circle(circle, definitions);
            circle.iter().for_each(|&node| broken[node as usize] = true);
        }
        for node in (0..all).filter(|&node| found.depth[node] > deepest) {
            broken[node] = true;
            if found.depth[node] == deepest + 1 {
                let place = definitions.get(node).map_or_else(|| self.links[node - first_link].place, |(name, _)| name.place);
                let message = format!("more than {deepest} definitions or links need one another in a chain");
                self.findings.mistake(
                    MistakeCode::Circle,
                    place,
                    message,
                    "shorten the chain: sum(…) adds up an array, or ribs and sections",
                );
            }
        }
        let mut shared: Shared = vec![None; self.texts.len()];
        for node in found.order.into_iter().map(|node| node as usize).filter(|&node| node < all && !broken[node]) {
            match node.checked_sub(first_link) {
                None if ranges[node].is_some() => {
                    let members: Vec<usize> = (0..first_link).filter(|&other| leaders[other] as usize == node).collect();
                    self.sequences(&members, definitions, (&ranges, &trees.definitions));
                }
                None => self.definition(node, &definitions[node], trees.definitions[node].first().and_then(Option::as_ref)),
                Some(link) => self.link(self.links[link], &trees, &mut shared),
            }
        }
        self.close_broken();
    }

    fn trees(&mut self, definitions: &[(Name, DefinitionEntry)]) -> Trees {
        let texts = std::mem::take(&mut self.texts);
        let trees = Trees {
            definitions: definitions
                .iter()
                .map(|(_, entry)| entry.texts().map(|written| self.parsed(written, parse)).collect())
                .collect(),
            texts: texts.iter().map(|written| self.parsed(written, parse)).collect(),
        };
        self.texts = texts;
        trees
    }

    /// The nodes a node depends on.
    fn needs(&self, node: usize, first_link: usize, all: usize, trees: &Trees) -> Vec<u32> {
        if node == all {
            return (first_link as u32..all as u32).collect();
        }
        let (of_node, own) = match node.checked_sub(first_link) {
            None => (&trees.definitions[node][..], None),
            Some(link) => (std::slice::from_ref(&trees.texts[self.links[link].text as usize]), Some(self.links[link])),
        };
        let mut needs = Vec::new();
        for tree in of_node.iter().flatten() {
            let (mentions, folds) = mentions(tree);
            needs.extend(folds.then_some(all as u32));
            for mention in mentions.iter().filter(|mention| !mention.in_fold) {
                let parts = full_name(mention);
                let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
                self.need(&parts, own, (first_link, all), &mut needs);
            }
        }
        needs.sort_unstable_by(|a, b| b.cmp(a));
        needs.dedup();
        needs
    }

    fn need(&self, parts: &[&str], own: Option<Link>, (first_link, all): (usize, usize), needs: &mut Vec<u32>) {
        let entity = |name: &str| self.names.find(&self.problem, name);
        if let (Some(link), [name]) = (own, parts) {
            let form = sections_form(&self.problem, link.section as usize);
            let kind = form.and_then(|form| sections::kind(form.kind));
            let other = form.is_some_and(|form| form.dimensions.contains(name)) && self.dimension_name(link) != Some(*name);
            let global = !other && entity(name).is_some();
            if !global && kind.is_some_and(|kind| kind.properties().contains(name)) {
                return self.need_property(link.section, name, first_link, needs);
            }
        }
        match parts {
            ["volume" | "volume_frustum" | "volume_prismatoid"] => needs.push(all as u32),
            [name] => {
                if let Some(Entity::Definition(d)) = entity(name) {
                    needs.push(d);
                }
            }
            [item, name] => match entity(item) {
                Some(Entity::Section(s)) => self.need_property(s, name, first_link, needs),
                Some(Entity::Rib(_)) if *name == "volume" => needs.push(all as u32),
                _ => {}
            },
            [rib, end, name] => {
                if let Some(Entity::Rib(r)) = entity(rib) {
                    let ends = if *end == "from" { &self.problem.ribs.from } else { &self.problem.ribs.to };
                    self.need_property(ends[r as usize], name, first_link, needs);
                }
            }
            _ => {}
        }
    }

    /// A given dimension needs its own link at the most, a derived property those of the whole section.
    fn need_property(&self, s: u32, name: &str, first_link: usize, needs: &mut Vec<u32>) {
        let given = sections_form(&self.problem, s as usize)
            .and_then(|form| form.dimensions.iter().position(|dimension| *dimension == name));
        let from = self.links.partition_point(|link| link.section < s);
        let of_section = self.links[from..].iter().enumerate().take_while(|(_, link)| link.section == s);
        let wanted = of_section.filter(|(_, link)| given.is_none_or(|at| at == link.position as usize));
        needs.extend(wanted.map(|(at, _)| (first_link + from + at) as u32));
    }

    /// The dimension a link is for.
    fn dimension_name(&self, link: Link) -> Option<&'static str> {
        sections_form(&self.problem, link.section as usize)?.dimensions.get(link.position as usize).copied()
    }

    fn say_circle(&mut self, circle: &[u32], definitions: &[(Name, DefinitionEntry)]) {
        let node = |node: u32| match definitions.get(node as usize) {
            Some((name, _)) => Some((name.text.clone(), name.place)),
            None => {
                let link = self.links.get(node as usize - definitions.len())?;
                let section = &self.problem.sections.names[link.section as usize];
                Some((format!("{section}.{}", self.dimension_name(*link)?), link.place))
            }
        };
        let (names, places): (Vec<String>, Vec<Place>) = circle.iter().filter_map(|&at| node(at)).unzip();
        if let Some(&place) = places.first() {
            self.circle(place, names);
        }
    }

    fn definition(&mut self, at: usize, (name, entry): &(Name, DefinitionEntry), tree: Option<&Ast>) {
        let value = match (entry, tree) {
            (DefinitionEntry::One(Scalar::Number(value, _)), _) => Some(Value::Scalar(Formula::Constant(*value))),
            (DefinitionEntry::One(Scalar::Expression(written)), Some(tree)) => {
                self.resolved(written, None, Stage::All, |resolver| resolver.value(tree))
            }
            _ => None,
        };
        if let Some(value) = &value {
            let user = format!("definition `{}`", name.text);
            for formula in value.formulas() {
                self.cells_filled(formula, None, &user);
            }
        }
        self.definitions[at] = value.map(|value| match value {
            Value::Scalar(formula) => Value::Scalar(self.defined(name.text.clone(), formula)),
            Value::Array(list) => {
                let named = |(index, formula)| self.defined(format!("{}[{}]", name.text, index + 1), formula);
                Value::Array(list.into_iter().enumerate().map(named).collect())
            }
        });
    }

    /// Enters a definition and gives what stands for it where it is used: itself, or the number or variable it is.
    pub(super) fn defined(&mut self, name: String, formula: Formula) -> Formula {
        let number = self.problem.definitions.len() as u32;
        self.problem.definitions.push((name, formula.clone()));
        match formula {
            Formula::Constant(_) | Formula::Variable(_) => formula,
            _ => Formula::Definition(number),
        }
    }

    fn link(&mut self, link: Link, trees: &Trees, shared: &mut Shared) {
        let Some(tree) = &trees.texts[link.text as usize] else { return };
        let mut scope = ItemScope::of(&self.problem, Collection::Sections, vec![link.section]);
        scope.itself = self.dimension_name(link);
        let written = Written { text: String::new(), place: link.place, inside: link.inside };
        let resolved = self.resolved(&written, Some(&scope), Stage::All, |resolver| resolver.scalar(tree));
        let dimension = match resolved {
            Some(formula) if self.cells_filled(&formula, Some(&scope), "a dimension") => self.linked(link, formula, shared),
            _ => Dimension::Constant(1.0),
        };
        let first = self.problem.sections.first_dimension[link.section as usize] as usize;
        self.problem.sections.dimensions[first + link.position as usize] = dimension;
    }

    /// A number, a variable, or a formula; equal formulas of one text are stored once.
    fn linked(&mut self, link: Link, formula: Formula, shared: &mut Shared) -> Dimension {
        if let Some(value) = Evaluation::constants(&self.problem).value(&formula, Item::Section(link.section)) {
            if value.is_nan() {
                self.findings.mistake(
                    MistakeCode::NoValue,
                    link.place,
                    "this has no value",
                    "it leaves the domain, as 0/0 or log(-1) do",
                );
            }
            self.positive(self.dimension_name(link).unwrap_or_default(), value, link.place);
            return Dimension::Constant(value);
        }
        match &formula {
            Formula::Variable(j) => return Dimension::Variable(*j),
            Formula::OwnProperty(property) => {
                let form = sections_form(&self.problem, link.section as usize);
                let at = form.and_then(|form| form.dimensions.iter().position(|name| **name == *property.0));
                if let Some(dimension) = at.and_then(|at| self.problem.dimensions(link.section as usize).get(at)) {
                    return *dimension;
                }
            }
            _ => {}
        }
        match &shared[link.text as usize] {
            Some((known, number)) if *known == formula => Dimension::Formula(*number),
            _ => {
                let number = self.problem.dimension_formulas.len() as u32;
                shared[link.text as usize] = Some((formula.clone(), number));
                self.problem.dimension_formulas.push(formula);
                Dimension::Formula(number)
            }
        }
    }

    /// Dimensions on circles or after syntax mistakes: a number, so that nothing points nowhere.
    fn close_broken(&mut self) {
        for dimension in &mut self.problem.sections.dimensions {
            if *dimension == Dimension::Formula(u32::MAX) {
                *dimension = Dimension::Constant(1.0);
            }
        }
    }
}
