//! The analysis as JSON.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::super::refinement::Lowest;
use super::{Analysis, CaseResponses, Extreme};
use crate::problem::Problem;
use crate::problem::structure::{DIRECTIONS, Structure};

/// Everything as one JSON object.
pub(super) fn write(analysis: &Analysis, problem: &Problem, out: &mut dyn Write) -> io::Result<()> {
    let definitions: Map<String, Value> = analysis.definitions.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
    let mut whole = json!({ "definitions": definitions, "equilibrium_residual": analysis.equilibrium_residual });
    if let Some(structure) = problem.structure.as_deref() {
        let cases: Map<String, Value> =
            analysis.cases.iter().map(|case| (case.name.clone(), case_json(case, structure, problem))).collect();
        whole["cases"] = cases.into();
    }
    let factors = analysis.modes.iter().filter_map(|found| Some((found.case.clone()?, lowest_json(found))));
    whole["buckling"] = factors.collect::<Map<String, Value>>().into();
    if let Some(found) = analysis.modes.iter().find(|found| found.case.is_none()) {
        whole["frequencies"] = lowest_json(found);
    }
    if !analysis.gradient.is_empty() {
        let of = |row: &Vec<f64>| -> Map<String, Value> {
            analysis.variables.iter().cloned().zip(row.iter().map(|&value| json!(value))).collect()
        };
        let gradient: Map<String, Value> =
            analysis.definitions.iter().zip(&analysis.gradient).map(|((name, _), row)| (name.clone(), of(row).into())).collect();
        whole["gradient"] = gradient.into();
    }
    serde_json::to_writer_pretty(&mut *out, &whole)?;
    writeln!(out)
}

fn lowest_json(found: &Lowest) -> Value {
    json!({ "pieces": found.pieces, "values": found.values, "with_twice_the_pieces": found.refined })
}

fn case_json(case: &CaseResponses, structure: &Structure, problem: &Problem) -> Value {
    let by_node = |list: &[(u32, usize, f64)]| {
        let mut nodes: Map<String, Value> = Map::new();
        for &(node, direction, value) in list {
            let name = structure.nodes.names[node as usize].to_owned();
            nodes.entry(name).or_insert_with(|| json!({}))[DIRECTIONS[direction]] = json!(value);
        }
        Value::from(nodes)
    };
    let mut ribs: Map<String, Value> = Map::new();
    let name = |extreme: &Extreme| problem.ribs.names[extreme.rib as usize].to_owned();
    for extreme in &case.forces {
        let ((least, at_least, _), (most, at_most, _)) = (extreme.least, extreme.most);
        ribs.entry(name(extreme)).or_insert_with(|| json!({}))[extreme.of] =
            json!({ "min": least, "min_at": at_least, "max": most, "max_at": at_most });
    }
    for extreme in &case.stresses {
        let ((least, at_least, low), (most, at_most, high)) = (extreme.least, extreme.most);
        ribs.entry(name(extreme)).or_insert_with(|| json!({}))["stress"] = json!({
            "min": least, "min_at": at_least, "min_point": low, "max": most, "max_at": at_most, "max_point": high
        });
    }
    json!({ "displacements": by_node(&case.displacements), "reactions": by_node(&case.reactions), "ribs": ribs })
}
