//! `ribopt mesh …`: the whole program and what its stages promise.

mod check;
mod formats;
mod networks;
mod program;
mod properties;
mod round_trip;
mod stages;
mod structure;
