//! The solutions with the largest μ, by sparse factors: a block Lanczos iteration in the inner product of K, with all vectors kept
//! orthogonal (Golub and Underwood, *The block Lanczos method for computing eigenvalues*, 1977; Parlett, *The Symmetric Eigenvalue Problem*,
//! §13.10).
//!
//! That none is missed, however often one occurs, is counted: K − B/σ has as many negative eigenvalues as there are μ above σ. Where fewer are
//! found, directions outside of all that was seen are added. (faer's iteration is for one vector: it stops short at repeated eigenvalues, and
//! does not end where B has a small rank, as the matrix of a few masses has.)

use faer::{Mat, Side};

use super::{Matrix, NEGLIGIBLE, Spectrum, dot, not_converging};
use crate::linear_algebra::{FactorizationError, SymmetricSolver};

/// Vectors in a block: eigenvalues that occur as often come up together, as in columns of square sections.
const BLOCK: usize = 4;

/// Most vectors kept. Lowest modes come up within a few dozen.
const MOST: usize = 800;

/// Residual of a pair, in the norm of K and relative to the largest |μ|: where μ is apart, its square is the error of μ.
const RESIDUAL: f64 = 1e-14;

/// A direction begun with of which less than this is left beside the basis is one of the basis.
const DEPENDENT: f64 = 1e-8;

/// σ lies below the last μ by this much, relative, so that K − B/σ is not singular by it.
const BELOW: f64 = 1e-7;

/// Rough residual of the first pair, relative, after which the others are looked for from near it.
const ROUGH: f64 = 1e-2;

/// At least `count` solutions with positive μ, where there are as many.
///
/// The largest μ is found roughly first. With K' = K − λ·B for a λ not far below 1/μ it is B φ = μ'·K' φ with μ' = μ/(1 − λμ): the large μ' lie
/// far apart where the μ crowd (Ericsson and Ruhe, *Math. Comp.* 35, 1980).
pub(super) fn spectrum(k: &Matrix, b: &Matrix, count: usize) -> Result<Spectrum, FactorizationError> {
    let rough = iterated(k, b, &Goal { count: 1, residual: ROUGH, is_counted: false })?;
    let Some(mu) = rough.values.first() else { return Ok(rough) };
    // K' stays positive definite where no μ exceeds the rough one by more than its residual; the factors tell.
    let lambda = 0.9 / mu;
    let goal = Goal { count, residual: RESIDUAL, is_counted: true };
    let mut found = match iterated(&k.plus(-lambda, b), b, &goal) {
        Err(FactorizationError::Singular) => return iterated(k, b, &goal),
        other => other?,
    };
    for (mu, vector) in found.values.iter_mut().zip(&mut found.vectors) {
        // φᵀK'φ = 1 is φᵀKφ = 1 + λμ'.
        let stiffness = 1.0 + lambda * *mu;
        *mu /= stiffness;
        vector.iter_mut().for_each(|value| *value /= stiffness.sqrt());
    }
    Ok(found)
}

/// What is looked for.
struct Goal {
    count: usize,
    /// Relative to the largest |μ|.
    residual: f64,
    /// Whether it is to be known that none is missing.
    is_counted: bool,
}

