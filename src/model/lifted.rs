//! The lifted model of a structure: design variables and, for every load case, the displacements of the free directions as *states*,
//! with as many state equations (equilibrium). Its elements know deformations; two constant maps lead from displacements to
//! deformations and from member forces to the equilibrium of nodes.

mod equations;

use std::collections::HashMap;
use std::sync::Arc;

use super::views::mapped::{Mapped, Maps, Rows};
use super::{AssemblyError, EvaluationError, Meta, Model, Own, RibModel, assemble};
use crate::problem::kinks::Auxiliary;
use crate::problem::statics::{Input, Statics};
use crate::problem::structure::{Action, DIRECTIONS, Structure};
use crate::problem::{Origin, Problem};
pub use equations::nodal_load;

/// Which variables are states, and which rows their equations: one block of both per load case, all after the design's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct States {
    /// The first of them; design variables stand before.
    pub first_variable: usize,
    /// The first of their equations.
    pub first_row: usize,
    /// States and equations per block.
    pub block: usize,
    /// Number of blocks. All have the same matrix ∂R/∂u.
    pub blocks: usize,
}

/// A model with states.
pub trait WithStates: Model {
    /// Design variables in the place of kinks, the last ones of the design, and the first of the rows that bound them.
    fn auxiliaries(&self) -> Option<(&[Auxiliary], usize)> {
        None
    }
}

/// A structure in design variables and displacements.
pub struct Lifted {
    model: Mapped<RibModel>,
    problem: Arc<Problem>,
    states: States,
    /// Node and direction of each state of a block.
    directions: Vec<(u32, u8)>,
    row_names: usize,
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
        let inner = assemble(&Arc::new(equations::inner_problem(problem, structure, statics)))?;
        let first_row = inner.rows_before(problem.constraints.len());
        let states = States { first_variable: own, first_row, block: directions.len(), blocks: structure.cases.len() };
        let numbering = Numbering { states, of: directions.iter().zip(0..).map(|(&at, number)| (at, number)).collect() };
        let mut maps = Maps::default();
        inputs(structure, statics, &numbering, &mut maps);
        let limits = equations::outputs(&inner, structure, statics, &numbering, &mut maps);
        let meta = outer_meta(inner.meta(), states, &limits);
        Ok(Lifted {
            model: Mapped::new(inner, maps, meta),
            problem: Arc::clone(problem),
            states,
            directions,
            row_names: first_row,
        })
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

    /// The assembled elements.
    pub fn inner(&self) -> &RibModel {
        self.model.inner()
    }

    fn state_name(&self, at: usize) -> String {
        let structure = prepared(&self.problem).0;
        let (node, direction) = self.directions[at % self.states.block];
        let case = &structure.cases[at / self.states.block];
        format!("{case}, {}, {}", &structure.nodes.names[node as usize], DIRECTIONS[usize::from(direction)])
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

/// B and b: design variables as they are, then for every case and combination what its inputs are made of.
fn inputs(structure: &Structure, statics: &Statics, numbering: &Numbering, maps: &mut Maps) {
    for j in 0..numbering.states.first_variable as u32 {
        maps.inputs.push([(j, 1.0)]);
        maps.constants.push(0.0);
    }
    let settled = settlements(structure);
    for set in 0..structure.load_sets() as u32 {
        let factors = structure.factors(set);
        for at in 0..statics.inputs {
            let (mut entries, mut constant): (Vec<(u32, f64)>, f64) = (Vec::new(), 0.0);
            let mut add = |node: u32, direction: usize, coefficient: f64| {
                for &(case, factor) in &factors {
                    match numbering.variable(case, node, direction) {
                        Some(variable) => entries.push((variable, factor * coefficient)),
                        None => {
                            let held = settled.get(&(case, node, direction as u8)).copied().unwrap_or(0.0);
                            constant += factor * coefficient * held;
                        }
                    }
                }
            };
            match statics.input(at) {
                Input::Displacement(node, direction) => add(node, direction, 1.0),
                Input::Deformation(member, component) => {
                    let declared = &structure.members[member as usize];
                    let row = &statics.members[member as usize].rows[component];
                    for (at, &coefficient) in row.iter().enumerate().filter(|(_, coefficient)| **coefficient != 0.0) {
                        add(if at < 6 { declared.start } else { declared.end }, at % 6, coefficient);
                    }
                }
            }
            maps.inputs.push(entries);
            maps.constants.push(constant);
        }
    }
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
            None => self.row_names,
        };
        Own { variables: self.states.first_variable - auxiliaries.len(), rows }
    }

    fn variable_name(&self, j: usize) -> String {
        match j.checked_sub(self.states.first_variable) {
            None => self.problem.variable_name(j),
            Some(at) => format!("displacement[{}]", self.state_name(at)),
        }
    }

    fn row_name(&self, i: usize) -> String {
        match i.checked_sub(self.states.first_row) {
            None => self.inner().row_name(i),
            Some(at) => format!("equilibrium[{}]", self.state_name(at)),
        }
    }

    fn row_place(&self, i: usize) -> Option<String> {
        if i < self.states.first_row { self.inner().row_place(i) } else { None }
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

/// Rows that pass on what they are.
fn identity(rows: &mut Rows, row: u32) {
    rows.push([(row, 1.0)]);
}
