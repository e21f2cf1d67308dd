//! H beams given by overall and web height, solved in the flange thickness: t = h − hw takes the place of h.
//!
//! h ≤ hw is outside the model's domain, and no solver respects a domain; it does respect the bound t > 0.

mod patterns;

use std::sync::Arc;

use crate::math::within;
use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError, Meta, Model, NameTable, Names, Pattern, Substitution};
use crate::problem::{Dimension, Problem};
use crate::sections;
use patterns::{bound_difference, connect_hessian, connect_jacobian};

/// Flanges thinner than this share of the overall height's reach are no longer told from zero.
const THINNEST: f64 = 1e-9;

/// A model in which some variables are replaced by their difference to another one.
pub struct FlangeSubstitution {
    model: Arc<dyn Model + Send>,
    /// For each variable, the one whose value is to be added: x_j = z_j + z_partner.
    partner: Vec<Option<u32>>,
    /// The replaced variables, in the order of the rows that keep their bounds.
    replaced: Vec<usize>,
    meta: Meta,
    /// The model's Jacobian position k goes to these positions (the second for the partner's column).
    jacobian_slots: Vec<[u32; 2]>,
    /// The model's Hessian position k adds factor × value to these positions.
    hessian_slots: Vec<Vec<(u32, f64)>>,
}

const NOWHERE: u32 = u32::MAX;

impl FlangeSubstitution {
    /// The pairs (h, hw) of the problem whose bounds let the flange vanish.
    pub fn pairs(problem: &Problem) -> Vec<(usize, usize)> {
        let mut taken = vec![false; problem.variables.lower.len()];
        let mut pairs = Vec::new();
        for section in 0..problem.sections.names.len() {
            let form = sections::form(problem.sections.form[section]);
            let dimensions = problem.dimensions(section);
            let parts = sections::kind_of(problem.sections.form[section]).part_factors(form);
            for [_, height] in parts {
                let Some((factor, minus)) = height.minus.filter(|(factor, _)| *factor == 1.0) else { continue };
                let (Dimension::Variable(h), Dimension::Variable(hw)) = (dimensions[height.plus], dimensions[minus]) else {
                    continue;
                };
                let (h, hw) = (h as usize, hw as usize);
                let may_vanish = problem.variables.lower[h] - factor * problem.variables.upper[hw] <= 0.0;
                let free = problem.variables.lower[h] < problem.variables.upper[h];
                if may_vanish && free && h != hw && !taken[h] && !taken[hw] {
                    (taken[h], taken[hw]) = (true, true);
                    pairs.push((h, hw));
                }
            }
        }
        pairs
    }

    /// Replaces h by h − hw for each pair (h, hw); no variable may stand in two pairs.
    pub fn new(model: Arc<dyn Model + Send>, pairs: &[(usize, usize)]) -> Self {
        let user = model.meta();
        let mut partner = vec![None; user.variables()];
        for &(h, hw) in pairs {
            partner[h] = Some(hw as u32);
        }
        let replaced: Vec<usize> = pairs.iter().map(|&(h, _)| h).collect();
        let mut meta = Meta {
            states: None,
            row_lower: user.row_lower.clone(),
            row_upper: user.row_upper.clone(),
            row_constants: user.row_constants.clone(),
            row_is_linear: user.row_is_linear.clone(),
            lower: user.lower.clone(),
            upper: user.upper.clone(),
            start: user.start.clone(),
            typical: user.typical.clone(),
            objective_is_linear: user.objective_is_linear,
            curvature: user.curvature,
            extra_work: user.extra_work,
            names: NameTable::new(FlangeNames {
                of: user.names.clone(),
                partner: partner.clone(),
                replaced: replaced.clone(),
                rows: user.rows(),
            }),
            jacobian: Pattern::default(),
            hessian: Pattern::default(),
        };
        for &(h, hw) in pairs {
            bound_difference(&mut meta, user, h, hw);
        }
        let jacobian_slots = connect_jacobian(user, &partner, &replaced, &mut meta);
        let hessian_slots = connect_hessian(user, &partner, &mut meta);
        FlangeSubstitution { model, partner, replaced, meta, jacobian_slots, hessian_slots }
    }

    fn add_to_partners(&self, values: &mut [f64]) {
        for (j, partner) in self.partner.iter().enumerate() {
            if let Some(partner) = partner {
                values[*partner as usize] += values[j];
            }
        }
    }
}

/// `h - hw` for what replaces h, `bounds of h` for the rows that follow.
struct FlangeNames {
    of: NameTable,
    partner: Vec<Option<u32>>,
    replaced: Vec<usize>,
    rows: usize,
}

impl Names for FlangeNames {
    fn variable(&self, j: usize) -> String {
        match self.partner[j] {
            Some(partner) => format!("{} - {}", self.of.variable(j), self.of.variable(partner as usize)),
            None => self.of.variable(j),
        }
    }

    fn row(&self, i: usize) -> String {
        match i.checked_sub(self.rows) {
            Some(at) => format!("bounds of {}", self.of.variable(self.replaced[at])),
            None => self.of.row(i),
        }
    }

