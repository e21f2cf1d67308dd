//! The lifted model of a structure: design variables and, for every load case, the displacements of the free directions as *states*,
//! with as many state equations (equilibrium). Its elements know deformations; two constant maps lead from displacements to
//! deformations and from member forces to the equilibrium of nodes.

mod equations;

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

pub use super::states::States;
use super::stiffness::{Factors, Mechanism, Stiffness};
use super::views::composed::{Composed, Links};
use super::views::mapped::{Mapped, Maps};
use super::with_states::WithStates;
use super::{AssemblyError, EvaluationError, Meta, Model, NameTable, Names, Own, RibModel, assemble, auxiliaries};
use crate::problem::kinks::Auxiliary;
use crate::problem::statics::{Input, Statics};
use crate::problem::structure::{Action, DIRECTIONS, Structure};
use crate::problem::{Origin, Problem};

/// A structure in design variables and displacements.
///
/// What the certificate finds at a point whose displacements are those of its design holds for the reduced model, too: multipliers of the
/// state equations are the adjoints, for which the Lagrangian is stationary in the states; and as the block [L_uu Kᵀ; K 0] has as many
/// positive as negative eigenvalues whatever L_uu is, the inertia of the lifted system is that of the reduced one and of these
/// (Haynsworth 1968).
pub struct Lifted {
    model: Composed<Mapped<RibModel>, RibModel>,
    problem: Arc<Problem>,
    states: States,
    /// Node and direction of each state of a block.
    directions: Vec<(u32, u8)>,
    stiffness: Stiffness,
    /// Factors at the design analysed last: their analysis of the pattern serves again.
    latest: Mutex<Option<Factors>>,
}

impl Lifted {
    /// Assembles the lifted model.
    ///
    /// # Errors
    /// As [`assemble`].
    ///
    /// # Panics
    /// Where the problem has no prepared structure; see [`Problem::prepare`].
    pub fn of(problem: &Arc<Problem>) -> Result<Lifted, AssemblyError> {
        let (structure, statics) = prepared(problem);
        let own = problem.variables.lower.len();
        let directions: Vec<(u32, u8)> = (0..structure.nodes.names.len() as u32)
            .flat_map(|node| (0..6u8).map(move |direction| (node, direction)))
            .filter(|&(node, direction)| statics.is_free(node, direction.into()))
            .collect();
        let forces = assemble(&Arc::new(equations::forces_problem(problem, structure, statics)))?;
        let rows = assemble(&Arc::new(equations::rows_problem(problem, structure, statics)))?;
        let first_row = rows.meta().rows();
        let states = States { first_variable: own, first_row, block: directions.len(), blocks: structure.cases.len() };
        let numbering = Numbering { states, of: directions.iter().zip(0..).map(|(&at, number)| (at, number)).collect() };
        let mut maps = Maps::default();
        deformations(structure, statics, &numbering, &mut maps);
        let (known, limits) = equations::outputs(&forces, structure, statics, &numbering, &mut maps);
        let names =
            LiftedNames { own: rows.meta().names.clone(), problem: Arc::clone(problem), states, directions: directions.clone() };
        let meta = Meta { names: NameTable::new(names), ..outer_meta(rows.meta(), states, &limits) };
        let own_rows = known.len();
        let right_sides = [vec![0.0; own_rows], limits].concat();
        let of_forces = Meta { row_lower: right_sides.clone(), row_upper: right_sides, ..meta.clone() };
        let links = links(structure, statics, &numbering, &known);
        let model = Composed::new(Mapped::new(forces, maps, of_forces), rows, links, own_rows, meta);
        let stiffness = Stiffness::of(model.first().meta(), states);
        let problem = Arc::clone(problem);
        let mut lifted = Lifted { model, problem, states, directions, stiffness, latest: Mutex::default() };
        lifted.start_analysed();
        Ok(lifted)
    }

    /// Starts at the analysed start of the design. A case's largest displacement there, and its largest rotation, are the magnitudes of all.
    fn start_analysed(&mut self) {
        let mut start = self.meta().start.clone();
        self.complete(&mut start);
        let mut typical = self.meta().typical.clone();
        let n = self.states.first_variable;
        for case in 0..self.states.blocks {
            let of_case = n + case * self.states.block;
            for turns in [false, true] {
                let alike = |state: &usize| (self.direction(*state).1 >= 3) == turns;
                let chosen = || (0..self.states.block).filter(alike).map(|state| of_case + state);
                let largest = chosen().map(|at| start[at].abs()).fold(0.0, f64::max);
                chosen().for_each(|at| typical[at] = largest);
            }
        }
        self.model.start_at(start, typical);
    }

    /// Its states.
    pub fn states(&self) -> States {
        self.states
    }

    /// The declaration.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// The node and the direction of a state of a block.
    pub fn direction(&self, state: usize) -> (u32, usize) {
        let (node, direction) = self.directions[state];
        (node, direction.into())
    }

