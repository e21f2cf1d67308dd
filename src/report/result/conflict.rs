//! Why nothing is feasible.

use serde::Serialize;

use super::super::Findings;
use crate::crosscheck::LimitMove;

#[derive(Serialize)]
struct Amount {
    name: String,
    amount: f64,
}

/// A move that is enough on its own.
#[derive(Serialize)]
struct Alternative {
    limit: String,
    from: f64,
    to: f64,
    relative: Option<f64>,
    least: bool,
}

#[derive(Serialize)]
pub(super) struct ConflictPart {
    violated: Vec<Amount>,
    constraints: Vec<String>,
    places: Vec<Option<String>>,
    bounds: Vec<String>,
    alternatives: Vec<Alternative>,
    minimal: bool,
}

impl ConflictPart {
    pub fn of(findings: &Findings<'_>) -> Option<Self> {
        let (conflict, model) = (findings.outcome.conflict.as_ref()?, findings.model);
        let amounts = |list: &[(usize, f64)]| {
            list.iter().map(|&(i, amount)| Amount { name: model.row_name(i), amount }).collect::<Vec<_>>()
        };
        let alternative = |found: &LimitMove| Alternative {
            limit: found.limit.label(model),
            from: found.from,
            to: found.to,
            relative: Some(found.relative()).filter(|share| share.is_finite()),
            least: found.least,
        };
        let side = |upper| if upper { "upper" } else { "lower" };
        Some(ConflictPart {
            violated: amounts(&conflict.violated_rows),
            constraints: conflict.rows.iter().map(|&i| model.row_name(i)).collect(),
            places: conflict.rows.iter().map(|&i| model.row_place(i)).collect(),
            bounds: conflict.bounds.iter().map(|&(j, upper)| format!("{}.{}", model.variable_name(j), side(upper))).collect(),
            alternatives: conflict.alternatives.iter().map(alternative).collect(),
            minimal: conflict.minimal,
        })
    }
}
