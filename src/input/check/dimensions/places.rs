//! Every place of the file where a number stands, with the dimension it asks for.

use super::walk::{Scope, Walk};
use crate::expression::Span;
use crate::expression::ast::Collection;
use crate::expression::parse::{parse, parse_condition, parse_range};
use crate::input::declaration::structure::{LoadEntry, StructureEntries, Vector};
use crate::input::declaration::{
    ConstraintEntry, Declaration, DefinitionEntry, DimensionEntry, ListEntry, Listing, Name, Numbers, Range, SectionEntry,
};
use crate::input::fields::Scalar;
use crate::input::source::Written;
use crate::problem::sections_form;
use crate::units::inference::Form;
use crate::units::{Dimension, Ratio};

impl Walk<'_, '_> {
    /// All places, those that make names known first.
    pub fn places(&mut self, declared: &Declaration) {
        self.columns();
        self.measured_data(declared);
        self.constants(declared);
        declared.sections.iter().for_each(|section| self.section(section));
        for rib in &declared.ribs {
            self.scalar(rib.length.as_ref(), &Dimension::LENGTH.into(), "the length of a rib");
            self.scalar(rib.member.roll.as_ref(), &Dimension::NONE.into(), "`roll` (degrees)");
            rib.member.offset.iter().for_each(|arm| self.vector(arm.as_ref(), &Dimension::LENGTH.into(), "an arm"));
        }
        self.structure(&declared.structure);
        self.links();
        if let Some((_, Some(written))) = &declared.objective
            && let Ok(ast) = parse(&written.text)
        {
            self.objective = Some(self.expression(&ast, written, Scope::default()));
        }
        for (at, entry) in declared.constraints.iter().enumerate() {
            self.constraint(at, entry);
        }
        self.settle_factors();
    }

    /// Columns whose headers have units.
    fn columns(&mut self) {
        for column in &self.assembly.columns {
            let own = match (column.holder, column.name.as_str()) {
                (Collection::Sections, name) => self.of_section(None, name),
                (Collection::Ribs, "length") => Dimension::LENGTH.into(),
                (holder, name) => self.datum(holder, name),
            };
            if self.inference.equal(&own, &column.dimension.into()).is_err() {
                let asked = self.known(&own).unwrap_or(Dimension::NONE);
                let message = format!("`{}`: expected {asked}, but its unit is one of {}", column.name, column.dimension);
                self.disagree(column.place, message, Some("correct the unit in the header".into()));
            }
        }
    }

    /// Data that are given with units.
    fn measured_data(&mut self, declared: &Declaration) {
        let sections = declared.sections.iter().flat_map(|entry| &entry.data).map(|(name, _)| (Collection::Sections, name));
        let ribs = declared.ribs.iter().flat_map(|entry| &entry.data).map(|(name, _)| (Collection::Ribs, name));
        let nodes = declared.structure.nodes.iter().flat_map(|entry| &entry.data).map(|(name, _)| (Collection::Nodes, name));
        for (holder, name) in sections.chain(ribs).chain(nodes) {
            let Some(&dimension) = declared.measured.get(&name.place) else { continue };
            let datum = self.datum(holder, &name.text);
            if self.inference.equal(&datum, &dimension.into()).is_err() {
                let other = self.known(&datum).unwrap_or(Dimension::NONE);
                let message = format!("`{}` is {dimension} here and {other} elsewhere", name.text);
                self.disagree(name.place, message, Some("one datum has one dimension".into()));
            }
        }
    }

    fn constants(&mut self, declared: &Declaration) {
        for (name, numbers) in &declared.parameters {
            let own = self.unknown(format!("name: {}", name.text));
            self.numbers(numbers, &own, &format!("`{}`", name.text));
        }
        for entry in &declared.variables {
            let own = self.unknown(format!("name: {}", entry.name.text));
            let Range { lower, upper, start } = &entry.range;
            self.list(entry.list.as_ref(), &own, &format!("`{}`", entry.name.text));
            for numbers in [lower, upper, start].into_iter().flatten() {
                self.numbers(numbers, &own, &format!("`{}`", entry.name.text));
            }
        }
        for (name, entry) in &declared.definitions {
            let own = self.unknown(format!("name: {}", name.text));
            self.definition(entry, &own, &format!("`{}`", name.text));
        }
    }

