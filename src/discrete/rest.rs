//! The design of given rows: the lists' variables at their numbers, all others at their best.

use super::{Design, List};
use crate::backends::argmin::Argmin;
use crate::backends::{Backend, Job, Solution};
use crate::certificate::{Certifier, Tolerances};
use crate::model::views::WithBounds;
use crate::model::{Budget, Class, Model, Substitution};
use crate::problem::Settings;

/// A problem whose lists' variables are chosen by others.
pub struct Rest<'a> {
    /// The problem in the user's variables, minimised.
    pub model: &'a dyn Model,
    /// The same in variables that are easier to solve in, each a function of one of the user's, where there are such.
    pub substitution: Option<&'a dyn Substitution>,
    /// What is proved about it.
    pub class: Class,
    /// Tolerances and limits.
    pub settings: &'a Settings,
    /// The lists.
    pub lists: &'a [List],
    /// When to end.
    pub budget: Budget<'a>,
}

impl Rest<'_> {
    /// What is accepted.
    pub(super) fn tolerances(&self) -> Tolerances {
        Tolerances { optimality: self.settings.optimality_tolerance, constraint: self.settings.constraint_tolerance }
    }

    /// Whether the lists leave nothing to be solved: all other variables are fixed, or follow.
    pub(super) fn is_nothing(&self) -> bool {
        let meta = self.model.meta();
        let listed: Vec<usize> = self.lists.iter().flat_map(|list| list.variables.iter().copied()).collect();
        (0..self.model.own().variables).all(|j| meta.is_fixed(j) || listed.contains(&j))
    }

    /// The numbers of these rows put into a point.
    fn put(&self, rows: &[usize], x: &mut [f64]) {
        for (list, &row) in self.lists.iter().zip(rows) {
            list.variables.iter().zip(&list.rows[row]).for_each(|(&j, value)| x[j] = *value);
        }
    }

    /// The design of these rows, the rest solved for from a point near it; `None` where it does not meet the limits.
    pub fn design(&self, rows: &[usize], near: &[f64]) -> Option<Design> {
        let mut x = near.to_vec();
        self.model.meta().clamp(&mut x);
        self.put(rows, &mut x);
        if !self.is_nothing() {
            x = self.solved(&x, rows)?;
        }
        self.model.complete(&mut x);
        let judge = Certifier::new(self.model, self.class, self.tolerances());
        let meets = judge.primal_infeasibility(&x)? <= self.settings.constraint_tolerance;
        let objective = self.model.objective(&x).ok().filter(|_| meets)?;
        Some(Design { rows: rows.to_vec(), x, objective })
    }

    /// The best of the other variables with those of the lists where they are in `x`.
    fn solved(&self, x: &[f64], rows: &[usize]) -> Option<Vec<f64>> {
        let (mut lower, mut upper) = (self.model.meta().lower.clone(), self.model.meta().upper.clone());
        self.put(rows, &mut lower);
        self.put(rows, &mut upper);
        let mut solution = match self.substitution {
            Some(other) => {
                let inside = WithBounds::new(other.model(), other.inward(&lower), other.inward(&upper));
                other.outward(&self.solve(&inside, &other.inward(x)).x)
            }
            None => self.solve(&WithBounds::new(self.model, lower, upper), x).x,
        };
        self.model.meta().clamp(&mut solution);
        self.put(rows, &mut solution);
        Some(solution).filter(|x| x.iter().all(|value| value.is_finite()))
    }

    /// A run of the interior point, within the limits.
    pub(super) fn solve(&self, model: &dyn Model, start: &[f64]) -> Solution {
        let mut start = start.to_vec();
        model.meta().clamp(&mut start);
        let settings = self.settings;
        let mut job = Job {
            algorithm: "interior-point",
            start: &start,
            start_multipliers: None,
            optimality_tolerance: settings.optimality_tolerance,
            step_tolerance: settings.step_tolerance,
            constraint_tolerance: settings.constraint_tolerance,
            max_iterations: settings.max_iterations,
            budget: self.budget,
            stop_test: None,
            part_test: None,
            observer: &mut |_| {},
        };
        Argmin.solve(model, &mut job)
    }
}
