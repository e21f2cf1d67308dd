//! A model whose inputs are partly the rows of another: f(z) = f₂(v(z)), c(z) = (c₂(v(z)), R(z)) with v(z) = A·z + a + Γ·q(z), where q and R
//! are the rows of the first model.
//!
//! Many rows look at the same few intermediate values (stresses at many points of a member at its end forces): these are computed once,
//! and the rows stay small. With V = ∂v/∂z = A + Γ·q_z: c_z = c₂_v·V, and the Hessian of the Lagrangian is Vᵀ·L₂_vv·V + Σ ŷ_k·∇²q_k with
//! ŷ = Γᵀ·L₂_v, and the multipliers of R as they are.

use super::mapped::Rows;
use crate::model::{EvaluationError, Meta, Model, Pattern};

/// How the second model's inputs follow from the variables and from the first model's rows.
#[derive(Debug, Clone, Default)]
pub struct Links {
    /// A: one row per input of the second model, over the variables.
    pub variables: Rows,
    /// a.
    pub constants: Vec<f64>,
    /// Γ: one row per input, over the rows of the first model.
    pub rows: Rows,
}

/// The composition.
pub struct Composed<F, S> {
    first: F,
    second: S,
    links: Links,
    /// Rows of the first model that are rows of the whole: from this one on.
    own_rows: usize,
    meta: Meta,
    /// Where V can be non-zero, and A's values along it.
    slopes: Pattern,
    constant_slopes: Vec<f64>,
    /// Shares of Γ·q_z in V: position in the first Jacobian, position in V, γ.
    through: Vec<(u32, u32, f64)>,
    /// For every product of an entry of the second Jacobian with one of V, its place in the Jacobian; in their order.
    jacobian_places: Vec<u32>,
    /// Where the first model's own rows stand in the Jacobian.
    first_places: Vec<u32>,
    /// Likewise for products in Vᵀ·H₂·V, and for the first Hessian.
    hessian_places: Vec<u32>,
    first_hessian: Vec<u32>,
}

/// What both models give at a point.
struct At {
    v: Vec<f64>,
    /// V along its pattern.
    slopes: Vec<f64>,
    /// The first Jacobian.
    first: Vec<f64>,
}

impl<F: Model, S: Model> Composed<F, S> {
    /// The composition; `meta` says bounds, starts and limits of the whole, its patterns are found here.
    pub fn new(first: F, second: S, links: Links, own_rows: usize, mut meta: Meta) -> Self {
        let (one, two, n) = (first.meta(), second.meta(), meta.lower.len());
        let mut positions = Vec::new();
        for input in 0..links.variables.len() {
            positions.extend(links.variables.row(input).iter().map(|&(j, _)| (input as u32, j)));
            for &(row, _) in links.rows.row(input) {
                positions.extend(one.jacobian.row(row as usize).iter().map(|&j| (input as u32, j)));
            }
        }
        let slopes = Pattern::from_positions(links.variables.len(), &mut positions);
        for (row, input) in two.jacobian.iter() {
            positions.extend(slopes.row(input).iter().map(|&j| (row as u32, j)));
        }
        let after = two.rows();
        for row in own_rows..one.rows() {
            positions.extend(one.jacobian.row(row).iter().map(|&j| ((after + row - own_rows) as u32, j)));
        }
        meta.jacobian = Pattern::from_positions(after + one.rows() - own_rows, &mut positions);
        for_pairs(&two.hessian, &slopes, |_, _, row, column, _| positions.push((row, column)));
        positions.extend(one.hessian.iter().map(|(row, column)| (row as u32, column as u32)));
        meta.hessian = Pattern::from_positions(n, &mut positions);
        // Every position looked up below was announced above.
        let place = |pattern: &Pattern, row: usize, column: u32| pattern.position(row, column).unwrap_or_default() as u32;
        let mut constant_slopes = vec![0.0; slopes.len()];
        let mut through = Vec::new();
        for input in 0..links.variables.len() {
            for &(j, value) in links.variables.row(input) {
                constant_slopes[place(&slopes, input, j) as usize] += value;
            }
            for &(row, gamma) in links.rows.row(input) {
                for at in one.jacobian.range(row as usize) {
                    through.push((at as u32, place(&slopes, input, one.jacobian.columns[at]), gamma));
                }
            }
        }
        let mut jacobian_places = Vec::new();
        for (row, input) in two.jacobian.iter() {
            jacobian_places.extend(slopes.row(input).iter().map(|&j| place(&meta.jacobian, row, j)));
        }
        let first_places = (own_rows..one.rows())
            .flat_map(|row| one.jacobian.row(row).iter().map(move |&j| (after + row - own_rows, j)))
            .map(|(row, j)| place(&meta.jacobian, row, j))
            .collect();
        let mut hessian_places = Vec::new();
        for_pairs(&two.hessian, &slopes, |_, _, row, column, _| hessian_places.push(place(&meta.hessian, row as usize, column)));
        let first_hessian = one.hessian.iter().map(|(row, column)| place(&meta.hessian, row, column as u32)).collect();
        Composed {
            first,
            second,
            links,
            own_rows,
            meta,
            slopes,
            constant_slopes,
            through,
            jacobian_places,
            first_places,
            hessian_places,
            first_hessian,
        }
    }

