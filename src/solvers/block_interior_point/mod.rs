//! A model of many independent components, solved component by component side by side: in one iteration every component that is
//! not done takes up to five Newton steps.
//!
//! | file | subject |
//! |---|---|
//! | `arena` | the iterates of all components |
//! | `frame` | one component, scaled, with slacks |
//! | `step`, `newton`, `search`, `barrier` | the iterations of the small interior point |
//! | `crossover` | from the barrier's path to the minimum itself |
//!
//! Components the small solver cannot do go to the sparse interior point, each as a model of its own. Nothing depends on the
//! number of threads.

mod arena;
mod barrier;
mod crossover;
mod frame;
mod newton;
mod parameters;
mod search;
mod step;
#[cfg(test)]
mod tests;

use rayon::prelude::*;

use super::{Conclusion, Progress, RankedPoint, Solver, Why, interior_point};
use crate::model::components::Components;
use crate::model::{Budget, EvaluationError, Evaluator, Model};
use arena::{Arena, ComponentIterate, Header, Phase};
use frame::Frame;
use parameters::PARAMETERS;
use step::Stepper;

/// The components of a model that is worth taking apart.
pub fn decomposes(model: &dyn Model) -> Option<Box<dyn Components + '_>> {
    if model.meta().variables() < PARAMETERS.fewest_variables { None } else { model.components() }
}

/// All components side by side.
pub struct BlockInteriorPoint<'a> {
    model: &'a Evaluator<'a>,
    components: &'a dyn Components,
    start: &'a [f64],
    multipliers: Option<&'a [f64]>,
    arena: Arena,
}

impl<'a> BlockInteriorPoint<'a> {
    /// From `start`, an earlier answer where there are multipliers.
    pub fn new(
        model: &'a Evaluator<'a>,
        components: &'a dyn Components,
        start: &'a [f64],
        multipliers: Option<&'a [f64]>,
    ) -> Self {
        let arena = Arena::new(components.partition(), model.meta(), PARAMETERS.largest);
        BlockInteriorPoint { model, components, start, multipliers, arena }
    }

    /// Some steps of every component under way; hard ones are solved to their end. A budget that runs out leaves the rest.
    fn advance(&mut self) {
        let model = self.model;
        let (meta, components, start, multipliers) = (model.meta(), self.components, self.start, self.multipliers);
        let stepper = || Stepper::new(Frame::new(components, meta, start), multipliers);
        let mut running = self.arena.iterates(components.partition(), |phase| matches!(phase, Phase::New | Phase::Running));
        let may_go_on = || model.budget().check(model.evaluations()).is_ok();
        running.par_chunks_mut(PARAMETERS.batch).for_each_init(stepper, |stepper, batch| {
            if may_go_on() {
                batch.iter_mut().for_each(|iterate| stepper.advance(iterate, PARAMETERS.steps));
            }
        });
        let mut hard = self.arena.iterates(components.partition(), |phase| phase == Phase::Hard);
        let budget = Budget { max_evaluations: u64::MAX, ..*model.budget() };
        hard.par_iter_mut().for_each(|iterate| by_sparse_interior_point(components, start, stepper().frame, iterate, budget));
        let evaluations = self.arena.headers().iter().map(|header| u64::from(header.evaluations)).max();
        model.count(evaluations.unwrap_or(0));
    }

    /// x of all components.
    fn x(&mut self) -> Vec<f64> {
        let mut x = self.start.to_vec();
        let mut frame = Frame::new(self.components, self.model.meta(), self.start);
        for iterate in self.arena.iterates(self.components.partition(), |phase| phase != Phase::New) {
            frame.scales_of(&iterate);
            frame.unscaled(&iterate).for_each(|(j, value)| x[j as usize] = value);
        }
        x
    }

    /// The current iterate without x: putting it together at every iteration would cost more than the iteration.
    fn progress(&self) -> RankedPoint {
        let headers = self.arena.headers();
        let worst = |value: fn(&Header) -> f64| headers.iter().map(value).fold(0.0, f64::max);
        RankedPoint {
            x: Vec::new(),
            objective: self.components.constant() + headers.iter().map(|header| header.objective).sum::<f64>(),
            relative_violation: worst(|header| header.relative_violation),
            feasibility: worst(|header| header.violation),
            optimality: worst(|header| header.error),
            multipliers: None,
        }
    }

    fn answer(&mut self) -> RankedPoint {
        let mut multipliers = vec![0.0; self.model.meta().rows()];
        let mut frame = Frame::new(self.components, self.model.meta(), self.start);
        for iterate in self.arena.iterates(self.components.partition(), |phase| phase != Phase::New) {
            frame.scales_of(&iterate);
            frame.multipliers(&iterate).for_each(|(i, y)| multipliers[i as usize] = y);
        }
        RankedPoint { x: self.x(), multipliers: Some(multipliers), ..self.progress() }
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
            return Conclusion::new(Why::LimitReached, message);
        }
        let (why, message) = if failed == 0 {
            (
                Why::Converged,
                format!("{count} independent components, at most {steps} Newton steps each, optimality error {error:.1e}"),
            )
        } else {
            (Why::Failed, format!("{failed} of {count} independent components were not solved"))
        };
        Conclusion::new(why, message)
    }
}

/// Solves one component as a model of its own.
fn by_sparse_interior_point(
    components: &dyn Components,
    start: &[f64],
    mut frame: Frame<'_>,
    iterate: &mut ComponentIterate<'_>,
    budget: Budget<'_>,
) {
    let model = components.model(iterate.component);
    let evaluator = Evaluator::new(model.as_ref(), budget);
    let variables = components.partition().variables(iterate.component);
    let start: Vec<f64> = variables.iter().map(|&j| start[j as usize]).collect();
    let solved = interior_point::solve_alone(&evaluator, &start);
    if iterate.row_scale.contains(&0.0) {
        iterate.row_scale.fill(1.0);
    }
    frame.select(iterate);
    let header = &mut iterate.header;
    header.evaluations = u32::try_from(evaluator.evaluations()).unwrap_or(u32::MAX);
    header.phase = if solved.is_some() { Phase::Solved } else { Phase::Failed };
    let Some(point) = solved else { return };
    (header.objective, header.violation, header.relative_violation) =
        (point.objective, point.feasibility, point.relative_violation);
    header.error = point.optimality;
    frame.take(iterate, &point.x, point.multipliers.as_deref().unwrap_or_default());
}

impl Solver for BlockInteriorPoint<'_> {
    fn name(&self) -> &'static str {
        "interior point by components"
    }

    fn begin(&mut self) -> Progress {
        self.advance();
        Progress::at(self.progress(), 0.0, self.model.evaluations())
    }

    fn step(&mut self, is_last: bool) -> Progress {
        if let Err(stop) = self.model.budget().check(self.model.evaluations()) {
            let conclusion = Conclusion::of(&EvaluationError::Stopped(stop));
            return Progress { at: None, ending: Some((conclusion, Some(self.answer()))) };
        }
        self.advance();
        let progress = Progress::at(self.progress(), self.step_norm(), self.model.evaluations());
        if !self.is_done() && !is_last {
            return progress;
        }
        let answer = self.answer();
        progress.concluded(self.conclusion(), Some(answer))
    }
}
