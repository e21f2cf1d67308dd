//! Models that problem files become: assembled, taken apart, rewritten.

mod assembly;
mod components;
#[path = "../support/mod.rs"]
mod support;
mod transformations;
