//! A model whose inputs are partly the rows of another: f(z) = f₂(v(z)), c(z) = (c₂(v(z)), R(z)) with v(z) = A·z + a + Γ·q(z), where q and R
//! are the rows of the first model.
//!
//! Many rows look at the same few intermediate values (stresses at many points of a member at its end forces): these are computed once,
//! and the rows stay small. With V = ∂v/∂z = A + Γ·q_z: c_z = c₂_v·V, and the Hessian of the Lagrangian is Vᵀ·L₂_vv·V + Σ ŷ_k·∇²q_k with
//! ŷ = Γᵀ·L₂_v, and the multipliers of R as they are.

mod at_point;

use super::mapped::Rows;
use crate::model::{Evaluation, EvaluationError, Meta, Model, Pattern};
use at_point::AtPoint;

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

impl<F: Model, S: Model> Composed<F, S> {
    /// The composition; `meta` says bounds, starts and limits of the whole, its patterns are found here.
    pub fn new(first: F, second: S, links: Links, own_rows: usize, mut meta: Meta) -> Self {
        let slopes = slopes_pattern(first.meta(), &links);
        (meta.jacobian, meta.hessian) = patterns(first.meta(), second.meta(), &slopes, own_rows, meta.lower.len());
        let (one, two) = (first.meta(), second.meta());
        let (constant_slopes, through) = shares_of_slopes(one, &links, &slopes);
        let mut jacobian_places = Vec::new();
        for (row, input) in two.jacobian.iter() {
            jacobian_places.extend(slopes.row(input).iter().map(|&j| place(&meta.jacobian, row, j)));
        }
        let after = two.rows();
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

    /// v(z) from the first model's rows.
    fn inputs(&self, z: &[f64], rows: &[f64]) -> Vec<f64> {
        let sum = |entries: &[(u32, f64)], values: &[f64]| {
            entries.iter().map(|&(at, factor)| factor * values[at as usize]).sum::<f64>()
        };
        let value = |(input, constant): (usize, &f64)| {
            constant + sum(self.links.variables.row(input), z) + sum(self.links.rows.row(input), rows)
        };
        self.links.constants.iter().enumerate().map(value).collect()
    }

    /// V from the first Jacobian.
    fn slopes(&self, first: &[f64]) -> Vec<f64> {
        let mut slopes = self.constant_slopes.clone();
        self.through.iter().for_each(|&(from, to, gamma)| slopes[to as usize] += gamma * first[from as usize]);
        slopes
    }
}

/// Every position looked up was announced when the pattern was made.
fn place(pattern: &Pattern, row: usize, column: u32) -> u32 {
    pattern.position(row, column).unwrap_or_default() as u32
}

/// Where V can be non-zero.
fn slopes_pattern(one: &Meta, links: &Links) -> Pattern {
    let mut positions = Vec::new();
    for input in 0..links.variables.len() {
        positions.extend(links.variables.row(input).iter().map(|&(j, _)| (input as u32, j)));
        for &(row, _) in links.rows.row(input) {
            positions.extend(one.jacobian.row(row as usize).iter().map(|&j| (input as u32, j)));
        }
    }
    Pattern::from_positions(links.variables.len(), &mut positions)
}

/// Where the whole's Jacobian and Hessian can be non-zero, for n variables.
fn patterns(one: &Meta, two: &Meta, slopes: &Pattern, own_rows: usize, n: usize) -> (Pattern, Pattern) {
    let mut positions = Vec::new();
    for (row, input) in two.jacobian.iter() {
        positions.extend(slopes.row(input).iter().map(|&j| (row as u32, j)));
    }
    let after = two.rows();
    for row in own_rows..one.rows() {
        positions.extend(one.jacobian.row(row).iter().map(|&j| ((after + row - own_rows) as u32, j)));
    }
    let jacobian = Pattern::from_positions(after + one.rows() - own_rows, &mut positions);
    let mut positions: Vec<(u32, u32)> = one.hessian.iter().map(|(row, column)| (row as u32, column as u32)).collect();
    for_pairs(&two.hessian, slopes, |_, _, row, column, _| positions.push((row, column)));
    (jacobian, Pattern::from_positions(n, &mut positions))
}

/// A's values along V, and the shares of Γ·q_z in it.
fn shares_of_slopes(one: &Meta, links: &Links, slopes: &Pattern) -> (Vec<f64>, Vec<(u32, u32, f64)>) {
    let (mut constant, mut through) = (vec![0.0; slopes.len()], Vec::new());
    for input in 0..links.variables.len() {
        for &(j, value) in links.variables.row(input) {
            constant[place(slopes, input, j) as usize] += value;
        }
        for &(row, gamma) in links.rows.row(input) {
            for at in one.jacobian.range(row as usize) {
                through.push((at as u32, place(slopes, input, one.jacobian.columns[at]), gamma));
            }
        }
    }
    (constant, through)
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

    fn at<'m>(&'m self, z: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(AtPoint::new(self, z)?))
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

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

    /// Counts how often rows and Jacobian are computed.
    struct Counted {
        model: Sample,
        rows: AtomicUsize,
        jacobians: AtomicUsize,
    }

    impl Model for Counted {
        fn meta(&self) -> &Meta {
            self.model.meta()
        }

        fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
            self.model.objective(x)
        }

        fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
            self.model.gradient(x, gradient)
        }

        fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
            self.rows.fetch_add(1, Relaxed);
            self.model.constraints(x, values)
        }

        fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
            self.jacobians.fetch_add(1, Relaxed);
            self.model.jacobian(x, values)
        }

        fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
            self.model.hessian(x, weight, y, values)
        }
    }

    #[test]
    fn at_one_point_the_first_model_is_computed_once() {
        let model = Sample::new(&[0.5, 0.3], |z| z[0]).row(-1.0, 1.0, |z| z[0] * z[1]);
        let first = Counted { model, rows: 0.into(), jacobians: 0.into() };
        let second = Sample::new(&[0.1], |v| v[0].powi(2)).row(-1.0, 1.0, |v| v[0].powi(3));
        let mut links = Links { constants: vec![0.0], ..Links::default() };
        links.variables.push([]);
        links.rows.push([(0, 2.0)]);
        let (lower, upper, start) = (vec![-9.0; 2], vec![9.0; 2], vec![0.5, 0.3]);
        let meta = Meta { lower, upper, start, row_lower: vec![-1.0], row_upper: vec![1.0], ..Meta::default() };
        let model = Composed::new(first, second, links, 1, meta);
        let (mut gradient, mut rows) = ([0.0; 2], [0.0; 1]);
        let (mut jacobian, mut hessian) = (vec![0.0; model.meta().jacobian.len()], vec![0.0; model.meta().hessian.len()]);
        let mut at = model.at(&[0.5, 0.3]).unwrap();
        at.gradient(&mut gradient).unwrap();
        at.constraints(&mut rows).unwrap();
        at.jacobian(&mut jacobian).unwrap();
        at.hessian(1.0, &[0.7], &mut hessian).unwrap();
        let counts = (model.first().rows.load(Relaxed), model.first().jacobians.load(Relaxed));
        assert_eq!(counts, (1, 1));
    }
}