fn iterated(k: &Matrix, b: &Matrix, goal: &Goal) -> Result<Spectrum, FactorizationError> {
    let mut iteration = Iteration::new(k, b)?;
    iteration.begin()?;
    let mut wanted = None;
    loop {
        let ritz = iteration.ritz()?;
        if ritz.largest == 0.0 {
            return Ok(Spectrum { values: Vec::new(), vectors: Vec::new() });
        }
        let above = |sigma: f64| k.plus(-1.0 / sigma, b).negative_eigenvalues();
        let least = NEGLIGIBLE * ritz.largest;
        let asked = match wanted {
            Some(asked) => asked,
            None => *wanted.insert(goal.count.min(above(least)?)),
        };
        // The last of a Ritz value's copies are within rounding of the first.
        let sigma = match ritz.values.get(goal.count - 1) {
            Some(last) if asked == goal.count => last * (1.0 - BELOW),
            _ => least,
        };
        let found = ritz.values.iter().filter(|mu| **mu > sigma).count();
        if ritz.converged(asked.max(found), goal.residual * ritz.largest) || iteration.outside.is_empty() {
            if !goal.is_counted || above(sigma)? == found {
                return Ok(iteration.spectrum(&ritz, found));
            }
            iteration.begin()?;
        } else {
            // As many again as a quarter of those there are, so that their small eigenproblems cost no more than the last does.
            let enough = iteration.basis.len() + iteration.basis.len() / 4;
            while iteration.basis.len() <= enough && !iteration.outside.is_empty() {
                iteration.follow()?;
            }
        }
    }
}

struct Iteration<'a> {
    b: &'a Matrix,
    k: &'a Matrix,
    scales: Vec<f64>,
    solver: SymmetricSolver,
    /// V with VᵀKV = I, and K·V.
    basis: Vec<Vec<f64>>,
    stiff: Vec<Vec<f64>>,
    /// The lower triangle of VᵀBV by rows.
    projected: Vec<Vec<f64>>,
    /// B·v of vectors whose K⁻¹Bv is yet to be looked at.
    loaded: Vec<Vec<f64>>,
    /// Of K⁻¹Bv, for the vectors v at the basis's end, what lies outside the basis, with its length.
    outside: Vec<(Vec<f64>, f64)>,
    begun: usize,
    largest_image: f64,
}

/// Eigenvalues within the basis.
struct Ritz {
    /// The largest first.
    values: Vec<f64>,
    residuals: Vec<f64>,
    /// How each is made of the basis, by column, the largest last.
    shapes: Mat<f64>,
    largest: f64,
}

impl Ritz {
    fn converged(&self, asked: usize, residual: f64) -> bool {
        self.residuals.len() >= asked && self.residuals[..asked].iter().all(|own| *own <= residual)
    }
}

impl<'a> Iteration<'a> {
    fn new(k: &'a Matrix, b: &'a Matrix) -> Result<Self, FactorizationError> {
        let scales = k.scales();
        let mut solver = SymmetricSolver::new(&k.pattern.offsets, &k.pattern.columns)?;
        if solver.factor(&k.scaled(&scales))?.positive < k.order() {
            return Err(FactorizationError::Singular);
        }
        let (basis, stiff, projected, loaded, outside) = Default::default();
        Ok(Iteration { b, k, scales, solver, basis, stiff, projected, loaded, outside, begun: 0, largest_image: 0.0 })
    }

    /// Adds directions without a pattern, and what they lead to.
    fn begin(&mut self) -> Result<(), FactorizationError> {
        let before = self.basis.len();
        self.take_in();
        for _ in 0..BLOCK {
            self.begun += 1;
            // Multiples of an irrational number, modulo 1, are spread evenly (Weyl 1916).
            let step = (2.0 + self.begun as f64).sqrt() / 8.0 + (5.0f64.sqrt() - 1.0) / 2.0;
            let share = |(at, scale): (usize, &f64)| (((at + 1) as f64 * step).fract() - 0.5) * scale;
            let mut direction: Vec<f64> = self.scales.iter().enumerate().map(share).collect();
            let length = self.length(&direction);
            direction.iter_mut().for_each(|value| *value /= length);
            self.append(direction, DEPENDENT);
        }
        if self.basis.len() == before {
            return Err(not_converging());
        }
        self.image()
    }

    /// Adds what lies outside, and what that leads to.
    fn follow(&mut self) -> Result<(), FactorizationError> {
        self.take_in();
        self.image()
    }

    /// Makes what lies outside part of the basis.
    fn take_in(&mut self) {
        let least = RESIDUAL * self.largest_image;
        std::mem::take(&mut self.outside).into_iter().for_each(|(vector, _)| self.append(vector, least));
    }

