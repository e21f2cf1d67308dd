//! Problems no point of which may be certified.

use super::Random;
use super::polynomial::{Polynomial, Power, Problem};

fn empty(random: &mut Random, n: usize) -> Problem {
    let mut problem = Problem::default();
    for _ in 0..n {
        let size = random.decade(-3.0, 3.0);
        problem.sizes.push(size);
        problem.centre.push(random.sign() * random.between(0.3, 3.0));
        problem.meta.start.push(size * random.sign() * random.between(0.3, 3.0));
        problem.meta.lower.push(f64::NEG_INFINITY);
        problem.meta.upper.push(f64::INFINITY);
    }
    problem
}

fn vector(random: &mut Random, n: usize) -> Vec<f64> {
    (0..n).map(|_| random.symmetric()).collect()
}

/// Rows a_i·w ≥ b_i with Σ y_i a_i = 0, y > 0, and Σ y_i b_i = gap·Σ y_i (|limit| + Σ|a_ij|·|x_j/s_j|) (Farkas): no point meets them.
/// Points: where violations are balanced, the start, and far away.
pub fn infeasible(random: &mut Random, gap: f64) -> (Problem, Vec<Vec<f64>>) {
    let most = if random.chance(0.1) { 30 } else { 8 };
    let n = 1 + random.below(most);
    let mut problem = empty(random, n);
    let count = 2 + random.below(4);
    let mut rows: Vec<Vec<f64>> = (1..count).map(|_| vector(random, n)).collect();
    let mut y: Vec<f64> = rows.iter().map(|_| random.between(0.3, 2.0)).collect();
    let last = (0..n).map(|j| -rows.iter().zip(&y).map(|(row, y)| y * row[j]).sum::<f64>()).collect();
    rows.push(last);
    y.push(1.0);
    // The size of a row: its entries times the variables' sizes, at the points judged and at the start.
    let reach = |j: usize, problem: &Problem| problem.centre[j].abs().max((problem.meta.start[j] / problem.sizes[j]).abs());
    let sizes: Vec<f64> = rows.iter().map(|row| 1.0 + (0..n).map(|j| row[j].abs() * reach(j, &problem)).sum::<f64>()).collect();
    let total: f64 = y.iter().zip(&sizes).map(|(y, size)| y * size).sum();
    let share = gap * total / y.iter().sum::<f64>();
    for row in &rows {
        let scale = random.decade(-3.0, 3.0) * random.sign();
        problem.rows.push(Polynomial::new(scale, row.clone(), Vec::new(), 0.0));
        let limit = scale * share;
        problem.meta.row_lower.push(if scale > 0.0 { limit } else { f64::NEG_INFINITY });
        problem.meta.row_upper.push(if scale > 0.0 { f64::INFINITY } else { limit });
    }
    let objective = objective(random, n);
    problem.objective.push(objective);
    let problem = problem.finish();
    let far = random.decade(0.0, 6.0);
    let away: Vec<f64> = vector(random, n).into_iter().map(|v| far * v).collect();
    let points = vec![problem.place(&vec![0.0; n]), problem.meta.start.clone(), problem.place(&away)];
    (problem, points)
}

fn objective(random: &mut Random, n: usize) -> Polynomial {
    let powers = (0..n).map(|_| Power { factor: random.between(0.1, 1.0), direction: vector(random, n), exponent: 2 }).collect();
    let linear = if random.chance(0.5) { vec![0.0; n] } else { vector(random, n) };
    Polynomial::new(random.decade(-3.0, 3.0), linear, powers, 0.0)
}

/// −(d·w)^p and convex terms across it: falls along d for ever, or along a parabola. Points along the way.
pub fn unbounded(random: &mut Random) -> (Problem, Vec<Vec<f64>>) {
    let n = 2 + random.below(8);
    let mut problem = empty(random, n);
    let scale = random.decade(-3.0, 3.0);
    let unit = |at: usize| (0..n).map(|j| if j == at { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let mut powers: Vec<Power> =
        (1..n).map(|j| Power { factor: random.between(0.1, 2.0), direction: unit(j), exponent: 2 }).collect();
    let mut linear = vec![0.0; n];
    match random.below(3) {
        0 => linear[0] = -random.between(0.5, 2.0),
        1 => powers.push(Power { factor: -1.0, direction: unit(0), exponent: 3 }),
        _ => powers.push(Power { factor: -random.between(0.1, 1.0), direction: unit(0), exponent: 2 }),
    }
    // A row that bends with the way: t_1 ≥ t_0²/10 is left open upwards.
    if random.chance(0.5) {
        let bend = Power { factor: -0.01, direction: unit(0), exponent: 2 };
        problem.rows.push(Polynomial::new(1.0, unit(1), vec![bend], 0.0));
        problem.meta.row_lower.push(-1.0);
        problem.meta.row_upper.push(f64::INFINITY);
        // What is gained must outweigh the way along the row: a cubic against a fourth power would not.
        powers.retain(|power| power.direction[1] == 0.0);
    }
    problem.objective.push(Polynomial::new(scale, linear, powers, 0.0));
    let problem = problem.finish();
    let mut points = Vec::new();
    for far in [0.0, 1.0, 1e2, 1e4] {
        let mut w = vec![0.0; n];
        (w[0], w[1]) = (far, 0.01 * far * far);
        points.push(problem.place(&w));
    }
    (problem, points)
}
