//! Where the derivatives in the substituted variables stand.

use super::{NOWHERE, THINNEST};
use crate::math::within;
use crate::model::{Meta, Pattern};

/// Bounds of t, and h's own bounds as a row hl ≤ t + hw ≤ hu.
pub(super) fn bound_difference(meta: &mut Meta, user: &Meta, h: usize, hw: usize) {
    let reach = [user.upper[h], user.start[h]].into_iter().find(|value| value.is_finite()).map_or(1.0, f64::abs);
    meta.lower[h] = THINNEST * reach.max(f64::MIN_POSITIVE);
    meta.upper[h] = (user.upper[h] - user.lower[hw]).max(meta.lower[h]);
    meta.start[h] = within(user.start[h] - user.start[hw], meta.lower[h], meta.upper[h]);
    meta.row_lower.push(user.lower[h]);
    meta.row_upper.push(user.upper[h]);
    meta.row_is_linear.push(true);
}

pub(super) fn connect_jacobian(user: &Meta, partner: &[Option<u32>], replaced: &[usize], meta: &mut Meta) -> Vec<[u32; 2]> {
    let mut positions: Vec<(u32, u32)> = Vec::with_capacity(user.jacobian.len());
    for (row, column) in user.jacobian.iter() {
        positions.push((row as u32, column as u32));
        positions.extend(partner[column].map(|partner| (row as u32, partner)));
    }
    for (at, &h) in replaced.iter().enumerate() {
        let row = (user.rows() + at) as u32;
        positions.push((row, h as u32));
        positions.extend(partner[h].map(|partner| (row, partner)));
    }
    meta.jacobian = Pattern::from_positions(user.rows() + replaced.len(), &mut positions);
    let slot = |row, column| meta.jacobian.position(row, column).map_or(NOWHERE, |at| at as u32);
    let slots =
        |(row, column): (usize, usize)| [slot(row, column as u32), partner[column].map_or(NOWHERE, |partner| slot(row, partner))];
    user.jacobian.iter().map(slots).collect()
}

/// TᵀHT for x = Tz: the entry (a, b) reaches (a or its partner) × (b or its partner).
pub(super) fn connect_hessian(user: &Meta, partner: &[Option<u32>], meta: &mut Meta) -> Vec<Vec<(u32, f64)>> {
    let reached = |j: usize| std::iter::once(j as u32).chain(partner[j]);
    let spread = |(a, b): (usize, usize)| {
        let mut entries: Vec<(u32, u32, f64)> = Vec::new();
        for i in reached(a) {
            for j in reached(b) {
                // An off-diagonal entry stands for two; where both land on the diagonal, they add up there.
                let twice = a != b && i == j;
                let mirrored = a == b && i < j;
                if !mirrored {
                    entries.push((i.max(j), i.min(j), if twice { 2.0 } else { 1.0 }));
                }
            }
        }
        entries
    };
    let mut positions: Vec<(u32, u32)> =
        user.hessian.iter().flat_map(|entry| spread(entry).into_iter().map(|(i, j, _)| (i, j))).collect();
    meta.hessian = Pattern::from_positions(user.variables(), &mut positions);
    let slot = |i: u32, j| meta.hessian.position(i as usize, j).map(|at| at as u32);
    user.hessian
        .iter()
        .map(|entry| spread(entry).into_iter().filter_map(|(i, j, factor)| Some((slot(i, j)?, factor))).collect())
        .collect()
}
