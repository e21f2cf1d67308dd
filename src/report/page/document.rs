//! The page around what it says, and the pictures in it.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// A whole page.
pub(super) fn document(title: &str, body: &Markup, script: &Markup) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                // Whatever a file of the user's says, nothing is fetched.
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";
                title { (title) }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body {
                main { (body) }
                script { (PreEscaped(include_str!("sort.js"))) }
                (script)
            }
        }
    }
    .into_string()
}

/// A picture with what it shows.
pub(super) fn figure(caption: &str, svg: &str) -> Markup {
    html! { figure { img alt=(caption) src={ "data:image/svg+xml," (encoded(svg)) }; figcaption { (caption) } } }
}

/// A text as part of a data URL: what has a meaning there, or in an attribute, is escaped.
fn encoded(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + text.len() / 8);
    for c in text.chars() {
        match c {
            '%' | '#' | '"' | '<' | '>' | '&' | '\n' | '\r' | '\t' => out += &format!("%{:02X}", u32::from(c)),
            c => out.push(c),
        }
    }
    out
}
