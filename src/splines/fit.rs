//! B-splines through data and near data.

use super::{BSplineCurve, KnotVector, SplineError, finite, rising, same_length};
use crate::math::banded::Banded;

/// Knots for interpolation at rising abscissae x with as many control values: clamped, inner knots on the data. Odd degrees leave out the
/// (degree − 1)/2 data points next to each end ("not a knot"); even ones take the middles between neighbours. As SciPy's `make_interp_spline`.
///
/// # Errors
/// Fewer than degree + 1 points, or abscissae that do not rise.
pub fn not_a_knot(degree: usize, x: &[f64]) -> Result<KnotVector, SplineError> {
    rising("abscissa", x)?;
    if x.len() < degree + 1 {
        return Err(SplineError::TooFewPoints { count: x.len(), least: degree + 1 });
    }
    let (first, last) = (x[0], x[x.len() - 1]);
    let middles: Vec<f64> = x.windows(2).map(|pair| pair[0] + 0.5 * (pair[1] - pair[0])).collect();
    // Both lists hold degree + 1 + inner values once the ends are cut off.
    let inner = if degree % 2 == 1 {
        let cut = degree.div_ceil(2);
        x.get(cut..x.len() - cut).unwrap_or_default()
    } else {
        middles.get(degree / 2..middles.len().saturating_sub(degree / 2)).unwrap_or_default()
    };
    let ends = |value| std::iter::repeat_n(value, degree + 1);
    KnotVector::new(degree, ends(first).chain(inner.iter().copied()).chain(ends(last)).collect())
}

/// The B-spline of these knots through the points `y[i]` at the abscissae `x[i]`, as many as control points.
///
/// ```
/// use ribopt::splines::{interpolate, not_a_knot};
/// let x = [0.0, 1.0, 2.5, 3.0, 4.0];
/// let cubes: Vec<[f64; 1]> = x.iter().map(|x: &f64| [x.powi(3)]).collect();
/// let spline = interpolate(not_a_knot(3, &x)?, &x, &cubes)?;
/// assert!((spline.evaluate(2.0)?[0] - 8.0).abs() < 1e-13);
/// # Ok::<(), ribopt::splines::SplineError>(())
/// ```
///
/// # Errors
/// Lists of wrong lengths, numbers that are not finite, abscissae that do not rise or lie outside the domain, or knots that leave a
/// control point undetermined (Schoenberg and Whitney: basis function i must not vanish at `x[i]`).
pub fn interpolate<const D: usize>(knots: KnotVector, x: &[f64], y: &[[f64; D]]) -> Result<BSplineCurve<D>, SplineError> {
    let p = knots.degree();
    rising("abscissa", x)?;
    same_length("the abscissae", knots.count(), x.len())?;
    same_length("the ordinates", x.len(), y.len())?;
    finite("ordinate", y.as_flattened())?;
    let mut matrix = Banded::zeros(x.len(), p, p);
    for (i, x) in x.iter().enumerate() {
        let basis = knots.basis(*x)?;
        let own = i.checked_sub(basis.first).and_then(|at| basis.values[0].get(at));
        if !own.is_some_and(|value| *value > 0.0) {
            return Err(SplineError::Undetermined { function: i + 1 });
        }
        for (at, value) in basis.values[0].iter().enumerate() {
            // Functions further than the band from i are zero here: basis function i holds x[i] in its support.
            *matrix.entry(i, basis.first + at) = *value;
        }
    }
    let mut controls = y.to_vec();
    matrix.solve(&mut controls).map_err(|singular| SplineError::Undetermined { function: singular.row + 1 })?;
    BSplineCurve::new(knots, controls)
}

