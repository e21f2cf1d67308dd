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
        let (values, slopes) = together(&gathered(inputs, x));
        for (lane, (inputs, &weight)) in inputs.iter().zip(weights).enumerate() {
            let gradient = [slopes[0][lane], slopes[1][lane], slopes[2][lane], slopes[3][lane]];
            sum += weight * scatter(inputs, &gradient, weight, first, target, values[lane]);
        }
    }
    sum
}

/// Their second derivatives, ten apiece in the order of the lower triangle; see
/// [`Kernel::add_hessians`](crate::expression::kernel::Kernel::add_hessians).
pub(super) fn add_hessians(elements: &Elements<'_>, x: &[f64], slots: &[u32], first: usize, target: &mut [f64]) {
    let ((inputs, _), (slots, _)) = (elements.inputs.as_chunks::<4>(), slots.as_chunks::<10>());
    let lanes = inputs.chunks(LANES).zip(slots.chunks(LANES)).zip(elements.weights.chunks(LANES));
    for ((inputs, slots), weights) in lanes {
        let seconds = hessians(&gathered(inputs, x));
        for (lane, (slots, &weight)) in slots.iter().zip(weights).enumerate().filter(|(_, (_, weight))| **weight != 0.0) {
            for (&slot, second) in slots.iter().zip(&seconds) {
                if let Some(sum) = target.get_mut((slot as usize).wrapping_sub(first)) {
                    *sum += weight * second[lane];
                }
            }
        }
    }
}

/// The lengths of a few frusta, by kind of length; lanes without a frustum hold ones.
fn gathered(inputs: &[[u32; 4]], x: &[f64]) -> [[f64; LANES]; 4] {
    let mut lengths = [[1.0; LANES]; 4];
    for (lane, inputs) in inputs.iter().enumerate() {
        for (lengths, &input) in lengths.iter_mut().zip(inputs) {
            lengths[lane] = x[input as usize];
        }
    }
    lengths
}

/// Lower triangles of the Hessians, row by row. With g = √S1·√S2/12 they are ±g/(x_i·x_j), − on the diagonal; the two lengths
/// of one end also meet in their own area.
pub(super) fn hessians<const L: usize>([w1, h1, w2, h2]: &[[f64; L]; 4]) -> [[f64; L]; 10] {
    let mut seconds = [[0.0; L]; 10];
    for k in 0..L {
        let (s1, s2) = (w1[k] * h1[k], w2[k] * h2[k]);
        let g = s1.sqrt() * s2.sqrt() / 12.0;
        let (q1, q2) = (1.0 / s1, 1.0 / s2);
        let (w1, h1, w2, h2) = (h1[k] * q1, w1[k] * q1, h2[k] * q2, w2[k] * q2);
        let (gw1, gh1, gw2, gh2) = (g * w1, g * h1, g * w2, g * h2);
        seconds[0][k] = -gw1 * w1;
        seconds[1][k] = gh1 * w1 + 1.0 / 3.0;
        seconds[2][k] = -gh1 * h1;
        seconds[3][k] = gw2 * w1;
        seconds[4][k] = gw2 * h1;
        seconds[5][k] = -gw2 * w2;
        seconds[6][k] = gh2 * w1;
        seconds[7][k] = gh2 * h1;
        seconds[8][k] = gh2 * w2 + 1.0 / 3.0;
        seconds[9][k] = -gh2 * h2;
    }
    seconds
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
