//! Several runs on one page: side by side first.

use maud::{Markup, html};
use serde_json::Value;

use super::{Left, number};

/// One row per run, which leads to its part of the page.
pub(super) fn beside_each_other(lefts: &[Left]) -> Markup {
    let value = |left: &Left, pointer: &str| number(left.result.pointer(pointer).filter(|value| value.is_number()));
    html! {
        h1 { (lefts.len()) " runs" }
        div class="wide" { table class="sortable" {
            thead { tr { @for title in ["run", "file", "status", "objective", "value", "proved bound", "volume", "mass"] { th { (title) } } } }
            tbody { @for (at, left) in lefts.iter().enumerate() { tr {
                td { a href={ "#run-" (at + 1) } { (left.text("/problem/title")) } }
                td { (left.text("/problem/file")) }
                td { (left.text("/status")) @if left.text("/status") == "certified" { ", " (left.text("/scope")) } }
                td { (left.text("/problem/objective")) }
                @for pointer in ["/objective", "/lower_bound", "/volume/total", "/mass"] {
                    td class="number" data-value=[left.result.pointer(pointer).and_then(Value::as_f64)] { (value(left, pointer)) }
                }
            } } }
        } }
    }
}
