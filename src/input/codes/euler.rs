//! Euler's critical force: N·safety ≤ π²EI/(kL)².

use super::{AXES, Axis, Effects, Lets, Places, Row, Where};

/// Data of a check.
pub(in crate::input) struct Euler {
    /// What N is multiplied with.
    pub safety: f64,
    /// About y and z.
    pub axes: [Axis; 2],
}

impl Euler {
    /// Rows of a rib under a case.
    pub fn rows(&self, effects: &Effects, places: &Places, at: Where, tag: &str) -> Vec<Row> {
        let mut rows = Vec::new();
        for ((axis, inertia), data) in AXES.iter().zip(&self.axes) {
            let Axis::Length { length, .. } = data else { continue };
            for &station in &places.axial {
                let mut lets = Lets::default();
                lets.name("N", effects.force("N", station, -1.0));
                lets.name(format!("N_cr_{axis}"), format!("pi^2*material.E*{}.{inertia}/({length})^2", at.critical));
                let short = format!("{}*$N <= $N_cr_{axis}", self.safety);
                rows.push(Row::new(&lets, format!("Euler {axis}"), format!("{}, {station}{tag}", effects.case), &short, None));
            }
        }
        rows
    }
}
