//! The elastic problem: how little must the rows give way for a point to exist?

use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError, Meta, Model, NameTable, Names, Pattern};

/// What slacks have to spare at the start, so that interior methods have room and slacks have a size of their own.
const ROOM: f64 = 0.1;

/// Minimise Σ(p + q) over (x, p, q) subject to c_l ≤ c(x) − S·p + S·q ≤ c_u, p, q ≥ 0 and x inside its bounds, for chosen rows
/// of a model; the others are left out. S_i is the row's scale at the reference point. Bounds stay hard.
pub struct Elastic<'a> {
    model: &'a dyn Model,
    meta: Meta,
    /// The chosen rows, ascending.
    rows: Vec<usize>,
    /// (place among the chosen, signed scale) of each slack: negative where the upper side gives way.
    slacks: Vec<(usize, f64)>,
    scales: Vec<f64>,
}

impl<'a> Elastic<'a> {
    /// The elastic form of the rows `rows` (ascending) of `model`, starting at `start` with more slack than it needs, its rows
    /// in units of their terms at `reference`.
    ///
    /// # Errors
    /// The model has no value or derivative at `start` or `reference`.
    pub fn new(model: &'a dyn Model, rows: Vec<usize>, start: &[f64], reference: &[f64]) -> Result<Self, EvaluationError> {
        let base = model.meta();
        let mut values = vec![0.0; base.rows()];
        model.constraints(start, &mut values)?;
        let scales = row_scales(model, start, reference)?;
        let (mut slacks, mut start) = (Vec::new(), start.to_vec());
        for (k, &i) in rows.iter().enumerate() {
            if base.row_upper[i].is_finite() {
                slacks.push((k, -scales[i]));
                start.push((values[i] - base.row_upper[i]).max(0.0) / scales[i] + ROOM);
            }
            if base.row_lower[i].is_finite() {
                slacks.push((k, scales[i]));
                start.push((base.row_lower[i] - values[i]).max(0.0) / scales[i] + ROOM);
            }
        }
        let meta = elastic_meta(base, &rows, &slacks, start);
        Ok(Elastic { model, meta, rows, slacks, scales })
    }

    /// The original variables of a point.
    pub fn original<'x>(&self, point: &'x [f64]) -> &'x [f64] {
        &point[..self.variables().min(point.len())]
    }

    /// Σ(p + q): the relative violation in all.
    pub fn violation(&self, point: &[f64]) -> f64 {
        point.iter().skip(self.variables()).sum()
    }

    /// The row of the original model behind row k.
    pub fn row(&self, k: usize) -> usize {
        self.rows[k]
    }

    /// The scale S of row k.
    pub fn scale(&self, k: usize) -> f64 {
        self.scales[self.rows[k]]
    }

    fn variables(&self) -> usize {
        self.model.meta().variables()
    }

    fn scatter(&self, y: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.scales.len()];
        for (&i, &y) in self.rows.iter().zip(y) {
            all[i] = y;
        }
        all
    }
}

/// max(|limit|, |∂c_i/∂x_j·x_j|) at `reference` where a limit is not 0; else ‖D∇c_i‖∞ at `start` with d_j = |x_j|, or 1 where that
/// is 0; 1 where all of it vanishes.
fn row_scales(model: &dyn Model, start: &[f64], reference: &[f64]) -> Result<Vec<f64>, EvaluationError> {
    let meta = model.meta();
    let limit = |i: usize| {
        [meta.row_lower[i], meta.row_upper[i]].into_iter().filter(|l| l.is_finite()).fold(0.0, |m: f64, l| m.max(l.abs()))
    };
    let size = |x: f64| if x == 0.0 { 1.0 } else { x.abs() };
    let at = |x: &[f64], size: &dyn Fn(f64) -> f64| -> Result<Vec<f64>, EvaluationError> {
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        model.jacobian(x, &mut jacobian)?;
        let slope = |at: usize| (jacobian[at] * size(x[meta.jacobian.columns[at] as usize])).abs();
        Ok((0..meta.rows()).map(|i| meta.jacobian.range(i).map(slope).fold(limit(i), f64::max)).collect())
    };
    let (terms, slopes) = (at(reference, &f64::abs)?, at(start, &size)?);
    let scale = |i: usize| if limit(i) > 0.0 { terms[i] } else { slopes[i] };
    Ok((0..meta.rows()).map(scale).map(|s| if s > 0.0 { s } else { 1.0 }).collect())
}

/// The chosen rows' names; `slack of row c` for what follows the variables.
struct ElasticNames {
    of: NameTable,
    variables: usize,
    rows: Vec<usize>,
    slacks: Vec<usize>,
}

impl Names for ElasticNames {
    fn variable(&self, j: usize) -> String {
        match j.checked_sub(self.variables) {
            None => self.of.variable(j),
            Some(at) => format!("slack of row {}", self.row(self.slacks[at])),
        }
    }

    fn row(&self, k: usize) -> String {
        self.of.row(self.rows[k])
    }

    fn row_place(&self, k: usize) -> Option<String> {
        self.of.row_place(self.rows[k])
    }
}

