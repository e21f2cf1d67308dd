//! A model in the logarithms of its variables, y = ln x: posynomials become convex, monomial rows affine.

mod at_point;

use std::sync::Arc;

use crate::math::{dot, within};
use crate::model::{Evaluation, EvaluationError, Meta, Model, NameTable, Names, Pattern, Substitution};
use at_point::LogarithmicAt;

/// f(eʸ) and c(eʸ); rows that are monomials k·Πxᵃ become ln k + Σa·y.
pub struct Logarithmic {
    model: Arc<dyn Model + Send>,
    meta: Meta,
    /// Rows replaced by their logarithm.
    monomial: Vec<bool>,
    /// Exponents along the Jacobian's pattern; zero outside monomial rows.
    exponents: Vec<f64>,
    /// ln k of each monomial row.
    constants: Vec<f64>,
    /// Where the model's Hessian positions stand in this one's pattern, and where the diagonal does.
    slots: Vec<u32>,
    diagonal: Vec<u32>,
}

impl Logarithmic {
    /// The model in log variables. `monomial` says which rows are monomials with a positive factor.
    ///
    /// `None` unless every variable is positive between its bounds and the start, moved off zero, has values.
    pub fn new(model: Arc<dyn Model + Send>, monomial: Vec<bool>) -> Option<Self> {
        let user = model.meta();
        if user.lower.iter().any(|&lower| lower < 0.0) || user.upper.iter().any(|&upper| upper <= 0.0) {
            return None;
        }
        let start: Vec<f64> = (0..user.variables()).map(|j| positive(user.start[j], user.upper[j])).collect();
        let (exponents, constants) = monomials(model.as_ref(), &start, &monomial)?;
        let (hessian, slots, diagonal) = with_diagonal(&user.hessian);
        let limit = |limits: &[f64]| -> Vec<f64> {
            limits.iter().zip(&monomial).map(|(&limit, &monomial)| if monomial { ln(limit) } else { limit }).collect()
        };
        let meta = Meta {
            lower: user.lower.iter().copied().map(ln).collect(),
            upper: user.upper.iter().copied().map(ln).collect(),
            start: start.iter().copied().map(f64::ln).collect(),
            // A logarithm has no unit: 1 is a step by a factor e.
            typical: Vec::new(),
            row_lower: limit(&user.row_lower),
            row_upper: limit(&user.row_upper),
            row_constants: Vec::new(),
            row_is_linear: monomial.clone(),
            objective_is_linear: false,
            states: None,
            jacobian: user.jacobian.clone(),
            hessian,
            curvature: user.curvature,
            extra_work: user.extra_work,
            names: NameTable::new(LogNames(user.names.clone())),
        };
        Some(Logarithmic { model, meta, monomial, exponents, constants, slots, diagonal })
    }

    fn x(&self, y: &[f64]) -> Vec<f64> {
        y.iter().map(|y| y.exp()).collect()
    }
}

/// `ln b`
struct LogNames(NameTable);

impl Names for LogNames {
    fn variable(&self, j: usize) -> String {
        format!("ln {}", self.0.variable(j))
    }

    fn row(&self, i: usize) -> String {
        self.0.row(i)
    }

    fn row_place(&self, i: usize) -> Option<String> {
        self.0.row_place(i)
    }
}

/// The logarithm of a limit; what is not positive does not limit a positive quantity from below.
fn ln(limit: f64) -> f64 {
    if limit > 0.0 { limit.ln() } else { f64::NEG_INFINITY }
}

/// A start off zero.
fn positive(start: f64, upper: f64) -> f64 {
    if start > 0.0 { start } else { upper.min(1.0) * 1e-3 }
}

/// Exponents and ln k of the monomial rows: x_j·∂c/∂x_j = a_j·c wherever it is taken.
fn monomials(model: &dyn Model, x: &[f64], monomial: &[bool]) -> Option<(Vec<f64>, Vec<f64>)> {
    let pattern = &model.meta().jacobian;
    let (mut values, mut jacobian) = (vec![0.0; monomial.len()], vec![0.0; pattern.len()]);
    if monomial.contains(&true) {
        model.constraints(x, &mut values).ok()?;
        model.jacobian(x, &mut jacobian).ok()?;
    }
    let (mut exponents, mut constants) = (vec![0.0; pattern.len()], vec![0.0; monomial.len()]);
    for row in (0..monomial.len()).filter(|&row| monomial[row]) {
        if values[row] <= 0.0 {
            return None;
        }
        constants[row] = values[row].ln();
        for at in pattern.range(row) {
            let j = pattern.columns[at] as usize;
            exponents[at] = rounded(jacobian[at] * x[j] / values[row]);
            constants[row] -= exponents[at] * x[j].ln();
        }
    }
    Some((exponents, constants))
}

