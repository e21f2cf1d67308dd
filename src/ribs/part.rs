//! Volume per unit length of a part whose area is a product: width w times height h, or times a difference H − c·h.

use super::frusta;
use super::law::VolumeLaw;
use crate::expression::kernel::{Elements, Kernel, gradients_one_by_one, hessians_one_by_one};
use crate::expression::tape::Workspace;

/// The kernel of one part between two ends.
///
/// Inputs are (w1, h1, w2, h2), or with a difference (w1, H1, h1, w2, H2, h2) where the height is H − c·h and c is the one
/// constant of the element: flanges b2·(h2 − h1) with c = 1, a web tw·(h − 2·tf) with c = 2.
///
/// The note prints 1/6 and 1/2 in the frustum's gradient (2.3.2); Euler's identity Σx·∂V/∂x = 2V demands 1/3 and 1/6.
///
/// ```
/// use ribopt::expression::kernel::Kernel;
/// use ribopt::expression::tape::Workspace;
/// use ribopt::ribs::{law::VolumeLaw, Part};
///
/// let frustum = Part::new(VolumeLaw::Frustum, false);
/// let mut gradient = [0.0; 4];
/// let volume = frustum.gradient(&[2.0, 3.0, 2.0, 3.0], &[], &mut Workspace::default(), &mut gradient);
/// assert_eq!(volume, 6.0);
/// assert_eq!(gradient, [1.5, 1.0, 1.5, 1.0]);
/// ```
pub struct Part {
    law: VolumeLaw,
    difference: bool,
}

/// Lower triangle of a full 4×4 matrix, row by row.
const FOUR: [(u32, u32); 10] = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 0), (3, 1), (3, 2), (3, 3)];

/// The prismatoid is bilinear: only products of a width and a height.
const BILINEAR: [(u32, u32); 4] = [(1, 0), (2, 1), (3, 0), (3, 2)];

/// The same with each height split in two, (w1, H1, h1, w2, H2, h2).
const SIX: [(u32, u32); 21] = {
    let mut pattern = [(0, 0); 21];
    let (mut row, mut at) = (0, 0);
    while row < 6 {
        let mut column = 0;
        while column <= row {
            pattern[at] = (row, column);
            at += 1;
            column += 1;
        }
        row += 1;
    }
    pattern
};

const BILINEAR_SPLIT: [(u32, u32); 8] = [(1, 0), (2, 0), (3, 1), (3, 2), (4, 0), (4, 3), (5, 0), (5, 3)];

/// Where each of the six inputs stands among (w1, h1, w2, h2).
const PLACE: [usize; 6] = [0, 1, 1, 2, 3, 3];

impl Part {
    /// The kernel for a law, with heights given directly or as differences.
    pub fn new(law: VolumeLaw, difference: bool) -> Part {
        Part { law, difference }
    }

    /// (w1, h1, w2, h2)
    fn lengths(&self, x: &[f64], data: &[f64]) -> [f64; 4] {
        if self.difference { [x[0], x[1] - data[0] * x[2], x[3], x[4] - data[0] * x[5]] } else { [x[0], x[1], x[2], x[3]] }
    }

    /// ∂height/∂input of each input.
    fn factors(data: &[f64]) -> [f64; 6] {
        let c = -data[0];
        [1.0, 1.0, c, 1.0, 1.0, c]
    }

    /// Volume per unit length by a law, from widths and heights (w1, h1, w2, h2).
    pub fn volume_per_length(law: VolumeLaw, [w1, h1, w2, h2]: [f64; 4]) -> f64 {
        match law {
            VolumeLaw::Frustum => {
                let (s1, s2) = (w1 * h1, w2 * h2);
                (s1 + s2 + s1.sqrt() * s2.sqrt()) / 3.0
            }
            VolumeLaw::Prismatoid => (2.0 * (w1 * h1 + w2 * h2) + w1 * h2 + w2 * h1) / 6.0,
        }
    }

    fn volume_gradient(&self, [w1, h1, w2, h2]: [f64; 4]) -> (f64, [f64; 4]) {
        match self.law {
            VolumeLaw::Frustum => {
                let (s1, s2) = (w1 * h1, w2 * h2);
                let (r1, r2) = (s1.sqrt(), s2.sqrt());
                let (q1, q2) = (1.0 / 3.0 + r2 / r1 / 6.0, 1.0 / 3.0 + r1 / r2 / 6.0);
                ((s1 + s2 + r1 * r2) / 3.0, [q1 * h1, q1 * w1, q2 * h2, q2 * w2])
            }
            VolumeLaw::Prismatoid => {
                let gradient = [2.0 * h1 + h2, 2.0 * w1 + w2, 2.0 * h2 + h1, 2.0 * w2 + w1].map(|sum| sum / 6.0);
                (Part::volume_per_length(self.law, [w1, h1, w2, h2]), gradient)
            }
        }
    }
}

