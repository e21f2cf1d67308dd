//! Many frusta of rectangles at a time, laid out so that the compiler uses vector instructions, of the widest kind the machine
//! has. Nothing is fused or reordered for that: the bits are the same on all.

use pulp::{Arch, Simd, WithSimd};

use super::row::{FRUSTA, Row};
use crate::expression::kernel::{Elements, scatter};

/// Frusta computed together.
const LANES: usize = 8;

/// Values and gradients of (S1 + S2 + √S1·√S2)/3 with S = w·h over elements (w1, h1, w2, h2); see
/// [`Kernel::add_gradients`](crate::expression::kernel::Kernel::add_gradients).
pub(super) fn add_gradients(elements: &Elements<'_>, x: &[f64], first: usize, target: &mut [f64]) -> f64 {
    Arch::new().dispatch(Gradients { elements, x, first, target })
}

struct Gradients<'a> {
    elements: &'a Elements<'a>,
    x: &'a [f64],
    first: usize,
    target: &'a mut [f64],
}

impl WithSimd for Gradients<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let Gradients { elements, x, first, target } = self;
        let (blocks, rest) = elements.inputs.as_chunks::<4>().0.as_chunks::<FRUSTA>();
        let (weights, last) = elements.weights.as_chunks::<FRUSTA>();
        let mut sum = 0.0;
        for (inputs, weights) in blocks.iter().zip(weights) {
            sum += match Row::of(inputs, x) {
                Some(row) => row.add_gradient(weights, first, target),
                None => add_anywhere(inputs, weights, x, first, target),
            };
        }
        sum + add_anywhere(rest, last, x, first, target)
    }
}

/// The same for frusta between any sections.
#[inline(always)]
fn add_anywhere(inputs: &[[u32; 4]], weights: &[f64], x: &[f64], first: usize, target: &mut [f64]) -> f64 {
    let mut sum = 0.0;
    for (inputs, weights) in inputs.chunks(LANES).zip(weights.chunks(LANES)) {
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
    Arch::new().dispatch(Hessians { elements, x, slots, first, target });
}

struct Hessians<'a> {
    elements: &'a Elements<'a>,
    x: &'a [f64],
    slots: &'a [u32],
    first: usize,
    target: &'a mut [f64],
}

impl WithSimd for Hessians<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Hessians { elements, x, slots, first, target } = self;
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
}

/// The lengths of a few frusta, by kind of length; lanes without a frustum hold ones.
#[inline(always)]
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
#[inline(always)]
pub(super) fn hessians<const L: usize>([w1, h1, w2, h2]: &[[f64; L]; 4]) -> [[f64; L]; 10] {
    let mut seconds = [[0.0; L]; 10];
    for k in 0..L {
        let (s1, s2) = (w1[k] * h1[k], w2[k] * h2[k]);
        let g = s1.sqrt() * s2.sqrt() * (1.0 / 12.0);
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
#[inline(always)]
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
    use crate::expression::kernel::{Kernel, gradients_one_by_one, hessians_one_by_one};
    use crate::expression::tape::Workspace;
    use crate::ribs::{Part, law::VolumeLaw};

    /// Elements of a row, and the same in reverse: no row.
    fn in_a_row_and_reversed(count: usize) -> [Vec<u32>; 2] {
        let frustum = |k: u32| [2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 3];
        let frusta = 0..count as u32;
        [frusta.clone().flat_map(frustum).collect(), frusta.rev().flat_map(frustum).collect()]
    }

    fn lengths(count: usize) -> Vec<f64> {
        (0..2 * count + 2).map(|j| 0.1 + 0.7 * (j as f64 * 0.618).fract()).collect()
    }

    #[test]
    fn many_at_a_time_are_the_same_as_one_by_one() {
        let (count, part) = (2 * FRUSTA + LANES + 3, Part::new(VolumeLaw::Frustum, false));
        let (x, weights) = (lengths(count), (0..count).map(|k| 1.0 + k as f64).collect::<Vec<_>>());
        for inputs in in_a_row_and_reversed(count) {
            let elements = Elements { inputs: &inputs, data: &[], weights: &weights };
            let mut expected = vec![0.0; x.len()];
            let total = gradients_one_by_one(&part, &elements, &x, 0, &mut expected, &mut Workspace::default());
            // In two stretches of variables, as two threads would; the cut goes through a section, and through none.
            for cut in [0, 7, 40, 2 * FRUSTA + 2, x.len()] {
                let mut gradient = vec![0.0; x.len()];
                let (left, right) = gradient.split_at_mut(cut);
                let value = part.add_gradients(&elements, &x, 0, left, &mut Workspace::default())
                    + part.add_gradients(&elements, &x, cut, right, &mut Workspace::default());
                assert!((value - total).abs() < 1e-13 * total, "{cut}: {value} {total}");
                assert!(gradient.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-13 * b.abs()), "{cut}");
            }
        }
    }

    #[test]
    fn a_section_without_area_gives_no_number() {
        let (count, part) = (FRUSTA, Part::new(VolumeLaw::Frustum, false));
        let (mut x, weights) = (lengths(count), vec![1.0; count]);
        let [inputs, _] = in_a_row_and_reversed(count);
        for (bad, at) in [(0.0, 0), (-1.0, 9), (f64::NAN, 2 * count), (f64::INFINITY, 2 * count + 1)] {
            let good = std::mem::replace(&mut x[at], bad);
            let mut gradient = vec![0.0; x.len()];
            let elements = Elements { inputs: &inputs, data: &[], weights: &weights };
            part.add_gradients(&elements, &x, 0, &mut gradient, &mut Workspace::default());
            assert!(gradient.iter().any(|slope| !slope.is_finite()), "{bad} at {at}");
            x[at] = good;
        }
    }

    #[test]
    fn second_derivatives_go_where_they_belong() {
        let (count, part) = (LANES + 3, Part::new(VolumeLaw::Frustum, false));
        let (x, weights) = (lengths(count), (0..count).map(|k| k as f64 - 2.0).collect::<Vec<_>>());
        let [inputs, _] = in_a_row_and_reversed(count);
        let elements = Elements { inputs: &inputs, data: &[], weights: &weights };
        let slots: Vec<u32> = (0..10 * count as u32).map(|k| k / 2).collect();
        let mut expected = vec![0.0; 5 * count];
        hessians_one_by_one(&part, &elements, &x, &slots, 0, &mut expected, &mut Workspace::default());
        let mut values = vec![0.0; 5 * count];
        let (left, right) = values.split_at_mut(7);
        part.add_hessians(&elements, &x, &slots, 0, left, &mut Workspace::default());
        part.add_hessians(&elements, &x, &slots, 7, right, &mut Workspace::default());
        assert!(expected.iter().any(|&value| value != 0.0) && values == expected);
    }
}
