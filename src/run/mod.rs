//! One run, start to finish.

pub mod folder;