    /// The second model.
    pub fn second(&self) -> &S {
        &self.second
    }

    /// The first model.
    pub fn first(&self) -> &F {
        &self.first
    }

    /// Gives the variables a start and their magnitudes.
    pub fn start_at(&mut self, start: Vec<f64>, typical: Vec<f64>) {
        (self.meta.start, self.meta.typical) = (start, typical);
    }

    /// v(z), and the first model's rows.
    fn inputs(&self, z: &[f64]) -> Result<(Vec<f64>, Vec<f64>), EvaluationError> {
        let mut rows = vec![0.0; self.first.meta().rows()];
        self.first.constraints(z, &mut rows)?;
        let sum = |entries: &[(u32, f64)], values: &[f64]| {
            entries.iter().map(|&(at, factor)| factor * values[at as usize]).sum::<f64>()
        };
        let value = |(input, constant): (usize, &f64)| {
            constant + sum(self.links.variables.row(input), z) + sum(self.links.rows.row(input), &rows)
        };
        Ok((self.links.constants.iter().enumerate().map(value).collect(), rows))
    }

    fn at(&self, z: &[f64]) -> Result<At, EvaluationError> {
        let (v, _) = self.inputs(z)?;
        let mut first = vec![0.0; self.first.meta().jacobian.len()];
        self.first.jacobian(z, &mut first)?;
        let mut slopes = self.constant_slopes.clone();
        self.through.iter().for_each(|&(from, to, gamma)| slopes[to as usize] += gamma * first[from as usize]);
        Ok(At { v, slopes, first })
    }
}

/// Calls back for every product V_ki·V_lj of an entry (k, l) of the lower triangle of H₂: positions in V, row and column of the lower triangle of
/// the whole, and how often it counts: H_kl stands for H_lk, too.
fn for_pairs(hessian: &Pattern, slopes: &Pattern, mut pair: impl FnMut(usize, usize, u32, u32, (usize, f64))) {
    for (entry, (k, l)) in hessian.iter().enumerate() {
        for a in slopes.range(k) {
            let i = slopes.columns[a];
            for b in slopes.range(l) {
                let j = slopes.columns[b];
                if k != l || i >= j {
                    let times = if k != l && i == j { 2.0 } else { 1.0 };
                    pair(a, b, i.max(j), i.min(j), (entry, times));
                }
            }
        }
    }
}

