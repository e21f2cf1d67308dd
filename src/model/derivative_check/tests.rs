use super::derivative_check;
use crate::model::{EvaluationError, Meta, Model, Pattern};

/// Rows x_i²·x_(i+1) along a chain; the derivative of one row may be wrong.
struct Chain {
    meta: Meta,
    wrong: Option<usize>,
}

impl Chain {
    fn new(n: usize, wrong: Option<usize>) -> Self {
        let rows = n - 1;
        let mut jacobian = (0..rows as u32).flat_map(|i| [(i, i), (i, i + 1)]).collect();
        let mut hessian = (0..n as u32).flat_map(|i| [(i, i), (i, i.saturating_sub(1))]).collect();
        let meta = Meta {
            lower: vec![0.0; n],
            upper: vec![2.0; n],
            start: vec![1.0; n],
            row_lower: vec![f64::NEG_INFINITY; rows],
            row_upper: vec![1.0; rows],
            jacobian: Pattern::from_positions(rows, &mut jacobian),
            hessian: Pattern::from_positions(n, &mut hessian),
            ..Meta::default()
        };
        Chain { meta, wrong }
    }
}

impl Model for Chain {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        Ok(x.iter().sum())
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        gradient.fill(1.0);
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.iter_mut().zip(x.windows(2)).for_each(|(value, pair)| *value = pair[0] * pair[0] * pair[1]);
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (i, (values, pair)) in values.chunks_mut(2).zip(x.windows(2)).enumerate() {
            let factor = if self.wrong == Some(i) { 1.01 } else { 1.0 };
            (values[0], values[1]) = (factor * 2.0 * pair[0] * pair[1], pair[0] * pair[0]);
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], _weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.fill(0.0);
        for (i, (y, pair)) in y.iter().zip(x.windows(2)).enumerate() {
            let at = |row: usize, column: usize| self.meta.hessian.position(row, column as u32).unwrap();
            values[at(i, i)] += 2.0 * y * pair[1];
            values[at(i + 1, i)] += 2.0 * y * pair[0];
        }
        Ok(())
    }
}

fn point(n: usize) -> Vec<f64> {
    (0..n).map(|j| 0.5 + (j as f64 * 0.618).fract()).collect()
}

#[test]
fn of_a_long_chain_many_variables_are_looked_at_at_once() {
    let check = derivative_check(&Chain::new(1000, None), &point(1000)).unwrap();
    assert_eq!((check.disagreements, check.variables), (0, (334, 1000)));
}

#[test]
fn one_wrong_derivative_among_many_is_found_and_named() {
    for n in [30, 1000] {
        let check = derivative_check(&Chain::new(n, Some(15)), &point(n)).unwrap();
        let worst = check.worst.unwrap();
        assert!(check.disagreements > 0 && worst.error > 1e-3, "{worst:?}");
        assert_eq!(worst.name, "∂(c16)/∂(x[16])");
    }
}
