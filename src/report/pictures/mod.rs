//! Pictures of a run as SVG: how the backends converged, the sections before and after, the lines of ribs, their profiles, the
//! network in space; what a structure does.

mod axes;
pub(super) mod canvas;
mod chains;
mod convergence;
mod cross_sections;
mod elevation;
mod network;
pub mod performance_profile;
mod profiles;
mod structure;
pub mod studies;

pub use chains::longest_line;
pub use convergence::{Trace, convergence};
pub use cross_sections::{cross_section, cross_sections};
pub use elevation::elevation;
pub use network::{Load, network};
pub use profiles::profiles;
pub use structure::{displaced, forces};

use super::About;
use canvas::{Canvas, Ink, Style};

/// Grey and dashed: before.
const BEFORE: Style = Style { stroke: Ink::Middle, width: 1.0, dash: "4 3", filled: false };

/// Filled: after.
const AFTER: Style = Style { stroke: Ink::Curve(0), width: 1.5, dash: "", filled: true };

/// Explains [`BEFORE`] and [`AFTER`] at the upper right.
fn before_and_after(canvas: &mut Canvas) {
    let (right, y) = (canvas.width() - 10.0, 38.0);
    canvas.path(&format!("M{} {y}h24", right - 170.0), BEFORE);
    canvas.text(right - 140.0, y + 4.0, "start", "start");
    canvas.path(&format!("M{} {}h24v8h-24Z", right - 85.0, y - 4.0), AFTER);
    canvas.text(right - 55.0, y + 4.0, "start", "answer");
}

/// `height, in mm`; the name alone where the file gives no unit.
fn with_unit(name: &str, about: &About) -> String {
    about.unit("length").map_or_else(|| name.into(), |unit| format!("{name}, in {unit}"))
}
