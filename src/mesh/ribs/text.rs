//! The text of problem.toml.

use std::fmt::Write;

use super::Options;

/// Limits as (name, scope, requirement). Heights are `height`, which every kind offers.
fn limits(options: &Options) -> Vec<(&'static str, &'static str, &'static str)> {
    let sag = "sum(ribs: load*sag/E*0.5*(1/from.Ix + 1/to.Ix)/(span/sag_ratio)) <= 1";
    let mut limits = vec![("stiffness", "for = \"ribs\"\nby = \"line\"", sag)];
    limits.extend(options.kind.limits().iter().map(|(name, require)| (*name, "for = \"sections\"", *require)));
    limits.extend([
        ("taper-up", "for = \"ribs\"", "to.height - from.height <= taper_slope*length"),
        ("taper-down", "for = \"ribs\"", "from.height - to.height <= taper_slope*length"),
    ]);
    limits
}

/// problem.toml for these options; numbers are written so that they read back bit for bit.
pub(super) fn problem(options: &Options) -> String {
    let mut text = String::new();
    let limits = limits(options);
    // A JSON string is a TOML basic string.
    let title = serde_json::Value::from(options.title.as_str());
    let parameters = [
        ("E", options.elastic_modulus),
        ("load", options.load),
        ("sag_ratio", options.sag_ratio),
        ("slenderness", options.slenderness),
        ("taper_slope", options.taper_slope),
        ("thickness", options.thickness),
    ];
    let _ = write!(text, "title = {title}\nminimize = \"volume\"\n");
    if let Some(unit) = options.unit {
        let _ = writeln!(text, "units = {{ length = \"{}\", force = \"kN\" }}", unit.name());
    }
    let _ = write!(text, "\n[parameters]\n");
    // A circle has no slenderness.
    for (name, value) in parameters.iter().filter(|(name, _)| limits.iter().any(|limit| limit.2.contains(name))) {
        let _ = writeln!(text, "{name} = {value:?}");
    }
    for (name, scope, require) in limits {
        let _ = write!(text, "\n[[constraints]]\nname = \"{name}\"\n{scope}\nrequire = \"{require}\"\n");
    }
    text.push_str("\n[tables]\nsections = \"sections.csv\"\nribs = \"ribs.csv\"\n");
    text
}
