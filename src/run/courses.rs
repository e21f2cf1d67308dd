//! What a structure does along all its ribs at a design: displacements and forces at many stations, for tables and pictures.

use std::sync::Arc;

use super::analyse::responses::{carrying, grounded};
use super::{MOST_LISTED, Subject};
use crate::model::{AssemblyError, EvaluationError, Lifted, Model, Reduced};
use crate::problem::evaluate::Evaluation;
use crate::problem::formula::{Response, Subject as Of, What};
use crate::problem::statics::Statics;
use crate::problem::structure::{Action, Structure};
use crate::problem::{Constraint, Dimension, Formula, Problem, Scope};
use crate::report::structure::{CaseCourses, Courses, MemberPlace, NodePlace};
use crate::structure::algebra::Numbers;
use crate::structure::axes::frame;
use crate::structure::beam::Force;

/// Stations of a small structure: fine enough for a smooth curve.
const FINE: usize = 17;

/// Places (members, stations and cases) up to which stations are so fine.
const FINE_PLACES: usize = 20_000;

/// Point loads on ribs that have stations of their own on either side, at the most.
const MOST_JUMPS: usize = 8;

/// Half the distance of these two, a share of the rib.
const JUMP: f64 = 1e-6;

/// The courses at x; `None` without a structure or a case, and where there would be more than [`MOST_LISTED`] places.
///
/// # Errors
/// A term that is too dense, or a response without a value.
pub(super) fn courses(subject: &Subject, x: &[f64]) -> Result<Option<Courses>, CoursesError> {
    let problem = subject.problem();
    let (Some(structure), Some(statics)) = (problem.structure.as_deref(), problem.statics.as_deref()) else { return Ok(None) };
    let sets = structure.load_sets();
    let Some(stations) = stations(structure).filter(|_| sets > 0) else { return Ok(None) };
    let mut courses = placed(problem, structure, statics, x);
    courses.cases = vec![CaseCourses::default(); sets];
    for (set, case) in courses.cases.iter_mut().enumerate() {
        case.name = structure.load_set_name(set as u32).to_owned();
        case.nodes = vec![[0.0; 6]; courses.nodes.len()];
        case.forces = vec![[0.0; 6]; structure.members.len() * stations.len()];
        case.moved = vec![[0.0; 3]; structure.members.len() * stations.len()];
    }
    courses.stations = stations;
    let mut asked = Asked::default();
    (0..sets as u32).for_each(|set| asked.list(structure, statics, set, &courses.stations));
    let deflections = asked.answer(problem, structure, x, &mut courses)?;
    displace(structure, &deflections, &mut courses);
    courses.without_rounding();
    Ok(Some(courses))
}

