//! The six deformations of a member as combinations of its nodes' twelve displacements: ab = a·Θ·O.
//!
//! e_N = u_j − u_i; e_zi = ψy − rz_i, e_zj = rz_j − ψy (plane x–y, slope rz); e_yi = ψz + ry_i, e_yj = −ry_j − ψz (plane x–z, slope −ry);
//! e_T = rx_j − rx_i, where ψ = (v_j − v_i)/L, (w_j − w_i)/L. Offsets: u_end = u + θ × r.

use super::algebra::Algebra;
use super::axes::Frame;

/// Number of basic forces.
pub const BASIC: usize = 6;

/// Rows: N, Mz_i, Mz_j, My_i, My_j, T; columns: x, y, z, rx, ry, rz of the start, then of the end.
pub type Rows<N> = [[N; 12]; BASIC];

/// ab of a member with its frame and rigid arms (global vectors from node to member end).
pub fn rows<A: Algebra>(algebra: &mut A, frame: &Frame<A::Number>, offset: [[f64; 3]; 2]) -> Rows<A::Number> {
    let displacement = |algebra: &mut A, end: usize, axis: [A::Number; 3]| along(algebra, end, axis, offset[end]);
    let rotation = |algebra: &mut A, end: usize, axis: [A::Number; 3]| turning(algebra, end, axis);
    let [e1, e2, e3] = frame.axes;
    let stretch = difference(algebra, &displacement, e1);
    let (psi_y, psi_z) = (difference(algebra, &displacement, e2), difference(algebra, &displacement, e3));
    let psi = [psi_y, psi_z].map(|row| row.map(|value| algebra.divide(value, frame.length)));
    let mut slope = |end, axis| rotation(algebra, end, axis);
    let (rz_i, rz_j, ry_i, ry_j) = (slope(0, e3), slope(1, e3), slope(0, e2), slope(1, e2));
    let (rx_i, rx_j) = (slope(0, e1), slope(1, e1));
    [
        stretch,
        combined(algebra, 1.0, &psi[0], -1.0, &rz_i),
        combined(algebra, 1.0, &rz_j, -1.0, &psi[0]),
        combined(algebra, 1.0, &psi[1], 1.0, &ry_i),
        combined(algebra, -1.0, &ry_j, -1.0, &psi[1]),
        combined(algebra, 1.0, &rx_j, -1.0, &rx_i),
    ]
}

/// The displacement of a member's end along an axis: axis·(u + θ × r) = axis·u + (r × axis)·θ.
pub fn along<A: Algebra>(algebra: &mut A, end: usize, axis: [A::Number; 3], arm: [f64; 3]) -> [A::Number; 12] {
    let mut row = [algebra.constant(0.0); 12];
    row[6 * end..6 * end + 3].copy_from_slice(&axis);
    if arm != [0.0; 3] {
        let arm = arm.map(|component| algebra.constant(component));
        let turned = algebra.cross(arm, axis);
        row[6 * end + 3..6 * end + 6].copy_from_slice(&turned);
    }
    row
}

/// The rotation of a member's end about an axis.
pub fn turning<A: Algebra>(algebra: &mut A, end: usize, axis: [A::Number; 3]) -> [A::Number; 12] {
    let mut row = [algebra.constant(0.0); 12];
    row[6 * end + 3..6 * end + 6].copy_from_slice(&axis);
    row
}

/// Where the six support forces of a simply supported member act: the start along x, y, z and about x, the end along y and z.
pub fn support_rows<A: Algebra>(algebra: &mut A, frame: &Frame<A::Number>, offset: [[f64; 3]; 2]) -> [[A::Number; 12]; 6] {
    let [e1, e2, e3] = frame.axes;
    [
        along(algebra, 0, e1, offset[0]),
        along(algebra, 0, e2, offset[0]),
        along(algebra, 0, e3, offset[0]),
        turning(algebra, 0, e1),
        along(algebra, 1, e2, offset[1]),
        along(algebra, 1, e3, offset[1]),
    ]
}

fn difference<A: Algebra>(
    algebra: &mut A,
    displacement: &impl Fn(&mut A, usize, [A::Number; 3]) -> [A::Number; 12],
    axis: [A::Number; 3],
) -> [A::Number; 12] {
    let (start, end) = (displacement(algebra, 0, axis), displacement(algebra, 1, axis));
    combined(algebra, 1.0, &end, -1.0, &start)
}

fn combined<A: Algebra>(
    algebra: &mut A,
    first: f64,
    left: &[A::Number; 12],
    second: f64,
    right: &[A::Number; 12],
) -> [A::Number; 12] {
    std::array::from_fn(|at| {
        let (left, right) = (algebra.scale(first, left[at]), algebra.scale(second, right[at]));
        algebra.add(left, right)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::algebra::Numbers;
    use crate::structure::axes::{Rule, frame};

    /// Rigid motions deform nothing, with rigid arms or without.
    #[test]
    fn rigid_motions_are_no_deformations() {
        let (start, end) = ([1.0, 2.0, -1.0], [3.0, -1.0, 2.5]);
        let offset = [[0.1, -0.2, 0.3], [-0.3, 0.05, 0.2]];
        let along = std::array::from_fn(|axis| (end[axis] + offset[1][axis]) - (start[axis] + offset[0][axis]));
        let frame = frame(&mut Numbers, along, Rule::in_space(along), 17.0);
        let rows = rows(&mut Numbers, &frame, offset);
        for motion in 0..6 {
            let mut u = [0.0; 12];
            for (at, node) in [start, end].into_iter().enumerate() {
                if motion < 3 {
                    u[6 * at + motion] = 1.0;
                } else {
                    let mut turn = [0.0; 3];
                    turn[motion - 3] = 1.0;
                    let moved = Numbers.cross(turn, node);
                    u[6 * at..6 * at + 3].copy_from_slice(&moved);
                    u[6 * at + 3..6 * at + 6].copy_from_slice(&turn);
                }
            }
            for row in &rows {
                let e: f64 = row.iter().zip(u).map(|(a, u)| a * u).sum();
                assert!(e.abs() < 1e-14, "motion {motion}: {e}");
            }
        }
    }
}