    fn row_place(&self, i: usize) -> Option<String> {
        if i < self.rows { self.of.row_place(i) } else { None }
    }
}

impl Substitution for FlangeSubstitution {
    fn model(&self) -> &dyn Model {
        self
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        let mut x = z.to_vec();
        for (j, partner) in self.partner.iter().enumerate() {
            if let Some(partner) = partner {
                let user = self.model.meta();
                x[j] = within(z[j] + z[*partner as usize], user.lower[j], user.upper[j]);
            }
        }
        x
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        let mut z = x.to_vec();
        for (j, partner) in self.partner.iter().enumerate() {
            if let Some(partner) = partner {
                z[j] = within(x[j] - x[*partner as usize], self.meta.lower[j], self.meta.upper[j]);
            }
        }
        z
    }

    fn vanishing(&self, x: &[f64]) -> Vec<(usize, usize)> {
        let pair = |&h: &usize| Some((h, self.partner[h]? as usize));
        let gone = |&(h, hw): &(usize, usize)| x[h] - x[hw] <= 2.0 * self.meta.lower[h];
        self.replaced.iter().filter_map(pair).filter(gone).collect()
    }

    fn outward_multipliers(&self, user: &dyn Model, _z: &[f64], y: &[f64]) -> Option<Vec<f64>> {
        Some(y.get(..user.meta().rows())?.to_vec())
    }
}

impl Model for FlangeSubstitution {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, z: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        let x = self.raw(z);
        Ok(Box::new(SubstitutedAt { view: self, inner: self.model.at(&x)?, x }))
    }
}

/// One point in the substituted variables.
struct SubstitutedAt<'m> {
    view: &'m FlangeSubstitution,
    x: Vec<f64>,
    inner: Box<dyn Evaluation + 'm>,
}

impl Evaluation for SubstitutedAt<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.inner.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let value = self.inner.gradient(gradient)?;
        self.view.add_to_partners(gradient);
        Ok(value)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let (rows, heights) = values.split_at_mut(self.view.model.meta().rows());
        for (height, &h) in heights.iter_mut().zip(&self.view.replaced) {
            *height = self.x[h];
        }
        self.inner.constraints(rows)
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut user = vec![0.0; self.view.jacobian_slots.len()];
        self.inner.jacobian(&mut user)?;
        values.fill(0.0);
        for (slots, value) in self.view.jacobian_slots.iter().zip(user) {
            for &slot in slots.iter().filter(|&&slot| slot != NOWHERE) {
                values[slot as usize] += value;
            }
        }
        let first = self.view.meta.jacobian.offsets[self.view.model.meta().rows()];
        values[first..].fill(1.0);
        Ok(())
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut user = vec![0.0; self.view.hessian_slots.len()];
        self.inner.hessian(weight, &y[..self.view.model.meta().rows()], &mut user)?;
        values.fill(0.0);
        for (slots, value) in self.view.hessian_slots.iter().zip(user) {
            for &(slot, factor) in slots {
                values[slot as usize] += factor * value;
            }
        }
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}

impl FlangeSubstitution {
    /// x(z) as it is, not moved into bounds: derivatives must be those of a linear map.
    fn raw(&self, z: &[f64]) -> Vec<f64> {
        let mut x = z.to_vec();
        for (j, partner) in self.partner.iter().enumerate() {
            if let Some(partner) = partner {
                x[j] += z[*partner as usize];
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::derivative_check::derivative_check;
    use crate::model::sample::Sample;

    /// x = (h, hw, b): a flange area with a root, and rows that hold h, hw and both.
    fn model() -> Sample {
        Sample::new(&[0.6, 0.4, 0.2], |x| x[2] * (x[0] - x[1]) + ((x[0] - x[1]) * x[2]).sqrt() * x[1])
            .bounds(&[0.1, 0.1, 0.01], &[1.0, 0.9, 1.0])
            .row(0.1, 2.0, |x| x[2] * x[0].powi(3) - x[1].powi(3))
            .row(0.0, 1.0, |x| x[0] * x[0] * x[1])
    }

    #[test]
    fn derivatives_stay_exact() {
        let model = model();
        let differences = FlangeSubstitution::new(Arc::new(model), &[(0, 1)]);
        let check = derivative_check(&differences, &[0.23, 0.45, 0.3]).unwrap();
        assert_eq!(check.disagreements, 0, "{:?}", check.worst);
        assert!(check.compared > 10);
    }

    #[test]
    fn points_go_there_and_back_and_bounds_become_a_row() {
        let model = model();
        let differences = FlangeSubstitution::new(Arc::new(model), &[(0, 1)]);
        let x = [0.7, 0.5, 0.3];
        let z = differences.inward(&x);
        assert!(z.iter().zip([0.2, 0.5, 0.3]).all(|(z, expected): (&f64, f64)| (z - expected).abs() < 1e-15));
        assert!(differences.outward(&z).iter().zip(x).all(|(there, x)| (there - x).abs() < 1e-15));
        assert_eq!((differences.meta().rows(), differences.meta().row_lower[2], differences.meta().row_upper[2]), (3, 0.1, 1.0));
        assert!(differences.meta().lower[0] > 0.0);
    }
}
