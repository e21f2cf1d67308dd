//! The second-order test of [`super::kkt`] where most active rows touch few variables: their null space is written down block by
//! block, and only what is left is factorised, often a small part.
//!
//! With the columns of Z an orthonormal basis of the null space of the narrow rows, S is positive definite on the null space of
//! all rows where [ZᵀSZ, (AZ)ᵀ; AZ, −δI] over the other rows has one negative eigenvalue per row: the same test, on the null space
//! itself instead of a penalty of 1/δ across it.

use super::system::{Hessian, places, weight};
use crate::certificate::parameters::second_order::{FEWEST, WIDEST};
use crate::certificate::point::Point;
use crate::linear_algebra::entries::Symmetric;
use crate::linear_algebra::null_space::Basis;
use crate::linear_algebra::saddle_point::DUAL;
use crate::linear_algebra::{Effort, FactorizationError};

/// Whether S shifted by `shift` times its magnitudes is certainly positive on the null space of the active rows. `None` where this test
/// does not pay, or cannot tell.
pub(super) fn is_positive(
    point: &Point<'_>,
    hessian: &Hessian,
    (free, held): (&[usize], &[usize]),
    shift: f64,
) -> Option<Result<bool, FactorizationError>> {
    if free.len() + held.len() < FEWEST || point.is_over() {
        return None;
    }
    let place = places(point.meta().variables(), free);
    let row = |&i: &usize| {
        let of_free = point.row_in_sizes(i).map(|(j, value)| (place[j], value));
        of_free.filter(|&(j, value)| j != u32::MAX && value != 0.0).collect()
    };
    let rows: Vec<Vec<(u32, f64)>> = held.iter().map(row).collect();
    let (narrow, wide): (Vec<_>, Vec<_>) = rows.into_iter().partition(|row| row.len() <= WIDEST);
    let basis = Basis::of(free.len(), &narrow)?;
    let order = basis.columns() + wide.len();
    (2 * order < free.len() + held.len()).then(|| {
        let mut entries = Vec::new();
        reduce_hessian(&basis, point, hessian, (free, &place), shift, &mut entries);
        for (k, row) in wide.iter().enumerate() {
            let at = (basis.columns() + k) as u32;
            row.iter().for_each(|&(j, value)| entries.extend(basis.row(j).map(|(column, z)| (at, column, value * z))));
            entries.push((at, at, -DUAL));
        }
        let positions: Vec<(u32, u32)> = entries.iter().map(|entry| (entry.0, entry.1)).collect();
        let inertia = Symmetric::curved(order, &positions)?.inertia(entries.iter().map(|entry| entry.2), Effort::Any)?;
        Ok(inertia.negative == wide.len())
    })
}

/// The lower triangle of Zᵀ(S + shift·W)Z.
fn reduce_hessian(
    basis: &Basis,
    point: &Point<'_>,
    hessian: &Hessian,
    (free, place): (&[usize], &[u32]),
    shift: f64,
    entries: &mut Vec<(u32, u32, f64)>,
) {
    let mut add = |a: u32, b: u32, value: f64| {
        for (k, z) in basis.row(a) {
            entries.extend(basis.row(b).filter(|&(l, _)| l <= k).map(|(l, other)| (k, l, z * value * other)));
        }
    };
    for (at, (row, column)) in point.meta().hessian.iter().enumerate() {
        let (a, b) = (place[row], place[column]);
        if a == u32::MAX || b == u32::MAX || hessian.values[at] == 0.0 {
            continue;
        }
        add(a, b, hessian.values[at]);
        if a != b {
            add(b, a, hessian.values[at]);
        }
    }
    free.iter().enumerate().for_each(|(k, &j)| add(k as u32, k as u32, shift * weight(hessian.size[j])));
}