/// The B-spline of these knots nearest to the data in the sum of squares; `x` need not rise. By the normal equations.
///
/// ```
/// use ribopt::splines::{KnotVector, least_squares};
/// let x: Vec<f64> = (0..50).map(|i| f64::from(i) / 49.0).collect();
/// let y: Vec<[f64; 1]> = x.iter().map(|x| [2.0 - x * x]).collect();
/// let spline = least_squares(KnotVector::clamped_uniform(2, 4, 0.0, 1.0)?, &x, &y)?;
/// assert!((spline.evaluate(0.3)?[0] - 1.91).abs() < 1e-13);
/// # Ok::<(), ribopt::splines::SplineError>(())
/// ```
///
/// # Errors
/// Lists of unequal length, fewer points than control points, numbers that are not finite, abscissae outside the domain, or data that leave
/// a control point undetermined.
pub fn least_squares<const D: usize>(knots: KnotVector, x: &[f64], y: &[[f64; D]]) -> Result<BSplineCurve<D>, SplineError> {
    let (p, n) = (knots.degree(), knots.count());
    same_length("the ordinates", x.len(), y.len())?;
    finite("abscissa", x)?;
    finite("ordinate", y.as_flattened())?;
    if x.len() < n {
        return Err(SplineError::TooFewPoints { count: x.len(), least: n });
    }
    schoenberg_whitney(&knots, x)?;
    let (mut normal, mut right) = (Banded::zeros(n, p, p), vec![[0.0; D]; n]);
    for (x, y) in x.iter().zip(y) {
        let basis = knots.basis(*x)?;
        for (i, row) in basis.values[0].iter().enumerate() {
            for (j, column) in basis.values[0].iter().enumerate() {
                *normal.entry(basis.first + i, basis.first + j) += row * column;
            }
            for d in 0..D {
                right[basis.first + i][d] += row * y[d];
            }
        }
    }
    normal.solve(&mut right).map_err(|singular| SplineError::Undetermined { function: singular.row + 1 })?;
    BSplineCurve::new(knots, right)
}

/// Every basis function gets a data point of its own, in order (necessary and sufficient for full rank).
fn schoenberg_whitney(knots: &KnotVector, x: &[f64]) -> Result<(), SplineError> {
    let mut sorted = x.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let mut at = 0;
    for function in 0..knots.count() {
        while at < sorted.len() && value_of(knots, function, sorted[at])? <= 0.0 {
            at += 1;
        }
        if at == sorted.len() {
            return Err(SplineError::Undetermined { function: function + 1 });
        }
        at += 1;
    }
    Ok(())
}

fn value_of(knots: &KnotVector, function: usize, x: f64) -> Result<f64, SplineError> {
    let basis = knots.basis(x)?;
    Ok(function.checked_sub(basis.first).and_then(|at| basis.values[0].get(at)).copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splines::reference::{Interpolation, reference};

    #[test]
    fn interpolation_as_scipy_for_every_degree() {
        let Interpolation { x, y, at, interpolation, .. } = reference();
        let y: Vec<[f64; 1]> = y.iter().map(|y| [*y]).collect();
        for (degree, expected) in interpolation {
            let spline = interpolate(not_a_knot(degree.parse().unwrap(), &x).unwrap(), &x, &y).unwrap();
            assert_eq!(spline.knots().knots().len(), expected.knots.len());
            for (ours, scipy) in spline.knots().knots().iter().zip(&expected.knots) {
                assert!((ours - scipy).abs() < 1e-15, "degree {degree}");
            }
            for (ours, scipy) in spline.controls().iter().zip(&expected.coefficients) {
                assert!((ours[0] - scipy).abs() < 1e-11, "degree {degree}");
            }
            for (x, scipy) in at.iter().zip(&expected.values) {
                assert!((spline.evaluate(*x).unwrap()[0] - scipy).abs() < 1e-12, "degree {degree}");
            }
        }
    }

    #[test]
    fn least_squares_as_scipy() {
        let fit = reference().fit;
        let y: Vec<[f64; 1]> = fit.y.iter().map(|y| [*y]).collect();
        let spline = least_squares(KnotVector::new(3, fit.knots).unwrap(), &fit.x, &y).unwrap();
        for (ours, scipy) in spline.controls().iter().zip(&fit.coefficients) {
            assert!((ours[0] - scipy).abs() < 1e-12);
        }
    }

    #[test]
    fn undetermined_data_are_named() {
        let knots = KnotVector::clamped_uniform(1, 4, 0.0, 3.0).unwrap();
        let crowded = [0.0, 0.1, 0.2, 0.3];
        let y = [[0.0]; 4];
        assert_eq!(interpolate(knots.clone(), &crowded, &y), Err(SplineError::Undetermined { function: 3 }));
        assert_eq!(least_squares(knots.clone(), &crowded, &y), Err(SplineError::Undetermined { function: 3 }));
        assert_eq!(
            least_squares(knots.clone(), &[0.0, 1.0, 3.0], &[[0.0]; 3]),
            Err(SplineError::TooFewPoints { count: 3, least: 4 })
        );
        assert!(matches!(least_squares(knots, &[0.0, 1.0, 2.0, 3.5], &y), Err(SplineError::Outside { .. })));
        assert!(matches!(not_a_knot(3, &[0.0, 1.0, 2.0]), Err(SplineError::TooFewPoints { count: 3, least: 4 })));
        assert!(matches!(not_a_knot(1, &[0.0, 0.0]), Err(SplineError::NotRising { position: 2, .. })));
    }
}
