//! From the file as declared to the checked problem: names looked up, numbers computed, sizes compared.

mod catalogues;
mod checks;
mod constants;
mod constraints;
mod data;
mod dimensions;
mod existence;
mod items;
mod links;
mod listing;
mod lists;
mod objective;
mod outlines;
mod overrides;
mod profiles;
mod requirement;
mod sequences;
mod spread;
mod structure;
mod tables;
mod unused;
mod variables;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::Arc;

use super::additions::Additions;
use super::declaration::{Declaration, Name};
use super::findings::Findings;
use super::source::{Place, Source, Written};
use super::table::Tables;
use crate::expression::ast::{Collection, Requirement};
use crate::geometry::polygon::Ring;
use crate::problem::Problem;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::modes;
use crate::problem::names::{Entity, Names};
use crate::problem::resolve::{Stage, Value, World};
use crate::units::System;
use data::DataColumns;
pub use dimensions::{Dimensions, Measured};
use links::Link;

/// The problem while it is put together. What only reading needs is dropped in the end.
pub(super) struct Assembly<'a> {
    source: &'a Source,
    pub findings: Findings,
    pub problem: Problem,
    names: Names,
    /// Where parameters, variables and definitions are declared.
    declared_at: HashMap<String, Place>,
    parameters: Vec<Option<Value>>,
    variables: Vec<(u32, Option<u32>)>,
    definitions: Vec<Option<Value>>,
    section_places: Vec<Place>,
    rib_places: Vec<Place>,
    /// Places of dimensions in the problem file (rows of tables have their line).
    dimension_places: HashMap<(u32, u8), Place>,
    section_data: DataColumns,
    rib_data: DataColumns,
    /// Dimensions given by expressions.
    links: Vec<Link>,
    /// The texts of those expressions, each once.
    texts: Vec<Written>,
    /// What the user's requirements were read as, by their places.
    requirements: BTreeMap<Place, Requirement>,
    text_numbers: HashMap<String, u32>,
    /// Points of tables' cells by their text, each kept once.
    points: HashMap<String, Option<Arc<Vec<Ring>>>>,
    used: Vec<(Collection, u32)>,
    /// The structure, until it is whole.
    building: structure::Building,
    /// The row that a constraint is being spread over.
    choice: spread::Choice,
    /// The index of the constraint at hand and its number.
    index: Option<(String, f64)>,
    /// What a table could not give.
    without: Without,
    /// Variables that take their values from lists.
    listings: Vec<(u32, listing::Listing)>,
    /// Catalogues by their names.
    catalogues: HashMap<String, Option<Arc<catalogues::Catalogue>>>,
    /// Sections that are rows of a catalogue.
    from_catalogues: Vec<(u32, Arc<catalogues::Catalogue>)>,
    /// What the file's numbers are in.
    units: System,
    /// Whether a number with a unit was met.
    quantities: bool,
    /// Columns of tables whose headers have units.
    columns: Vec<dimensions::MeasuredColumn>,
    /// Whether the text at hand was written by a check: the user cannot do anything about what it hides or states in vain.
    quiet: bool,
}

/// What tables could not give: what is missing for that reason is no further mistake.
#[derive(Default)]
struct Without {
    /// Some of the sections, as rows were passed over.
    sections: bool,
    /// A whole table.
    table: bool,
}

/// What the check brings.
pub(super) struct Checked {
    pub problem: Problem,
    pub findings: Findings,
    pub dimensions: Dimensions,
    /// The numbers of the additions' constants.
    pub constants: Vec<f64>,
}

/// Puts the problem together, reading the tables on the way.
pub(super) fn check(
    mut declared: Declaration,
    source: &Source,
    findings: Findings,
    additions: &Additions,
    tables: &mut Tables<'_>,
) -> Checked {
    let mut assembly = Assembly::new(source, findings);
    assembly.units = tables.units.clone();
    assembly.quantities = !declared.measured.is_empty();
    let overrides = assembly.overrides(&additions.changes);
    assembly.declare_names(&declared);
    assembly.parameters(&declared, &overrides);
    let constants = additions.constants().iter().filter_map(|scalar| assembly.constant(scalar)).collect();
    assembly.variables(&declared.variables);
    assembly.profiles(&declared);
    assembly.read_catalogues(&declared.catalogues, tables);
    assembly.items(&declared);
    assembly.tables(&declared, tables);
    assembly.finish_items();
    assembly.structure_after_ribs(&declared, tables);
    if assembly.without.table {
        // Names and properties would be missed that only the table could have given: nothing but grammar is looked at.
        assembly.grammar(&declared);
        let dimensions = Dimensions::default();
        return Checked { problem: assembly.problem, findings: assembly.findings, dimensions, constants };
    }
    assembly.apply(&overrides);
    assembly.lists();
    assembly.check_variables();
    assembly.finish_structure(&declared);
    assembly.links(&declared.definitions);
    assembly.objective(&declared);
    assembly.constraints(&declared.constraints);
    assembly.checks(&declared.checks);
    assembly.check_existence();
    assembly.say_unused();
    assembly.say_unused_cases();
    assembly.problem.title = declared.title.take().unwrap_or_else(|| title(source));
    let dimensions = if assembly.findings.clean() { assembly.dimensions(&declared) } else { Dimensions::default() };
    assembly.problem.units = declared.units.into_iter().map(|(key, label)| (key, label.text)).collect();
    assembly.problem.settings = declared.settings.clone();
    if assembly.findings.clean() {
        assembly.problem.prepare();
        modes::follow(&mut assembly.problem);
    }
    Checked { problem: assembly.problem, findings: assembly.findings, dimensions, constants }
}

