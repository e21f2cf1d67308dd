//! The JSON Schema of the problem file, for completion and checks in editors.

use serde_json::{Map, Value, json};

use crate::problem::settings::{ARGMIN_ALGORITHMS, BACKENDS, NLOPT_ALGORITHMS, Settings};
use crate::sections;

/// The schema (JSON Schema, draft 2020-12). Section kinds and their dimensions come from [`sections::KINDS`].
///
/// ```
/// let schema = ribopt::input::schema();
/// assert_eq!(schema["properties"]["minimize"]["type"], "string");
/// ```
pub fn schema() -> Value {
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "ribopt problem file",
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "title": { "type": "string", "description": "Shown in reports; the file's stem if left out." },
            "minimize": { "type": "string", "description": "The objective, an expression. Default \"volume\" where there are ribs." },
            "maximize": { "type": "string", "description": "Instead of minimize." },
            "units": map_of(json!({ "type": "string" }), "Labels for reports, such as length = \"m\"."),
            "parameters": map_of(one_or_many(), "Constants: numbers, arrays, or expressions in other parameters."),
            "variables": map_of(variable(), "Free design variables."),
            "definitions": map_of(scalar("An expression."), "Names for expressions, in any order, without circles."),
            "sections": map_of(section(), "Cross-sections."),
            "ribs": { "type": "array", "items": rib() },
            "constraints": { "type": "array", "items": constraint() },
            "solver": solver(),
            "tables": object(json!({
                "sections": text("CSV table of sections: name, kind, dimensions (b, or b.lower, b.upper, b.start), data."),
                "ribs": text("CSV table of ribs: name, from, to (or section), length, volume, data."),
            }), &[]),
        },
        "not": { "required": ["minimize", "maximize"] },
    })
}

fn text(description: &str) -> Value {
    json!({ "type": "string", "description": description })
}

/// A number or an expression.
fn scalar(description: &str) -> Value {
    json!({ "type": ["number", "string"], "description": description })
}

fn one_or_many() -> Value {
    json!({ "type": ["number", "string", "array"], "items": { "type": ["number", "string"] } })
}

fn map_of(value: Value, description: &str) -> Value {
    json!({ "type": "object", "additionalProperties": value, "description": description })
}

fn object(properties: Value, required: &[&str]) -> Value {
    json!({ "type": "object", "additionalProperties": false, "properties": properties, "required": required })
}

fn variable() -> Value {
    object(
        json!({
            "size": scalar("Number of elements x[1], x[2], … of an array."),
            "lower": one_or_many(), "upper": one_or_many(), "start": one_or_many(),
        }),
        &[],
    )
}

fn data() -> Value {
    map_of(json!({ "type": ["number", "string"] }), "Further numbers, or text for grouping.")
}

/// One alternative per form of every kind.
fn section() -> Value {
    let own = object(json!({ "lower": scalar("Lower bound."), "upper": scalar("Upper bound."), "start": scalar("Start.") }), &[]);
    let dimension = json!({
        "anyOf": [scalar("A fixed number, or an expression."), own],
        "description": "A number (fixed), bounds and start (a variable), or an expression.",
    });
    let alternatives = sections::forms().map(|(kind, form)| {
        let mut properties = Map::new();
        properties.insert("kind".into(), json!({ "const": kind.name() }));
        properties.insert("data".into(), data());
        let list = form.dimensions.first().and_then(|name| name.strip_suffix("[1]"));
        let mut required = vec!["kind"];
        match list {
            // As a list; one by one under their numbered names they are read too.
            Some(name) => {
                let count = form.dimensions.len();
                let list = json!({ "type": "array", "items": dimension, "minItems": count, "maxItems": count });
                properties.insert(name.into(), list);
                required.push(name);
            }
            None => {
                properties.extend(form.dimensions.iter().map(|name| ((*name).to_owned(), dimension.clone())));
                required.extend(form.dimensions);
            }
        }
        if kind.has_outline() {
            let point = json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
            properties.insert(
                "points".into(),
                json!({ "type": "array", "items": point, "description": "Points [x, y] of the outline or line." }),
            );
            required.push("points");
        }
        object(Value::Object(properties), &required)
    });
    json!({ "anyOf": alternatives.collect::<Vec<Value>>() })
}

fn rib() -> Value {
    let mut rib = object(
        json!({
            "name": text("Its name."),
            "from": text("Section at the left end."),
            "to": text("Section at the right end."),
            "section": text("The same section at both ends, instead of from and to."),
            "length": scalar("Length, positive."),
            "volume": { "enum": ["frustum", "prismatoid"], "description": "Volume law, by default frustum." },
            "data": data(),
        }),
        &["name", "length"],
    );
    rib["oneOf"] = json!([{ "required": ["from", "to"] }, { "required": ["section"] }]);
    rib
}

fn constraint() -> Value {
    let kinds: Vec<&str> = sections::KINDS.iter().map(|kind| kind.name()).collect();
    object(
        json!({
            "name": text("Its name in reports."),
            "require": text("a <= b, a >= b, a == b, or lo <= a <= hi with constant lo and hi."),
            "for": { "enum": ["sections", "ribs"], "description": "Once per section or rib." },
            "only": { "type": ["array", "string"], "items": { "type": "string" }, "description": "Patterns (* and ?) of names." },
            "kind": { "enum": kinds, "description": "Items of this kind only." },
            "where": text("A comparison of data and parameters that chooses items."),
            "by": text("One row per group of items sharing a value of this datum."),
        }),
        &["require"],
    )
}

fn solver() -> Value {
    let defaults = Settings::default();
    let tolerance = |value: f64, what: &str| json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1, "default": value, "description": what });
    let count = |value: u64, what: &str| json!({ "type": "integer", "minimum": 1, "default": value, "description": what });
    let algorithm = |names: &[&str]| object(json!({ "algorithm": { "enum": names, "default": "auto" } }), &[]);
    object(
        json!({
            "backends": { "type": "array", "items": { "enum": BACKENDS }, "description": "Default: all that are built in." },
            "optimality_tolerance": tolerance(defaults.optimality_tolerance, "Largest accepted dual infeasibility (TolFun)."),
            "step_tolerance": tolerance(defaults.step_tolerance, "Relative step below which a run has stopped (TolX)."),
            "constraint_tolerance": tolerance(defaults.constraint_tolerance, "Largest accepted violation, relative (TolCon)."),
            "max_iterations": count(defaults.max_iterations, "Iterations per backend."),
            "max_evaluations": count(defaults.max_evaluations, "Evaluations per backend."),
            "max_seconds": { "type": "number", "exclusiveMinimum": 0, "default": defaults.max_seconds,
                "description": "Seconds for the whole command." },
            "nlopt": algorithm(NLOPT_ALGORITHMS),
            "argmin": algorithm(ARGMIN_ALGORITHMS),
        }),
        &[],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_is_an_alternative() {
        let alternatives = schema()["properties"]["sections"]["additionalProperties"]["anyOf"].clone();
        let count = alternatives.as_array().map_or(0, Vec::len);
        assert_eq!(count, sections::forms().count());
        assert_eq!(alternatives[0]["required"], json!(["kind", "b", "h"]));
    }
}
