//! The KKT matrix with inequality rows of few variables eliminated: W + Σ + AᵀΔA over the variables, bordered by the rows left.
//!
//! An inequality row has −1/D on its diagonal, a pivot that makes no fill where the row has few variables. What is left is of
//! half the order or less. Where D is very large (an active limit) Δ is smaller than D, so that W is not lost in rounding; solutions
//! are refined with the whole matrix, which makes up for that and for the rounding of the condensed one.

use std::collections::HashMap;

use super::super::parameters::PARAMETERS;
use super::super::vectors::norm_max;
use super::system::System;
use crate::linear_algebra::congruence::CongruentSolver;
use crate::linear_algebra::{Effort, FactorizationError, Inertia};
use crate::model::Pattern;

/// Factors, and where the system's values stand in the matrix.
pub(super) struct Condensed {
    solver: CongruentSolver,
    values: Vec<f64>,
    hessian_places: Vec<usize>,
    diagonal_places: Vec<usize>,
    /// Of all products of two entries of a condensed row, row by row.
    product_places: Vec<usize>,
    /// Of the entries of the rows kept, and of their diagonal.
    kept_places: Vec<usize>,
    kept_diagonal: Vec<usize>,
    condensed: Vec<usize>,
    kept: Vec<usize>,
    /// Of the rows kept those that are equalities.
    equalities: Vec<usize>,
    /// What holds each variable without the condensed rows.
    stiffness: Vec<f64>,
    /// Δ of each condensed row.
    weights: Vec<f64>,
    right: Vec<f64>,
    step: Vec<f64>,
    residual: Vec<f64>,
    correction: Vec<f64>,
}

impl Condensed {
    /// The condensed form of a large system; `None` where there is little to condense. `slack` tells the inequality rows.
    pub fn new(system: &System, slack: &[Option<usize>]) -> Option<Self> {
        if system.order() < PARAMETERS.condensing.least_order {
            return None;
        }
        let alike = rows_alike(system, slack);
        let pays = |&i: &usize| slack[i].is_some_and(|_| pays(system.jacobian.row(i).len(), alike[system.jacobian.row(i)]));
        let (condensed, kept): (Vec<usize>, Vec<usize>) = (0..slack.len()).partition(pays);
        if condensed.len() < kept.len() {
            return None;
        }
        let n = system.primal.len();
        let equalities: Vec<usize> = kept.iter().copied().filter(|&i| slack[i].is_none()).collect();
        let pattern = pattern(system, &condensed, &kept);
        // Every position looked up is in the pattern.
        let place = |(a, b): (u32, u32)| pattern.position(a.max(b) as usize, a.min(b)).unwrap_or_default();
        let places = |positions: Vec<(u32, u32)>| positions.into_iter().map(place).collect();
        let diagonal = |from: usize, to: usize| places((from as u32..to as u32).map(|k| (k, k)).collect());
        Some(Condensed {
            hessian_places: places(of_hessian(system).collect()),
            diagonal_places: diagonal(0, n),
            product_places: places(of_products(system, &condensed).collect()),
            kept_places: places(of_kept(system, &kept).collect()),
            kept_diagonal: diagonal(n, n + kept.len()),
            weights: vec![0.0; condensed.len()],
            right: vec![0.0; n + kept.len()],
            step: vec![0.0; n + kept.len()],
            residual: vec![0.0; system.order()],
            correction: vec![0.0; system.order()],
            values: vec![0.0; pattern.len()],
            // Beside equalities the matrix is not quasi-definite.
            solver: match equalities.is_empty() {
                true => CongruentSolver::for_quasi_definite(pattern.offsets, pattern.columns),
                false => CongruentSolver::for_saddle_points(pattern.offsets, pattern.columns),
            }
            .ok()?,
            condensed,
            kept,
            equalities,
            stiffness: vec![0.0; n],
        })
    }

    /// Factorises the system's values. The inertia is that of the whole matrix.
    pub fn factor(&mut self, system: &System, effort: Effort) -> Result<Inertia, FactorizationError> {
        self.values.fill(0.0);
        for (&place, value) in self.hessian_places.iter().zip(&system.hessian_values) {
            self.values[place] += value;
        }
        for (&place, value) in self.diagonal_places.iter().zip(&system.primal) {
            self.values[place] += value;
        }
        self.weigh(system);
        let mut places = self.product_places.iter();
        for (&i, weight) in self.condensed.iter().zip(&self.weights) {
            let entries = &system.jacobian_values[system.jacobian.range(i)];
            for ((a, b), &place) in products(entries).zip(places.by_ref()) {
                self.values[place] += weight * a * b;
            }
        }
        let kept = self.kept.iter().flat_map(|&i| &system.jacobian_values[system.jacobian.range(i)]);
        for (&place, value) in self.kept_places.iter().zip(kept) {
            self.values[place] = *value;
        }
        for (&place, &i) in self.kept_diagonal.iter().zip(&self.kept) {
            self.values[place] = -system.dual[i];
        }
        let inertia = self.solver.factor_by(&self.values, effort)?;
        Ok(Inertia { negative: inertia.negative + self.condensed.len(), ..inertia })
    }