/// Exponents are nearly always whole or simple fractions; rounding of the division is taken off again.
fn rounded(exponent: f64) -> f64 {
    let twelfths = (exponent * 12.0).round() / 12.0;
    if (exponent - twelfths).abs() <= 1e-13 * exponent.abs() { twelfths } else { exponent }
}

fn with_diagonal(pattern: &Pattern) -> (Pattern, Vec<u32>, Vec<u32>) {
    let n = pattern.rows();
    let mut positions: Vec<(u32, u32)> = pattern.iter().map(|(i, j)| (i as u32, j as u32)).collect();
    positions.extend((0..n as u32).map(|j| (j, j)));
    let full = Pattern::from_positions(n, &mut positions);
    // Every position asked for was put in above.
    let slot = |i: usize, j: usize| full.position(i, j as u32).unwrap_or(0) as u32;
    let slots = pattern.iter().map(|(i, j)| slot(i, j)).collect();
    let diagonal = (0..n).map(|j| slot(j, j)).collect();
    (full, slots, diagonal)
}

impl Substitution for Logarithmic {
    fn model(&self) -> &dyn Model {
        self
    }

    fn outward(&self, y: &[f64]) -> Vec<f64> {
        let user = self.model.meta();
        let inside = |(j, x): (usize, f64)| match y[j] {
            // A bound reached in logarithms is that very bound.
            y if y <= self.meta.lower[j] => user.lower[j],
            y if y >= self.meta.upper[j] => user.upper[j],
            _ => within(x, user.lower[j], user.upper[j]),
        };
        self.x(y).into_iter().enumerate().map(inside).collect()
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        let upper = &self.model.meta().upper;
        x.iter().zip(upper).map(|(&x, &upper)| positive(x, upper).ln()).collect()
    }

    /// The user's rows say the same as these, and so their gradients point the same way where they are active: λ_i·∇c_i =
    /// λ'_i·∇c'_i, over relative changes of the variables; likewise the objectives.
    fn outward_multipliers(&self, user: &dyn Model, z: &[f64], y: &[f64]) -> Option<Vec<f64>> {
        if user.meta().rows() != self.monomial.len() || y.len() != self.monomial.len() {
            return None;
        }
        let x = self.outward(z);
        let (own, users) = (Slopes::of(self.model.as_ref(), &x)?, Slopes::of(user, &x)?);
        let factor = share(dot(&own.objective, &users.objective), dot(&own.objective, &own.objective))?;
        let one = |i: usize| {
            if y[i] == 0.0 {
                return Some(0.0);
            }
            let logarithm = if self.monomial[i] { own.values[i].recip() } else { 1.0 };
            let row = users.row(user.meta(), i);
            let along = row.clone().map(|(_, slope)| slope * slope).sum();
            let share = share(common(row, own.row(self.model.meta(), i)), along)?;
            Some(y[i] * factor * logarithm * share)
        };
        (0..y.len()).map(one).collect()
    }
}

/// Values and slopes of a model at x, over relative changes of its variables.
struct Slopes {
    x: Vec<f64>,
    objective: Vec<f64>,
    values: Vec<f64>,
    jacobian: Vec<f64>,
}

