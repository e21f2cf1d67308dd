//! Every displacement, reaction, force and stress of a structure, in all cases and combinations: rows of one model.

use std::collections::HashMap;
use std::sync::Arc;

use crate::model::structural::mechanism;
use crate::model::{AssemblyError, EvaluationError, Lifted, Model, Reduced};
use crate::problem::formula::{Response, Subject, What};
use crate::problem::statics::Statics;
use crate::problem::structure::{Plane, Structure};
use crate::problem::{Constraint, Formula, Problem, Scope};
use crate::sections;
use crate::structure::beam::Force;

/// With more members than this, forces are looked at in the start, the middle and the end only.
const MANY_MEMBERS: usize = 10_000;

/// What a structure does in one case or combination.
#[derive(Debug, Default)]
pub struct CaseResponses {
    /// The case or combination.
    pub name: String,
    /// Node, direction, displacement or rotation.
    pub displacements: Vec<(u32, usize, f64)>,
    /// Node, direction, what the ground exerts.
    pub reactions: Vec<(u32, usize, f64)>,
    /// Extremes by rib and by force.
    pub forces: Vec<Extreme>,
    /// Extremes of normal stress by rib.
    pub stresses: Vec<Extreme>,
}

/// The smallest and the largest value of something along a rib.
#[derive(Debug, Clone)]
pub struct Extreme {
    /// The rib.
    pub rib: u32,
    /// `N`, `My`, …; empty for stresses.
    pub of: &'static str,
    /// The smallest value, its station and its point (of stresses).
    pub least: (f64, f64, &'static str),
    /// The largest.
    pub most: (f64, f64, &'static str),
}

/// What one constraint of the model of responses is.
#[derive(Clone, Copy)]
enum Row {
    Displacement(u32, usize),
    Reaction(u32, usize),
    Force(u32, &'static str, f64),
    Stress(u32, f64, &'static str),
}

/// The model of every response.
pub struct Responses {
    model: Reduced<Lifted>,
    rows: Vec<Row>,
}

impl Responses {
    /// The model; `None` where there is no structure, or none that can move.
    ///
    /// # Errors
    /// A term is too dense.
    pub fn of(problem: &Problem) -> Result<Option<Self>, AssemblyError> {
        let (Some(structure), Some(statics)) = (problem.structure.as_deref(), problem.statics.as_deref()) else {
            return Ok(None);
        };
        let mut rows = Vec::new();
        let mut constraints = Vec::new();
        for set in 0..structure.load_sets() as u32 {
            list(problem, structure, statics, set, &mut rows, &mut constraints);
        }
        let asked = Problem { constraints, objective: Formula::default(), auxiliaries: Vec::new(), ..problem.clone() };
        let model = Reduced::of(Lifted::of(&Arc::new(asked))?, false);
        Ok(model.map(|model| Responses { model, rows }))
    }

    /// How the structure moves without resistance, in words; `None` where it does not.
    ///
    /// # Errors
    /// The state equations have no value.
    pub fn mechanism(&self, x: &[f64]) -> Result<Option<String>, EvaluationError> {
        mechanism(self.model.lifted(), x)
    }

    /// The responses of every case and combination.
    ///
    /// # Errors
    /// Some response has no value.
    pub fn by_case(&self, x: &[f64]) -> Result<Vec<CaseResponses>, EvaluationError> {
        let mut values = vec![0.0; self.model.meta().rows()];
        self.model.constraints(x, &mut values)?;
        Ok(self.collected(&values))
    }

    /// The largest residual of an equilibrium equation over the largest sum of the sizes of one's terms.
    ///
    /// # Errors
    /// The state equations have no value.
    pub fn residual(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.model.lifted().residual(&self.model.solved(x)?)
    }

    fn collected(&self, values: &[f64]) -> Vec<CaseResponses> {
        let asked = self.model.lifted().problem();
        let Some(structure) = asked.structure.as_deref() else { return Vec::new() };
        let named = |set: u32| CaseResponses { name: structure.load_set_name(set).to_owned(), ..CaseResponses::default() };
        let mut cases: Vec<CaseResponses> = (0..structure.load_sets() as u32).map(named).collect();
        let mut known = Known::new();
        let inner = self.model.lifted().inner();
        for (at, &value) in values.iter().enumerate() {
            let origin = inner.row_origin(at);
            let item = match &asked.constraints[origin.constraint as usize].scope {
                Scope::Nodes(items) | Scope::Ribs(items) => items[origin.item as usize],
                _ => continue,
            };
            match self.rows[origin.constraint as usize] {
                Row::Displacement(set, direction) => cases[set as usize].displacements.push((item, direction, value)),
                Row::Reaction(set, direction) => cases[set as usize].reactions.push((item, direction, value)),
                Row::Force(set, of, station) => {
                    widen(&mut known, (set, item, of), &mut cases[set as usize].forces, (value, station, ""));
                }
                Row::Stress(set, station, point) => {
                    widen(&mut known, (set, item, ""), &mut cases[set as usize].stresses, (value, station, point));
                }
            }
        }
        cases.iter_mut().for_each(without_rounding);
        cases.iter_mut().for_each(|case| case.displacements.sort_by_key(|&(node, direction, _)| (node, direction)));
        cases.iter_mut().for_each(|case| case.reactions.sort_by_key(|&(node, direction, _)| (node, direction)));
        cases
    }
}

fn list(
    problem: &Problem,
    structure: &Structure,
    statics: &Statics,
    set: u32,
    rows: &mut Vec<Row>,
    constraints: &mut Vec<Constraint>,
) {
    let mut ask = |row: Row, scope: Scope, what: What| {
        let left = Formula::Response(Arc::new(Response { set, subject: Subject::Own, what }));
        constraints.push(Constraint::unlimited("", scope, left));
        rows.push(row);
    };
    let nodes = 0..structure.nodes.names.len() as u32;
    for direction in 0..6 {
        let known: Vec<u32> = nodes.clone().filter(|&node| statics.exists[node as usize][direction]).collect();
        ask(Row::Displacement(set, direction), Scope::Nodes(known), What::Displacement(direction as u8));
        ask(Row::Reaction(set, direction), Scope::Nodes(grounded(structure, direction)), What::Reaction(direction as u8));
    }
    let stations: Vec<f64> = match structure.members.len() > MANY_MEMBERS {
        true => vec![0.0, 0.5, 1.0],
        false => structure.stations.clone(),
    };
    for (name, force) in Force::NAMED {
        let ribs = carrying(structure, statics, force);
        for &station in &stations {
            ask(Row::Force(set, name, station), Scope::Ribs(ribs.clone()), What::Force(force, station));
        }
    }
    for (point, ribs) in points(problem, structure) {
        for &station in &stations {
            ask(Row::Stress(set, station, point), Scope::Ribs(ribs.clone()), What::Stress(station, Arc::from(point)));
        }
    }
}

/// Nodes that something holds in a direction: fixed, or by a spring.
pub(in crate::run) fn grounded(structure: &Structure, direction: usize) -> Vec<u32> {
    let held = structure.supports.iter().filter(|support| support.fixed[direction] || support.springs[direction] != 0.0);
    held.map(|support| support.node).collect()
}

/// The ribs that a force can be in.
pub(in crate::run) fn carrying(structure: &Structure, statics: &Statics, force: Force) -> Vec<u32> {
    let component = match force {
        Force::N => 0..1,
        Force::T => 5..6,
        Force::Mz | Force::Vy => 1..3,
        Force::My | Force::Vz => 3..5,
    };
    // A member hinged at both ends bends under loads on its span.
    let bends = |member: usize| match force {
        Force::N | Force::T => false,
        Force::My | Force::Vz => !structure.members[member].pinned,
        Force::Mz | Force::Vy => !structure.members[member].pinned && structure.plane == Plane::Space,
    };
    let carries = |member: &usize| bends(*member) || statics.members[*member].components[component.clone()].contains(&true);
    (0..structure.members.len()).filter(carries).map(|member| structure.members[member].rib).collect()
}

/// The critical points of normal stress, each with the ribs that have it.
fn points(problem: &Problem, structure: &Structure) -> Vec<(&'static str, Vec<u32>)> {
    let mut list: Vec<(&'static str, Vec<u32>)> = Vec::new();
    for member in &structure.members {
        let form = problem.sections.form[problem.ribs.from[member.rib as usize] as usize];
        let points = sections::kind_of(form).points(sections::form(form));
        let names = match (member.pinned, structure.plane) {
            (true, _) => &["centre"],
            (false, Plane::Space) => points.normal,
            (false, _) => points.upright,
        };
        for &name in names {
            match list.iter_mut().find(|(known, _)| *known == name) {
                Some((_, ribs)) => ribs.push(member.rib),
                None => list.push((name, vec![member.rib])),
            }
        }
    }
    list
}

/// What rounding leaves of a zero, relative to the largest value of its kind in the structure.
const ROUNDING: f64 = 1e-12;

/// Forces and moments, displacements and rotations that are zero but for rounding are zero.
fn without_rounding(case: &mut CaseResponses) {
    let turns = |of: &str| matches!(of, "T" | "My" | "Mz");
    for moments in [false, true] {
        let of_kind = |extreme: &&mut Extreme| turns(extreme.of) == moments;
        let reach = |extreme: &Extreme| extreme.least.0.abs().max(extreme.most.0.abs());
        let largest = case.forces.iter().filter(|extreme| turns(extreme.of) == moments).map(reach).fold(0.0, f64::max);
        for extreme in case.forces.iter_mut().filter(of_kind) {
            for end in [&mut extreme.least, &mut extreme.most] {
                if end.0.abs() <= ROUNDING * largest {
                    end.0 = 0.0;
                }
            }
        }
    }
    for list in [&mut case.displacements, &mut case.reactions] {
        for rotations in [false, true] {
            let of_kind = |direction: usize| (direction >= 3) == rotations;
            let largest = list.iter().filter(|(_, at, _)| of_kind(*at)).map(|(.., value)| value.abs()).fold(0.0, f64::max);
            list.iter_mut()
                .filter(|(_, at, value)| of_kind(*at) && value.abs() <= ROUNDING * largest)
                .for_each(|entry| entry.2 = 0.0);
        }
    }
}

/// Where each extreme stands in its list: by set, rib and force.
type Known = HashMap<(u32, u32, &'static str), usize>;

fn widen(known: &mut Known, key: (u32, u32, &'static str), list: &mut Vec<Extreme>, seen: (f64, f64, &'static str)) {
    let at = *known.entry(key).or_insert_with(|| {
        list.push(Extreme { rib: key.1, of: key.2, least: seen, most: seen });
        list.len() - 1
    });
    if seen.0 < list[at].least.0 {
        list[at].least = seen;
    }
    if seen.0 > list[at].most.0 {
        list[at].most = seen;
    }
}
