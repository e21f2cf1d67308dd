//! A model that falls apart, solved component by component side by side, as one argmin solver: in one argmin iteration every
//! component that is not done takes up to five Newton steps.
//!
//! | file | subject |
//! |---|---|
//! | [`arena`] | the iterates of all components |
//! | [`frame`] | one component, scaled, with slacks |
//! | [`step`], [`newton`], [`search`], [`barrier`] | the iterations of the small interior point |
//! | [`crossover`] | from the barrier's path to the minimum itself |
//!
//! Components the small solver cannot do go to the sparse interior point, each as a model of its own. Nothing depends on the
//! number of threads.

mod arena;
mod barrier;
mod crossover;
mod frame;
mod newton;
mod search;
mod step;

use argmin::core::{Error, KV, Problem, Solver, State};
use rayon::prelude::*;

use super::interior_point;
use super::state::{Conclusion, NlpState, Point, given};
use crate::backends::Termination;
use crate::model::components::Components as Pieces;
use crate::model::{Budget, EvaluationError, Evaluator, Model};
use arena::{Arena, Header, Phase, Piece};
use frame::Frame;
use step::Stepper;

/// Components of more variables or rows than this are no work for dense matrices.
const LARGEST: usize = 64;
/// Models with fewer variables are left in one piece: there is nothing to gain.
const FEWEST_VARIABLES: usize = 200;
/// Components a thread takes at a time.
const BATCH: usize = 128;
/// Steps every component takes in one iteration: turning from one to the next costs about as much as a step.
const STEPS: u32 = 5;

/// Whether this model is worth taking apart.
pub(super) fn fall_apart(model: &dyn Model) -> Option<Box<dyn Pieces + '_>> {
    if model.meta().variables() < FEWEST_VARIABLES { None } else { model.components() }
}

/// All components side by side.
pub(super) struct Components<'a> {
    pieces: &'a dyn Pieces,
    start: &'a [f64],
    multipliers: Option<&'a [f64]>,
    arena: Arena,
}

impl<'a> Components<'a> {
    /// From `start`, an earlier answer where there are multipliers.
    pub fn new(pieces: &'a dyn Pieces, model: &'a dyn Model, start: &'a [f64], multipliers: Option<&'a [f64]>) -> Self {
        let arena = Arena::new(pieces.partition(), model.meta(), LARGEST);
        Components { pieces, start, multipliers, arena }
    }

    /// Some steps of every component under way; hard ones are solved to their end. A budget that runs out leaves the rest.
    fn advance(&mut self, model: &'a Evaluator<'a>) {
        let (meta, pieces, start, multipliers) = (model.meta(), self.pieces, self.start, self.multipliers);
        let stepper = || Stepper::new(Frame::new(pieces, meta, start), multipliers);
        let mut running = self.arena.pieces(pieces.partition(), |phase| matches!(phase, Phase::New | Phase::Running));
        let may_go_on = || model.budget().check(model.evaluations()).is_ok();
        running.par_chunks_mut(BATCH).for_each_init(stepper, |stepper, batch| {
            if may_go_on() {
                batch.iter_mut().for_each(|piece| stepper.advance(piece, STEPS));
            }
        });
        let mut hard = self.arena.pieces(pieces.partition(), |phase| phase == Phase::Hard);
        let budget = Budget { max_evaluations: u64::MAX, ..*model.budget() };
        hard.par_iter_mut().for_each(|piece| by_sparse_interior_point(pieces, start, stepper().frame, piece, budget));
        let evaluations = self.arena.headers().iter().map(|header| u64::from(header.evaluations)).max();
        model.count(evaluations.unwrap_or(0));
    }

    /// x of all components.
    fn x(&mut self, model: &'a Evaluator<'a>) -> Vec<f64> {
        let mut x = self.start.to_vec();
        let mut frame = Frame::new(self.pieces, model.meta(), self.start);
        for piece in self.arena.pieces(self.pieces.partition(), |phase| phase != Phase::New) {
            frame.scales_of(&piece);
            frame.unscaled(&piece).for_each(|(j, value)| x[j as usize] = value);
        }
        x
    }

