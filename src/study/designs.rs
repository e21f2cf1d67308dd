//! Where the points of a study lie, in shares of every axis: pure functions of counts and a seed.

use crate::math::split_mix::SplitMix;

/// Owen-scrambled points of Sobol's sequence are known up to this many, and this many dimensions.
pub(super) const MOST_SOBOL: (usize, usize) = (1 << 16, 256);

/// All combinations of the axes' values by their numbers, the last axis fastest.
pub(super) fn grid(counts: &[usize]) -> Vec<Vec<usize>> {
    let total = counts.iter().product();
    let point = |mut number: usize| {
        let mut at = vec![0; counts.len()];
        for (axis, &count) in counts.iter().enumerate().rev() {
            at[axis] = number % count;
            number /= count;
        }
        at
    };
    (0..total).map(point).collect()
}

/// The base point, where no axis has a value, then every axis alone with each of its values.
pub(super) fn centered(counts: &[usize]) -> Vec<Vec<Option<usize>>> {
    let base = vec![None; counts.len()];
    let alone = |axis: usize, value: usize| {
        let mut point = base.clone();
        point[axis] = Some(value);
        point
    };
    let others = counts.iter().enumerate().flat_map(|(axis, &count)| (0..count).map(move |value| (axis, value)));
    std::iter::once(base.clone()).chain(others.map(|(axis, value)| alone(axis, value))).collect()
}

/// Independent uniform shares.
pub(super) fn random(samples: usize, axes: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut stream = SplitMix::new(seed);
    (0..samples).map(|_| (0..axes).map(|_| stream.uniform()).collect()).collect()
}

/// A Latin hypercube (McKay, Beckman, Conover 1979): of `samples` equal parts of every axis each holds one point, anywhere in it.
pub(super) fn latin_hypercube(samples: usize, axes: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut stream = SplitMix::new(seed);
    let mut points = vec![vec![0.0; axes]; samples];
    for axis in 0..axes {
        let mut parts: Vec<usize> = (0..samples).collect();
        // Fisher and Yates.
        for last in (1..samples).rev() {
            parts.swap(last, (stream.uniform() * (last + 1) as f64) as usize);
        }
        for (point, part) in points.iter_mut().zip(parts) {
            point[axis] = (part as f64 + stream.uniform()) / samples as f64;
        }
    }
    points
}

/// Sobol's sequence, scrambled after Owen by the seed; within [`MOST_SOBOL`].
pub(super) fn sobol(samples: usize, axes: usize, seed: u64) -> Vec<Vec<f64>> {
    let seed = (seed ^ (seed >> 32)) as u32;
    let share = |number: usize, axis: usize| f64::from(sobol_burley::sample(number as u32, axis as u32, seed));
    (0..samples).map(|number| (0..axes).map(|axis| share(number, axis)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_every_combination_once() {
        let points = grid(&[2, 3]);
        assert_eq!(points, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
        assert!(grid(&[2, 0]).is_empty());
    }

    #[test]
    fn centered_points_move_one_axis_at_a_time() {
        let points = centered(&[2, 1]);
        assert_eq!(points, [vec![None, None], vec![Some(0), None], vec![Some(1), None], vec![None, Some(0)]]);
    }

    #[test]
    fn every_part_of_every_axis_holds_one_point() {
        for points in [latin_hypercube(17, 3, 5), sobol(16, 3, 5)] {
            let parts = points.len();
            for axis in 0..3 {
                let mut found: Vec<usize> = points.iter().map(|point| (point[axis] * parts as f64) as usize).collect();
                found.sort_unstable();
                assert_eq!(found, (0..parts).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn the_seed_alone_decides() {
        for design in [random, latin_hypercube, sobol] {
            assert_eq!(design(9, 2, 1), design(9, 2, 1));
            assert_ne!(design(9, 2, 1), design(9, 2, 2));
            assert!(design(9, 2, 1).iter().flatten().all(|share| (0.0..1.0).contains(share)));
        }
    }
}