/// Position of (i, j) in a row-by-row lower triangle.
fn packed(i: usize, j: usize) -> usize {
    let (i, j) = (i.max(j), i.min(j));
    i * (i + 1) / 2 + j
}

impl Kernel for Part {
    fn inputs(&self) -> usize {
        if self.difference { 6 } else { 4 }
    }

    fn data(&self) -> usize {
        usize::from(self.difference)
    }

    fn hessian_pattern(&self) -> &[(u32, u32)] {
        match (self.law, self.difference) {
            (VolumeLaw::Frustum, false) => &FOUR,
            (VolumeLaw::Frustum, true) => &SIX,
            (VolumeLaw::Prismatoid, false) => &BILINEAR,
            (VolumeLaw::Prismatoid, true) => &BILINEAR_SPLIT,
        }
    }

    fn value(&self, x: &[f64], data: &[f64], _: &mut Workspace) -> f64 {
        Part::volume_per_length(self.law, self.lengths(x, data))
    }

    fn gradient(&self, x: &[f64], data: &[f64], _: &mut Workspace, gradient: &mut [f64]) -> f64 {
        let (value, by_length) = self.volume_gradient(self.lengths(x, data));
        if self.difference {
            let factors = Part::factors(data);
            for (input, slot) in gradient.iter_mut().enumerate() {
                *slot = by_length[PLACE[input]] * factors[input];
            }
        } else {
            gradient.copy_from_slice(&by_length);
        }
        value
    }

    fn add_gradients(
        &self,
        elements: &Elements<'_>,
        x: &[f64],
        first: usize,
        target: &mut [f64],
        workspace: &mut Workspace,
    ) -> f64 {
        if self.law == VolumeLaw::Frustum && !self.difference {
            return frusta::add_gradients(elements, x, first, target);
        }
        gradients_one_by_one(self, elements, x, first, target, workspace)
    }

    fn hessian(&self, x: &[f64], data: &[f64], _: &mut Workspace, hessian: &mut [f64]) {
        let full = match self.law {
            VolumeLaw::Frustum => frusta::hessians(&self.lengths(x, data).map(|length| [length])).map(|[second]| second),
            // In the order of FOUR: w1·h1 and w2·h2 weigh 2, the crossed products 1.
            VolumeLaw::Prismatoid => [0.0, 2.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 2.0, 0.0].map(|weight| weight / 6.0),
        };
        if self.difference {
            let factors = Part::factors(data);
            for (slot, &(i, j)) in hessian.iter_mut().zip(self.hessian_pattern()) {
                let (i, j) = (i as usize, j as usize);
                *slot = full[packed(PLACE[i], PLACE[j])] * factors[i] * factors[j];
            }
        } else {
            for (slot, &(i, j)) in hessian.iter_mut().zip(self.hessian_pattern()) {
                *slot = full[packed(i as usize, j as usize)];
            }
        }
    }

    fn add_hessians(
        &self,
        elements: &Elements<'_>,
        x: &[f64],
        slots: &[u32],
        first: usize,
        target: &mut [f64],
        workspace: &mut Workspace,
    ) {
        if self.law == VolumeLaw::Frustum && !self.difference {
            return frusta::add_hessians(elements, x, slots, first, target);
        }
        hessians_one_by_one(self, elements, x, slots, first, target, workspace);
    }

    fn explain(&self, x: &[f64], data: &[f64]) -> Option<String> {
        let [w1, h1, w2, h2] = self.lengths(x, data);
        for (end, w, h) in [("left", w1, h1), ("right", w2, h2)] {
            let area = w * h;
            if !area.is_finite() {
                return Some(format!("the area at the {end} end overflows ({w} × {h})"));
            }
            if area <= 0.0 && self.law == VolumeLaw::Frustum {
                return Some(format!("the area at the {end} end is {area} ({w} × {h}), and a frustum needs a positive one"));
            }
        }
        let mut gradient = [0.0; 6];
        let value = self.gradient(x, data, &mut Workspace::default(), &mut gradient[..self.inputs()]);
        (!value.is_finite() || gradient.iter().any(|d| !d.is_finite())).then(|| "the volume overflows".to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 6]; 2] = [[0.3, 0.9, 0.4, 0.2, 0.7, 0.1], [5.0, 110.0, 50.0, 20.0, 200.0, 100.0]];

