//! What a direction adds to those found.

use crate::certificate::parameters::second_order::INDEPENDENT;
use crate::math::dot;

/// Whether two vectors span one line.
fn is_parallel(a: &[f64], b: &[f64]) -> bool {
    dot(a, b).powi(2) > 0.999 * dot(a, a) * dot(b, b)
}

/// Whether a vector spans another line than those found.
pub(super) fn is_new(found: &[Vec<f64>], v: &[f64]) -> bool {
    found.iter().all(|known| !is_parallel(known, v))
}

/// What of v is beyond the span of an orthonormal basis, of length one; `None` where that is hardly anything.
pub(super) fn beyond(basis: &[Vec<f64>], v: &[f64]) -> Option<Vec<f64>> {
    let mut rest = v.to_vec();
    // Twice is enough (Giraud, Langou, Rozložník and van den Eshof 2005).
    for known in basis.iter().chain(basis) {
        let share = dot(known, &rest);
        rest.iter_mut().zip(known).for_each(|(rest, known)| *rest -= share * known);
    }
    let length = dot(&rest, &rest).sqrt();
    rest.iter_mut().for_each(|rest| *rest /= length);
    (length > INDEPENDENT * dot(v, v).sqrt()).then_some(rest)
}
