//! The range of a linear row over a box, end by end, for bounds that follow from rows.

/// The finite part of an end of the row's range, the sizes it is summed from, and its open variables.
#[derive(Default, Clone, Copy)]
pub(super) struct End {
    pub(super) sum: f64,
    pub(super) magnitude: f64,
    pub(super) open: usize,
}

impl End {
    pub(super) fn add(&mut self, term: f64) {
        if term.is_finite() {
            self.sum += term;
            self.magnitude += term.abs();
        } else {
            self.open += 1;
        }
    }

    /// The sum without one variable's own term, where no other is open.
    pub(super) fn without(self, own: f64) -> Option<f64> {
        match (own.is_finite(), self.open) {
            (true, 0) => Some(self.sum - own),
            (false, 1) => Some(self.sum),
            _ => None,
        }
    }
}

/// The least and the most of coefficient·v between two bounds of v.
pub(super) fn range(coefficient: f64, lower: f64, upper: f64) -> (f64, f64) {
    if coefficient > 0.0 { (coefficient * lower, coefficient * upper) } else { (coefficient * upper, coefficient * lower) }
}
