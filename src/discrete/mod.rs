//! Sizes from lists: variables that take values of a grid, and sections that are rows of a catalogue.
//!
//! [`mod@search`] is branch and bound over ranges of lists: it knows neither models nor files, only what is proved of the designs within ranges
//! ([`Relaxation`]). [`convex`] proves it for linear, geometric and convex problems, by the certificate's rigorous bounds; [`exchange`]
//! looks for good designs where nothing is proved. [`hull`] says what the rows of a catalogue have in common.

pub mod convex;
pub mod exchange;
pub mod hull;
mod list;
mod rest;
pub mod search;

pub use list::{List, Range};
pub use rest::Rest;
pub use search::{Bounded, Design, Found, Relaxation, Relaxed, search};
