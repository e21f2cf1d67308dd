//! ribopt sizes structural ribs: the lightest rectangular (frustum) ribs and H beams that still meet their limits.
//!
//! The rooms, in reading order (arrows point down only; `tests/arrows.rs` holds them):
//!
//! | room | what happens there |
//! |---|---|
//! | [`run`] | one run, start to finish |
//! | [`input`] | the TOML file and its CSV tables become a checked [`problem::Problem`] |
//! | [`log`], [`report`] | iteration CSV; tables, JSON, terminal |
//! | [`crosscheck`] | several backends, one verdict |
//! | [`backends`] | NLopt and argmin behind one trait |
//! | [`certificate`] | the proof at a point, by code that knows no solver |
//! | [`solvers`] | our own interior points and augmented Lagrangian |
//! | [`model`] | objective, rows and their exact sparse derivatives |
//! | [`problem`] | the checked declaration; knows no TOML |
//! | [`ribs`], [`sections`] | volumes and section properties |
//! | [`expression`] | parse, differentiate, evaluate |
//! | [`linear_algebra`] | sparse symmetric factorisation, by a library |
//! | [`files`] | inputs within limits, outputs whole and never in an input's place |
//! | [`geometry`], [`splines`], [`math`], [`mesh`] | the note's mathematics, geometry and quad meshes |
#![warn(missing_docs)]

pub mod backends;
pub mod certificate;
pub mod crosscheck;
pub mod expression;
pub mod files;
pub mod geometry;
pub mod input;
pub mod linear_algebra;
pub mod log;
pub mod math;
pub mod mesh;
pub mod model;
pub mod problem;
pub mod recession;
pub mod report;
pub mod ribs;
pub mod run;
pub mod sections;
pub mod solvers;
pub mod splines;
