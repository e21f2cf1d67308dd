//! Problems around a stationary point of chosen nature.

use nalgebra::DMatrix;

use super::polynomial::{Polynomial, Power, Problem, quadratic};
use super::{Nature, Random, degenerate};

/// How many coordinates of each kind.
#[derive(Debug, Clone, Copy)]
struct Counts {
    strict: usize,
    weak: usize,
    free: usize,
}

impl Counts {
    fn total(self) -> usize {
        self.strict + self.weak + self.free
    }

    fn first_free(self) -> usize {
        self.strict + self.weak
    }
}

/// The problem, x* and points beside it.
pub fn around(random: &mut Random, nature: Nature, near: usize) -> (Problem, Vec<Vec<f64>>) {
    let counts = counts(random, nature);
    let flat = flat_coordinate(random, nature, counts);
    let k = curvature(random, nature, counts, flat);
    let coordinates = coordinates(random, counts);
    let mut problem = empty(random, counts.total());
    let mut objective = vec![0.0; counts.total()];
    let scale = random.decade(-3.0, 3.0);
    let is_degenerate = flat.is_some();
    let (mut powers, mut compensated) = (Vec::new(), Vec::new());
    for (i, own) in coordinates.iter().enumerate().take(counts.first_free()) {
        let multiplier = if i < counts.strict { random.decade(-1.5, 0.5) } else { 0.0 };
        let is_equality = i < counts.strict && random.chance(0.3);
        let signed = if is_equality { multiplier * random.sign() } else { multiplier };
        objective.iter_mut().zip(own).for_each(|(g, t)| *g += signed * t);
        match single(own) {
            Some((j, slope)) => bound(&mut problem, j, slope > 0.0, is_equality),
            None => {
                let bend = (!is_degenerate && random.chance(0.4)).then(|| Power {
                    factor: 0.5 * random.symmetric(),
                    direction: (0..counts.total()).map(|_| random.symmetric()).collect(),
                    exponent: 2,
                });
                // What a multiplier times a bent row adds to the Lagrangian is taken off the objective.
                compensated
                    .extend(bend.iter().filter(|_| signed != 0.0).map(|p| Power { factor: signed * p.factor, ..p.clone() }));
                row(random, &mut problem, own, bend.into_iter().collect(), is_equality);
            }
        }
    }
    redundant_limits(random, &mut problem, &coordinates[..counts.first_free()]);
    inactive_rows(random, &mut problem);
    powers.extend(quadratic(&k, &coordinates));
    powers.extend(compensated);
    problem.objective.push(Polynomial::new(1.0, objective, powers, 0.0));
    if let Some(at) = flat {
        degenerate::add_power(random, nature, &mut problem, (&coordinates, at), at < counts.first_free());
    }
    problem.objective[0].scale = scale;
    let problem = problem.finish();
    let mut points = vec![problem.place(&vec![0.0; counts.total()])];
    for _ in 0..near {
        let distance = random.decade(-13.0, -5.0);
        let w: Vec<f64> = (0..counts.total()).map(|_| distance * random.symmetric()).collect();
        let mut x = problem.place(&w);
        problem.meta.clamp(&mut x);
        points.push(x);
    }
    (problem, points)
}

fn counts(random: &mut Random, nature: Nature) -> Counts {
    let most = if random.chance(0.1) { 30 } else { 10 };
    let weak = if random.chance(0.05) { 11 } else { 5 };
    let mut counts = Counts { strict: random.below(most / 3 + 1), weak: random.below(weak), free: random.below(most / 3 + 1) };
    match nature {
        Nature::FallsOnFace(face) => counts.weak = counts.weak.max(face),
        Nature::Saddle => counts.free = counts.free.max(1),
        Nature::Maximum => (counts.weak, counts.free) = (0, counts.free.max(1)),
        Nature::DegenerateMinimum | Nature::DegenerateNoMinimum if counts.weak + counts.free == 0 => counts.free = 1,
        _ if counts.total() == 0 => counts.free = 1,
        _ => {}
    }
    counts
}