/// Why there are none.
#[derive(Debug, thiserror::Error)]
pub(super) enum CoursesError {
    /// The model is too large.
    #[error(transparent)]
    Assembly(#[from] AssemblyError),
    /// There is no value.
    #[error(transparent)]
    Value(#[from] EvaluationError),
}

/// Fine ones where the structure is small, and on either side of point loads; else the file's; none where there were too many places.
fn stations(structure: &Structure) -> Option<Vec<f64>> {
    let lines = structure.members.len() * structure.load_sets();
    if lines * FINE > FINE_PLACES {
        return (lines * structure.stations.len() <= MOST_LISTED).then(|| structure.stations.clone());
    }
    let mut stations: Vec<f64> = (0..FINE).map(|at| at as f64 / (FINE - 1) as f64).collect();
    let mut jumps: Vec<f64> = Vec::new();
    for load in &structure.loads {
        if let Action::Point { at, .. } = load.action
            && !jumps.contains(&at)
            && jumps.len() < MOST_JUMPS
        {
            jumps.push(at);
        }
    }
    let beside = jumps.iter().flat_map(|at| [at - JUMP, at + JUMP]).filter(|at| (0.0..=1.0).contains(at));
    stations.extend(beside);
    stations.sort_by(f64::total_cmp);
    Some(stations)
}

/// Nodes and members where the design puts them.
pub(super) fn placed(problem: &Problem, structure: &Structure, statics: &Statics, x: &[f64]) -> Courses {
    let evaluation = Evaluation::at(problem, x);
    let value = |coordinate: Dimension| evaluation.dimension(u32::MAX, coordinate).unwrap_or(f64::NAN);
    let place = |node: usize| NodePlace {
        name: structure.nodes.names[node].to_owned(),
        position: structure.nodes.position[node].map(value),
        held: [false; 6],
    };
    let mut nodes: Vec<NodePlace> = (0..structure.nodes.names.len()).map(place).collect();
    for support in &structure.supports {
        let held = std::array::from_fn(|at| support.fixed[at] || support.springs[at] != 0.0);
        nodes[support.node as usize].held = held;
    }
    let member = |(number, member): (usize, &crate::problem::structure::Member)| {
        let end = |end: usize, node: u32| -> [f64; 3] {
            let position = nodes[node as usize].position;
            std::array::from_fn(|axis| position[axis] + member.offset[end][axis])
        };
        let ends = [end(0, member.start), end(1, member.end)];
        let along = std::array::from_fn(|axis| ends[1][axis] - ends[0][axis]);
        let axes = frame(&mut Numbers, along, statics.members[number].rule, member.roll).axes;
        let name = problem.ribs.names[member.rib as usize].to_owned();
        MemberPlace { rib: member.rib as usize, name, nodes: [member.start, member.end], ends, axes, pinned: member.pinned }
    };
    let members = structure.members.iter().enumerate().map(member).collect();
    Courses { plane: structure.plane, nodes, members, simple_cases: structure.cases.len(), ..Courses::default() }
}

/// What one constraint of the model of responses is: its set, and what of its items.
#[derive(Clone, Copy)]
enum Row {
    Displacement(usize, usize),
    Reaction(usize, usize),
    Force(usize, usize, usize),
    Deflection(usize, bool, usize),
}

/// Constraints, and what they are.
#[derive(Default)]
struct Asked {
    rows: Vec<Row>,
    constraints: Vec<Constraint>,
}

/// Deflections of every member at every station along its z and its y, set by set.
type Deflections = Vec<Vec<[f64; 2]>>;

impl Asked {
    fn ask(&mut self, row: Row, set: u32, scope: Scope, what: What) {
        self.rows.push(row);
        let left = Formula::Response(Arc::new(Response { set, subject: Of::Own, what }));
        self.constraints.push(Constraint::unlimited("", scope, left));
    }

    fn list(&mut self, structure: &Structure, statics: &Statics, set: u32, stations: &[f64]) {
        let number = set as usize;
        for direction in 0..6 {
            let exists = |node: &u32| statics.exists[*node as usize][direction];
            let known: Vec<u32> = (0..structure.nodes.names.len() as u32).filter(exists).collect();
            self.ask(Row::Displacement(number, direction), set, Scope::Nodes(known), What::Displacement(direction as u8));
            let held = Scope::Nodes(grounded(structure, direction));
            self.ask(Row::Reaction(number, direction), set, held, What::Reaction(direction as u8));
        }
        for (at, (_, force)) in Force::NAMED.into_iter().enumerate() {
            let ribs = carrying(structure, statics, force);
            for (station, &s) in stations.iter().enumerate() {
                self.ask(Row::Force(number, at, station), set, Scope::Ribs(ribs.clone()), What::Force(force, s));
            }
        }
        for (vertical, moment) in [(true, Force::My), (false, Force::Mz)] {
            let ribs = carrying(structure, statics, moment);
            // At its ends a rib lies on its chord.
            for (station, &s) in stations.iter().enumerate().filter(|(_, s)| **s > 0.0 && **s < 1.0) {
                let what = What::Deflection(vertical, s);
                self.ask(Row::Deflection(number, vertical, station), set, Scope::Ribs(ribs.clone()), what);
            }
        }
    }

    /// Fills in displacements of nodes, reactions and forces; brings back deflections.
    fn answer(
        self,
        problem: &Problem,
        structure: &Structure,
        x: &[f64],
        courses: &mut Courses,
    ) -> Result<Deflections, CoursesError> {
        let mut deflections = vec![vec![[0.0; 2]; structure.members.len() * courses.stations.len()]; courses.cases.len()];
        let (objective, auxiliaries) = (Formula::default(), Vec::new());
        let asked = Problem { constraints: self.constraints, objective, auxiliaries, ..problem.clone() };
        let Some(model) = Reduced::of(Lifted::of(&Arc::new(asked))?, false) else { return Ok(deflections) };
        let mut values = vec![0.0; model.meta().rows()];
        model.constraints(&x[..model.meta().variables().min(x.len())], &mut values)?;
        let inner = model.lifted().inner();
        let constraints = &model.lifted().problem().constraints;
        let per_member = courses.stations.len();
        let place = |rib: u32, station: usize| structure.member(rib).map_or(0, |member| member as usize * per_member + station);
        let mut reactions: Vec<Vec<(u32, [f64; 6])>> = vec![Vec::new(); courses.cases.len()];
        for list in &mut reactions {
            *list = structure.supports.iter().map(|support| (support.node, [0.0; 6])).collect();
        }
        let mut cases = std::mem::take(&mut courses.cases);
        for (at, &value) in values.iter().enumerate() {
            let origin = inner.row_origin(at);
            let (Scope::Nodes(items) | Scope::Ribs(items)) = &constraints[origin.constraint as usize].scope else { continue };
            let item = items[origin.item as usize];
            match self.rows[origin.constraint as usize] {
                Row::Displacement(set, direction) => cases[set].nodes[item as usize][direction] = value,
                Row::Reaction(set, direction) => {
                    reactions[set].iter_mut().filter(|(node, _)| *node == item).for_each(|(_, all)| all[direction] = value);
                }
                Row::Force(set, force, station) => cases[set].forces[place(item, station)][force] = value,
                Row::Deflection(set, vertical, station) => {
                    deflections[set][place(item, station)][usize::from(!vertical)] = value;
                }
            }
        }
        for (case, reactions) in cases.iter_mut().zip(reactions) {
            case.reactions = reactions;
        }
        courses.cases = cases;
        Ok(deflections)
    }
}

/// Displacements along the ribs: of the straight line between their ends, which rigid arms may carry, and of the rib from that line.
fn displace(structure: &Structure, deflections: &Deflections, courses: &mut Courses) {
    let stations = courses.stations.clone();
    for (case, deflections) in courses.cases.iter_mut().zip(deflections) {
        for (number, (member, place)) in structure.members.iter().zip(&courses.members).enumerate() {
            let end = |end: usize, node: u32| carried(case.nodes[node as usize], member.offset[end]);
            let [from, to] = [end(0, member.start), end(1, member.end)];
            for (station, s) in stations.iter().enumerate() {
                let at = number * stations.len() + station;
                let [along_z, along_y] = deflections[at];
                case.moved[at] = std::array::from_fn(|axis| {
                    from[axis] + s * (to[axis] - from[axis]) + along_z * place.axes[2][axis] + along_y * place.axes[1][axis]
                });
            }
        }
    }
}

/// The displacement at the end of a rigid arm: u + θ × r.
fn carried([x, y, z, rx, ry, rz]: [f64; 6], [a, b, c]: [f64; 3]) -> [f64; 3] {
    [x + ry * c - rz * b, y + rz * a - rx * c, z + rx * b - ry * a]
}
