//! Load cases, known from the loads, and `[combinations]` of them.

use super::super::Assembly;
use crate::input::declaration::Name;
use crate::input::declaration::structure::StructureEntries;
use crate::input::source::Place;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::Combination;

impl Assembly<'_> {
    /// The number of a case, new where it is met for the first time.
    pub(super) fn case(&mut self, name: &str, place: Place) -> u32 {
        if let Some(&known) = self.building.cases.get(name) {
            return known;
        }
        let number = self.building.structure.cases.len() as u32;
        self.building.structure.cases.push(name.into());
        self.building.case_places.push(place);
        self.building.cases.insert(name.into(), number);
        number
    }

    /// Where a case is met for the first time.
    pub(in crate::input::check) fn case_place(&self, case: u32) -> Place {
        self.building.case_places.get(case as usize).copied().unwrap_or(Place::Whole)
    }

    /// Where a combination is declared.
    pub(in crate::input::check) fn combination_place(&self, combination: usize) -> Place {
        self.building.combination_places.get(combination).copied().unwrap_or(Place::Whole)
    }

    pub(super) fn combinations(&mut self, entries: &StructureEntries) {
        for entry in &entries.combinations {
            self.new_combination(&entry.name);
            let mut factors = Vec::new();
            for (case, scalar) in &entry.factors {
                let found = self.building.cases.get(case.text.as_str()).copied();
                if found.is_none() {
                    self.unknown_case(case);
                }
                if let (Some(case), Some(factor)) = (found, self.finite(scalar)) {
                    factors.push((case, factor));
                }
            }
            let combination = Combination { name: entry.name.text.as_str().into(), factors };
            self.building.structure.combinations.push(combination);
            self.building.combination_places.push(entry.name.place);
        }
    }

    fn new_combination(&mut self, name: &Name) {
        if self.building.cases.contains_key(name.text.as_str()) {
            let message = format!("`{}` is a load case already", name.text);
            self.findings.mistake(
                MistakeCode::DuplicateName,
                name.place,
                message,
                "cases and combinations share their names; rename one of them",
            );
        }
    }

    fn unknown_case(&mut self, name: &Name) {
        let help = did_you_mean(&name.text, self.building.structure.cases.iter().map(|case| &**case));
        let known = || match self.building.structure.cases.as_slice() {
            [] => "cases are named by [[loads]]".to_owned(),
            list => format!("known: {}", list.join(", ")),
        };
        let help = help.unwrap_or_else(known);
        self.findings.mistake(MistakeCode::UnknownItem, name.place, format!("there is no load case `{}`", name.text), help);
    }
}
