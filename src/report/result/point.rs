//! The reported point: values, bounds, rows.

use serde::{Serialize, Serializer};

use super::super::Findings;

/// Values by variable name.
pub(super) struct Point<'a> {
    /// For the names.
    pub findings: &'a Findings<'a>,
    /// The values.
    pub x: &'a [f64],
}

impl Serialize for Point<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.x.iter().enumerate().map(|(j, value)| (self.findings.model.variable_name(j), value)))
    }
}

pub(super) struct BoundsPart<'a>(pub &'a Findings<'a>);

impl Serialize for BoundsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Bound {
            name: String,
            active: &'static str,
            multiplier: f64,
            sensitivity: f64,
        }
        serializer.collect_seq((0..self.0.model.meta().variables()).map(|j| {
            let held = self.0.bound(j);
            let (multiplier, sensitivity) = (held.multiplier, held.sensitivity);
            Bound { name: self.0.model.variable_name(j), active: held.side.as_str(), multiplier, sensitivity }
        }))
    }
}

pub(super) struct ConstraintsPart<'a>(pub &'a Findings<'a>);

impl Serialize for ConstraintsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Row {
            name: String,
            value: f64,
            lower: f64,
            upper: f64,
            active: &'static str,
            multiplier: f64,
            sensitivity: f64,
        }
        let meta = self.0.model.meta();
        serializer.collect_seq((0..meta.rows()).map(|i| {
            let held = self.0.row(i);
            Row {
                name: self.0.model.row_name(i),
                value: self.0.row_value(i),
                lower: meta.row_lower[i],
                upper: meta.row_upper[i],
                active: held.side.as_str(),
                multiplier: held.multiplier,
                sensitivity: held.sensitivity,
            }
        }))
    }
}
