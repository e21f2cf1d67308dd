//! First and second derivatives of an eigenvalue or a cut, put together.

use crate::linear_algebra::FactorizationError;
use crate::linear_algebra::pencil::Complement;

/// Second derivatives by (z, z') with z' ≤ z; repeats add up.
pub(super) type Curvature = Vec<(usize, usize, f64)>;

/// A value and its derivatives along design and displacements.
pub(super) struct Smooth {
    pub slope: Vec<f64>,
    pub curvature: Curvature,
}

/// Adds −2·(S_z w)ᵀ·P·(S_z' w), by which a mode turns with the design, to second derivatives.
pub(super) fn turned(
    complement: &Complement,
    mixed: &[Vec<(usize, f64)>],
    curvature: &mut Curvature,
) -> Result<(), FactorizationError> {
    let order = complement.order();
    let moving: Vec<usize> = (0..mixed.len()).filter(|&z| !mixed[z].is_empty()).collect();
    for (at, &i) in moving.iter().enumerate() {
        let mut column = vec![0.0; order];
        mixed[i].iter().for_each(|&(row, value)| column[row] += value);
        let projected = complement.project(&column)?;
        for &j in &moving[..=at] {
            let seen: f64 = mixed[j].iter().map(|&(row, value)| value * projected[row]).sum();
            curvature.push((i, j, -2.0 * seen));
        }
    }
    Ok(())
}

/// g(m(z)) from the derivatives of m and g.
pub(super) fn chained(slope: Vec<f64>, mut curvature: Curvature, active: &[usize], first: f64, second: f64) -> Smooth {
    curvature.iter_mut().for_each(|(.., value)| *value *= first);
    for (at, &i) in active.iter().enumerate() {
        curvature.extend(active[..=at].iter().map(|&j| (i, j, second * slope[i] * slope[j])));
    }
    Smooth { slope: slope.iter().map(|value| first * value).collect(), curvature }
}
