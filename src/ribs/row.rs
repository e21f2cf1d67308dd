//! Frusta in a row, each beginning at the section where the one before it ends, as along a line of ribs: a root is taken once
//! for both neighbours, and what a section feels from them is added up before it is written.

/// Frusta in a block: many to share their sections, few enough for registers and the nearest cache.
pub(super) const FRUSTA: usize = 32;
const SECTIONS: usize = FRUSTA + 1;

/// A block of a row.
pub(super) struct Row<'a> {
    /// Its first variable.
    begin: usize,
    /// Widths and heights of its sections.
    sections: &'a [[f64; 2]; SECTIONS],
}

impl<'a> Row<'a> {
    /// `None` unless the variables of the frusta are (j, j+1, j+2, j+3), (j+2, j+3, j+4, j+5), …
    #[inline(always)]
    pub fn of(inputs: &[[u32; 4]; FRUSTA], x: &'a [f64]) -> Option<Row<'a>> {
        let begin = inputs[0][0];
        // No way out of the loop before its end, so that the compiler uses vector instructions.
        let mut in_order = true;
        for (inputs, first) in inputs.iter().zip((0..).step_by(2)) {
            for (&input, place) in inputs.iter().zip(first..) {
                in_order &= input == begin.wrapping_add(place);
            }
        }
        let begin = begin as usize;
        let sections = in_order.then(|| x.get(begin..begin + 2 * SECTIONS)).flatten()?.as_chunks().0.first_chunk()?;
        Some(Row { begin, sections })
    }

    /// Adds the weighted gradient to the derivatives by the variables from `first` on; returns the weighted values of the frusta
    /// whose first variable is among them.
    #[inline(always)]
    pub fn add_gradient(&self, weights: &[f64; FRUSTA], first: usize, target: &mut [f64]) -> f64 {
        let (mut values, gradient) = self.values_and_gradient(weights);
        let (begin, end) = (self.begin.max(first), (self.begin + 2 * SECTIONS).min(first + target.len()));
        if end.saturating_sub(begin) < 2 * SECTIONS {
            for (value, variable) in values.iter_mut().zip((self.begin..).step_by(2)) {
                *value = if (begin..end).contains(&variable) { *value } else { 0.0 };
            }
        }
        let own = gradient.as_flattened().get(begin - self.begin..end.saturating_sub(self.begin)).unwrap_or_default();
        for (sum, slope) in target.iter_mut().skip(begin - first).zip(own) {
            *sum += slope;
        }
        total(&values)
    }

    /// Weighted values by frustum and weighted derivatives by section. With r = √S a frustum of weight a is a/3·(r² + s² + r·s), and
    /// between neighbours of roots q, s and weights a, b its slope by S is (a + b)/3 + (a·q + b·s)/(6r).
    #[inline(always)]
    fn values_and_gradient(&self, weights: &[f64; FRUSTA]) -> ([f64; FRUSTA], [[f64; 2]; SECTIONS]) {
        const LAST: usize = FRUSTA;
        let (mut areas, mut roots) = ([0.0; SECTIONS], [0.0; SECTIONS]);
        for (k, [w, h]) in self.sections.iter().enumerate() {
            areas[k] = w * h;
            roots[k] = areas[k].sqrt();
        }
        let (mut values, mut slopes) = ([0.0; FRUSTA], [0.0; SECTIONS]);
        for k in 0..FRUSTA {
            values[k] = weights[k] * (1.0 / 3.0) * (areas[k] + areas[k + 1] + roots[k] * roots[k + 1]);
        }
        let slope = |weights: f64, neighbours: f64, root: f64| weights * (1.0 / 3.0) + neighbours / (6.0 * root);
        slopes[0] = slope(weights[0], weights[0] * roots[1], roots[0]);
        slopes[LAST] = slope(weights[LAST - 1], weights[LAST - 1] * roots[LAST - 1], roots[LAST]);
        for k in 1..LAST {
            let (a, b) = (weights[k - 1], weights[k]);
            slopes[k] = slope(a + b, a * roots[k - 1] + b * roots[k + 1], roots[k]);
        }
        let mut gradient = [[0.0; 2]; SECTIONS];
        for (k, [w, h]) in self.sections.iter().enumerate() {
            gradient[k] = [slopes[k] * h, slopes[k] * w];
        }
        (values, gradient)
    }
}

/// The sum, several partial ones side by side.
#[inline(always)]
fn total(values: &[f64; FRUSTA]) -> f64 {
    let mut sums = [0.0; 8];
    for values in values.as_chunks::<8>().0 {
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += value;
        }
    }
    sums.iter().sum()
}
