//! Values at other points than the judged one, measured with that one's scales.

use crate::certificate::multipliers::Multipliers;
use crate::certificate::parameters::feasibility::ROUNDINGS;
use crate::certificate::parameters::higher_order::CORRECTED;
use crate::certificate::point::Point;
use crate::certificate::scales::{self, RowTerms};
use crate::model::Model;

/// Objective and rows.
pub(super) struct Values {
    pub(super) objective: f64,
    pub(super) rows: Vec<f64>,
}

/// Another point.
pub(in crate::certificate) struct Trial<'x> {
    x: &'x [f64],
    pub(super) values: Values,
    /// The rows' terms here, or, where they have no derivatives here, at the judged point.
    terms: RowTerms,
}

impl<'x> Trial<'x> {
    /// `None` where the model has no value.
    pub(in crate::certificate) fn at(point: &Point<'_>, x: &'x [f64]) -> Option<Trial<'x>> {
        let (model, meta) = (&point.origin.model, point.meta());
        let (mut rows, mut jacobian) = (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
        let mut at = model.at(x).ok()?;
        at.constraints(&mut rows).ok()?;
        let objective = at.objective().ok()?;
        let terms = match at.jacobian(&mut jacobian) {
            Ok(()) => scales::row_terms(meta, x, &jacobian),
            Err(_) => point.terms.clone(),
        };
        Some(Trial { x, values: Values { objective, rows }, terms })
    }

    pub(in crate::certificate) fn objective(&self) -> f64 {
        self.values.objective
    }

    /// Whether it meets bounds and rows as well as the judged point must.
    pub(in crate::certificate) fn is_feasible(&self, point: &Point<'_>, tolerance: f64) -> bool {
        let meta = point.meta();
        let scale = |i: usize, limit: f64| {
            let rounding = ROUNDINGS * (limit.abs() + self.terms.all[i].max(point.terms.all[i]));
            tolerance * limit.abs().max(self.terms.moving[i]) + rounding + CORRECTED * point.slopes[i]
        };
        let meets = |i: usize| {
            let (lower, upper, value) = (meta.row_lower[i], meta.row_upper[i], self.values.rows[i]);
            (lower.is_infinite() || value >= lower - scale(i, lower)) && (upper.is_infinite() || value <= upper + scale(i, upper))
        };
        let inside = |j: usize| {
            let slack = tolerance * point.sizes[j];
            self.x[j] >= meta.lower[j] - slack && self.x[j] <= meta.upper[j] + slack
        };
        (0..self.x.len()).all(inside) && (0..self.values.rows.len()).all(meets)
    }
}

impl Values {
    /// f + yᵀ(c − limit) with the judged point's multipliers.
    pub(super) fn lagrangian(&self, point: &Point<'_>, multipliers: &Multipliers) -> f64 {
        self.terms(point, multipliers).map(|(y, distance)| y * distance).sum::<f64>() + self.objective
    }

    /// f + Σ|y_i|·violation_i: what violations within the tolerance gain is taken off again.
    pub(super) fn penalised(&self, point: &Point<'_>, multipliers: &Multipliers) -> f64 {
        self.terms(point, multipliers).map(|(y, distance)| (y * distance).max(0.0)).sum::<f64>() + self.objective
    }

    /// What rounding may make of either.
    pub(super) fn rounding(&self, point: &Point<'_>, multipliers: &Multipliers) -> f64 {
        let size = |i: usize, y: f64| y.abs() * (self.rows[i].abs() + point.row_limit(i, y).abs());
        let rows: f64 = multipliers.rows.iter().enumerate().filter(|(_, y)| **y != 0.0).map(|(i, &y)| size(i, y)).sum();
        ROUNDINGS * (self.objective.abs() + rows)
    }

    /// (y_i, c_i − limit_i)
    fn terms(&self, point: &Point<'_>, multipliers: &Multipliers) -> impl Iterator<Item = (f64, f64)> {
        let with_multiplier = multipliers.rows.iter().enumerate().filter(|(_, y)| **y != 0.0);
        with_multiplier.map(|(i, &y)| (y, self.rows[i] - point.row_limit(i, y)))
    }
}
