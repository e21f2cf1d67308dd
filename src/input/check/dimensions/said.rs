//! What was inferred, for `check --units`.

use std::collections::BTreeMap;

use super::Measured;
use super::walk::Walk;
use crate::expression::ast::Collection;
use crate::input::declaration::Declaration;
use crate::problem::resolve::Value;
use crate::problem::{Formula, Origin, sections_form};
use crate::units::{Dimension, Shown};

impl Walk<'_, '_> {
    /// Parameters, variables, definitions and data with their dimensions.
    pub fn measured(&mut self, declared: &Declaration) -> Vec<Measured> {
        let mut list = Vec::new();
        for (at, (name, _)) in declared.parameters.iter().enumerate() {
            let value = match self.assembly.parameters.get(at) {
                Some(Some(Value::Scalar(Formula::Constant(value)))) => Some(*value),
                _ => None,
            };
            list.push(self.one(name.text.clone(), format!("name: {}", name.text), value));
        }
        for entry in &declared.variables {
            list.push(self.one(entry.name.text.clone(), format!("name: {}", entry.name.text), None));
        }
        for (name, _) in &declared.definitions {
            list.push(self.one(name.text.clone(), format!("name: {}", name.text), None));
        }
        for holder in [Collection::Sections, Collection::Ribs, Collection::Nodes] {
            let columns = self.assembly.problem.columns(holder);
            let mut names: Vec<&str> = columns.iter().map(|column| column.name.split('[').next().unwrap_or_default()).collect();
            names.dedup();
            for name in names {
                let form = self.datum(holder, name);
                let dimension = self.known(&form);
                list.push(Measured { name: format!("{name} (data)"), dimension, value: None });
            }
        }
        let mut of_materials: Vec<&str> = Vec::new();
        for (name, _) in declared.structure.materials.iter().flat_map(|material| &material.numbers) {
            if !of_materials.contains(&name.text.as_str()) {
                of_materials.push(&name.text);
            }
        }
        for name in of_materials {
            let form = self.of_material(name);
            let dimension = self.known(&form);
            list.push(Measured { name: format!("material.{name}"), dimension, value: None });
        }
        list
    }

    /// What variables, rows and the objective measure, and what that is told in.
    pub fn shown(&mut self, declared: &Declaration) -> Shown {
        let (rows, objective) = (std::mem::take(&mut self.rows), self.objective.take());
        let mut shown = Shown { system: self.assembly.units.clone(), wanted: declared.show.clone(), ..Shown::default() };
        shown.rows = rows.into_iter().filter_map(|(name, form)| Some((name, self.known(&form)?))).collect();
        shown.objective = match declared.objective {
            Some(_) => objective.and_then(|form| self.known(&form)),
            None => Some(Dimension::whole([3, 0, 0, 0])),
        };
        for entry in &declared.variables {
            let form = self.unknown(format!("name: {}", entry.name.text));
            shown.variables.extend(self.known(&form).map(|dimension| (entry.name.text.clone(), dimension)));
        }
        self.show_sections(&mut shown);
        shown
    }

    /// Variables that are dimensions of sections: by the dimension's name alone where all kinds with it agree what it measures, for there may
    /// be a million of them.
    fn show_sections(&mut self, shown: &mut Shown) {
        let problem = &self.assembly.problem;
        let dimension = |j: usize| match problem.variables.origin[j] {
            Origin::Dimension(section, position) => {
                sections_form(problem, section as usize).map(|form| (form.dimensions[usize::from(position)], form.kind))
            }
            _ => None,
        };
        let mut measured: BTreeMap<(&str, &str), Option<Dimension>> = BTreeMap::new();
        for (name, kind) in (0..problem.variables.origin.len()).filter_map(dimension) {
            measured.entry((name, kind)).or_insert_with(|| {
                let form = self.of_section(Some(kind), name);
                self.known(&form)
            });
        }
        let agree = |name: &str| {
            let mut all = measured.range((name, "")..).take_while(|((other, _), _)| *other == name).map(|(_, measures)| measures);
            all.next().is_none_or(|first| all.all(|other| other == first))
        };
        for (&(name, _), measures) in measured.iter().filter(|((name, _), _)| agree(name)) {
            shown.variables.extend(measures.map(|measures| (format!(".{name}"), measures)));
        }
        for j in 0..problem.variables.origin.len() {
            let Some((name, kind)) = dimension(j).filter(|(name, _)| !agree(name)) else { continue };
            shown.variables.extend(measured[&(name, kind)].map(|measures| (problem.variable_name(j), measures)));
        }
    }

    fn one(&mut self, name: String, key: String, value: Option<f64>) -> Measured {
        let form = self.unknown(key);
        Measured { name, dimension: self.known(&form), value }
    }
}
