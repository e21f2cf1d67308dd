//! Many frusta of rectangles at a time, laid out so that the compiler uses vector instructions.

use crate::expression::kernel::{Elements, scatter};

/// Frusta computed together.
const LANES: usize = 8;

/// Values and gradients of (S1 + S2 + √S1·√S2)/3 with S = w·h over elements (w1, h1, w2, h2); see
/// [`Kernel::add_gradients`](crate::expression::kernel::Kernel::add_gradients).
pub(super) fn add_gradients(elements: &Elements<'_>, x: &[f64], first: usize, target: &mut [f64]) -> f64 {
    let (inputs, _) = elements.inputs.as_chunks::<4>();
    let mut sum = 0.0;
    for (inputs, weights) in inputs.chunks(LANES).zip(elements.weights.chunks(LANES)) {
        let mut lengths = [[1.0; LANES]; 4];
        for (lane, inputs) in inputs.iter().enumerate() {
            for (lengths, &input) in lengths.iter_mut().zip(inputs) {
                lengths[lane] = x[input as usize];
            }
        }
        let (values, slopes) = together(&lengths);
        for (lane, (inputs, &weight)) in inputs.iter().zip(weights).enumerate() {
            let gradient = [slopes[0][lane], slopes[1][lane], slopes[2][lane], slopes[3][lane]];
            sum += weight * scatter(inputs, &gradient, weight, first, target, values[lane]);
        }
    }
    sum
}

/// Values and derivatives by w1, h1, w2, h2. With m = √S1·√S2: ∂V/∂S1 = 1/3 + S2/(6m).
fn together([w1, h1, w2, h2]: &[[f64; LANES]; 4]) -> ([f64; LANES], [[f64; LANES]; 4]) {
    let (mut values, mut slopes) = ([0.0; LANES], [[0.0; LANES]; 4]);
    for k in 0..LANES {
        let (s1, s2) = (w1[k] * h1[k], w2[k] * h2[k]);
        let mean = s1.sqrt() * s2.sqrt();
        let sixth = 1.0 / (6.0 * mean);
        let (q1, q2) = (1.0 / 3.0 + s2 * sixth, 1.0 / 3.0 + s1 * sixth);
        values[k] = (s1 + s2 + mean) * (1.0 / 3.0);
        slopes[0][k] = q1 * h1[k];
        slopes[1][k] = q1 * w1[k];
        slopes[2][k] = q2 * h2[k];
        slopes[3][k] = q2 * w2[k];
    }
    (values, slopes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::kernel::Kernel;
    use crate::expression::tape::Workspace;
    use crate::ribs::{Part, law::Law};

    #[test]
    fn many_at_a_time_are_the_same_as_one_by_one() {
        let count = 2 * LANES + 3;
        let x: Vec<f64> = (0..2 * count + 2).map(|j| 0.1 + 0.7 * (j as f64 * 0.618).fract()).collect();
        let inputs: Vec<u32> = (0..count as u32).flat_map(|k| [2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 3]).collect();
        let weights: Vec<f64> = (0..count).map(|k| 1.0 + k as f64).collect();
        let elements = Elements { inputs: &inputs, data: &[], weights: &weights };
        let part = Part::new(Law::Frustum, false);
        let (mut expected, mut total, mut slope) = (vec![0.0; x.len()], 0.0, [0.0; 4]);
        for (inputs, weight) in inputs.chunks(4).zip(&weights) {
            let local: Vec<f64> = inputs.iter().map(|&j| x[j as usize]).collect();
            total += weight * part.gradient(&local, &[], &mut Workspace::default(), &mut slope);
            inputs.iter().zip(slope).for_each(|(&j, slope)| expected[j as usize] += weight * slope);
        }
        // In two stretches of variables, as two threads would.
        let mut gradient = vec![0.0; x.len()];
        let (left, right) = gradient.split_at_mut(7);
        let value = part.add_gradients(&elements, &x, 0, left, &mut Workspace::default())
            + part.add_gradients(&elements, &x, 7, right, &mut Workspace::default());
        assert!((value - total).abs() < 1e-13 * total);
        assert!(gradient.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-13 * b.abs()));
    }
}
