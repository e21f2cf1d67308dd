//! A model behind two constant linear maps: f(x) = f̂(Bx + b), c(x) = C·ĉ(Bx + b) + D·x.
//!
//! What is linear by nature (a member's deformations in its nodes' displacements, the sum of member forces at a node) stays out of the
//! elements: they keep few inputs, and their Hessians stay small.

use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError, Meta, Model, Pattern};

/// A sparse matrix by rows.
#[derive(Debug, Clone)]
pub struct Rows {
    offsets: Vec<usize>,
    entries: Vec<(u32, f64)>,
}

impl Default for Rows {
    fn default() -> Self {
        Rows { offsets: vec![0], entries: Vec::new() }
    }
}

impl Rows {
    /// Adds a row.
    pub fn push(&mut self, entries: impl IntoIterator<Item = (u32, f64)>) {
        self.entries.extend(entries);
        self.offsets.push(self.entries.len());
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// True without rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Column and value of a row's entries.
    pub fn row(&self, row: usize) -> &[(u32, f64)] {
        &self.entries[self.offsets[row]..self.offsets[row + 1]]
    }

    /// The transposed matrix with this many rows.
    pub fn transposed(&self, rows: usize) -> Rows {
        let mut offsets = vec![0; rows + 1];
        self.entries.iter().for_each(|&(column, _)| offsets[column as usize + 1] += 1);
        (0..rows).for_each(|row| offsets[row + 1] += offsets[row]);
        let mut next = offsets.clone();
        let mut entries = vec![(0, 0.0); self.entries.len()];
        for row in 0..self.len() {
            for &(column, value) in self.row(row) {
                entries[next[column as usize]] = (row as u32, value);
                next[column as usize] += 1;
            }
        }
        Rows { offsets, entries }
    }
}

/// The maps.
#[derive(Debug, Clone, Default)]
pub struct Maps {
    /// B: one row per variable of the inner model.
    pub inputs: Rows,
    /// b.
    pub constants: Vec<f64>,
    /// C: one row per outer row, over inner rows.
    pub outputs: Rows,
    /// D: one row per outer row, over outer variables.
    pub linear: Rows,
}

/// One share of an outer value: `factor` times an inner one.
#[derive(Debug, Clone, Copy)]
struct Share {
    from: u32,
    to: u32,
    factor: f64,
}

/// The model behind the maps.
pub struct Mapped<M> {
    inner: M,
    meta: Meta,
    maps: Maps,
    /// Cᵀ.
    outputs_of: Rows,
    jacobian: Vec<Share>,
    linear: Vec<(u32, f64)>,
    hessian: Vec<Share>,
}

impl<M: Model> Mapped<M> {
    /// The inner model behind these maps; `meta` says bounds, starts and limits of the outer one, its patterns are found here.
    pub fn new(inner: M, maps: Maps, mut meta: Meta) -> Self {
        let own = inner.meta();
        let outputs_of = maps.outputs.transposed(own.rows());
        let mut positions = Vec::new();
        for outer in 0..maps.outputs.len() {
            for &(row, _) in maps.outputs.row(outer) {
                for &input in own.jacobian.row(row as usize) {
                    positions.extend(maps.inputs.row(input as usize).iter().map(|&(j, _)| (outer as u32, j)));
                }
            }
            positions.extend(maps.linear.row(outer).iter().map(|&(j, _)| (outer as u32, j)));
        }
        meta.jacobian = Pattern::from_positions(maps.outputs.len(), &mut positions);
        each_pair(&own.hessian, &maps.inputs, |_, row, column, _| positions.push((row, column)));
        meta.hessian = Pattern::from_positions(meta.lower.len(), &mut positions);
        let jacobian = jacobian_shares(own, &maps, &meta.jacobian);
        let mut hessian = Vec::new();
        each_pair(&own.hessian, &maps.inputs, |from, row, column, factor| {
            let to = meta.hessian.position(row as usize, column).unwrap_or_default() as u32; // announced above
            hessian.push(Share { from, to, factor });
        });
        let place = |outer: usize, j: u32| meta.jacobian.position(outer, j).unwrap_or_default() as u32;
        let linear = (0..maps.linear.len())
            .flat_map(|outer| maps.linear.row(outer).iter().map(move |&(j, value)| (outer, j, value)))
            .map(|(outer, j, value)| (place(outer, j), value))
            .collect();
        Mapped { inner, meta, maps, outputs_of, jacobian, linear, hessian }
    }

    /// Gives the outer variables a start and their magnitudes.
    pub fn start_at(&mut self, start: Vec<f64>, typical: Vec<f64>) {
        (self.meta.start, self.meta.typical) = (start, typical);
    }

    /// The model behind the maps.
    pub fn inner(&self) -> &M {
        &self.inner
    }

