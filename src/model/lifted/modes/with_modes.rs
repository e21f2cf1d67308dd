//! A model with eigenvalues as further rows, before the state equations.

use super::{Modes, Solved};
use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError, Meta, Model, Pattern};

/// A model whose rows are those of another, with eigenvalues put in.
pub(in super::super) struct WithModes<F> {
    first: F,
    modes: Option<Modes>,
    /// Rows of the first model that stand before the eigenvalues.
    before: usize,
    meta: Meta,
    /// Where the first model's Jacobian and Hessian stand.
    jacobian_places: Vec<usize>,
    hessian_places: Vec<usize>,
    /// The variables of each eigenvalue.
    columns: Vec<Vec<u32>>,
}

impl<F: Model> WithModes<F> {
    /// The first model's rows with the eigenvalues after the first `before` of them.
    pub fn new(first: F, modes: Option<Modes>, before: usize) -> Self {
        let own = first.meta();
        let columns = modes.as_ref().map_or_else(Vec::new, Modes::columns);
        let count = columns.len();
        let moved = |row: usize| if row < before { row } else { row + count };
        let mut positions: Vec<(u32, u32)> = own.jacobian.iter().map(|(row, j)| (moved(row) as u32, j as u32)).collect();
        for (at, columns) in columns.iter().enumerate() {
            positions.extend(columns.iter().map(|&j| ((before + at) as u32, j)));
        }
        let jacobian = Pattern::from_positions(own.rows() + count, &mut positions);
        let mut positions: Vec<(u32, u32)> = own.hessian.iter().map(|(row, column)| (row as u32, column as u32)).collect();
        for columns in &columns {
            positions.extend(columns.iter().enumerate().flat_map(|(at, &i)| columns[..=at].iter().map(move |&j| (i, j))));
        }
        let hessian = Pattern::from_positions(own.variables(), &mut positions);
        // Every position looked up was announced above.
        let place = |pattern: &Pattern, row: usize, column: usize| pattern.position(row, column as u32).unwrap_or_default();
        let jacobian_places = own.jacobian.iter().map(|(row, j)| place(&jacobian, moved(row), j)).collect();
        let hessian_places = own.hessian.iter().map(|(row, column)| place(&hessian, row, column)).collect();
        let spread = |limits: &[f64], open: f64| -> Vec<f64> {
            let (head, tail) = limits.split_at(before.min(limits.len()));
            head.iter().copied().chain(std::iter::repeat_n(open, count)).chain(tail.iter().copied()).collect()
        };
        let meta = Meta {
            row_lower: spread(&own.row_lower, f64::NEG_INFINITY),
            row_upper: spread(&own.row_upper, f64::INFINITY),
            row_constants: spread(&own.row_constants, 0.0),
            row_is_linear: Vec::new(),
            jacobian,
            hessian,
            ..own.clone()
        };
        WithModes { first, modes, before, meta, jacobian_places, hessian_places, columns }
    }

    /// The model without them.
    pub fn first(&self) -> &F {
        &self.first
    }

    /// The eigenvalues, where there are any.
    pub fn modes(&self) -> Option<&Modes> {
        self.modes.as_ref()
    }
}

impl<F: Model> Model for WithModes<F> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, z: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        let solved = self.modes.as_ref().map(|modes| modes.at(z));
        Ok(Box::new(AtPoint { view: self, first: self.first.at(z)?, solved }))
    }
}

struct AtPoint<'m, F> {
    view: &'m WithModes<F>,
    first: Box<dyn Evaluation + 'm>,
    solved: Option<Solved<'m>>,
}

impl<F: Model> AtPoint<'_, F> {
    /// A list by row of the first model, from one by row of the whole.
    fn without_modes(&self, whole: &[f64]) -> Vec<f64> {
        let (before, count) = (self.view.before, self.view.columns.len());
        whole[..before].iter().chain(&whole[before + count..]).copied().collect()
    }
}

impl<F: Model> Evaluation for AtPoint<'_, F> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.first.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.first.gradient(gradient)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let Some(solved) = &mut self.solved else { return self.first.constraints(values) };
        let (before, count) = (self.view.before, self.view.columns.len());
        let mut own = vec![0.0; values.len() - count];
        self.first.constraints(&mut own)?;
        values[..before].copy_from_slice(&own[..before]);
        values[before..before + count].copy_from_slice(&solved.values()?);
        values[before + count..].copy_from_slice(&own[before..]);
        Ok(())
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let mut own = vec![0.0; view.jacobian_places.len()];
        self.first.jacobian(&mut own)?;
        values.fill(0.0);
        view.jacobian_places.iter().zip(own).for_each(|(&place, value)| values[place] = value);
        let (Some(solved), Some(modes)) = (&mut self.solved, &view.modes) else { return Ok(()) };
        for (at, &one) in modes.wanted.iter().enumerate() {
            let smooth = solved.smooth(one, false)?;
            for place in view.meta.jacobian.range(view.before + at) {
                values[place] = smooth.slope[view.meta.jacobian.columns[place] as usize];
            }
        }
        Ok(())
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let mut own = vec![0.0; view.hessian_places.len()];
        let of_first = self.without_modes(y);
        self.first.hessian(weight, &of_first, &mut own)?;
        values.fill(0.0);
        view.hessian_places.iter().zip(own).for_each(|(&place, value)| values[place] = value);
        let (Some(solved), Some(modes)) = (&mut self.solved, &view.modes) else { return Ok(()) };
        for (&one, &multiplier) in modes.wanted.iter().zip(&y[view.before..]).filter(|(_, multiplier)| **multiplier != 0.0) {
            for (row, column, value) in solved.smooth(one, true)?.curvature {
                if let Some(place) = view.meta.hessian.position(row, column as u32) {
                    values[place] += multiplier * value;
                }
            }
        }
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}
