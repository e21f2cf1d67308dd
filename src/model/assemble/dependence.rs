//! What is true of formulas and worth asking once: do they reach over items, do they hold variables?

use crate::problem::{Dimension, Formula, Problem};

/// Two answers per definition and one per section, computed once.
pub(super) struct Dependence {
    /// Which variables count as numbers.
    given: Vec<bool>,
    definition_reaches: Vec<bool>,
    definition_constant: Vec<bool>,
    section_constant: Vec<bool>,
    lengths_vary: bool,
}

impl Dependence {
    pub fn of(problem: &Problem) -> Dependence {
        Dependence::beside(problem, Vec::new())
    }

    /// The same where these variables, one flag each, count as numbers.
    pub fn beside(problem: &Problem, given: Vec<bool>) -> Dependence {
        let mut facts = Dependence {
            given,
            definition_reaches: vec![false; problem.definitions.len()],
            definition_constant: vec![true; problem.definitions.len()],
            section_constant: Vec::new(),
            lengths_vary: (0..problem.ribs.names.len() as u32)
                .any(|rib| problem.structure.as_deref().is_some_and(|structure| structure.moves(rib))),
        };
        // Definitions stand in any order and are free of cycles: at most as many rounds as definitions settle them.
        while facts.improve(problem) {}
        facts.section_constant = (0..problem.sections.names.len())
            .map(|section| {
                problem.dimensions(section).iter().all(|dimension| match dimension {
                    Dimension::Constant(_) => true,
                    Dimension::Variable(variable) => facts.is_given(*variable),
                    Dimension::Formula(formula) => facts.is_constant(&problem.dimension_formulas[*formula as usize]),
                })
            })
            .collect();
        facts
    }

    fn improve(&mut self, problem: &Problem) -> bool {
        let mut changed = false;
        for (index, (_, formula)) in problem.definitions.iter().enumerate() {
            let (reaches, constant) = (self.reaches_items(formula), self.is_constant(formula));
            changed |= reaches != self.definition_reaches[index] || constant != self.definition_constant[index];
            self.definition_reaches[index] = reaches;
            self.definition_constant[index] = constant;
        }
        changed
    }

    /// True where a sum over items or a rib's volume stands inside, so that it is worth taking apart.
    pub fn reaches_items(&self, formula: &Formula) -> bool {
        match formula {
            Formula::Over { .. } | Formula::Volume(_) | Formula::RibVolume(_) | Formula::OwnVolume => true,
            Formula::Definition(definition) => self.definition_reaches[*definition as usize],
            other => other.children().any(|one| self.reaches_items(one)),
        }
    }

    fn is_given(&self, variable: u32) -> bool {
        self.given.get(variable as usize).is_some_and(|given| *given)
    }

    /// True where no variable can stand inside.
    pub fn is_constant(&self, formula: &Formula) -> bool {
        match formula {
            Formula::OwnLength => !self.lengths_vary,
            Formula::Variable(variable) => self.is_given(*variable),
            Formula::RibVolume(_)
            | Formula::Volume(_)
            | Formula::OwnProperty(_)
            | Formula::EndProperty(..)
            | Formula::AtProperty(..)
            | Formula::OwnVolume
            | Formula::Profile(..)
            | Formula::Response(_) => false,
            Formula::Definition(definition) => self.definition_constant[*definition as usize],
            Formula::SectionProperty(section, _) => {
                self.section_constant.get(*section as usize).is_some_and(|constant| *constant)
            }
            other => other.children().all(|one| self.is_constant(one)),
        }
    }
}
