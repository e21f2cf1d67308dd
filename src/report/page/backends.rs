//! What each backend brought and what its point measures; how far they agree.

use maud::{Markup, html};
use serde_json::Value;

use super::{Left, number};

/// The backends, one row each.
pub(super) fn section(left: &Left) -> Markup {
    let text = |entry: &Value, pointer: &str| entry.pointer(pointer).and_then(Value::as_str).unwrap_or_default().to_owned();
    let certified = |entry: &Value| match entry.pointer("/certificate/certified").and_then(Value::as_bool) {
        Some(true) => "certified",
        Some(false) => "not certified",
        None => "no value",
    };
    let measures = ["primal_infeasibility", "dual_infeasibility", "complementarity"];
    let solutions = left.list("solutions");
    html! {
        @if !solutions.is_empty() {
            h2 { "Backends and certificates" }
            div class="wide" { table {
                thead { tr { @for title in ["backend", "algorithm", "point", "objective", "iterations", "evaluations", "seconds", "primal", "dual", "complementarity"] { th { (title) } } } }
                tbody { @for entry in solutions { tr {
                    td { (text(entry, "/backend")) }
                    td { (text(entry, "/algorithm")) }
                    td { (certified(entry)) }
                    @for key in ["objective", "iterations", "evaluations", "seconds"] { td class="number" { (number(entry.get(key))) } }
                    @for key in measures { td class="number" { (number(entry.pointer(&format!("/certificate/{key}")))) } }
                } } }
            } }
            ul { @for entry in solutions { li { (text(entry, "/backend")) ": " (text(entry, "/message")) } } }
            @if let Some(agree) = left.result.pointer("/agreement/agree").and_then(Value::as_bool) {
                p { @if agree { "The backends agree" } @else { "The backends do not agree" }
                    ": objectives differ by " (number(left.result.pointer("/agreement/objective_difference"))) "." }
            }
        }
    }
}
