//! Where and when a constraint looks at the structure: the one case, station and point that its responses have in common.

use std::sync::Arc;

use crate::problem::formula::{Response, What};
use crate::problem::{Constraint, Formula, Problem};
use crate::report::utilisation::Place;

/// The place of a constraint; a part is left empty where its responses differ in it.
pub(super) fn of(problem: &Problem, constraint: &Constraint) -> Place {
    let Some(structure) = problem.structure.as_deref() else { return Place::default() };
    let mut found = Found::default();
    let mut definitions = vec![false; problem.definitions.len()];
    for formula in std::iter::once(&constraint.left).chain(constraint.right.formulas()) {
        found.look(formula, problem, &mut definitions);
    }
    let case = only(&found.sets).map_or(String::new(), |&set| structure.load_set_name(set).to_owned());
    Place { case, station: only(&found.stations).copied(), point: only(&found.points).map_or(String::new(), |p| p.to_string()) }
}

fn only<T>(list: &[T]) -> Option<&T> {
    if let [one] = list { Some(one) } else { None }
}

#[derive(Default)]
struct Found {
    sets: Vec<u32>,
    stations: Vec<f64>,
    points: Vec<Arc<str>>,
}

fn add<T: PartialEq>(list: &mut Vec<T>, value: T) {
    if !list.contains(&value) {
        list.push(value);
    }
}

impl Found {
    fn look(&mut self, formula: &Formula, problem: &Problem, definitions: &mut [bool]) {
        match formula {
            Formula::Response(response) => self.note(response),
            Formula::Definition(definition) => {
                let at = *definition as usize;
                if !std::mem::replace(&mut definitions[at], true) {
                    self.look(&problem.definitions[at].1, problem, definitions);
                }
            }
            Formula::Unary(_, inner) | Formula::Profile(_, inner) => self.look(inner, problem, definitions),
            Formula::Binary(_, left, right) => {
                self.look(left, problem, definitions);
                self.look(right, problem, definitions);
            }
            Formula::Fold(_, list) => list.iter().for_each(|part| self.look(part, problem, definitions)),
            Formula::Over { body, .. } => self.look(body, problem, definitions),
            _ => {}
        }
    }

    fn note(&mut self, response: &Response) {
        let (station, point) = match &response.what {
            What::Mass | What::Length => return,
            What::Stress(station, point) | What::Shear(station, point, _) => (Some(*station), Some(point)),
            What::Deflection(_, station) | What::Sag(_, station, _) | What::Force(_, station) => (Some(*station), None),
            _ => (None, None),
        };
        add(&mut self.sets, response.set);
        station.into_iter().for_each(|station| add(&mut self.stations, station));
        point.into_iter().for_each(|point| add(&mut self.points, Arc::clone(point)));
    }
}