    /// The mechanism a design is, where it is one.
    ///
    /// # Errors
    /// Where the state equations have no value.
    pub fn mechanism(&self, x: &[f64]) -> Result<Option<Mechanism>, EvaluationError> {
        self.stiffness.mechanism(self.model.first(), x)
    }

    /// The largest residual of a state equation at design and states, over the largest sum of the sizes of one's terms.
    ///
    /// # Errors
    /// Where the state equations have no value.
    pub fn residual(&self, z: &[f64]) -> Result<f64, EvaluationError> {
        self.stiffness.residual(self.model.first(), z)
    }

    /// The model of the user's rows, over design variables and inputs.
    pub fn inner(&self) -> &RibModel {
        self.model.second()
    }
}

/// The user's names, then those of the states and their equations.
struct LiftedNames {
    own: NameTable,
    problem: Arc<Problem>,
    states: States,
    directions: Vec<(u32, u8)>,
}

impl LiftedNames {
    fn state(&self, at: usize) -> String {
        let structure = prepared(&self.problem).0;
        let (node, direction) = self.directions[at % self.states.block];
        let case = &structure.cases[at / self.states.block];
        format!("{case}, {}, {}", &structure.nodes.names[node as usize], DIRECTIONS[usize::from(direction)])
    }
}

impl Names for LiftedNames {
    fn variable(&self, j: usize) -> String {
        match j.checked_sub(self.states.first_variable) {
            None => self.problem.variable_name(j),
            Some(at) => format!("displacement[{}]", self.state(at)),
        }
    }

    fn row(&self, i: usize) -> String {
        match i.checked_sub(self.states.first_row) {
            None => self.own.row(i),
            Some(at) => format!("equilibrium[{}]", self.state(at)),
        }
    }

    fn objective(&self) -> String {
        self.own.objective()
    }

    fn rib_volume(&self, rib: usize) -> String {
        self.own.rib_volume(rib)
    }

    fn row_place(&self, i: usize) -> Option<String> {
        if i < self.states.first_row { self.own.row_place(i) } else { None }
    }
}

/// The structure and what was prepared of it.
fn prepared(problem: &Problem) -> (&Structure, &Statics) {
    let structure = problem.structure.as_deref().expect("only problems with a structure are lifted");
    (structure, problem.statics.as_deref().expect("the reader prepares every structure"))
}

/// Where the states stand among the outer variables.
struct Numbering {
    states: States,
    of: HashMap<(u32, u8), u32>,
}

impl Numbering {
    /// The variable of a displacement in a case; `None` where it is held.
    fn variable(&self, case: u32, node: u32, direction: usize) -> Option<u32> {
        let at = self.of.get(&(node, direction as u8))?;
        Some((self.states.first_variable + case as usize * self.states.block) as u32 + at)
    }

    /// The state equation of a direction in a case.
    fn row(&self, case: u32, node: u32, direction: usize) -> Option<usize> {
        let at = self.of.get(&(node, direction as u8))?;
        Some(self.states.first_row + case as usize * self.states.block + *at as usize)
    }
}

/// What an input is made of where it is linear in the displacements: entries and constant.
struct Linear<'a> {
    structure: &'a Structure,
    statics: &'a Statics,
    numbering: &'a Numbering,
    settled: HashMap<(u32, u32, u8), f64>,
}

impl Linear<'_> {
    fn of(&self, factors: &[(u32, f64)], input: Input) -> (Vec<(u32, f64)>, f64) {
        let (mut entries, mut constant): (Vec<(u32, f64)>, f64) = (Vec::new(), 0.0);
        let mut add = |node: u32, direction: usize, coefficient: f64| {
            for &(case, factor) in factors {
                match self.numbering.variable(case, node, direction) {
                    Some(variable) => entries.push((variable, factor * coefficient)),
                    None => {
                        let held = self.settled.get(&(case, node, direction as u8)).copied().unwrap_or(0.0);
                        constant += factor * coefficient * held;
                    }
                }
            }
        };
        match input {
            Input::Displacement(node, direction) => add(node, direction, 1.0),
            Input::Deformation(member, component) => {
                let declared = &self.structure.members[member as usize];
                let row = &self.statics.members[member as usize].rows[component];
                for (at, &coefficient) in row.iter().enumerate().filter(|(_, coefficient)| **coefficient != 0.0) {
                    add(if at < 6 { declared.start } else { declared.end }, at % 6, coefficient);
                }
            }
        }
        (entries, constant)
    }
}

/// B and b of the forces: design variables as they are, then what members deform by in every case.
fn deformations(structure: &Structure, statics: &Statics, numbering: &Numbering, maps: &mut Maps) {
    for j in 0..numbering.states.first_variable as u32 {
        maps.inputs.push([(j, 1.0)]);
        maps.constants.push(0.0);
    }
    let linear = Linear { structure, statics, numbering, settled: settlements(structure) };
    for case in 0..structure.cases.len() as u32 {
        for at in 0..statics.inputs {
            let (entries, constant) = linear.of(&[(case, 1.0)], statics.input(at));
            maps.inputs.push(entries);
            maps.constants.push(constant);
        }
    }
}