fn flat_coordinate(random: &mut Random, nature: Nature, counts: Counts) -> Option<usize> {
    let is_flat = matches!(nature, Nature::DegenerateMinimum | Nature::DegenerateNoMinimum);
    is_flat.then(|| counts.strict + random.below(counts.weak + counts.free))
}

/// K: arbitrary over strict coordinates; over the others by the nature of the point.
fn curvature(random: &mut Random, nature: Nature, counts: Counts, flat: Option<usize>) -> DMatrix<f64> {
    let (n, first, weak, free) = (counts.total(), counts.strict, counts.weak, counts.free);
    let mut k = DMatrix::zeros(n, n);
    for i in 0..first {
        for j in 0..n {
            let value = 2.0 * random.symmetric();
            (k[(i, j)], k[(j, i)]) = (value, value);
        }
    }
    let zz = definite(random, free, nature);
    let m = on_weak_limits(random, weak, nature);
    let coupling = DMatrix::from_fn(weak, free, |_, _| random.symmetric());
    let ss = match free {
        0 => m,
        _ => m + &coupling * zz.clone().lu().solve(&coupling.transpose()).expect("free coordinates bend"),
    };
    k.view_mut((first, first), (weak, weak)).copy_from(&ss);
    k.view_mut((first, first + weak), (weak, free)).copy_from(&coupling);
    k.view_mut((first + weak, first), (free, weak)).copy_from(&coupling.transpose());
    k.view_mut((first + weak, first + weak), (free, free)).copy_from(&zz);
    if let Some(at) = flat {
        k.row_mut(at).fill(0.0);
        k.column_mut(at).fill(0.0);
    }
    k
}

/// Q·diag·Qᵀ over the free coordinates.
fn definite(random: &mut Random, size: usize, nature: Nature) -> DMatrix<f64> {
    let turned = DMatrix::from_fn(size, size, |_, _| random.symmetric()).qr().q();
    let mut values: Vec<f64> = (0..size).map(|_| random.decade(-1.0, 1.0)).collect();
    match nature {
        Nature::Saddle => values[0] = -random.decade(-1.5, 1.0),
        Nature::Maximum => values.iter_mut().for_each(|value| *value = -*value),
        _ => {}
    }
    &turned * DMatrix::from_diagonal(&values.into()) * turned.transpose()
}

/// M: positive definite plus entries that are not negative, and one face on which it falls where that is wanted.
fn on_weak_limits(random: &mut Random, weak: usize, nature: Nature) -> DMatrix<f64> {
    let mut m = match random.below(3) {
        // Indefinite, but copositive.
        0 => DMatrix::from_fn(weak, weak, |i, j| if i == j { 1.0 } else { 0.0 }),
        _ => definite(random, weak, Nature::StrictMinimum),
    };
    for i in 0..weak {
        for j in 0..i {
            if random.chance(0.4) {
                let more = random.between(0.0, 5.0);
                m[(i, j)] += more;
                m[(j, i)] += more;
            }
        }
    }
    if let Nature::FallsOnFace(face) = nature {
        // On the face, 1 and equal entries so negative that (1, …, 1) falls though no smaller face does; nothing that could
        // fall beside it.
        let margin = random.decade(-1.5, -0.3);
        let off = if face == 1 { 0.0 } else { -(1.0 + margin) / (face as f64 - 1.0) };
        for i in 0..weak {
            for j in 0..weak {
                let both = (i < face, j < face);
                match both {
                    (true, true) => {
                        m[(i, j)] = if i != j {
                            off
                        } else if face == 1 {
                            -margin
                        } else {
                            1.0
                        }
                    }
                    (true, false) | (false, true) => m[(i, j)] = m[(i, j)].max(0.0),
                    _ => {}
                }
            }
        }
    }
    m
}

/// Rows of T: some of the limits are bounds.
fn coordinates(random: &mut Random, counts: Counts) -> Vec<Vec<f64>> {
    let n = counts.total();
    let is_sparse = random.chance(0.3);
    (0..n)
        .map(|i| {
            let is_bound = i < counts.first_free() && random.chance(0.5);
            let slope = random.between(0.5, 2.0) * if is_bound { random.sign() } else { 1.0 };
            let mut row = vec![0.0; n];
            row[i] = slope;
            if !is_bound {
                // Diagonally dominant: well conditioned.
                let share = 0.8 * slope / n as f64;
                let others = row.iter_mut().enumerate().filter(|(j, _)| *j != i);
                others.for_each(|(_, entry)| {
                    if !is_sparse || random.chance(0.2) {
                        *entry = share * random.symmetric();
                    }
                });
            }
            row
        })
        .collect()
}

