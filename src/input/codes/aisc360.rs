//! AISC 360-22, E3: flexural buckling of members without slender elements.
//!
//! P_n = F_cr·A with F_cr = 0.658^(Fy/Fe)·Fy (E3-2) where KL/r ≤ 4.71·√(E/Fy), else 0.877·Fe (E3-3), Fe = π²E/(KL/r)².
//!
//! The two meet neither in value nor in slope: at the join, Fy/Fe = (4.71/π)² = 2.2477, they are 0.39032·Fy and 0.39017·Fy. A rib that
//! starts on the side of (E3-2) is held by both, which is (E3-2) below the join to 0.04 %, (E3-3) exactly up to Fy/Fe = 2.54, and
//! safe beyond. One that starts beyond the join is held by (E3-3), and kept there.

use super::{AXES, Axis, Effects, Lets, Places, Row, Where};

/// KL/r at the join over √(E/Fy).
pub(in crate::input) const JOIN: f64 = 4.71;

/// How a section is made.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::input) enum Made {
    Rolled,
    BuiltUp,
}

/// Data of a check.
pub(in crate::input) struct Aisc {
    /// The yield strength, an expression in the rib's names.
    pub fy: String,
    /// The resistance factor.
    pub phi: f64,
    /// Buckling about y and z.
    pub axes: [Axis; 2],
}

impl Aisc {
    /// What rows about an axis are written in.
    pub fn lets(&self, axis: usize, effects: &Effects, station: f64, at: Where) -> Option<Lets> {
        let ((n, inertia), Axis::Length { length, .. }) = (AXES[axis], &self.axes[axis]) else { return None };
        let mut lets = Lets::default();
        lets.name("Fy", &self.fy);
        lets.name("N", effects.force("N", station, -1.0));
        lets.name(format!("Fe_{n}"), format!("pi^2*material.E*{}.{inertia}/({}.A*({length})^2)", at.critical, at.section));
        Some(lets)
    }

    /// Rows of E3 of a rib under a case; `beyond`: whether it starts beyond the join about y and z.
    pub fn rows(&self, effects: &Effects, places: &Places, at: Where, beyond: [bool; 2], tag: &str) -> Vec<Row> {
        let (mut rows, phi, a) = (Vec::new(), self.phi, at.section);
        for &station in &places.axial {
            for (axis, (n, _)) in AXES.iter().enumerate() {
                let Some(lets) = self.lets(axis, effects, station, at) else { continue };
                let mut row = |clause: String, short: String| {
                    let detail = format!("{}, {station}{tag}", effects.case);
                    rows.push(Row::new(&lets, clause, detail, &short, Some(station)));
                };
                if !beyond[axis] {
                    row(format!("E3-2 {n}"), format!("$N <= {phi}*0.658^($Fy/$Fe_{n})*$Fy*{a}.A"));
                }
                row(format!("E3-3 {n}"), format!("$N <= {phi}*0.877*$Fe_{n}*{a}.A"));
                if beyond[axis] && station == 0.0 {
                    row(format!("E3 join {n}"), format!("{JOIN}^2*$Fe_{n} <= pi^2*$Fy"));
                }
            }
        }
        rows
    }
}