    /// Bx + b.
    pub fn inward(&self, x: &[f64]) -> Vec<f64> {
        let inputs = &self.maps.inputs;
        let value =
            |(at, constant): (usize, &f64)| constant + inputs.row(at).iter().map(|&(j, b)| b * x[j as usize]).sum::<f64>();
        self.maps.constants.iter().enumerate().map(value).collect()
    }
}

/// Every share of the outer Jacobian.
fn jacobian_shares(own: &Meta, maps: &Maps, pattern: &Pattern) -> Vec<Share> {
    let mut shares = Vec::new();
    for outer in 0..maps.outputs.len() {
        for &(row, c) in maps.outputs.row(outer) {
            for from in own.jacobian.range(row as usize) {
                for &(j, b) in maps.inputs.row(own.jacobian.columns[from] as usize) {
                    let to = pattern.position(outer, j).unwrap_or_default() as u32; // announced by the caller
                    shares.push(Share { from: from as u32, to, factor: c * b });
                }
            }
        }
    }
    shares
}

/// Calls back for every share of BᵀHB's lower triangle: inner position, outer row and column, factor.
fn each_pair(pattern: &Pattern, inputs: &Rows, mut share: impl FnMut(u32, u32, u32, f64)) {
    for (from, (k, l)) in pattern.iter().enumerate() {
        for &(i, b) in inputs.row(k) {
            for &(j, d) in inputs.row(l) {
                // H_kl stands for H_lk, too: both orders fall on the lower triangle, twice on its diagonal.
                let factor = if k != l && i == j { 2.0 * b * d } else { b * d };
                if k != l || i >= j {
                    share(from as u32, i.max(j), i.min(j), factor);
                }
            }
        }
    }
}

impl<M: Model> Model for Mapped<M> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(MappedAt { view: self, x: x.to_vec(), inner: self.inner.at(&self.inward(x))? }))
    }
}

/// One point behind the maps.
struct MappedAt<'m, M> {
    view: &'m Mapped<M>,
    x: Vec<f64>,
    inner: Box<dyn Evaluation + 'm>,
}

impl<M: Model> Evaluation for MappedAt<'_, M> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.inner.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let mut inner = vec![0.0; self.view.inner.meta().variables()];
        let value = self.inner.gradient(&mut inner)?;
        gradient.fill(0.0);
        for (at, slope) in inner.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
            self.view.maps.inputs.row(at).iter().for_each(|&(j, b)| gradient[j as usize] += b * slope);
        }
        Ok(value)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut inner = vec![0.0; self.view.inner.meta().rows()];
        self.inner.constraints(&mut inner)?;
        for (outer, value) in values.iter_mut().enumerate() {
            let own: f64 = self.view.maps.outputs.row(outer).iter().map(|&(row, c)| c * inner[row as usize]).sum();
            let linear: f64 = self.view.maps.linear.row(outer).iter().map(|&(j, d)| d * self.x[j as usize]).sum();
            *value = own + linear;
        }
        Ok(())
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut inner = vec![0.0; self.view.inner.meta().jacobian.len()];
        self.inner.jacobian(&mut inner)?;
        values.fill(0.0);
        self.view.jacobian.iter().for_each(|share| values[share.to as usize] += share.factor * inner[share.from as usize]);
        self.view.linear.iter().for_each(|&(to, value)| values[to as usize] += value);
        Ok(())
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let outputs_of = &self.view.outputs_of;
        let inner_y: Vec<f64> =
            (0..outputs_of.len()).map(|row| outputs_of.row(row).iter().map(|&(outer, c)| c * y[outer as usize]).sum()).collect();
        let mut inner = vec![0.0; self.view.inner.meta().hessian.len()];
        self.inner.hessian(weight, &inner_y, &mut inner)?;
        values.fill(0.0);
        self.view.hessian.iter().for_each(|share| values[share.to as usize] += share.factor * inner[share.from as usize]);
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::derivative_check::derivative_check;
    use crate::model::sample::Sample;
    use num_dual::DualNum;

    #[test]
    fn derivatives_pass_the_maps() {
        let inner = Sample::new(&[0.5, 0.3, -0.2], |z| z[0] * z[1] + z[2].exp() * z[1])
            .row(-1.0, 1.0, |z| z[0] * z[1] * z[2])
            .row(-1.0, 1.0, |z| z[0].sin() + z[2].powi(2) * z[1]);
        let mut maps = Maps { constants: vec![0.1, 0.0, -0.4], ..Maps::default() };
        maps.inputs.push([(0, 1.0), (1, -2.0)]);
        maps.inputs.push([(1, 0.5)]);
        maps.inputs.push([(0, 0.3), (1, 1.0), (2, 1.0)]);
        maps.outputs.push([(0, 2.0), (1, -1.0)]);
        maps.outputs.push([(1, 3.0)]);
        maps.linear.push([(2, 4.0)]);
        maps.linear.push([]);
        let meta = Meta {
            lower: vec![-9.0; 3],
            upper: vec![9.0; 3],
            start: vec![0.2, 0.4, 0.7],
            row_lower: vec![-1.0; 2],
            row_upper: vec![1.0; 2],
            ..Meta::default()
        };
        let model = Mapped::new(inner, maps, meta);
        let check = derivative_check(&model, &[0.2, 0.4, 0.7]).unwrap();
        assert_eq!(check.disagreements, 0, "{:?}", check.worst);
    }
}
