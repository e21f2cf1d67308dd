//! From the iterate to the component's own values and back.

use super::super::arena::ComponentIterate;
use super::super::parameters::PARAMETERS;
use super::{Frame, inward, outward};
use crate::solvers::barrier::pushed;

impl<'m> Frame<'m> {
    /// The largest violation of the rows by the values evaluated last: absolute, and relative to large limits.
    pub fn violation(&self, component: usize) -> (f64, f64) {
        let beyond = |(&row, value): (&u32, &f64)| {
            let (lower, upper) = (self.meta.row_lower[row as usize], self.meta.row_upper[row as usize]);
            let (below, above) = ((lower - value).max(0.0), (value - upper).max(0.0));
            (below.max(above), (below / lower.abs().max(1.0)).max(above / upper.abs().max(1.0)))
        };
        let all = self.partition.rows(component).iter().zip(&self.natural_rows).map(beyond);
        all.fold((0.0, 0.0), |worst: (f64, f64), next| (worst.0.max(next.0), worst.1.max(next.1)))
    }

    /// The component's variables with their unscaled values: exactly on the bounds they rest on, never beyond.
    pub fn unscaled<'f>(&'f self, iterate: &'f ComponentIterate<'_>) -> impl Iterator<Item = (u32, f64)> + 'f {
        let variables = self.partition.variables(iterate.component);
        variables.iter().enumerate().map(|(at, &j)| {
            let (w, lower, upper) = (iterate.w[at], self.meta.lower[j as usize], self.meta.upper[j as usize]);
            let x = match w {
                _ if w == self.lower[at] => lower,
                _ if w == self.upper[at] => upper,
                _ => outward(self.d[at], w).min(upper).max(lower),
            };
            (j, x)
        })
    }

    /// The component's rows with their unscaled multipliers.
    pub fn multipliers<'f>(&'f self, iterate: &'f ComponentIterate<'_>) -> impl Iterator<Item = (u32, f64)> + 'f {
        let factors = self.row_factors(iterate);
        self.partition.rows(iterate.component).iter().zip(&*iterate.y).zip(factors).map(|((&i, y), factor)| (i, y * factor))
    }

    /// What unscales each row's multiplier. A row that has one rests on its limit: that is its value.
    pub(super) fn row_factors<'f>(&'f self, iterate: &'f ComponentIterate<'_>) -> impl Iterator<Item = f64> + 'f {
        self.partition.rows(iterate.component).iter().enumerate().map(|(at, &i)| {
            let (lower, upper) = (self.meta.row_lower[i as usize], self.meta.row_upper[i as usize]);
            let limit = if lower > 0.0 && (iterate.y[at] < 0.0 || upper == f64::INFINITY) { lower } else { upper };
            let value = if self.logarithmic_rows[at] { limit } else { 1.0 };
            iterate.row_scale[at] / iterate.header.scaled(iterate.header.objective).1 / value
        })
    }

    /// Takes the start for an answer, with the multipliers of all rows: on the limits whose multipliers say so.
    pub fn take_start(&self, iterate: &mut ComponentIterate<'_>, multipliers: &[f64]) {
        let x: Vec<f64> = self.partition.variables(iterate.component).iter().map(|&j| self.start[j as usize]).collect();
        let y: Vec<f64> = self.partition.rows(iterate.component).iter().map(|&i| multipliers[i as usize]).collect();
        self.take(iterate, &x, &y);
        for i in 0..self.m {
            let at = self.n + i;
            iterate.w[at] = match iterate.y[i] {
                y if y > PARAMETERS.idle => self.upper[at],
                y if y < -PARAMETERS.idle => self.lower[at],
                _ => pushed(self.rows[i], self.lower[at], self.upper[at], PARAMETERS.kappa_1),
            };
        }
        for (at, &w) in iterate.w.iter().enumerate() {
            iterate.z_lower[at] = f64::from(u8::from(w <= self.lower[at]));
            iterate.z_upper[at] = f64::from(u8::from(w >= self.upper[at]));
        }
    }

    /// Takes unscaled values and multipliers as the component's iterate.
    pub fn take(&self, iterate: &mut ComponentIterate<'_>, x: &[f64], multipliers: &[f64]) {
        for (at, &x) in x.iter().enumerate() {
            iterate.w[at] = inward(self.d[at], x);
        }
        iterate.y.copy_from_slice(multipliers);
        let factors: Vec<f64> = self.row_factors(iterate).collect();
        iterate.y.iter_mut().zip(factors).for_each(|(y, factor)| *y /= factor);
    }
}
