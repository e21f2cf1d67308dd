//! The lifted model of a structure: design variables and, for every load case, the displacements of the free directions as *states*,
//! with as many state equations (equilibrium). Its elements know deformations; two constant maps lead from displacements to
//! deformations and from member forces to the equilibrium of nodes.

mod bounded;
mod equations;
mod maps;
mod modes;
mod names;

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

pub use super::states::States;
use super::stiffness::{Factors, Mechanism, Stiffness};
use super::views::composed::{Composed, Links};
use super::views::mapped::{Mapped, Maps};
use super::with_states::WithStates;
use super::{AssemblyError, Evaluation, EvaluationError, Meta, Model, NameTable, Own, RibModel, assemble, auxiliaries};
use crate::problem::kinks::Auxiliary;
use crate::problem::modes::eigenvalues;
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use crate::problem::{Origin, Problem};
use maps::{Known, deformations, links, outer_meta};
pub use modes::Modes;
use modes::WithModes;
use names::LiftedNames;

/// A structure in design variables and displacements.
///
/// What the certificate finds at a point whose displacements are those of its design holds for the reduced model, too: multipliers of the
/// state equations are the adjoints, for which the Lagrangian is stationary in the states; and as the block [L_uu Kᵀ; K 0] has as many
/// positive as negative eigenvalues whatever L_uu is, the inertia of the lifted system is that of the reduced one and of these
/// (Haynsworth 1968).
pub struct Lifted {
    model: Composed<WithModes<Mapped<RibModel>>, RibModel>,
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
        let wanted = eigenvalues(problem);
        let directions: Vec<(u32, u8)> = statics.free_directions().map(|(node, direction)| (node, direction as u8)).collect();
        let forces = assemble(&Arc::new(equations::forces_problem(problem, structure, statics)))?;
        let rows = assemble(&Arc::new(equations::rows_problem(problem, structure, statics, wanted.clone())))?;
        let first_row = rows.meta().rows();
        // Without a case nothing is displaced; modes have displacements of their own.
        let block = if structure.cases.is_empty() { 0 } else { directions.len() };
        let are_bounded = bounded::are_bounded(problem, structure, statics);
        let states = States { first_variable: own, first_row, block, blocks: structure.cases.len(), are_bounded };
        let numbering = Numbering { states, of: directions.iter().zip(0..).map(|(&at, number)| (at, number)).collect() };
        let mut maps = Maps::default();
        deformations(structure, statics, &numbering, &mut maps);
        let (known, limits) = equations::outputs(&forces, structure, statics, &numbering, &mut maps);
        let names =
            LiftedNames { own: rows.meta().names.clone(), problem: Arc::clone(problem), states, directions: directions.clone() };
        let meta = Meta { names: NameTable::new(names), ..outer_meta(rows.meta(), states, &limits) };
        let modes = Modes::of(problem, structure, statics, &numbering, wanted)?;
        let own_rows = known.len();
        let right_sides = [vec![0.0; own_rows], limits].concat();
        let of_forces = Meta { row_lower: right_sides.clone(), row_upper: right_sides, ..meta.clone() };
        let mut links = links(structure, statics, &numbering, &known);
        let count = modes.as_ref().map_or(0, Modes::count);
        for at in 0..count {
            links.variables.push([]);
            links.rows.push([((own_rows + at) as u32, 1.0)]);
            links.constants.push(0.0);
        }
        let first = WithModes::new(Mapped::new(forces, maps, of_forces), modes, own_rows);
        let meta = Meta { row_is_linear: linear_rows(&meta, rows.meta(), &links), ..meta };
        let model = Composed::new(first, rows, links, own_rows + count, meta);
        let stiffness = Stiffness::of(model.first().first().meta(), states);
        let problem = Arc::clone(problem);
        let mut lifted = Lifted { model, problem, states, directions, stiffness, latest: Mutex::default() };
        lifted.start_analysed();
        Ok(lifted)
    }

    /// Starts at the analysed start of the design. A case's largest displacement there, and its largest rotation, are the magnitudes of all,
    /// when all have grown until the first limit is met.
    fn start_analysed(&mut self) {
        let mut start = self.meta().start.clone();
        self.complete(&mut start);
        let growth = self.growth_to_limits(&start).unwrap_or(1.0);
        let mut typical = self.meta().typical.clone();
        let n = self.states.first_variable;
        for case in 0..self.states.blocks {
            let of_case = n + case * self.states.block;
            for turns in [false, true] {
                let alike = |state: &usize| (self.direction(*state).1 >= 3) == turns;
                let chosen = || (0..self.states.block).filter(alike).map(|state| of_case + state);
                let largest = chosen().map(|at| growth * start[at].abs()).fold(0.0, f64::max);
                chosen().for_each(|at| typical[at] = largest);
            }
        }
        self.model.start_at(start, typical);
    }

    /// By which factor all states may grow until the first row, linear in them, meets its limit. `None` where no row limits them.
    fn growth_to_limits(&self, z: &[f64]) -> Option<f64> {
        let meta = self.meta();
        let (mut rows, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
        let mut at = self.at(z).ok()?;
        at.constraints(&mut rows).ok()?;
        at.jacobian(&mut jacobian).ok()?;
        let growth = |row: usize| {
            let along = |at: usize| {
                let column = meta.jacobian.columns[at] as usize;
                if column < self.states.first_variable { 0.0 } else { jacobian[at] * z[column] }
            };
            let slope: f64 = meta.jacobian.range(row).map(along).sum();
            let limit = if slope > 0.0 { meta.row_upper[row] } else { meta.row_lower[row] };
            1.0 + (limit - rows[row]) / slope
        };
        let factors = (0..self.states.first_row).map(growth).filter(|factor| *factor > 0.0 && factor.is_finite());
        factors.min_by(f64::total_cmp)
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
        self.stiffness.mechanism(self.model.first().first(), x)
    }

    /// The largest residual of a state equation at design and states, over the largest sum of the sizes of one's terms.
    ///
    /// # Errors
    /// Where the state equations have no value.
    pub fn residual(&self, z: &[f64]) -> Result<f64, EvaluationError> {
        self.stiffness.residual(self.model.first().first(), z)
    }

    /// The modes of the eigenvalues that are asked for.
    ///
    /// # Errors
    /// None is asked for.
    pub fn modes(&self) -> Result<&Modes, EvaluationError> {
        let none = || EvaluationError::Invalid { term: "modes of the structure".into(), cause: "none is asked for".into() };
        self.model.first().modes().ok_or_else(none)
    }

    /// The model of the user's rows, over design variables and inputs.
    pub fn inner(&self) -> &RibModel {
        self.model.second()
    }
}

/// Rows that are affine in design and displacements: those affine in inputs that are.
fn linear_rows(meta: &Meta, inner: &Meta, links: &Links) -> Vec<bool> {
    let is_affine = |&input: &u32| links.rows.row(input as usize).is_empty();
    let affine = |row: usize| row >= inner.rows() || inner.jacobian.row(row).iter().all(is_affine);
    (0..meta.rows()).map(|row| meta.is_row_linear(row) && affine(row)).collect()
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

impl WithStates for Lifted {
    fn solve_states(&self, x: &[f64], earlier: Option<Factors>) -> Result<(Vec<f64>, Factors), EvaluationError> {
        self.stiffness.solve_states(self.model.first().first(), x, earlier)
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

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        self.model.at(x)
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
