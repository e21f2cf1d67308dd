//! Definitions that coordinates and moduli may use: those made of parameters and variables alone.

use super::super::Assembly;
use crate::expression::ast::Ast;
use crate::expression::parse::parse;
use crate::input::declaration::{Declaration, DefinitionEntry};
use crate::input::fields::Scalar;
use crate::problem::Formula;
use crate::problem::mentions::mentions;
use crate::problem::names::Entity;
use crate::problem::order::order;
use crate::problem::resolve::{Report, Resolver, Stage, Value};

impl Assembly<'_> {
    /// Values of definitions as far as parameters and variables go. Places of nodes are needed before sections are linked, when
    /// all definitions are read again and their mistakes told.
    pub(super) fn early_definitions(&mut self, declared: &Declaration) {
        let structure = &declared.structure;
        if structure.nodes.is_empty() && structure.node_table.is_none() && structure.materials.is_empty() {
            return;
        }
        let trees: Vec<Option<Ast>> = declared
            .definitions
            .iter()
            .map(|(_, entry)| match entry {
                DefinitionEntry::One(Scalar::Expression(written)) => parse(&written.text).ok(),
                DefinitionEntry::One(Scalar::Number(..)) | DefinitionEntry::Sequence(_) => None,
            })
            .collect();
        self.definitions = vec![None; trees.len()];
        let found = order(trees.len(), |at| trees[at as usize].as_ref().map_or_else(Vec::new, |tree| self.definitions_in(tree)));
        let mut circular = vec![false; trees.len()];
        found.circles.iter().flatten().for_each(|&at| circular[at as usize] = true);
        for at in found.order {
            if !circular[at as usize] {
                self.definitions[at as usize] =
                    self.early_value(&declared.definitions[at as usize].1, trees[at as usize].as_ref());
            }
        }
    }

    fn definitions_in(&self, tree: &Ast) -> Vec<u32> {
        let names = mentions(tree).0.into_iter().filter_map(|mention| match mention.parts {
            [name] => self.names.find(&self.problem, name),
            _ => None,
        });
        names.filter_map(|entity| if let Entity::Definition(at) = entity { Some(at) } else { None }).collect()
    }

    fn early_value(&self, entry: &DefinitionEntry, tree: Option<&Ast>) -> Option<Value> {
        if let DefinitionEntry::One(Scalar::Number(value, _)) = entry {
            return Some(Value::Scalar(Formula::Constant(*value)));
        }
        Resolver::new(self.world(Stage::Variables), None, &mut Report::default()).value(tree?)
    }
}
