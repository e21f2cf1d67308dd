//! Bicubic interpolation of data on a regular grid, note 1.5.3: a cubic spline in each direction.

use super::{KnotVector, SplineError, finite, interpolate, not_a_knot, rising, same_length};

/// A bicubic spline through heights on a grid, twice continuously differentiable (not-a-knot in both directions).
#[derive(Debug, Clone, PartialEq)]
pub struct BicubicInterpolant {
    x: KnotVector,
    y: KnotVector,
    /// Row by row: all y of the first x first.
    coefficients: Vec<f64>,
}

impl BicubicInterpolant {
    /// Through `z[i][j]` at `(x[i], y[j])`; x and y rise, at least four of each.
    ///
    /// ```
    /// use ribopt::splines::BicubicInterpolant;
    /// let (x, y) = ([0.0, 1.0, 2.0, 4.0], [0.0, 0.5, 1.0, 2.0, 3.0]);
    /// let z: Vec<Vec<f64>> = x.iter().map(|x| y.iter().map(|y| x * x * y + y * y * y).collect()).collect();
    /// let surface = BicubicInterpolant::new(&x, &y, &z)?;
    /// assert!((surface.evaluate(3.0, 1.5)? - 16.875).abs() < 1e-12);
    /// let [dx, dy] = surface.gradient(3.0, 1.5)?;
    /// assert!((dx - 9.0).abs() < 1e-12 && (dy - 15.75).abs() < 1e-12);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// Abscissae that do not rise or are fewer than four, rows of wrong length, numbers that are not finite.
    pub fn new(x: &[f64], y: &[f64], z: &[Vec<f64>]) -> Result<Self, SplineError> {
        rising("x", x)?;
        rising("y", y)?;
        same_length("rows of z", x.len(), z.len())?;
        let (in_x, in_y) = (not_a_knot(3, x)?, not_a_knot(3, y)?);
        let mut coefficients = vec![0.0; x.len() * y.len()];
        // First along y in every row, then along x in every column.
        for (row, target) in z.iter().zip(coefficients.chunks_exact_mut(y.len())) {
            same_length("a row of z", y.len(), row.len())?;
            finite("z", row)?;
            let data: Vec<[f64; 1]> = row.iter().map(|z| [*z]).collect();
            target.copy_from_slice(interpolate(in_y.clone(), y, &data)?.controls().as_flattened());
        }
        for j in 0..y.len() {
            let data: Vec<[f64; 1]> = coefficients[j..].iter().step_by(y.len()).map(|c| [*c]).collect();
            let column = interpolate(in_x.clone(), x, &data)?;
            for (i, [coefficient]) in column.controls().iter().enumerate() {
                coefficients[i * y.len() + j] = *coefficient;
            }
        }
        Ok(BicubicInterpolant { x: in_x, y: in_y, coefficients })
    }

    /// Height at (x, y).
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn evaluate(&self, x: f64, y: f64) -> Result<f64, SplineError> {
        self.derivative(x, y, [0, 0])
    }

    /// (∂z/∂x, ∂z/∂y) at (x, y).
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn gradient(&self, x: f64, y: f64) -> Result<[f64; 2], SplineError> {
        Ok([self.derivative(x, y, [1, 0])?, self.derivative(x, y, [0, 1])?])
    }

    /// A partial derivative at (x, y): `order` = times by x, times by y.
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn derivative(&self, x: f64, y: f64, order: [usize; 2]) -> Result<f64, SplineError> {
        let (in_x, in_y) = (self.x.basis_derivatives(x, order[0])?, self.y.basis_derivatives(y, order[1])?);
        let mut height = 0.0;
        for (i, a) in in_x.values[order[0]].iter().enumerate() {
            let row = &self.coefficients[(in_x.first + i) * self.y.count() + in_y.first..];
            height += a * in_y.values[order[1]].iter().zip(row).map(|(b, c)| b * c).sum::<f64>();
        }
        Ok(height)
    }

    /// The rectangle it is defined on: (from, to) in x and in y.
    pub fn domain(&self) -> [(f64, f64); 2] {
        [self.x.domain(), self.y.domain()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splines::reference::reference;

    #[test]
    fn as_scipy() {
        let data = reference().bicubic;
        let surface = BicubicInterpolant::new(&data.x, &data.y, &data.z).unwrap();
        for at in 0..data.px.len() {
            let (x, y) = (data.px[at], data.py[at]);
            let [dx, dy] = surface.gradient(x, y).unwrap();
            assert!((surface.evaluate(x, y).unwrap() - data.value[at]).abs() < 1e-12);
            assert!((dx - data.dx[at]).abs() < 1e-12 && (dy - data.dy[at]).abs() < 1e-12);
        }
    }

    #[test]
    fn goes_through_the_data_and_refuses_bad_grids() {
        let data = reference().bicubic;
        let surface = BicubicInterpolant::new(&data.x, &data.y, &data.z).unwrap();
        for (x, row) in data.x.iter().zip(&data.z) {
            for (y, z) in data.y.iter().zip(row) {
                assert!((surface.evaluate(*x, *y).unwrap() - z).abs() < 1e-13);
            }
        }
        assert!(matches!(surface.evaluate(0.0, 3.0), Err(SplineError::Outside { .. })));
        assert!(matches!(
            BicubicInterpolant::new(&data.x[..3], &data.y, &data.z[..3]),
            Err(SplineError::TooFewPoints { count: 3, least: 4 })
        ));
        assert!(matches!(BicubicInterpolant::new(&data.x[..5], &data.y, &data.z), Err(SplineError::Length { .. })));
    }
}
