//! The composition at one point: the first model's rows and Jacobian, and the second model's, are computed once and only when asked for.

use super::{Composed, for_pairs};
use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError, Model};

/// Both models at a point.
pub(super) struct AtPoint<'m, F, S> {
    view: &'m Composed<F, S>,
    z: Vec<f64>,
    first: First<'m>,
    second: Option<Second<'m>>,
}

/// The first model at z.
struct First<'m> {
    at: Box<dyn Evaluation + 'm>,
    /// Its rows.
    rows: Option<Vec<f64>>,
    /// Its Jacobian, and V.
    slopes: Option<(Vec<f64>, Vec<f64>)>,
}

/// The second model at v(z).
struct Second<'m> {
    at: Box<dyn Evaluation + 'm>,
    /// f₂ and ∇f₂.
    gradient: Option<(f64, Vec<f64>)>,
    jacobian: Option<Vec<f64>>,
}

/// What is kept, computed where it is not yet.
fn kept<T>(place: &mut Option<T>, compute: impl FnOnce() -> Result<T, EvaluationError>) -> Result<&mut T, EvaluationError> {
    match place {
        Some(value) => Ok(value),
        None => Ok(place.insert(compute()?)),
    }
}

impl First<'_> {
    fn rows(&mut self, count: usize) -> Result<&[f64], EvaluationError> {
        let Self { at, rows, .. } = self;
        let rows = kept(rows, || {
            let mut rows = vec![0.0; count];
            at.constraints(&mut rows)?;
            Ok(rows)
        })?;
        Ok(rows)
    }

    /// The Jacobian, and V.
    fn slopes<F: Model, S: Model>(&mut self, view: &Composed<F, S>) -> Result<&(Vec<f64>, Vec<f64>), EvaluationError> {
        let Self { at, slopes, .. } = self;
        let slopes = kept(slopes, || {
            let mut jacobian = vec![0.0; view.first.meta().jacobian.len()];
            at.jacobian(&mut jacobian)?;
            let slopes = view.slopes(&jacobian);
            Ok((jacobian, slopes))
        })?;
        Ok(slopes)
    }
}

impl Second<'_> {
    fn gradient(&mut self, variables: usize) -> Result<&(f64, Vec<f64>), EvaluationError> {
        let Self { at, gradient, .. } = self;
        let gradient = kept(gradient, || {
            let mut gradient = vec![0.0; variables];
            let value = at.gradient(&mut gradient)?;
            Ok((value, gradient))
        })?;
        Ok(gradient)
    }

    fn jacobian(&mut self, entries: usize) -> Result<&[f64], EvaluationError> {
        let Self { at, jacobian, .. } = self;
        let jacobian = kept(jacobian, || {
            let mut jacobian = vec![0.0; entries];
            at.jacobian(&mut jacobian)?;
            Ok(jacobian)
        })?;
        Ok(jacobian)
    }
}

impl<'m, F: Model, S: Model> AtPoint<'m, F, S> {
    pub fn new(view: &'m Composed<F, S>, z: &[f64]) -> Result<Self, EvaluationError> {
        let first = First { at: view.first.at(z)?, rows: None, slopes: None };
        Ok(AtPoint { view, z: z.to_vec(), first, second: None })
    }

    fn both(&mut self) -> Result<(&mut First<'m>, &mut Second<'m>), EvaluationError> {
        let Self { view, z, first, second } = self;
        let second = kept(second, || {
            let v = view.inputs(z, first.rows(view.first.meta().rows())?);
            Ok(Second { at: view.second.at(&v)?, gradient: None, jacobian: None })
        })?;
        Ok((first, second))
    }

    /// ŷ = Γᵀ·(w·∇f₂ + c₂_vᵀ·y) for the rows that feed the second model, the rest as it is.
    fn first_multipliers(&mut self, weight: f64, own: &[f64], rest: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let view = self.view;
        let two = view.second.meta();
        let mut slope = vec![0.0; two.variables()];
        if weight != 0.0 {
            slope.copy_from_slice(&self.both()?.1.gradient(two.variables())?.1);
            slope.iter_mut().for_each(|slope| *slope *= weight);
        }
        two.jacobian.add_transposed(self.both()?.1.jacobian(two.jacobian.len())?, own, &mut slope);
        let mut multipliers = vec![0.0; view.first.meta().rows()];
        for (input, &slope) in slope.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
            view.links.rows.row(input).iter().for_each(|&(row, gamma)| multipliers[row as usize] += gamma * slope);
        }
        multipliers[view.own_rows..].iter_mut().zip(rest).for_each(|(multiplier, y)| *multiplier += y);
        Ok(multipliers)
    }
}

impl<F: Model, S: Model> Evaluation for AtPoint<'_, F, S> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.both()?.1.at.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let view = self.view;
        let (first, second) = self.both()?;
        let slopes = &first.slopes(view)?.1;
        let (value, inner) = second.gradient(view.second.meta().variables())?;
        gradient.fill(0.0);
        view.slopes.add_transposed(slopes, inner, gradient);
        Ok(*value)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let (own, rest) = values.split_at_mut(view.second.meta().rows());
        let (first, second) = self.both()?;
        second.at.constraints(own)?;
        rest.copy_from_slice(&first.rows(view.first.meta().rows())?[view.own_rows..]);
        Ok(())
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let pattern = &view.second.meta().jacobian;
        let (first, second) = self.both()?;
        let ((first, slopes), second) = (first.slopes(view)?, second.jacobian(pattern.len())?);
        values.fill(0.0);
        let mut places = view.jacobian_places.iter();
        for (entry, (_, input)) in pattern.iter().enumerate() {
            let range = view.slopes.range(input);
            for (slope, &place) in slopes[range.clone()].iter().zip(places.by_ref().take(range.len())) {
                values[place as usize] += second[entry] * slope;
            }
        }
        let begin = view.first.meta().jacobian.offsets[view.own_rows];
        view.first_places.iter().zip(&first[begin..]).for_each(|(&place, value)| values[place as usize] += value);
        Ok(())
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let two = view.second.meta();
        let (own, rest) = y.split_at(two.rows());
        let mut second = vec![0.0; two.hessian.len()];
        self.both()?.1.at.hessian(weight, own, &mut second)?;
        values.fill(0.0);
        let mut places = view.hessian_places.iter();
        let slopes = &self.first.slopes(view)?.1;
        for_pairs(&two.hessian, &view.slopes, |a, b, _, _, (entry, times)| {
            if let Some(&place) = places.next() {
                values[place as usize] += times * second[entry] * slopes[a] * slopes[b];
            }
        });
        let multipliers = self.first_multipliers(weight, own, rest)?;
        let mut first = vec![0.0; view.first.meta().hessian.len()];
        self.first.at.hessian(0.0, &multipliers, &mut first)?;
        view.first_hessian.iter().zip(&first).for_each(|(&place, value)| values[place as usize] += value);
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}
