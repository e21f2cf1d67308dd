//! ribopt sizes structural ribs and proves its answers: the lightest ribs that still meet their limits, and a certificate that they are.
//!
//! # A problem in a dozen lines
//!
//! ```
//! use ribopt::{Problem, Rib, Section};
//!
//! let answer = Problem::new("A haunched rib")
//!     .parameter("M", 40.0)
//!     .section("left", Section::new("rectangle").with("b", 0.1..=0.4).with("h", 0.2..=1.0))
//!     .section("right", Section::new("rectangle").with("b", "left.b").with("h", 0.2..=1.0))
//!     .rib("only", Rib::between("left", "right", 3.0))
//!     .require("bending", "M/left.Wx <= 8e3")
//!     .require("stiff", "right.Ix >= 2e-4")
//!     .require("upright", "left.h <= 4*left.b")
//!     .solve()?;
//!
//! assert!(answer.is_certified(), "{}", answer.message());
//! // Ix = b·h³/12 of the right end is just what is asked of it.
//! let (b, h) = (answer.value("left.b").unwrap(), answer.value("right.h").unwrap());
//! assert!((b * h.powi(3) / 12.0 - 2e-4).abs() < 1e-9);
//! assert!(answer.volume().unwrap() < 0.14);
//! # Ok::<(), ribopt::Error>(())
//! ```
//!
//! [`Problem`] speaks the words of the problem file (docs/problem-file.md): what the file can say, expressions above all, the builder takes as
//! text. [`Problem::to_toml`] writes the file.
//!
//! # Functions of your own
//!
//! [`solve`] and [`certify`] take any [`model::Model`]; [`model::closures`] makes one of Rust closures with their derivatives. [`Settings`] says
//! what is accepted and when to give up.
//!
//! # The rooms, in reading order
//!
//! Arrows point down only; `tests/repository/arrows.rs` holds them, and `tests/repository/circles.rs` that the files of a room form no circle.
//! `docs/architecture.md` follows a constraint and a bound from the file to the report, `docs/glossary.md` says what every word means.
//! “note (2.3.1)” in comments is row 2.3.1 of `docs/formulas.md`, which holds every formula with its published source.
//!
//! | room | what happens there |
//! |---|---|
//! | [`api`] | problems put together in Rust, answers by name |
//! | `cli` | arguments, subcommands, exit codes: what the program and the Python package run |
//! | `study` | many runs of one problem: points, chains, a table |
//! | `run` | one run, start to finish |
//! | `input` | the TOML file and its CSV tables become a checked `problem::Problem` |
//! | `log`, `report` | iteration CSV; tables, JSON, terminal |
//! | [`crosscheck`] | several backends, one verdict |
//! | `discrete` | sizes from lists: branch and bound |
//! | [`backends`] | NLopt and argmin behind one trait |
//! | [`certificate`] | the proof at a point, by code that knows no solver |
//! | `recession` | does the objective fall for ever? |
//! | `solvers` | our own interior points and augmented Lagrangian |
//! | [`model`] | objective, rows and their exact sparse derivatives; views |
//! | `problem` | the checked declaration; knows no TOML |
//! | `structure` | bars and beams as expressions: flexibilities, forces, axes |
//! | `ribs`, [`sections`] | volumes and section properties |
//! | `expression` | parse, differentiate, evaluate |
//! | `linear_algebra` | symmetric factorisations with inertia, patterns, partitions, null spaces, least squares with signs |
//! | `files` | inputs within limits, outputs whole and never in an input's place |
//! | `units` | units of quantities, the algebra of dimensions |
//! | `geometry`, `splines`, `math`, `mesh` | mathematics, geometry and quad meshes |
//!
//! What is meant for programs is on this page, in [`model`], [`certificate`], the kinds of [`sections`], [`backends`] (to write one) and
//! [`crosscheck`]'s answers. The other rooms are public for the command line, tests and benchmarks, and change without notice.
#![warn(missing_docs)]

// The command line names the house's rooms as any program does.
extern crate self as ribopt;

pub mod api;
pub mod backends;
pub mod certificate;
// Its comments are the program's help, where `<file stem>` is no tag.
#[allow(rustdoc::invalid_html_tags)]
#[doc(hidden)]
pub mod cli;
pub mod crosscheck;
#[doc(hidden)]
pub mod discrete;
#[doc(hidden)]
pub mod expression;
#[doc(hidden)]
pub mod files;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod input;
#[doc(hidden)]
pub mod linear_algebra;
#[doc(hidden)]
pub mod log;
#[doc(hidden)]
pub mod math;
#[doc(hidden)]
pub mod mesh;
pub mod model;
#[doc(hidden)]
pub mod problem;
#[doc(hidden)]
pub mod recession;
#[doc(hidden)]
pub mod report;
#[doc(hidden)]
pub mod ribs;
#[doc(hidden)]
pub mod run;
pub mod sections;
#[doc(hidden)]
pub mod solvers;
#[doc(hidden)]
pub mod splines;
#[doc(hidden)]
pub mod structure;
#[doc(hidden)]
pub mod study;
#[doc(hidden)]
pub mod units;

pub use api::{Answer, Constraint, Problem, Rib, Section, Value, certify, solve};
pub use problem::Settings;
pub use run::RunError as Error;