impl<F: Model, S: Model> Model for Composed<F, S> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, z: &[f64]) -> Result<f64, EvaluationError> {
        self.second.objective(&self.inputs(z)?.0)
    }

    fn gradient(&self, z: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let at = self.at(z)?;
        let mut inner = vec![0.0; at.v.len()];
        let value = self.second.gradient(&at.v, &mut inner)?;
        gradient.fill(0.0);
        self.slopes.add_transposed(&at.slopes, &inner, gradient);
        Ok(value)
    }

    fn constraints(&self, z: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (v, rows) = self.inputs(z)?;
        let (own, rest) = values.split_at_mut(self.second.meta().rows());
        self.second.constraints(&v, own)?;
        rest.copy_from_slice(&rows[self.own_rows..]);
        Ok(())
    }

    fn jacobian(&self, z: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let at = self.at(z)?;
        let pattern = &self.second.meta().jacobian;
        let mut second = vec![0.0; pattern.len()];
        self.second.jacobian(&at.v, &mut second)?;
        values.fill(0.0);
        let mut places = self.jacobian_places.iter();
        for (entry, (_, input)) in pattern.iter().enumerate() {
            let range = self.slopes.range(input);
            for (slope, &place) in at.slopes[range.clone()].iter().zip(places.by_ref().take(range.len())) {
                values[place as usize] += second[entry] * slope;
            }
        }
        let begin = self.first.meta().jacobian.offsets[self.own_rows];
        self.first_places.iter().zip(&at.first[begin..]).for_each(|(&place, value)| values[place as usize] += value);
        Ok(())
    }

    fn hessian(&self, z: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let at = self.at(z)?;
        let two = self.second.meta();
        let (own, rest) = y.split_at(two.rows());
        let mut second = vec![0.0; two.hessian.len()];
        self.second.hessian(&at.v, weight, own, &mut second)?;
        values.fill(0.0);
        let mut places = self.hessian_places.iter();
        for_pairs(&two.hessian, &self.slopes, |a, b, _, _, (entry, times)| {
            if let Some(&place) = places.next() {
                values[place as usize] += times * second[entry] * at.slopes[a] * at.slopes[b];
            }
        });
        let multipliers = self.first_multipliers(&at, weight, own, rest)?;
        let mut first = vec![0.0; self.first.meta().hessian.len()];
        self.first.hessian(z, 0.0, &multipliers, &mut first)?;
        self.first_hessian.iter().zip(&first).for_each(|(&place, value)| values[place as usize] += value);
        Ok(())
    }
}

impl<F: Model, S: Model> Composed<F, S> {
    /// ŷ = Γᵀ·(w·∇f₂ + c₂_vᵀ·y) for the rows that feed the second model, the rest as it is.
    fn first_multipliers(&self, at: &At, weight: f64, own: &[f64], rest: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let pattern = &self.second.meta().jacobian;
        let mut slope = vec![0.0; at.v.len()];
        if weight != 0.0 {
            self.second.gradient(&at.v, &mut slope)?;
            slope.iter_mut().for_each(|slope| *slope *= weight);
        }
        let mut second = vec![0.0; pattern.len()];
        self.second.jacobian(&at.v, &mut second)?;
        pattern.add_transposed(&second, own, &mut slope);
        let mut multipliers = vec![0.0; self.first.meta().rows()];
        for (input, &slope) in slope.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
            self.links.rows.row(input).iter().for_each(|&(row, gamma)| multipliers[row as usize] += gamma * slope);
        }
        multipliers[self.own_rows..].iter_mut().zip(rest).for_each(|(multiplier, y)| *multiplier += y);
        Ok(multipliers)
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::derivative_check::derivative_check;
    use crate::model::sample::Sample;

    #[test]
    fn derivatives_pass_both_models() {
        let first = Sample::new(&[0.5, 0.3, -0.2], |z| z[0])
            .row(-1.0, 1.0, |z| z[0] * z[1] * z[2])
            .row(-1.0, 1.0, |z| z[0].sin() + z[2].powi(2) * z[1])
            .row(-1.0, 1.0, |z| z[1].exp() * z[0]);
        let second = Sample::new(&[0.1, 0.2, 0.4], |v| v[0] * v[1] + v[2].powi(3) * v[1])
            .row(-1.0, 1.0, |v| v[0] * v[2] + v[1].powi(2))
            .row(-1.0, 1.0, |v| v[1] * v[2].cos());
        let mut links = Links { constants: vec![0.0, 0.3, -0.1], ..Links::default() };
        links.variables.push([(0, 1.0)]);
        links.variables.push([(2, 0.5)]);
        links.variables.push([]);
        links.rows.push([]);
        links.rows.push([(0, 2.0), (1, -1.0)]);
        links.rows.push([(1, 1.5)]);
        let meta = Meta {
            lower: vec![-9.0; 3],
            upper: vec![9.0; 3],
            start: vec![0.2, 0.4, 0.7],
            row_lower: vec![-1.0; 3],
            row_upper: vec![1.0; 3],
            ..Meta::default()
        };
        let model = Composed::new(first, second, links, 2, meta);
        let check = derivative_check(&model, &[0.2, 0.4, 0.7]).unwrap();
        assert_eq!(check.disagreements, 0, "{:?}", check.worst);
    }
}
