//! Where and when a constraint looks at the structure: the one case, station and point that its responses have in common.

use std::sync::Arc;

use crate::problem::formula::{Response, What};
use crate::problem::modes::NO_SET;
use crate::problem::{Constraint, Formula, Problem};
use crate::report::utilisation::Place;

/// The place of a constraint; a part is left empty where its responses differ in it.
pub(super) fn of(problem: &Problem, constraint: &Constraint) -> Place {
    let Some(structure) = problem.structure.as_deref() else { return Place::default() };
    let mut found = Found::default();
    let mut definitions = vec![false; problem.definitions.len()];
    for formula in constraint.asked() {
        found.look(formula, problem, &mut definitions);
    }
    let case = only(&found.sets).map_or(String::new(), |&set| structure.load_set_name(set).to_owned());
    let point = only(&found.points).map_or(String::new(), |point| point.to_string());
    let mut place = Place { case, station: only(&found.stations).copied(), point };
    complete(&mut place, &constraint.detail, |name| structure.load_set(name).is_some());
    place
}

/// What a row is told apart by says the rest: limits of bars that may vanish are on their forces, which have no point.
fn complete(place: &mut Place, detail: &str, is_case: impl Fn(&str) -> bool) {
    const WAYS: [&str; 3] = ["tension", "compression", "torsion reversed"];
    // Signs of moments, stations of other forces and bounds of rows that checks by codes state.
    const BEGINNINGS: [&str; 6] = ["+M", "-M", "N at ", "chi_", "k_", "as its "];
    let is_way = |part: &str| WAYS.contains(&part) || BEGINNINGS.iter().any(|beginning| part.starts_with(beginning));
    for part in detail.split(", ").filter(|part| !part.is_empty() && !is_way(part)) {
        match part.parse::<f64>() {
            _ if is_case(part) => {
                if place.case.is_empty() {
                    place.case = part.to_owned();
                }
            }
            Ok(station) => place.station = place.station.or(Some(station)),
            Err(_) if place.point.is_empty() => place.point = part.to_owned(),
            Err(_) => {}
        }
    }
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
            What::Mass | What::Length | What::PerForce(..) => return,
            What::Stress(station, point) | What::Shear(station, point, _) => (Some(*station), Some(point)),
            What::Deflection(_, station) | What::Sag(_, station, _) | What::Force(_, station) => (Some(*station), None),
            _ => (None, None),
        };
        if response.set != NO_SET {
            add(&mut self.sets, response.set);
        }
        station.into_iter().for_each(|station| add(&mut self.stations, station));
        point.into_iter().for_each(|point| add(&mut self.points, Arc::clone(point)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rows_detail_says_what_its_formulas_do_not() {
        let mut place = Place::default();
        complete(&mut place, "P, 0.5, centre, compression", |name| name == "P");
        assert_eq!(place, Place { case: "P".into(), station: Some(0.5), point: "centre".into() });
        complete(&mut place, "Q, 1, top", |name| name == "Q");
        assert_eq!((place.case.as_str(), place.station), ("P", Some(0.5)));
        let mut place = Place::default();
        complete(&mut place, "P, 0.5, +My, -Mz at 1, N at 0, chi_LT = 1/lambda_LT^2, as its end", |name| name == "P");
        assert_eq!(place, Place { case: "P".into(), station: Some(0.5), point: String::new() });
    }
}
