//! The schema of `[[checks]]`.

use serde_json::{Value, json};

use super::{object, or_word, scalar, text};
use crate::input::codes::CURVES;

fn names(description: &str) -> Value {
    json!({ "type": ["array", "string"], "items": { "type": "string" }, "description": description })
}

pub(super) fn check() -> Value {
    let curves: Vec<&str> = CURVES.iter().map(|(curve, _)| *curve).collect();
    let curve = json!({ "enum": curves, "description": "Buckling curve of Table 6.1." });
    let length = scalar("Buckling length, an expression in the rib's names; \"system\": by the structure's own factor.");
    let axis = object(json!({ "length": length, "curve": curve }), &["length"]);
    let axis = or_word(&["held"], axis, "Its buckling length; \"held\": it cannot buckle that way.");
    let ltb = object(
        json!({
            "length": scalar("Length between lateral restraints."),
            "C1": scalar("Factor of the moments' course in M_cr."),
            "curve": { "enum": curves[1..], "description": "Curve of Table 6.3." },
            "clause": { "enum": ["6.3.2.2", "6.3.2.3"], "default": "6.3.2.2" },
            "lambda_LT0": scalar("Plateau of 6.3.2.3."),
            "beta": scalar("Factor of 6.3.2.3."),
        }),
        &["length", "C1", "curve"],
    );
    object(
        json!({
            "name": text("Its name in reports."),
            "code": { "enum": ["Euler", "EN 1993-1-1", "AISC 360-22"] },
            "ribs": names("Ribs or patterns."),
            "cases": names("Cases and combinations, or patterns."),
            "fy": scalar("Yield strength, in the rib's names: material.fy."),
            "gamma_M1": scalar("Partial factor."),
            "stress_unit": scalar("MPa in one unit of the file's stresses."),
            "class": { "enum": [1, 2, 3], "description": "Class of Table 5.2 that is required." },
            "web": { "enum": ["bending", "compression"], "description": "What webs carry, for c/t limits." },
            "safety": scalar("What N is multiplied with (Euler)."),
            "phi": scalar("Resistance factor (AISC 360-22)."),
            "made": { "enum": ["rolled", "built-up"] },
            "buckling": object(json!({ "y": axis, "z": axis }), &["y", "z"]),
            "ltb": or_word(&["held"], ltb, "Lateral torsional buckling; \"held\": it cannot buckle that way."),
            "Cm": object(json!({ "y": scalar("Cmy."), "z": scalar("Cmz."), "LT": scalar("CmLT.") }), &["y", "z", "LT"]),
        }),
        &["code", "ribs", "cases", "buckling"],
    )
}
