//! Pictures of a run as SVG: how the backends converged, the sections before and after, the line of ribs and its profiles.

mod axes;
pub(super) mod canvas;
mod convergence;
mod cross_sections;
mod elevation;
mod profiles;

pub use convergence::{Trace, convergence};
pub use cross_sections::{cross_section, cross_sections};
pub use elevation::elevation;
pub use profiles::profiles;

/// Grey and dashed: before.
const BEFORE: &str = "fill=\"none\" stroke=\"#888888\" stroke-width=\"1.2\" stroke-dasharray=\"5 3\"";

/// Filled: after.
const AFTER: &str = "fill=\"#0072b2\" fill-opacity=\"0.25\" fill-rule=\"evenodd\" stroke=\"#0072b2\" stroke-width=\"1.4\"";

/// Explains [`BEFORE`] and [`AFTER`] at the upper right.
fn before_and_after(canvas: &mut canvas::Canvas, right: f64, y: f64) {
    canvas.path(&format!("M{} {y}h24", right - 190.0), BEFORE);
    canvas.text(right - 160.0, y + 4.0, "start", "start");
    canvas.path(&format!("M{} {}h24v8h-24Z", right - 100.0, y - 4.0), AFTER);
    canvas.text(right - 70.0, y + 4.0, "start", "answer");
}