fn empty(random: &mut Random, n: usize) -> Problem {
    let mut problem = Problem::default();
    for _ in 0..n {
        let size = random.decade(-3.0, 3.0);
        let centre = if random.chance(0.15) { 0.0 } else { random.sign() * random.between(0.3, 3.0) };
        let start = centre + random.sign() * random.between(0.05, 1.0);
        problem.sizes.push(size);
        problem.centre.push(centre);
        problem.meta.start.push(start * size);
        problem.meta.lower.push(f64::NEG_INFINITY);
        problem.meta.upper.push(f64::INFINITY);
    }
    problem
}

fn single(row: &[f64]) -> Option<(usize, f64)> {
    let mut used = row.iter().enumerate().filter(|(_, entry)| **entry != 0.0);
    match (used.next(), used.next()) {
        (Some((j, &slope)), None) => Some((j, slope)),
        _ => None,
    }
}

fn bound(problem: &mut Problem, j: usize, is_lower: bool, is_equality: bool) {
    let at = problem.centre[j] * problem.sizes[j];
    let (meta, size) = (&mut problem.meta, problem.sizes[j]);
    if is_lower || is_equality {
        meta.lower[j] = at;
        meta.start[j] = at + (meta.start[j] - at).abs();
    }
    if !is_lower || is_equality {
        meta.upper[j] = at;
        meta.start[j] = if is_equality { at } else { at - (meta.start[j] - at).abs() };
    }
    debug_assert!(size > 0.0);
}

fn row(random: &mut Random, problem: &mut Problem, linear: &[f64], powers: Vec<Power>, is_equality: bool) {
    let scale = random.decade(-3.0, 3.0) * random.sign();
    let constant = if random.chance(0.5) { scale * random.symmetric() } else { 0.0 };
    problem.rows.push(Polynomial::new(scale, linear.to_vec(), powers, constant));
    let (is_lower, meta) = (scale > 0.0, &mut problem.meta);
    meta.row_lower.push(if is_lower || is_equality { constant } else { f64::NEG_INFINITY });
    meta.row_upper.push(if !is_lower || is_equality { constant } else { f64::INFINITY });
}

/// Sums of limits, and limits once more: nothing new, but dependent.
fn redundant_limits(random: &mut Random, problem: &mut Problem, limits: &[Vec<f64>]) {
    if limits.is_empty() || random.chance(0.6) {
        return;
    }
    // A bent row is not repeated by its linear part.
    let straight: Vec<&Vec<f64>> =
        limits.iter().filter(|limit| !problem.rows.iter().any(|row| row.linear == **limit && !row.powers.is_empty())).collect();
    for _ in 0..=random.below(3) {
        let mut sum = vec![0.0; problem.sizes.len()];
        for limit in &straight {
            if random.chance(0.4) {
                let factor = random.between(0.2, 2.0);
                sum.iter_mut().zip(limit.iter()).for_each(|(sum, t)| *sum += factor * t);
            }
        }
        if sum.iter().any(|entry| *entry != 0.0) {
            row(random, problem, &sum, Vec::new(), false);
        }
    }
}

fn inactive_rows(random: &mut Random, problem: &mut Problem) {
    for _ in 0..random.below(3) {
        let linear: Vec<f64> = problem.sizes.iter().map(|_| random.symmetric()).collect();
        row(random, problem, &linear, Vec::new(), false);
        // Moved away, inwards.
        let (last, scale) = (problem.rows.len() - 1, problem.rows.last().map_or(1.0, |row| row.scale.abs()));
        problem.meta.row_lower[last] -= scale * random.between(0.1, 1.0);
        problem.meta.row_upper[last] += scale * random.between(0.1, 1.0);
    }
}