    fn definition(&mut self, entry: &DefinitionEntry, own: &Form, what: &str) {
        if let DefinitionEntry::Sequence(sequence) = entry
            && let Ok((index, _)) = parse_range(&sequence.range.text)
        {
            self.indices.push(index);
        }
        entry.texts().for_each(|written| self.written(written, Scope::default(), own, what));
        self.indices.clear();
    }

    fn list(&mut self, list: Option<&ListEntry>, needed: &Form, what: &str) {
        match list.map(|list| &list.values) {
            Some(Listing::Step(step)) => self.scalar(Some(step), needed, what),
            Some(Listing::Values(values)) => values.iter().for_each(|value| self.scalar(Some(value), needed, what)),
            Some(Listing::Integer) | None => {}
        }
    }

    fn numbers(&mut self, numbers: &Numbers, needed: &Form, what: &str) {
        match numbers {
            Numbers::One(scalar) => self.scalar(Some(scalar), needed, what),
            Numbers::Many(list, _) => list.iter().for_each(|scalar| self.scalar(Some(scalar), needed, what)),
        }
    }

    /// An expression where a number of some dimension is asked for; a bare number is one of the file's.
    fn scalar(&mut self, scalar: Option<&Scalar>, needed: &Form, what: &str) {
        if let Some(Scalar::Expression(written)) = scalar {
            self.written(written, Scope::default(), needed, what);
        }
    }

    fn written(&mut self, written: &Written, scope: Scope, needed: &Form, what: &str) {
        let Ok(ast) = parse(&written.text) else { return };
        let form = self.expression(&ast, written, scope);
        let span = Span { start: 0, end: written.text.len() };
        self.needed(written, span, &form, needed, what);
    }

    fn vector(&mut self, vector: Option<&Vector>, needed: &Form, what: &str) {
        vector.into_iter().flat_map(|vector| &vector.parts).for_each(|part| self.scalar(Some(part), needed, what));
    }

    /// Bounds and starts of a section's own dimensions. Its expressions are links.
    fn section(&mut self, section: &SectionEntry) {
        let kind = section.kind.as_ref().map(|kind| kind.text.as_str());
        for (name, entry) in &section.dimensions {
            if let DimensionEntry::Own(Range { lower, upper, start }, list) = entry {
                let own = self.of_section(kind, &name.text);
                let what = format!("`{}`", name.text);
                self.list(list.as_ref(), &own, &what);
                [lower, upper, start].into_iter().for_each(|scalar| self.scalar(scalar.as_ref(), &own, &what));
            }
        }
    }

    /// Dimensions given by expressions, each text once per dimension.
    fn links(&mut self) {
        let assembly = self.assembly;
        let mut seen = std::collections::BTreeSet::new();
        for link in &assembly.links {
            let Some(form) = sections_form(&assembly.problem, link.section as usize) else { continue };
            let Some(&name) = form.dimensions.get(link.position as usize) else { continue };
            if !seen.insert((link.text, name)) {
                continue;
            }
            let Some(text) = assembly.texts.get(link.text as usize) else { continue };
            let written = Written { place: link.place, inside: link.inside, text: text.text.clone() };
            let needed = self.of_section(Some(form.kind), name);
            let scope = Scope { holder: Some(Collection::Sections), itself: Some(name) };
            self.written(&written, scope, &needed, &format!("`{name}`"));
        }
    }