fn elastic_meta(base: &Meta, rows: &[usize], slacks: &[(usize, f64)], start: Vec<f64>) -> Meta {
    let (n, more) = (base.variables(), slacks.len());
    let mut jacobian = Pattern { offsets: vec![0], columns: Vec::new() };
    let mut next = slacks.iter().enumerate().peekable();
    for (k, &i) in rows.iter().enumerate() {
        jacobian.columns.extend_from_slice(base.jacobian.row(i));
        while let Some((place, _)) = next.next_if(|(_, slack)| slack.0 == k) {
            jacobian.columns.push((n + place) as u32);
        }
        jacobian.offsets.push(jacobian.columns.len());
    }
    let mut hessian = base.hessian.clone();
    hessian.offsets.extend(std::iter::repeat_n(hessian.columns.len(), more));
    let chosen = |all: &[f64]| rows.iter().map(|&i| all[i]).collect();
    Meta {
        lower: base.lower.iter().copied().chain(std::iter::repeat_n(0.0, more)).collect(),
        upper: base.upper.iter().copied().chain(std::iter::repeat_n(f64::INFINITY, more)).collect(),
        start,
        typical: base
            .typical
            .iter()
            .copied()
            .chain(std::iter::repeat_n(0.0, if base.typical.is_empty() { 0 } else { more }))
            .collect(),
        row_lower: chosen(&base.row_lower),
        row_upper: chosen(&base.row_upper),
        row_constants: if base.row_constants.is_empty() { Vec::new() } else { chosen(&base.row_constants) },
        row_is_linear: rows.iter().map(|&i| base.is_row_linear(i)).collect(),
        objective_is_linear: true,
        states: None,
        jacobian,
        hessian,
        curvature: base.curvature,
        extra_work: base.extra_work,
        names: NameTable::new(ElasticNames {
            of: base.names.clone(),
            variables: n,
            rows: rows.to_vec(),
            slacks: slacks.iter().map(|&(k, _)| k).collect(),
        }),
    }
}

impl Model for Elastic<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, point: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(ElasticAt { view: self, point: point.to_vec(), inner: self.model.at(self.original(point))? }))
    }
}

/// One point with its slacks.
struct ElasticAt<'m> {
    view: &'m Elastic<'m>,
    point: Vec<f64>,
    inner: Box<dyn Evaluation + 'm>,
}

impl Evaluation for ElasticAt<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        Ok(self.view.violation(&self.point))
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let (original, slacks) = gradient.split_at_mut(self.view.variables());
        original.fill(0.0);
        slacks.fill(1.0);
        self.objective()
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let mut all = vec![0.0; view.scales.len()];
        self.inner.constraints(&mut all)?;
        for (value, &i) in values.iter_mut().zip(&view.rows) {
            *value = all[i];
        }
        for (&(k, scale), slack) in view.slacks.iter().zip(&self.point[view.variables()..]) {
            values[k] += scale * slack;
        }
        Ok(())
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let base = &self.view.model.meta().jacobian;
        let mut all = vec![0.0; base.len()];
        self.inner.jacobian(&mut all)?;
        let mut next = self.view.slacks.iter().peekable();
        let mut at = 0;
        for (k, &i) in self.view.rows.iter().enumerate() {
            let own = &all[base.range(i)];
            values[at..at + own.len()].copy_from_slice(own);
            at += own.len();
            while let Some(&(_, scale)) = next.next_if(|slack| slack.0 == k) {
                values[at] = scale;
                at += 1;
            }
        }
        Ok(())
    }

    fn hessian(&mut self, _weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let all = self.view.scatter(y);
        self.inner.hessian(0.0, &all, values)
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::sample::Sample;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn slacks_make_any_point_feasible_and_derivatives_agree_with_differences() {
        let model = Sample::new(&[1.5, 2.0], |x| x[0])
            .row(-INF, 1.0, |x| x[0] * x[0] + x[1] * x[1])
            .row(9.0, 9.0, |x| x[0] * x[1])
            .row(3.0, INF, |x| x[0] - x[1]);
        let elastic = Elastic::new(&model, vec![0, 1, 2], &[1.5, 2.0], &[1.5, 2.0]).unwrap();
        let start = elastic.meta().start.clone();
        assert_eq!(start.len(), 6);
        let mut values = [0.0; 3];
        elastic.constraints(&start, &mut values).unwrap();
        assert!(values[0] <= 1.0 && (values[1] - 9.0).abs() < 1e-12 && values[2] >= 3.0, "{values:?}");
        let pattern = &elastic.meta().jacobian;
        let mut jacobian = vec![0.0; pattern.len()];
        elastic.jacobian(&start, &mut jacobian).unwrap();
        for (at, (row, column)) in pattern.iter().enumerate() {
            let (mut up, mut down, mut high, mut low) = (start.clone(), start.clone(), [0.0; 3], [0.0; 3]);
            up[column] += 1e-6;
            down[column] -= 1e-6;
            elastic.constraints(&up, &mut high).unwrap();
            elastic.constraints(&down, &mut low).unwrap();
            assert!((jacobian[at] - (high[row] - low[row]) / 2e-6).abs() < 1e-6, "{row} {column}");
        }
    }

    #[test]
    fn rows_left_out_do_not_count() {
        let model = Sample::new(&[0.0], |x| x[0]).row(1.0, INF, |x| x[0]).row(-INF, -1.0, |x| x[0]);
        let elastic = Elastic::new(&model, vec![1], &[0.0], &[0.0]).unwrap();
        assert_eq!((elastic.meta().rows(), elastic.row(0), elastic.violation(&elastic.meta().start)), (1, 1, 1.0 + ROOM));
    }
}