/// The first row of the forces that is a state equation is their number; before it stand the basic forces of members known by them.
type Known = HashMap<(u32, u32, u8), u32>;

/// What the user's rows look at, in every case and combination: basic forces, deformations of bars, displacements.
fn links(structure: &Structure, statics: &Statics, numbering: &Numbering, known: &Known) -> Links {
    let mut links = Links::default();
    for j in 0..numbering.states.first_variable as u32 {
        links.variables.push([(j, 1.0)]);
        links.rows.push([]);
        links.constants.push(0.0);
    }
    let linear = Linear { structure, statics, numbering, settled: settlements(structure) };
    for set in 0..structure.load_sets() as u32 {
        let factors = structure.factors(set);
        for at in 0..statics.inputs {
            let input = statics.input(at);
            let force = |&(case, factor): &(u32, f64)| match input {
                Input::Deformation(member, component) => Some((*known.get(&(case, member, component as u8))?, factor)),
                Input::Displacement(..) => None,
            };
            let forces: Vec<(u32, f64)> = factors.iter().filter_map(force).collect();
            let by_forces = matches!(input, Input::Deformation(member, _) if statics.members[member as usize].by_forces);
            let (entries, constant) = if by_forces { (Vec::new(), 0.0) } else { linear.of(&factors, input) };
            links.variables.push(entries);
            links.rows.push(forces);
            links.constants.push(constant);
        }
    }
    links
}

/// Prescribed displacements by case, node and direction.
fn settlements(structure: &Structure) -> HashMap<(u32, u32, u8), f64> {
    let mut settled = HashMap::new();
    for load in &structure.loads {
        if let Action::Displacement { node, direction, value } = load.action {
            *settled.entry((load.case, node, direction)).or_insert(0.0) += value;
        }
    }
    settled
}

/// Bounds and starts of the design, open ones of the states; limits of the rows, the loads for the state equations.
fn outer_meta(inner: &Meta, states: States, loads: &[f64]) -> Meta {
    let (n, m) = (states.first_variable, states.first_row);
    let number = states.block * states.blocks;
    let with = |own: &[f64], value: f64| own[..n].iter().copied().chain(std::iter::repeat_n(value, number)).collect();
    let followed = |own: &[f64]| own[..m].iter().copied().chain(loads.iter().copied()).collect();
    Meta {
        lower: with(&inner.lower, f64::NEG_INFINITY),
        upper: with(&inner.upper, f64::INFINITY),
        start: with(&inner.start, 0.0),
        typical: with(&inner.typical, 0.0),
        row_lower: followed(&inner.row_lower),
        row_upper: followed(&inner.row_upper),
        row_is_linear: inner.row_is_linear[..m].iter().copied().chain(std::iter::repeat_n(false, number)).collect(),
        objective_is_linear: inner.objective_is_linear,
        states: Some(states),
        ..Meta::default()
    }
}

impl WithStates for Lifted {
    fn solve_states(&self, x: &[f64], earlier: Option<Factors>) -> Result<(Vec<f64>, Factors), EvaluationError> {
        self.stiffness.solve_states(self.model.first(), x, earlier)
    }

    fn auxiliaries(&self) -> Option<(&[Auxiliary], usize)> {
        let auxiliaries = &self.problem.auxiliaries;
        auxiliaries.first().map(|first| (auxiliaries.as_slice(), self.inner().rows_before(first.constraints.start)))
    }
}

impl Model for Lifted {
    fn meta(&self) -> &Meta {
        self.model.meta()
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.model.objective(x)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.model.gradient(x, gradient)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.constraints(x, values)
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.jacobian(x, values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.hessian(x, weight, y, values)
    }

    fn own(&self) -> Own {
        let auxiliaries = &self.problem.auxiliaries;
        let rows = match auxiliaries.first() {
            Some(first) => self.inner().rows_before(first.constraints.start),
            None => self.states.first_row,
        };
        Own { variables: self.states.first_variable - auxiliaries.len(), rows }
    }

    /// States are what the analysis of the design says, whatever stood in their place.
    fn complete(&self, x: &mut [f64]) {
        let n = self.states.first_variable;
        let earlier = self.latest.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Ok((z, factors)) = self.solve_states(&x[..n], earlier) {
            x[n..].copy_from_slice(&z[n..]);
            *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(factors);
        }
        if let Some((list, first)) = self.auxiliaries() {
            auxiliaries::complete(self, list, first, n, x);
        }
    }
}

/// The inner problem's variables: the design's, then one per input.
fn with_inputs(problem: &mut Problem, inputs: usize) {
    let variables = &mut problem.variables;
    problem.first_input = variables.lower.len() as u32;
    variables.typical.resize(variables.lower.len(), 0.0);
    for at in 0..inputs as u32 {
        variables.origin.push(Origin::Input(at));
    }
    for (column, value) in [
        (&mut variables.lower, f64::NEG_INFINITY),
        (&mut variables.upper, f64::INFINITY),
        (&mut variables.start, 0.0),
        (&mut variables.typical, 0.0),
    ] {
        let length = column.len() + inputs;
        column.resize(length, value);
    }
}