    /// Solves with the factors found last, refined; `None` where no solution is any good.
    pub fn solve(&mut self, system: &System, right: &[f64], solution: &mut [f64]) -> Option<()> {
        solution.fill(0.0);
        let size = norm_max(right);
        let mut residual = std::mem::take(&mut self.residual);
        let mut correction = std::mem::take(&mut self.correction);
        residual.copy_from_slice(right);
        let mut least = size;
        for _ in 0..PARAMETERS.condensing.most_steps {
            if least <= PARAMETERS.condensing.enough * size || self.solve_condensed(system, &residual, &mut correction).is_err() {
                break;
            }
            solution.iter_mut().zip(&correction).for_each(|(x, step)| *x += step);
            system.residual(right, solution, &mut residual);
            let left = norm_max(&residual);
            // A step that makes it worse (or a NaN) is taken back.
            if left.is_nan() || left >= least {
                solution.iter_mut().zip(&correction).for_each(|(x, step)| *x -= step);
                break;
            }
            let slow = left > 0.5 * least;
            least = left;
            if slow {
                break;
            }
        }
        (self.residual, self.correction) = (residual, correction);
        (least <= PARAMETERS.condensing.usable * size).then_some(())
    }

    /// Δ of every condensed row: D, but for limits of stiffness.
    fn weigh(&mut self, system: &System) {
        let jacobian = &system.jacobian;
        for (stiffness, &place) in self.stiffness.iter_mut().zip(&self.diagonal_places) {
            *stiffness = self.values[place].abs().max(PARAMETERS.condensing.least_curvature);
        }
        // A variable without curvature is held by its equations.
        for at in self.equalities.iter().flat_map(|&i| jacobian.range(i)) {
            let stiffness = &mut self.stiffness[jacobian.columns[at] as usize];
            *stiffness = stiffness.max(system.jacobian_values[at].abs());
        }
        for (&i, weight) in self.condensed.iter().zip(&mut self.weights) {
            let held = |at: usize| self.stiffness[jacobian.columns[at] as usize] / system.jacobian_values[at].powi(2);
            let stiffest = jacobian.range(i).map(held).fold(f64::INFINITY, f64::min);
            *weight = (1.0 / system.dual[i]).min(PARAMETERS.condensing.stiffest * stiffest);
        }
    }

    fn solve_condensed(&mut self, system: &System, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        let n = system.primal.len();
        let jacobian = &system.jacobian;
        self.right[..n].copy_from_slice(&right[..n]);
        for (&i, weight) in self.condensed.iter().zip(&self.weights) {
            for at in jacobian.range(i) {
                self.right[jacobian.columns[at] as usize] += system.jacobian_values[at] * weight * right[n + i];
            }
        }
        for (k, &i) in self.kept.iter().enumerate() {
            self.right[n + k] = right[n + i];
        }
        self.solver.solve_once(&self.right, &mut self.step)?;
        x[..n].copy_from_slice(&self.step[..n]);
        for (k, &i) in self.kept.iter().enumerate() {
            x[n + i] = self.step[n + k];
        }
        for (&i, weight) in self.condensed.iter().zip(&self.weights) {
            let along: f64 = jacobian.range(i).map(|at| system.jacobian_values[at] * x[jacobian.columns[at] as usize]).sum();
            x[n + i] = weight * (along - right[n + i]);
        }
        Ok(())
    }
}

/// How many inequality rows have the same variables.
fn rows_alike<'s>(system: &'s System, slack: &[Option<usize>]) -> HashMap<&'s [u32], usize> {
    let mut alike = HashMap::new();
    let inequalities = (0..slack.len()).filter(|&i| slack[i].is_some());
    inequalities.for_each(|i| *alike.entry(system.jacobian.row(i)).or_default() += 1);
    alike
}

/// Whether rows of the same variables make no more products of two of these than they have entries, pivots and right-hand sides.
fn pays(variables: usize, rows: usize) -> bool {
    variables * variables.saturating_sub(1) / 2 <= rows * (variables + 2)
}

/// Positions of the condensed matrix: W, the products within condensed rows, the rows kept, the diagonal.
fn pattern(system: &System, condensed: &[usize], kept: &[usize]) -> Pattern {
    let order = system.primal.len() + kept.len();
    let mut positions: Vec<(u32, u32)> = of_hessian(system).chain(of_kept(system, kept)).collect();
    positions.extend(of_products(system, condensed).map(|(a, b)| (a.max(b), a.min(b))));
    positions.extend((0..order as u32).map(|k| (k, k)));
    Pattern::from_positions(order, &mut positions)
}

fn of_hessian(system: &System) -> impl Iterator<Item = (u32, u32)> {
    system.hessian.iter().map(|(row, column)| (row as u32, column as u32))
}

fn of_products(system: &System, condensed: &[usize]) -> impl Iterator<Item = (u32, u32)> {
    condensed.iter().flat_map(|&i| products(system.jacobian.row(i)))
}

fn of_kept(system: &System, kept: &[usize]) -> impl Iterator<Item = (u32, u32)> {
    let row = move |(k, &i): (usize, &usize)| {
        system.jacobian.row(i).iter().map(move |&column| ((system.primal.len() + k) as u32, column))
    };
    kept.iter().enumerate().flat_map(row)
}

/// Every pair of a short list, each with itself included, once.
fn products<T: Copy>(list: &[T]) -> impl Iterator<Item = (T, T)> {
    list.iter().enumerate().flat_map(move |(k, &a)| list[..=k].iter().map(move |&b| (a, b)))
}
