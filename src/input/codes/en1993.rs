//! EN 1993-1-1:2005, 6.3.1: flexural buckling of uniform members.
//!
//! N ≤ χ·A·fy/γM1 (6.47), χ = 1/(Φ + √(Φ² − λ̄²)) ≤ 1, Φ = ½·[1 + α·(λ̄ − 0.2) + λ̄²] (6.49), λ̄ = √(A·fy/N_cr) (6.50). The formula for χ has
//! a value for every λ̄ ≥ 0 and passes 1 at 0.2: with N ≤ A·fy/γM1 beside it the bound χ ≤ 1 has no corner.

use super::{AXES, Axis, Effects, Lets, Places, Row, Where};

/// Imperfection factors of Table 6.1 (flexural buckling) and Table 6.3 (lateral-torsional buckling: a to d).
pub(in crate::input) const CURVES: [(&str, f64); 5] = [("a0", 0.13), ("a", 0.21), ("b", 0.34), ("c", 0.49), ("d", 0.76)];

/// Data of a check.
pub(in crate::input) struct En {
    /// The yield strength, an expression in the rib's names.
    pub fy: String,
    /// The partial factor.
    pub gamma: f64,
    /// Buckling about y and z.
    pub axes: [Axis; 2],
}

impl En {
    /// N_cr, λ̄, Φ and χ of one axis.
    fn axis(&self, axis: usize, at: Where, effects: &Effects, lets: &mut Lets) {
        let (n, inertia) = AXES[axis];
        let alpha = match &self.axes[axis] {
            Axis::Held => {
                lets.name(format!("lambda_{n}"), "0");
                return lets.name(format!("chi_{n}"), "1");
            }
            Axis::Length { length, alpha } => {
                lets.name(format!("N_cr_{n}"), format!("pi^2*material.E*{}.{inertia}/({length})^2", at.critical));
                *alpha
            }
            Axis::System { alpha } => {
                // λ·|N|, smooth where the force changes its sign: of n = N/(A·fy) above 1e-3 it is 5e-7 too large.
                let size = format!("sqrt($N^2 + (1e-6*{}.A*$fy)^2)", at.section);
                lets.name(format!("N_cr_{n}"), format!("buckling({})*{size}", effects.of()));
                *alpha
            }
        };
        lets.name(format!("lambda_{n}"), format!("sqrt({}.A*$fy/$N_cr_{n})", at.section));
        lets.name(format!("phi_{n}"), format!("0.5*(1 + {alpha}*($lambda_{n} - 0.2) + $lambda_{n}^2)"));
        lets.name(format!("chi_{n}"), format!("1/($phi_{n} + sqrt($phi_{n}^2 - $lambda_{n}^2))"));
    }

    /// What all rows are written in. The axial force comes first: the structure's own factor needs it.
    pub fn lets(&self, effects: &Effects, axial: f64, at: Where) -> Lets {
        let mut lets = Lets::default();
        lets.name("fy", &self.fy);
        lets.name("N", effects.force("N", axial, -1.0));
        (0..2).for_each(|axis| self.axis(axis, at, effects, &mut lets));
        lets
    }

    /// Rows of 6.3.1 of a rib under a case.
    pub fn rows(&self, effects: &Effects, places: &Places, at: Where, tag: &str) -> Vec<Row> {
        let mut rows = Vec::new();
        for &station in &places.axial {
            let lets = self.lets(effects, station, at);
            let detail = || format!("{}, {station}{tag}", effects.case);
            let mut row = |clause: &str, short: String| rows.push(Row::new(&lets, clause, detail(), &short, Some(station)));
            for (axis, data) in self.axes.iter().enumerate() {
                if !matches!(data, Axis::Held) {
                    let n = AXES[axis].0;
                    row(&format!("6.3.1 {n}"), format!("$N <= $chi_{n}*{}.A*$fy/{}", at.section, self.gamma));
                }
            }
            row("6.3.1 cap", format!("$N <= {}.A*$fy/{}", at.section, self.gamma));
        }
        rows
    }
}
