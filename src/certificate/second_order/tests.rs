//! Three tests of one thing, on the same random problems: they must agree with one another and with what is known of the blocks.

use super::by_component;
use super::kkt::Kkt;
use super::null_space;
use super::system::{Active, Choice, Hessian};
use crate::certificate::Side;
use crate::certificate::multipliers::Multipliers;
use crate::certificate::parameters::second_order::ROUNDING;
use crate::certificate::point::{Origin, Point};
use crate::linear_algebra::{Effort, Partition};
use crate::math::split_mix::SplitMix;
use crate::model::{EvaluationError, Meta, Model, Pattern};

/// Blocks of two variables with an equality each: enough of them for all three tests.
const BLOCKS: usize = 1100;

/// ½(x − 1)ᵀS(x − 1) with S of 2 × 2 blocks, and a row pᵀx = pᵀ1 for each block.
struct Blocks {
    meta: Meta,
    /// S₁₁, S₂₁, S₂₂ of each block.
    hessian: Vec<[f64; 3]>,
    rows: Vec<[f64; 2]>,
}

impl Blocks {
    /// Random blocks; on the null space of its row, block k has the curvature that `curvature` says, relative to |S|.
    fn new(seed: u64, curvature: impl Fn(usize) -> f64) -> Blocks {
        let mut random = SplitMix::new(seed);
        let (mut hessian, mut rows) = (Vec::new(), Vec::new());
        for k in 0..BLOCKS {
            let mut symmetric = || 2.0 * random.uniform() - 1.0;
            let [p, q] = [symmetric() + 1.5, symmetric() + 1.5];
            let (a, b) = (symmetric(), symmetric());
            // The null space is (q, −p): a·q² − 2b·p·q + c·p² = curvature·(p² + q²).
            let c = (curvature(k) * (p * p + q * q) - a * q * q + 2.0 * b * p * q) / (p * p);
            hessian.push([a, b, c]);
            rows.push([p, q]);
        }
        let pairs = |k: u32| [(2 * k, 2 * k), (2 * k + 1, 2 * k), (2 * k + 1, 2 * k + 1)];
        let limits: Vec<f64> = rows.iter().map(|[p, q]| p + q).collect();
        let blocks = 0..BLOCKS as u32;
        let meta = Meta {
            lower: vec![f64::NEG_INFINITY; 2 * BLOCKS],
            upper: vec![f64::INFINITY; 2 * BLOCKS],
            start: vec![1.0; 2 * BLOCKS],
            row_lower: limits.clone(),
            row_upper: limits,
            row_is_linear: vec![true; BLOCKS],
            hessian: Pattern::from_positions(2 * BLOCKS, &mut blocks.clone().flat_map(pairs).collect()),
            jacobian: Pattern::from_positions(BLOCKS, &mut blocks.flat_map(|k| [(k, 2 * k), (k, 2 * k + 1)]).collect()),
            ..Meta::default()
        };
        Blocks { meta, hessian, rows }
    }
}

impl Model for Blocks {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let mut value = 0.0;
        for (k, [a, b, c]) in self.hessian.iter().enumerate() {
            let (u, v) = (x[2 * k] - 1.0, x[2 * k + 1] - 1.0);
            (gradient[2 * k], gradient[2 * k + 1]) = (a * u + b * v, b * u + c * v);
            value += 0.5 * (gradient[2 * k] * u + gradient[2 * k + 1] * v);
        }
        Ok(value)
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.gradient(x, &mut vec![0.0; x.len()])
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (k, [p, q]) in self.rows.iter().enumerate() {
            values[k] = p * x[2 * k] + q * x[2 * k + 1];
        }
        Ok(())
    }

    fn jacobian(&self, _: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.copy_from_slice(&self.rows.concat());
        Ok(())
    }

    fn hessian(&self, _: &[f64], weight: f64, _: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.iter_mut().zip(self.hessian.concat()).for_each(|(value, entry)| *value = weight * entry);
        Ok(())
    }
}

/// Whether each test finds negative curvature: null-space basis, sparse KKT matrix, dense component by component.
fn verdicts(model: &Blocks) -> [bool; 3] {
    let origin = Origin::new(model);
    let x = model.meta.start.clone();
    let mut point = Point::new(&origin, &x).unwrap();
    point.sigma = 1.0;
    let multipliers = Multipliers { rows: vec![0.0; BLOCKS], bounds: vec![0.0; 2 * BLOCKS] };
    let (rows, bounds) = (vec![Side::Equal; BLOCKS], vec![Side::None; 2 * BLOCKS]);
    let active = Active { rows: &rows, bounds: &bounds, multipliers: &multipliers, nearly_weak: 1e-3 };
    let hessian = Hessian::of(&point, &multipliers).unwrap();
    let Choice { free, held, .. } = Choice::all(&point, &active);
    assert_eq!((free.len(), held.len()), (2 * BLOCKS, BLOCKS));
    let on_basis = null_space::is_positive(&point, &hessian, (&free, &held), ROUNDING).expect("it pays").unwrap();
    let whole = Kkt::new(&point, &hessian, &free, &held).unwrap().has_negative_curvature(ROUNDING, Effort::Any).unwrap();
    let partition = Partition::of_patterns(&model.meta.jacobian, &model.meta.hessian).unwrap();
    let apart = by_component::judge(&point, &active, &hessian, &partition, None).unwrap();
    [!on_basis, whole, apart.escape.is_some()]
}

#[test]
fn all_three_find_the_one_block_of_negative_curvature_and_none_where_there_is_none() {
    for seed in 0..5 {
        let place = (seed as usize * 271) % BLOCKS;
        for least in [0.3, 1e-3, -1e-3, -0.3] {
            let model = Blocks::new(seed, |k| if k == place { least } else { 0.1 + 0.5 * (k % 7) as f64 });
            assert_eq!(verdicts(&model), [least < 0.0; 3], "seed {seed}: {least} at block {place}");
        }
    }
}