    fn structure(&mut self, entries: &StructureEntries) {
        let gravity = self.unknown("gravity".into());
        if let Some(vector) = &entries.gravity {
            self.vector(Some(vector), &gravity, "`gravity`");
            // gravity·density·volume is a weight.
            let density = self.of_material("density");
            let weight = gravity.times(&density, Ratio::ONE);
            if let Some(weight) = weight {
                let per_volume = Dimension::whole([-3, 1, 0, 0]);
                if self.inference.equal(&weight, &per_volume.into()).is_err() {
                    let help = "a density of mass goes with an acceleration; a specific weight with gravity = [0, 0, -1]";
                    let message = "gravity times density is no weight per volume".to_owned();
                    self.disagree(vector.place, message, Some(help.into()));
                }
            }
        }
        for material in &entries.materials {
            for (name, scalar) in &material.numbers {
                let needed = self.of_material(&name.text);
                self.scalar(Some(scalar), &needed, &format!("`{}`", name.text));
            }
        }
        for node in &entries.nodes {
            self.vector(node.at.as_ref(), &Dimension::LENGTH.into(), "a coordinate");
        }
        for (name, scalar) in &entries.masses {
            self.scalar(Some(scalar), &Dimension::MASS.into(), &format!("the mass of `{}`", name.text));
        }
        for support in &entries.supports {
            for (name, scalar) in &support.springs {
                let stiffness = if turns(name) { Dimension::MOMENT } else { Dimension::whole([-1, 1, 0, 0]) };
                self.scalar(Some(scalar), &stiffness.into(), &format!("a spring `{}`", name.text));
            }
        }
        entries.loads.iter().for_each(|load| self.load(load));
        for (name, factor) in entries.combinations.iter().flat_map(|combination| &combination.factors) {
            self.scalar(Some(factor), &Dimension::NONE.into(), &format!("the factor of `{}`", name.text));
        }
    }

    fn load(&mut self, load: &LoadEntry) {
        let at_a_point = load.nodes.is_some() || load.at.is_some();
        let force = if at_a_point { Dimension::FORCE } else { Dimension::whole([-1, 1, 0, 0]) };
        let what = if at_a_point { "a force" } else { "a force along a rib" };
        self.vector(load.force.as_ref(), &force.into(), what);
        self.vector(load.force_end.as_ref(), &force.into(), what);
        self.vector(load.moment.as_ref(), &Dimension::MOMENT.into(), "a moment");
        for (scalar, word) in [(&load.from, "`from`"), (&load.to, "`to`"), (&load.at, "`at`")] {
            self.scalar(scalar.as_ref(), &Dimension::NONE.into(), word);
        }
        for (scalar, word) in [(&load.temperature, "`temperature`"), (&load.gradient, "`gradient`")] {
            self.scalar(scalar.as_ref(), &Dimension::TEMPERATURE.into(), word);
        }
        self.scalar(load.pretension.as_ref(), &Dimension::FORCE.into(), "`pretension`");
        for (name, scalar) in load.displacement.iter().flatten() {
            let needed = if turns(name) { Dimension::NONE } else { Dimension::LENGTH };
            self.scalar(Some(scalar), &needed.into(), &format!("a displacement `{}`", name.text));
        }
    }

    fn constraint(&mut self, at: usize, entry: &ConstraintEntry) {
        let scope = Scope { holder: entry.repeated, itself: None };
        if let Some(written) = &entry.filter
            && let Ok(condition) = parse_condition(&written.text)
        {
            self.condition(&condition, written, scope);
        }
        let index = entry.index.as_ref().and_then(|written| parse_range(&written.text).ok());
        self.indices.extend(index.map(|(name, _)| name));
        if let Some(written) = &entry.require
            && let Some(requirement) = self.assembly.requirements.get(&written.place)
        {
            let form = self.requirement(requirement, written, scope);
            let name = entry.name.as_ref().map_or_else(|| format!("c{}", at + 1), |name| name.text.clone());
            self.rows.push((name, form));
        }
        self.indices.clear();
    }
}

/// Whether a direction is one about an axis.
fn turns(name: &Name) -> bool {
    name.text.trim_start_matches('k').starts_with('r')
}
