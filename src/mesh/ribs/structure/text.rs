//! The text of problem.toml for a structure.

use std::fmt::Write;

use super::Structure;
use crate::mesh::ribs::Options;

/// What the text needs to know of the mesh.
pub(super) struct Shape {
    /// What displacements are held against.
    pub span: f64,
    /// Whether loads act on nodes by area.
    pub has_surface: bool,
    /// Whether snow falls on anything.
    pub snows: bool,
}

/// problem.toml; numbers are written so that they read back bit for bit.
pub(super) fn problem(options: &Options, structure: &Structure, shape: &Shape) -> String {
    let snows = shape.snows && structure.snow > 0.0;
    let limits = limits(options, structure);
    let mut text = String::new();
    // A JSON string is a TOML basic string. Writing to a string cannot fail.
    let title = serde_json::Value::from(options.title.as_str());
    let _ = write!(text, "title = {title}\nminimize = \"volume\"\n");
    if let Some(unit) = options.unit {
        let _ = writeln!(text, "units = {{ length = \"{}\", force = \"kN\" }}", unit.name());
    }
    // Loads on nodes leave forces between them linear, but for the ribs' own weight.
    let stations = if shape.has_surface { "[0, 1]" } else { "[0, 0.25, 0.5, 0.75, 1]" };
    let _ = write!(
        text,
        "\n[structure]\n\
         gravity = [0, 0, -1]                       # density is a weight per volume here\n\
         stations = {stations}\n\
         \n[materials.steel]\nE = {:?}\nnu = {:?}\ndensity = {:?}\nstrength = {:?}\n\n[parameters]\n",
        options.elastic_modulus, structure.poisson, structure.density, structure.strength
    );
    let parameters = [
        ("span", shape.span),
        ("sag_ratio", options.sag_ratio),
        ("slenderness", options.slenderness),
        ("taper_slope", options.taper_slope),
        ("thickness", options.thickness),
    ];
    for (name, value) in parameters.iter().filter(|(name, _)| limits.iter().any(|limit| limit.2.contains(name))) {
        let _ = writeln!(text, "{name} = {value:?}");
    }
    text.push_str("\n[[loads]]\ncase = \"dead\"\nself_weight = true\n");
    if !shape.has_surface {
        lines_loads(&mut text, structure, snows);
    }
    let factors = if snows { ["dead = 1.35, snow = 1.5", "dead = 1, snow = 1"] } else { ["dead = 1.35", "dead = 1"] };
    let _ = write!(text, "\n[combinations]\nULS = {{ {} }}\nSLS = {{ {} }}\n", factors[0], factors[1]);
    for (name, scope, require) in limits {
        let _ = write!(text, "\n[[constraints]]\nname = \"{name}\"\n{scope}\nrequire = \"{require}\"\n");
    }
    text.push_str(
        "\n[tables]\nnodes = \"nodes.csv\"\nsupports = \"supports.csv\"\nsections = \"sections.csv\"\nribs = \"ribs.csv\"\n",
    );
    if shape.has_surface {
        text.push_str("loads = \"loads.csv\"\n");
    }
    text
}

/// Without a surface loads act along the ribs.
fn lines_loads(text: &mut String, structure: &Structure, snows: bool) {
    if structure.dead > 0.0 {
        let _ = write!(text, "[[loads]]\ncase = \"dead\"\nribs = [\"*\"]\nforce = [0, 0, {:?}]\n", -structure.dead);
    }
    if snows {
        let force = -structure.snow;
        let _ = write!(text, "[[loads]]\ncase = \"snow\"\nribs = [\"*\"]\naxes = \"projected\"\nforce = [0, 0, {force:?}]\n");
    }
}

/// Limits as (name, scope, requirement).
fn limits(options: &Options, structure: &Structure) -> Vec<(&'static str, &'static str, &'static str)> {
    let mut limits = vec![
        ("strength", "for = \"ribs\"", "abs(stress(ULS)) <= material.strength"),
        ("sag", "for = \"nodes\"", "disp(SLS, z) >= -span/sag_ratio"),
    ];
    limits.extend(options.kind.limits().iter().map(|(name, require)| (*name, "for = \"sections\"", *require)));
    if structure.sharing.tapers() {
        limits.extend([
            ("taper-up", "for = \"ribs\"", "to.height - from.height <= taper_slope*length"),
            ("taper-down", "for = \"ribs\"", "from.height - to.height <= taper_slope*length"),
        ]);
    }
    limits
}
