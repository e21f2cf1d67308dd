//! Why nothing is feasible.

use serde::Serialize;

use super::super::Findings;

#[derive(Serialize)]
struct Amount {
    name: String,
    amount: f64,
}

#[derive(Serialize)]
pub(super) struct ConflictPart {
    violated: Vec<Amount>,
    constraints: Vec<String>,
    places: Vec<Option<String>>,
    bounds: Vec<String>,
    relaxations: Vec<Amount>,
    minimal: bool,
}

impl ConflictPart {
    pub fn of(findings: &Findings<'_>) -> Option<Self> {
        let (conflict, model) = (findings.outcome.conflict.as_ref()?, findings.model);
        let amounts = |list: &[(usize, f64)]| {
            list.iter().map(|&(i, amount)| Amount { name: model.row_name(i), amount }).collect::<Vec<_>>()
        };
        let side = |upper| if upper { "upper" } else { "lower" };
        Some(ConflictPart {
            violated: amounts(&conflict.violated_rows),
            constraints: conflict.rows.iter().map(|&i| model.row_name(i)).collect(),
            places: conflict.rows.iter().map(|&i| model.row_place(i)).collect(),
            bounds: conflict.bounds.iter().map(|&(j, upper)| format!("{}.{}", model.variable_name(j), side(upper))).collect(),
            relaxations: amounts(&conflict.relaxations),
            minimal: conflict.minimal,
        })
    }
}
