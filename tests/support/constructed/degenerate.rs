//! What decides beyond second order, along a coordinate in which the Lagrangian is flat.

use nalgebra::DMatrix;

use super::polynomial::{Power, Problem};
use super::{Nature, Random};

/// Adds a power of coordinate `at` to the objective, and brings the start near enough for it to be seen.
pub fn add_power(
    random: &mut Random,
    nature: Nature,
    problem: &mut Problem,
    (coordinates, at): (&[Vec<f64>], usize),
    is_one_sided: bool,
) {
    let unit = visible(problem, coordinates, at);
    let power = beyond_second_order(random, nature, (&coordinates[at], unit), is_one_sided);
    let change = power.factor.abs() * unit.1.powi(power.exponent);
    problem.objective[0].powers.push(power);
    // The objective's scale is also that of its start: nearer starts until the power does not drown in it.
    for _ in 0..20 {
        if change > 1e-2 * visible(problem, coordinates, at).0 {
            break;
        }
        for j in (0..coordinates.len()).filter(|&j| problem.centre[j] != 0.0) {
            let here = problem.centre[j] * problem.sizes[j];
            problem.meta.start[j] = here + 0.5 * (problem.meta.start[j] - here);
        }
    }
}

fn beyond_second_order(
    random: &mut Random,
    nature: Nature,
    (coordinate, (scale, reach)): (&[f64], (f64, f64)),
    is_one_sided: bool,
) -> Power {
    let share = random.decade(-1.5, 0.0);
    let (sign, exponent) = match (nature, is_one_sided) {
        (Nature::DegenerateMinimum, true) => (1.0, 3 + random.below(2) as i32),
        (Nature::DegenerateMinimum, false) => (1.0, 4),
        (_, true) => (-1.0, 3 + random.below(2) as i32),
        (_, false) if random.chance(0.5) => (random.sign(), 3),
        (_, false) => (-1.0, 4),
    };
    Power { factor: sign * share * scale / reach.powi(exponent), direction: coordinate.to_vec(), exponent }
}

/// The objective's scale, and how far coordinate `at` moves as the first variable moves by its own size: a power of the coordinate
/// must be seen within that, or it is rounding.
fn visible(problem: &Problem, coordinates: &[Vec<f64>], at: usize) -> (f64, f64) {
    let n = coordinates.len();
    let start = problem.deviation(&problem.meta.start);
    let size = |j: usize| problem.centre[j].abs().max((start[j] + problem.centre[j]).abs());
    let slope = |w: &[f64]| {
        problem.objective[0].gradient(w).iter().enumerate().fold(0.0, |most: f64, (j, g)| most.max((g * size(j)).abs()))
    };
    let scale = slope(&vec![0.0; n]).max(slope(&start));
    let turned = DMatrix::from_fn(n, n, |i, j| coordinates[i][j]);
    let unit = nalgebra::DVector::from_fn(n, |i, _| if i == at { 1.0 } else { 0.0 });
    let along = turned.lu().solve(&unit).expect("coordinates are independent");
    let fastest = (0..n).fold(0.0, |most: f64, j| most.max((along[j] / size(j)).abs()));
    (if scale > 0.0 { scale } else { 1.0 }, 1.0 / fastest)
}
