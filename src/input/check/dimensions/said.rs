//! What was inferred, for `check --units`.

use super::Measured;
use super::walk::Walk;
use crate::expression::ast::Collection;
use crate::input::declaration::Declaration;
use crate::problem::Formula;
use crate::problem::resolve::Value;

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

    fn one(&mut self, name: String, key: String, value: Option<f64>) -> Measured {
        let form = self.unknown(key);
        Measured { name, dimension: self.known(&form), value }
    }
}