    fn kernels() -> impl Iterator<Item = Part> {
        [VolumeLaw::Frustum, VolumeLaw::Prismatoid].into_iter().flat_map(|law| [Part::new(law, false), Part::new(law, true)])
    }

    /// Central differences of a function at x.
    fn difference(x: &[f64], at: usize, f: impl Fn(&[f64]) -> f64) -> f64 {
        let step = 1e-5 * x[at];
        let shifted = |by: f64| {
            let mut y = x.to_vec();
            y[at] += by;
            f(&y)
        };
        (shifted(step) - shifted(-step)) / (2.0 * step)
    }

    #[test]
    fn gradient_and_hessian_agree_with_central_differences() {
        for kernel in kernels() {
            for point in POINTS {
                let x = &point[..kernel.inputs()];
                let (data, n) = ([1.0], kernel.inputs());
                let mut gradient = vec![0.0; n];
                kernel.gradient(x, &data, &mut Workspace::default(), &mut gradient);
                for (at, &slope) in gradient.iter().enumerate() {
                    let expected = difference(x, at, |x| kernel.value(x, &data, &mut Workspace::default()));
                    assert!((slope - expected).abs() < 1e-7 * (1.0 + expected.abs()), "{at}: {slope} {expected}");
                }
                let mut values = vec![0.0; kernel.hessian_pattern().len()];
                kernel.hessian(x, &data, &mut Workspace::default(), &mut values);
                let mut full = vec![vec![0.0; n]; n];
                for (&(i, j), &value) in kernel.hessian_pattern().iter().zip(&values) {
                    full[i as usize][j as usize] = value;
                    full[j as usize][i as usize] = value;
                }
                for (i, row) in full.iter().enumerate() {
                    for (j, &entry) in row.iter().enumerate() {
                        let expected = difference(x, j, |x| {
                            let mut gradient = vec![0.0; n];
                            kernel.gradient(x, &data, &mut Workspace::default(), &mut gradient);
                            gradient[i]
                        });
                        assert!((entry - expected).abs() < 1e-6 * (1.0 + expected.abs()), "({i},{j}): {entry} {expected}");
                    }
                }
            }
        }
    }

    #[test]
    fn euler_s_identity_holds_and_the_note_s_printed_gradient_breaks_it() {
        let x = [0.3, 0.9, 0.2, 0.7];
        let mut gradient = [0.0; 4];
        let volume = Part::new(VolumeLaw::Frustum, false).gradient(&x, &[], &mut Workspace::default(), &mut gradient);
        let euler: f64 = x.iter().zip(gradient).map(|(x, d)| x * d).sum();
        assert!((euler - 2.0 * volume).abs() < 1e-15);
        let [b1, h1, b2, h2] = x;
        let printed = h1 / 6.0 + 0.5 * (h1 * b2 * h2 / b1).sqrt();
        let difference = difference(&x, 0, |x| Part::new(VolumeLaw::Frustum, false).value(x, &[], &mut Workspace::default()));
        assert!((printed - difference).abs() > 1e-3, "the misprint would pass: {printed} {difference}");
        assert!((gradient[0] - difference).abs() < 1e-9);
    }

    #[test]
    fn tapered_h_beam_of_docs_formulas() {
        let (web, flange) = ([8.0, 180.0, 6.0, 100.0], [100.0, 20.0, 60.0, 30.0]);
        let volume = |law| {
            let part = Part::new(law, false);
            1000.0 * (part.value(&web, &[], &mut Workspace::default()) + part.value(&flange, &[], &mut Workspace::default()))
        };
        assert!((volume(VolumeLaw::Prismatoid) - 2_960_000.0).abs() < 1e-6);
        assert!((volume(VolumeLaw::Frustum) - 2_888_960.87).abs() < 5e-3);
    }

    #[test]
    fn areas_that_are_not_positive_are_explained() {
        let frustum = Part::new(VolumeLaw::Frustum, true);
        assert!(frustum.explain(&[1.0, 1.0, 2.0, 1.0, 2.0, 1.0], &[1.0]).unwrap().contains("left end is -1"));
        assert!(!frustum.value(&[1.0, 1.0, 2.0, 1.0, 1.0, 2.0], &[1.0], &mut Workspace::default()).is_finite());
        assert_eq!(frustum.explain(&[1.0, 2.0, 1.0, 1.0, 2.0, 1.0], &[1.0]), None);
    }
}
