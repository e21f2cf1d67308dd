//! The schema of structures.

use serde_json::{Value, json};

use super::{data, map_of, object, or_table, or_word, scalar, text};

/// Numbers along the axes: two in a plane, three in space.
fn along(description: &str) -> Value {
    json!({ "type": "array", "items": { "type": ["number", "string"] }, "minItems": 2, "maxItems": 3, "description": description })
}

fn names(description: &str) -> Value {
    json!({ "type": ["array", "string"], "items": { "type": "string" }, "description": description })
}

pub(super) fn settings() -> Value {
    let stations = json!({
        "type": ["integer", "string", "array"], "items": { "type": ["number", "string"] }, "default": 9,
        "description": "How many stations of a rib a response without one is required at, or their fractions of its length.",
    });
    object(
        json!({
            "plane": { "enum": ["xz", "xy"], "description": "Left out: space. xz: z up, free x, z, ry. xy: plan, free x, y, rz." },
            "joints": joints(),
            "gravity": along("What self-weight multiplies densities by: [0, 0, -9.81]."),
            "stations": stations,
            "buckling_pieces": { "type": ["integer", "string"], "default": 4, "description": "Pieces of a compressed rib." },
        }),
        &[],
    )
}

fn joints() -> Value {
    json!({ "enum": ["rigid", "pinned"], "default": "rigid", "description": "pinned: a bar, axial force only." })
}

pub(super) fn material() -> Value {
    json!({
        "type": "object",
        "required": ["E"],
        "not": { "required": ["G", "nu"] },
        "properties": {
            "E": scalar("Young's modulus."),
            "G": scalar("Shear modulus."),
            "nu": scalar("Poisson's ratio, instead of G."),
            "density": scalar("Mass or weight per volume, as gravity goes with it."),
            "alpha": scalar("Coefficient of thermal expansion."),
        },
        "additionalProperties": scalar("A number of the user's own: material.fy."),
    })
}

pub(super) fn node() -> Value {
    let about = "Coordinates: numbers, expressions in parameters, or in variables.";
    let (at, mut node) = (along(about), object(json!({ "at": along(about), "data": data() }), &["at"]));
    for key in ["items", "minItems", "maxItems"] {
        node[key] = at[key].clone();
    }
    or_table(&["array"], node, about)
}

pub(super) fn support() -> Value {
    let direction = json!({ "enum": ["x", "y", "z", "rx", "ry", "rz"] });
    let about = "pinned: all displacements; fixed: everything; or a list of directions.";
    let words = ["fixed", "pinned"];
    let fix = json!({ "type": ["string", "array"], "if": { "type": "string" }, "then": { "enum": words }, "items": direction,
        "description": about });
    let springs = json!({ "type": "object", "propertyNames": direction, "additionalProperties": scalar("Stiffness.") });
    let mut support = or_word(&words, object(json!({ "fix": fix, "springs": springs }), &[]), about);
    support["type"] = json!(["string", "array", "object"]);
    support["items"] = direction;
    support
}

/// Adds to the rib's keys what makes it a member.
pub(super) fn member(rib: &mut Value) {
    let force = json!({ "type": ["array", "string"], "items": { "enum": ["My", "Mz", "T"] } });
    let hinges = object(json!({ "start": force, "end": force }), &[]);
    let hinges = or_word(&["both", "start", "end"], hinges, "Released forces at its ends; both: both moments at both ends.");
    let offset = object(json!({ "start": along("Global axes."), "end": along("Global axes.") }), &[]);
    let keys = json!({
        "start": text("Node where it starts."),
        "end": text("Node where it ends."),
        "material": text("Its material; left out: the only one."),
        "up": along("Direction of the section's height; left out: z, for vertical ribs x; in a plane the left normal."),
        "roll": scalar("Degrees by which the section is turned about the rib."),
        "joints": joints(),
        "hinges": hinges,
        "offset": offset,
        "shear": { "type": "boolean", "default": false, "description": "Whether shear deforms it (Timoshenko)." },
    });
    if let (Some(rib), Value::Object(keys)) = (rib.as_object_mut(), keys) {
        rib.extend(keys);
    }
}

pub(super) fn load() -> Value {
    let moment = json!({ "type": ["number", "string", "array"], "items": { "type": ["number", "string"] },
        "description": "Three numbers in space, one in a plane." });
    object(
        json!({
            "case": text("The load case."),
            "nodes": names("Nodes or patterns."),
            "ribs": names("Ribs or patterns."),
            "axes": { "enum": ["global", "local", "projected"], "default": "global",
                "description": "Of the components on ribs; projected: per length of the projection, as snow." },
            "force": along("At nodes a force; on ribs a force per length, with `at` a force."),
            "force_end": along("At `to`, where it differs: linear between."),
            "moment": moment,
            "from": scalar("Where it begins, a fraction."),
            "to": scalar("Where it ends, a fraction."),
            "at": scalar("Where the force or moment acts, a fraction."),
            "self_weight": { "type": "boolean", "description": "Density times gravity; of all ribs where none is named." },
            "temperature": scalar("How much warmer."),
            "gradient": scalar("Temperature at the top less that at the bottom."),
            "pretension": scalar("Tension between locked ends."),
            "displacement": map_of(scalar("How far."), "Of supported directions of nodes."),
        }),
        &["case"],
    )
}
