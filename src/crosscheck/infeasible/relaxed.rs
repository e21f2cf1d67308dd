//! An elastic minimum, and what is read off it.

use crate::certificate::Certificate;
use crate::model::{Elastic, Model};

/// Less than this share of a variable's size is rounding.
const NEGLIGIBLE: f64 = 1e-6;
/// Multipliers below this, relative, are noise.
pub(super) const NOISE: f64 = 1e-6;

/// An elastic minimum.
pub(super) struct Relaxed {
    pub(super) x: Vec<f64>,
    pub(super) violation: f64,
    pub(super) certificate: Certificate,
    /// Multipliers of the model's rows, length m.
    pub(super) multipliers: Vec<f64>,
    /// Rows with multipliers, and the side they give way on: without them the violation could shrink.
    pub(super) carriers: Vec<(usize, bool)>,
}

impl Relaxed {
    /// The same point with multipliers from elsewhere, of which all that are not 0 conflict.
    pub(super) fn with_multipliers(self, multipliers: Vec<f64>) -> Relaxed {
        let carriers = multipliers.iter().enumerate().filter(|(_, y)| **y != 0.0).map(|(row, &y)| (row, y > 0.0)).collect();
        Relaxed { multipliers, carriers, ..self }
    }

    pub(super) fn is_better(&self, other: &Relaxed) -> bool {
        (other.certificate.certified, self.violation) < (self.certificate.certified, other.violation)
    }
}

/// What is asked of an elastic minimum.
#[derive(Clone, Copy)]
pub(super) enum Asked {
    /// Its multipliers, which tell the limits that conflict.
    Multipliers,
    /// Whether anything is violated: a point at which nothing is proves by itself that no less is possible.
    WhetherAny,
}

/// What is known of a point without violation: no point has less, and no limit carries a multiplier.
pub(super) fn nothing_violated(elastic: &Elastic<'_>) -> Certificate {
    let meta = elastic.meta();
    Certificate {
        certified: true,
        row_multipliers: vec![0.0; meta.rows()],
        bound_multipliers: vec![0.0; meta.variables()],
        variable_scales: vec![1.0; meta.variables()],
        ..Certificate::default()
    }
}

/// `x` where variables that are zero but for rounding stand at the model's start: what rounding has left of them would be taken
/// for their size.
pub(super) fn sized(model: &dyn Model, x: &[f64]) -> Vec<f64> {
    let size = |start: f64| if start == 0.0 { 1.0 } else { start.abs() };
    x.iter().zip(&model.meta().start).map(|(&x, &start)| if x.abs() < NEGLIGIBLE * size(start) { start } else { x }).collect()
}

/// Multipliers of the elastic problem lie between −1/S and 1/S; noise is far below.
pub(super) fn carriers(elastic: &Elastic<'_>, certificate: &Certificate) -> Vec<(usize, bool)> {
    let y = certificate.row_multipliers.iter().enumerate();
    y.filter(|&(k, y)| (y * elastic.scale(k)).abs() > NOISE).map(|(k, &y)| (elastic.row(k), y > 0.0)).collect()
}
