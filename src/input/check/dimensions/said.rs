//! What was inferred, for `check --units`.

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
        for j in 0..self.assembly.problem.variables.origin.len() {
            let Origin::Dimension(section, position) = self.assembly.problem.variables.origin[j] else { continue };
            let Some(form) = sections_form(&self.assembly.problem, section as usize) else { continue };
            let measures = self.of_section(Some(form.kind), form.dimensions[usize::from(position)]);
            let name = self.assembly.problem.variable_name(j);
            shown.variables.extend(self.known(&measures).map(|dimension| (name, dimension)));
        }
        shown
    }

    fn one(&mut self, name: String, key: String, value: Option<f64>) -> Measured {
        let form = self.unknown(key);
        Measured { name, dimension: self.known(&form), value }
    }
}
