//! The JSON Schema of the problem file, for completion and checks in editors.

mod checks;
mod sets;
mod solver;
mod structure;
#[cfg(test)]
mod tests;

use serde_json::{Map, Value, json};

use super::parse_tables::{DEFAULT_DEGREE, PROFILE_KINDS};
use crate::sections::{self, Form, Kind};
use crate::units::SHOWN_KINDS;

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
            "units": map_of(json!({ "type": "string" }), "What numbers are in, such as length = \"m\", force = \"kN\": quantities are converted into these."),
            "show": show(),
            "parameters": map_of(one_or_many(), "Constants: numbers, arrays, or expressions in other parameters."),
            "variables": map_of(variable(), "Free design variables."),
            "profiles": map_of(profile(), "B-splines of few control values along a line, used as profile(NAME, s)."),
            "definitions": map_of(definition(), "Names for expressions, in any order, without circles."),
            "catalogues": map_of(catalogue(), "Families of sections, a CSV file each; used by kind = \"catalogue\"."),
            "sections": map_of(section(), "Cross-sections."),
            "ribs": { "type": "array", "items": rib() },
            "structure": structure::settings(),
            "materials": map_of(structure::material(), "Materials of ribs between nodes."),
            "nodes": map_of(structure::node(), "Nodes: coordinates, two in a plane, three in space."),
            "supports": map_of(structure::support(), "What holds nodes: keys are names or patterns."),
            "masses": map_of(scalar("Mass."), "Masses at nodes besides the ribs' own, for frequencies."),
            "loads": { "type": "array", "items": structure::load() },
            "combinations": map_of(map_of(scalar("Factor."), "Factors by load case."), "Combinations of load cases."),
            "constraints": { "type": "array", "items": constraint() },
            "checks": { "type": "array", "items": checks::check() },
            "solver": solver::solver(),
            "tables": object(json!({
                "sections": text("CSV table of sections: name, kind, dimensions (b, or b.lower, b.upper, b.start, b.step, b.values), data."),
                "ribs": text("CSV table of ribs: name, from, to (or section), length (or start and end), volume, data."),
                "nodes": text("CSV table of nodes: name, x, y, z, data."),
                "supports": text("CSV table of supports: node, fix (pinned, fixed, or directions such as x z), kx … krz."),
                "loads": text("CSV table of loads: case, node (or rib, line), fx, fy, fz, mx, my, mz, axes, at."),
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
    json!({ "type": ["number", "string", "array"], "items": { "type": ["number", "string", "array"] } })
}

fn map_of(value: Value, description: &str) -> Value {
    json!({ "type": "object", "additionalProperties": value, "description": description })
}

fn object(properties: Value, required: &[&str]) -> Value {
    json!({ "type": "object", "additionalProperties": false, "properties": properties, "required": required })
}

/// A table, or a value of one of these types. Keys of a table are judged as they stand, not as one way among others: a mistake in them
/// is told once, and where it is.
fn or_table(types: &[&str], mut table: Value, description: &str) -> Value {
    table["type"] = types.iter().copied().chain(["object"]).collect();
    table["description"] = json!(description);
    table
}

/// A table, or one of these words.
fn or_word(words: &[&str], table: Value, description: &str) -> Value {
    let mut either = or_table(&["string"], table, description);
    either["if"] = json!({ "type": "string" });
    either["then"] = json!({ "enum": words });
    either
}

/// Units that reports show.
fn show() -> Value {
    let kinds = SHOWN_KINDS.iter().map(|(kind, dimension)| ((*kind).to_owned(), text(&format!("A unit of {dimension}."))));
    object(Value::Object(kinds.collect()), &[])
}

/// An expression, or a sequence.
fn definition() -> Value {
    let sequence = object(
        json!({
            "for": { "type": "string", "pattern": "^.* in 1\\.\\..*$", "description": "The numbers of its elements: i in 1..N." },
            "first": one_or_many(),
            "value": scalar("An element by its number and those before it: v[i-1] + a[i]."),
        }),
        &["for", "value"],
    );
    or_table(&["number", "string"], sequence, "An expression, or a sequence of elements each made of those before it.")
}

/// Control values of a profile.
fn control() -> Value {
    let range = json!({ "size": scalar("Number of control values."), "lower": one_or_many(), "upper": one_or_many(), "start": one_or_many() });
    object(range, &[])
}

fn variable() -> Value {
    object(
        json!({
            "size": scalar("Number of elements x[1], x[2], … of an array."),
            "positive": { "type": "boolean", "description": "Above 0, which is no bound: a minimum at 0 is not attained." },
            "lower": one_or_many(), "upper": one_or_many(), "start": one_or_many(),
            "step": scalar("Values from the lower bound in steps of this."),
            "values": list_of_values(),
            "integer": { "type": "boolean", "description": "Whole numbers only." },
        }),
        &[],
    )
}

fn list_of_values() -> Value {
    json!({ "type": "array", "items": { "type": ["number", "string"] }, "minItems": 1, "description": "The values it may take." })
}

fn profile() -> Value {
    let kinds: Vec<&str> = PROFILE_KINDS.iter().map(|(kind, _)| *kind).collect();
    object(
        json!({
            "kind": { "enum": kinds, "default": "b-spline", "description": "constant: 1 control value; linear: 2." },
            "degree": json!({ "type": ["integer", "string"], "minimum": 0, "default": DEFAULT_DEGREE }),
            "control": control(),
            "knots": { "type": "array", "items": { "type": ["number", "string"] },
                "description": "size + degree + 1 knots rising from 0 to 1; uniform and clamped if left out." },
        }),
        &["control"],
    )
}

fn data() -> Value {
    let datum = json!({ "type": ["number", "string", "array"], "items": { "type": "number" } });
    map_of(datum, "Further numbers, arrays of numbers, or text for grouping.")
}

/// The kind first, then what it asks for: editors name the very key that is wrong. Forms that number a dimension (`thickness[1]`,
/// …) are one, with an array.
fn section() -> Value {
    let kinds: Vec<&str> = sections::KINDS.iter().map(|kind| kind.name()).chain(["catalogue"]).collect();
    let rule = |kind: &&'static dyn Kind| {
        json!({
            "if": { "properties": { "kind": { "const": kind.name() } }, "required": ["kind"] },
            "then": of_kind(*kind),
        })
    };
    json!({
        "type": "object",
        "required": ["kind"],
        "additionalProperties": true, // the kind's rule knows which; Tombi wants it said
        "properties": { "kind": { "enum": kinds, "description": "What it is a section of." } },
        "allOf": sections::KINDS.iter().map(rule).chain([catalogue_section()]).collect::<Vec<Value>>(),
    })
}

/// A row of a catalogue.
fn catalogue_section() -> Value {
    let keys = json!({ "kind": { "const": "catalogue" }, "from": text("A name of [catalogues]."), "data": data() });
    json!({
        "if": { "properties": { "kind": { "const": "catalogue" } }, "required": ["kind"] },
        "then": object(keys, &["kind", "from"]),
    })
}

fn catalogue() -> Value {
    let table = object(
        json!({
            "file": text("CSV: name and the dimensions of a kind."), "kind": text("The kind; general if left out."),
            "properties": { "type": ["array", "string"], "items": { "type": "string" },
                "description": "What its sections are known by (kind general), computed from their dimensions: A, Ix, Wx, …" },
        }),
        &["file"],
    );
    or_table(&["string"], table, "Sections to choose from: a CSV table (name, A, Ix, …), or what it is a family of.")
}

/// All keys of a kind, and the sets of dimensions of which one must be given.
fn of_kind(kind: &'static dyn Kind) -> Value {
    let range = json!({
        "lower": scalar("Lower bound."), "upper": scalar("Upper bound."), "start": scalar("Start."),
        "step": scalar("Values from the lower bound in steps of this."), "values": list_of_values(),
        "integer": { "type": "boolean", "description": "Whole numbers only." },
    });
    let about = "A number (fixed), bounds and start (a variable), or an expression.";
    let dimension = or_table(&["number", "string"], object(range, &[]), about);
    let mut properties = Map::new();
    properties.extend([("kind".into(), json!({ "const": kind.name() })), ("data".into(), data())]);
    if kind.has_outline() {
        properties.insert("points".into(), points());
    }
    if kind.takes_holes() {
        let holes = json!({ "type": "array", "items": points(), "description": "Rings of points inside the outer one." });
        properties.insert("holes".into(), holes);
    }
    let whole = |form: &&Form| form.dimensions.len() < 2 || form.dimensions.iter().all(|name| list_name(name).is_none());
    let forms: Vec<&Form> = kind.forms().iter().filter(whole).collect();
    for name in forms.iter().flat_map(|form| form.dimensions) {
        let (key, value) = match list_name(name) {
            Some(list) => (list, json!({ "type": "array", "items": dimension, "minItems": 1 })),
            None => (*name, dimension.clone()),
        };
        properties.insert(key.to_owned(), value);
    }
    let named = |name: &&'static str| list_name(name).unwrap_or(name);
    let fixed = || ["kind"].into_iter().chain(kind.has_outline().then_some("points"));
    let asked = forms.iter().map(|form| fixed().chain(form.dimensions.iter().map(named)).collect()).collect();
    let mut rule = object(Value::Object(properties), &[]);
    if let (Some(rule), Value::Object(needs)) = (rule.as_object_mut(), sets::one_of_sets(asked)) {
        rule.extend(needs);
    }
    rule
}

/// `thickness` of `thickness[2]`.
fn list_name(dimension: &str) -> Option<&str> {
    dimension.strip_suffix(']')?.split_once('[').map(|(list, _)| list)
}

fn points() -> Value {
    let pair = json!({ "type": "array", "items": { "type": ["number", "string"] }, "minItems": 2, "maxItems": 2 });
    json!({ "type": "array", "items": pair, "minItems": 2, "description": "Corners [x, y] in order; numbers or constant expressions." })
}

fn rib() -> Value {
    let mut rib = object(
        json!({
            "name": text("Its name."),
            "from": text("Section at the left end."),
            "to": text("Section at the right end."),
            "section": text("The same section at both ends, instead of from and to."),
            "length": scalar("Length, positive; of a rib between nodes their distance."),
            "volume": { "enum": ["frustum", "prismatoid"], "description": "Volume law, by default frustum." },
            "data": data(),
        }),
        &["name"],
    );
    structure::member(&mut rib["properties"]);
    let both = |one: &str, other: &str, alone: &str| {
        json!({
            "if": { "required": [one] },
            "then": { "required": [other] },
            "else": { "if": { "required": [other] }, "then": { "required": [one] }, "else": { "required": [alone] } },
        })
    };
    let one_section = json!({ "properties": { "from": false, "to": false } });
    rib["allOf"] = json!([
        { "if": { "required": ["section"] }, "then": one_section, "else": both("from", "to", "section") },
        both("start", "end", "length"),
    ]);
    rib
}

fn constraint() -> Value {
    let kinds: Vec<&str> = sections::KINDS.iter().map(|kind| kind.name()).collect();
    object(
        json!({
            "name": text("Its name in reports."),
            "require": text("a <= b, a >= b, a == b, or lo <= a <= hi with constant lo and hi."),
            "for": { "type": "string", "pattern": "^(sections|ribs|nodes|.* in .*)$", "description": "Once per section, rib or node, or per number: i in 1..N." },
            "only": { "type": ["array", "string"], "items": { "type": "string" }, "description": "Patterns (* and ?) of names." },
            "kind": { "enum": kinds, "description": "Items of this kind only." },
            "where": text("A comparison of data and parameters that chooses items."),
            "cases": { "type": ["array", "string"], "items": { "type": "string" },
                "description": "Once per case or combination that matches; the word case stands for it." },
            "by": text("One row per group of items sharing a value of this datum."),
        }),
        &["require"],
    )
}