impl Slopes {
    fn of(model: &dyn Model, x: &[f64]) -> Option<Slopes> {
        let meta = model.meta();
        let (mut objective, mut values, mut jacobian) =
            (vec![0.0; x.len()], vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
        model.gradient(x, &mut objective).ok()?;
        model.constraints(x, &mut values).ok()?;
        model.jacobian(x, &mut jacobian).ok()?;
        objective.iter_mut().zip(x).for_each(|(slope, x)| *slope *= x);
        Some(Slopes { x: x.to_vec(), objective, values, jacobian })
    }

    /// The row's slopes by variable, ascending.
    fn row<'s>(&'s self, meta: &'s Meta, i: usize) -> impl Iterator<Item = (u32, f64)> + Clone + 's {
        meta.jacobian.range(i).map(|at| {
            let j = meta.jacobian.columns[at];
            (j, self.jacobian[at] * self.x[j as usize])
        })
    }
}

/// t of the t·a that is nearest to b, by a·b and a·a; `None` where a is no direction.
fn share(product: f64, square: f64) -> Option<f64> {
    Some(product / square).filter(|share| share.is_finite())
}

/// a·b of two sparse vectors by ascending places.
fn common(a: impl Iterator<Item = (u32, f64)>, b: impl Iterator<Item = (u32, f64)>) -> f64 {
    let (mut b, mut sum) = (b.peekable(), 0.0);
    for (place, value) in a {
        while b.next_if(|&(other, _)| other < place).is_some() {}
        sum += b.next_if(|&(other, _)| other == place).map_or(0.0, |(_, other)| value * other);
    }
    sum
}

impl Model for Logarithmic {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, y: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        let x = self.x(y);
        let inner = self.model.at(&x)?;
        Ok(Box::new(LogarithmicAt { view: self, y: y.to_vec(), x, inner, gradient: None, jacobian: None }))
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::derivative_check::derivative_check;
    use crate::model::sample::Sample;

    /// A posynomial objective, a monomial row and a posynomial row.
    fn model(least: f64) -> Sample {
        Sample::new(&[0.6, 0.4, 0.2], |x| x[0] * x[1] * 2.0 + x[2] / x[0] + (x[0] * x[1] * x[2]).sqrt())
            .bounds(&[least, 0.1, 0.0], &[1.0, 0.9, 1.0])
            .row(1e-3, f64::INFINITY, |x| x[0] * x[1].powi(3) / 12.0)
            .row(0.0, 1.0, |x| x[0] / x[1] + x[2] * x[2] * 0.5)
    }

    #[test]
    fn derivatives_stay_exact_and_monomial_rows_become_affine() {
        let log = Logarithmic::new(Arc::new(model(0.1)), vec![true, false]).unwrap();
        let check = derivative_check(&log, &[-0.7, -1.1, -0.4]).unwrap();
        assert_eq!(check.disagreements, 0, "{:?}", check.worst);
        let mut jacobian = [0.0; 6];
        log.jacobian(&[-0.7, -1.1, -0.4], &mut jacobian).unwrap();
        assert_eq!(jacobian[..3], [1.0, 3.0, 0.0]);
        let mut values = [0.0; 2];
        log.constraints(&[0.0, 0.0, 0.0], &mut values).unwrap();
        assert!((values[0] - (1.0f64 / 12.0).ln()).abs() < 1e-14);
        assert_eq!(log.meta().row_lower[0], 1e-3f64.ln());
        assert_eq!(log.outward(&log.meta().lower), [0.1, 0.1, 0.0]);
    }

    #[test]
    fn multipliers_are_those_of_the_users_rows() {
        let log = Logarithmic::new(Arc::new(model(0.1)), vec![true, false]).unwrap();
        // The same problem, its objective and second row in other units.
        let user = Sample::new(&[0.6, 0.4, 0.2], |x| (x[0] * x[1] * 2.0 + x[2] / x[0] + (x[0] * x[1] * x[2]).sqrt()) * 5.0)
            .row(1e-3, f64::INFINITY, |x| x[0] * x[1].powi(3) / 12.0)
            .row(f64::NEG_INFINITY, 10.0, |x| (x[0] / x[1] + x[2] * x[2] * 0.5) * 10.0);
        let x = [0.5, 0.3, 0.4];
        let found = log.outward_multipliers(&user, &log.inward(&x), &[-0.2, 0.3]).unwrap();
        let monomial = 0.5 * 0.3f64.powi(3) / 12.0;
        assert!((found[0] - 5.0 * -0.2 / monomial).abs() < 1e-9 * found[0].abs(), "{found:?}");
        assert!((found[1] - 5.0 * 0.3 / 10.0).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn variables_that_may_be_negative_have_no_logarithm() {
        assert!(Logarithmic::new(Arc::new(model(-0.1)), vec![true, false]).is_none());
    }
}
