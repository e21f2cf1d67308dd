//! The ribs in space, to be turned, picked and coloured.

use maud::{Markup, PreEscaped, html};

use super::Left;

/// The view, where the run left a network.
pub(super) fn view(left: &Left) -> Markup {
    let Some(network) = &left.network else { return html! {} };
    html! {
        h2 { "In space" }
        div class="view" {
            p class="controls" {
                label { "coloured by " select {
                    option value="utilisation" { "utilisation" } option value="limit" { "what governs" } option value="section" { "section" }
                } }
                @for way in ["space", "top", "front", "side"] { button type="button" data-way=(way) { (way) } }
            }
            canvas tabindex="0" aria-label="The ribs in space: drag to turn, scroll to come nearer, click to pick" {}
            ul class="legend" {}
            output {}
            // Within a script only the end of one means anything.
            script type="application/json" { (PreEscaped(network.replace('<', "\\u003c"))) }
        }
    }
}

/// What draws it; nothing where there is no view.
pub(super) fn script(lefts: &[Left]) -> Markup {
    html! { @if lefts.iter().any(|left| left.network.is_some()) { script { (PreEscaped(include_str!("view/view.bundle.js"))) } } }
}