    /// The current iterate without x: putting it together at every iteration would cost more than the iteration.
    fn progress(&self) -> Point {
        let headers = self.arena.headers();
        let worst = |value: fn(&Header) -> f64| headers.iter().map(value).fold(0.0, f64::max);
        Point {
            x: Vec::new(),
            objective: self.pieces.constant() + headers.iter().map(|header| header.objective).sum::<f64>(),
            relative_violation: worst(|header| header.relative_violation),
            feasibility: worst(|header| header.violation),
            optimality: worst(|header| header.error),
            multipliers: None,
        }
    }

    fn answer(&mut self, model: &'a Evaluator<'a>) -> Point {
        let mut multipliers = vec![0.0; model.meta().rows()];
        let mut frame = Frame::new(self.pieces, model.meta(), self.start);
        for piece in self.arena.pieces(self.pieces.partition(), |phase| phase != Phase::New) {
            frame.scales_of(&piece);
            frame.multipliers(&piece).for_each(|(i, y)| multipliers[i as usize] = y);
        }
        Point { x: self.x(model), multipliers: Some(multipliers), ..self.progress() }
    }

    fn step_norm(&self) -> f64 {
        self.arena.headers().iter().map(|header| header.step).sum::<f64>().sqrt()
    }

    fn is_done(&self) -> bool {
        self.arena.headers().iter().all(|header| matches!(header.phase, Phase::Solved | Phase::Failed))
    }

    fn conclusion(&self) -> Conclusion {
        let headers = self.arena.headers();
        let failed = headers.iter().filter(|header| header.phase != Phase::Solved).count();
        let error = headers.iter().map(|header| header.error).fold(0.0, f64::max);
        let (count, steps) = (headers.len(), headers.iter().map(|header| header.iterations).max().unwrap_or(0));
        if !self.is_done() {
            let message =
                format!("the limit on iterations is reached: {failed} of {count} independent components are not solved");
            return Conclusion { termination: Termination::LimitReached, message, invalid: None };
        }
        let (termination, message) = if failed == 0 {
            (
                Termination::Converged,
                format!("{count} independent components, at most {steps} Newton steps each, optimality error {error:.1e}"),
            )
        } else {
            (Termination::Failed, format!("{failed} of {count} independent components were not solved"))
        };
        Conclusion { termination, message, invalid: None }
    }
}

/// Solves one component as a model of its own.
fn by_sparse_interior_point(pieces: &dyn Pieces, start: &[f64], mut frame: Frame<'_>, piece: &mut Piece<'_>, budget: Budget<'_>) {
    let model = pieces.model(piece.component);
    let evaluator = Evaluator::new(model.as_ref(), budget);
    let variables = pieces.partition().variables(piece.component);
    let start: Vec<f64> = variables.iter().map(|&j| start[j as usize]).collect();
    let solved = interior_point::solve_alone(&evaluator, &start);
    if piece.row_scale.contains(&0.0) {
        piece.row_scale.fill(1.0);
    }
    frame.turn_to(piece);
    let header = &mut piece.header;
    header.evaluations = u32::try_from(evaluator.evaluations()).unwrap_or(u32::MAX);
    header.phase = if solved.is_some() { Phase::Solved } else { Phase::Failed };
    let Some(point) = solved else { return };
    (header.objective, header.violation, header.relative_violation) =
        (point.objective, point.feasibility, point.relative_violation);
    header.error = point.optimality;
    frame.take(piece, &point.x, point.multipliers.as_deref().unwrap_or_default());
}

impl<'a, 's> Solver<&'a Evaluator<'a>, NlpState<'s>> for Components<'a> {
    fn name(&self) -> &str {
        "interior point by components"
    }

    fn init(
        &mut self,
        problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let model = given(problem)?;
        self.advance(model);
        let point = self.progress();
        Ok((state.at(point, 0.0, model.evaluations()), None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let model = given(problem)?;
        if let Err(stop) = model.budget().check(model.evaluations()) {
            let answer = self.answer(model);
            return Ok((state.conclude(Conclusion::of(&EvaluationError::Stopped(stop)), Some(answer)), None));
        }
        self.advance(model);
        let point = self.progress();
        let state = state.at(point, self.step_norm(), model.evaluations());
        if !self.is_done() && state.get_iter() + 1 < state.get_max_iters() {
            return Ok((state, None));
        }
        let answer = self.answer(model);
        Ok((state.conclude(self.conclusion(), Some(answer)), None))
    }
}