    /// Makes a direction part of the basis, unless no more than `least` of it is left beside it.
    fn append(&mut self, mut v: Vec<f64>, least: f64) {
        let left = self.leave(&mut v);
        if left <= least || left.is_nan() {
            return;
        }
        // Once more after it was made longer: what is left of a short vector is not orthogonal to the last digit.
        v.iter_mut().for_each(|value| *value /= left);
        let left = self.leave(&mut v);
        v.iter_mut().for_each(|value| *value /= left);
        let (stiff, loaded) = (self.k.times(&v), self.b.times(&v));
        self.basis.push(v);
        self.stiff.push(stiff);
        self.projected.push(self.basis.iter().map(|other| dot(other, &loaded)).collect());
        self.loaded.push(loaded);
    }

    /// Takes the basis out of v, twice (Parlett §6.9), and tells the length of what is left.
    fn leave(&self, v: &mut [f64]) -> f64 {
        for _ in 0..2 {
            for (other, stiff) in self.basis.iter().zip(&self.stiff) {
                let share = dot(stiff, v);
                v.iter_mut().zip(other).for_each(|(value, other)| *value -= share * other);
            }
        }
        self.length(v)
    }

    /// In the norm of K.
    fn length(&self, v: &[f64]) -> f64 {
        dot(v, &self.k.times(v)).max(0.0).sqrt()
    }

    /// K⁻¹Bv of the vectors appended, outside the basis.
    fn image(&mut self) -> Result<(), FactorizationError> {
        if self.basis.len() > MOST {
            return Err(not_converging());
        }
        for loaded in std::mem::take(&mut self.loaded) {
            let right: Vec<f64> = loaded.iter().zip(&self.scales).map(|(value, scale)| value * scale).collect();
            let mut image = vec![0.0; right.len()];
            self.solver.solve(&right, &mut image)?;
            image.iter_mut().zip(&self.scales).for_each(|(value, scale)| *value *= scale);
            self.largest_image = self.largest_image.max(dot(&image, &loaded).abs().sqrt());
            let left = self.leave(&mut image);
            self.outside.push((image, left));
        }
        Ok(())
    }

    fn ritz(&self) -> Result<Ritz, FactorizationError> {
        let count = self.basis.len();
        let projected = Mat::from_fn(count, count, |i, j| self.projected[i.max(j)][i.min(j)]);
        let found = projected.self_adjoint_eigen(Side::Lower).map_err(|_| not_converging())?;
        let ascending = found.S().column_vector();
        let values: Vec<f64> = (0..count).rev().map(|at| ascending[at]).collect();
        let largest = values.iter().fold(0.0f64, |largest, mu| largest.max(mu.abs()));
        let shapes = found.U().to_owned();
        // What a pair's image has outside the basis comes from the vectors not yet followed.
        let first = count - self.outside.len();
        let part = |(j, (_, length)): (usize, &(Vec<f64>, f64)), at: usize| (shapes[(first + j, at)] * length).abs();
        let residual = |at: usize| self.outside.iter().enumerate().map(|one| part(one, at)).sum();
        let residuals = (0..count).rev().map(residual).collect();
        Ok(Ritz { values, residuals, shapes, largest })
    }

    /// The first of these pairs.
    fn spectrum(&self, ritz: &Ritz, found: usize) -> Spectrum {
        let count = self.basis.len();
        let vector = |at: usize| {
            let mut vector = vec![0.0; self.k.order()];
            for (j, own) in self.basis.iter().enumerate() {
                let share = ritz.shapes[(j, count - 1 - at)];
                vector.iter_mut().zip(own).for_each(|(value, own)| *value += share * own);
            }
            vector
        };
        Spectrum { values: ritz.values[..found].to_vec(), vectors: (0..found).map(vector).collect() }
    }
}