/// The file's stem; of a `problem.toml`, the name of its folder.
fn title(source: &Source) -> String {
    let path = Path::new(&source.name);
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let folder = || path.parent()?.file_name().map(|name| name.to_string_lossy().into_owned());
    if stem == "problem" { folder().unwrap_or(stem) } else { stem }
}

impl<'a> Assembly<'a> {
    fn new(source: &'a Source, findings: Findings) -> Self {
        Assembly {
            source,
            findings,
            problem: Problem::default(),
            names: Names::default(),
            declared_at: HashMap::new(),
            parameters: Vec::new(),
            variables: Vec::new(),
            definitions: Vec::new(),
            section_places: Vec::new(),
            rib_places: Vec::new(),
            dimension_places: HashMap::new(),
            section_data: DataColumns::default(),
            rib_data: DataColumns::default(),
            links: Vec::new(),
            texts: Vec::new(),
            requirements: BTreeMap::new(),
            text_numbers: HashMap::new(),
            points: HashMap::new(),
            used: Vec::new(),
            building: structure::Building::default(),
            choice: spread::Choice::default(),
            index: None,
            without: Without::default(),
            listings: Vec::new(),
            catalogues: HashMap::new(),
            from_catalogues: Vec::new(),
            units: System::default(),
            quantities: false,
            columns: Vec::new(),
            quiet: false,
        }
    }

    /// What names can refer to by now.
    fn world(&self, stage: Stage) -> World<'_> {
        World {
            problem: &self.problem,
            names: &self.names,
            parameters: &self.parameters,
            variables: &self.variables,
            definitions: &self.definitions,
            units: &self.units,
            stage,
            chosen: self.chosen(),
        }
    }

    /// Enters the names of parameters, variables and definitions.
    fn declare_names(&mut self, declared: &Declaration) {
        let parameters = declared.parameters.iter().enumerate();
        let variables = declared.variables.iter().enumerate();
        let definitions = declared.definitions.iter().enumerate();
        let all = parameters.map(|(at, (name, _))| (name, Entity::Parameter(at as u32)));
        let all = all.chain(variables.map(|(at, entry)| (&entry.name, Entity::Variable(at as u32))));
        let all = all.chain(definitions.map(|(at, (name, _))| (name, Entity::Definition(at as u32))));
        for (name, entity) in all {
            let first = self.names.find(&self.problem, &name.text);
            if self.usable(name, entity.word()) && self.is_new(name, entity.word(), first) {
                self.names.declare(&name.text, entity);
                self.declared_at.insert(name.text.clone(), name.place);
            }
        }
    }

    /// A name must not be empty or a word of the language.
    fn usable(&mut self, name: &Name, what: &str) -> bool {
        let reserved = ["pi", "where", "and", "or", "not"].contains(&name.text.as_str());
        if reserved {
            let message = format!("`{}` is a word of the language and cannot name a {what}", name.text);
            self.findings.mistake(MistakeCode::ReservedName, name.place, message, "choose another name");
        } else if name.text.trim().is_empty() {
            self.findings.mistake(MistakeCode::ReservedName, name.place, format!("a {what} without a name"), "give it a name");
        }
        !reserved && !name.text.trim().is_empty()
    }

    /// Whether the name is free; a mistake naming both places otherwise.
    fn is_new(&mut self, name: &Name, what: &str, first: Option<Entity>) -> bool {
        let Some(first) = first else { return true };
        let place = self.entity_place(&name.text, first);
        let message = format!("the name `{}` is given twice", name.text);
        let help = format!("the {} is declared at {}; rename it or this {what}", first.word(), self.spoken(place));
        self.findings.mistake(MistakeCode::DuplicateName, name.place, message, help);
        false
    }

    fn entity_place(&self, name: &str, entity: Entity) -> Place {
        let found = match entity {
            Entity::Section(s) => self.section_places.get(s as usize),
            Entity::Rib(r) => self.rib_places.get(r as usize),
            _ => self.declared_at.get(name),
        };
        found.copied().unwrap_or(Place::Whole)
    }

    /// A place in words: `rib.toml:12`.
    fn spoken(&self, place: Place) -> String {
        match place {
            Place::File { start, .. } => format!("{}:{}", self.source.name, self.source.line(start as usize)),
            Place::Row { table, line, .. } => {
                let name = self.findings.tables.get(table as usize).map_or("", |(_, name)| name);
                format!("{name}:{line}")
            }
            Place::Argument { .. } => "--set".to_owned(),
            Place::Whole => self.source.name.clone(),
        }
    }
}
