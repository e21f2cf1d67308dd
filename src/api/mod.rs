//! The way in for programs: a problem put together in Rust, solved and judged, its answer by names.
//!
//! | file | subject |
//! |---|---|
//! | `problem` | [`Problem`]: sections, ribs, variables and constraints, written in the words of the problem file |
//! | `answer` | [`Answer`]: the verdict, values and multipliers by name |
//! | `any_model` | [`solve`] and [`certify`] for a [`Model`](crate::model::Model) of your own |

mod answer;
mod any_model;
mod problem;
mod toml_text;

pub use answer::Answer;
pub use any_model::{certify, solve};
pub use problem::{Constraint, Problem, Rib, Section, Value};
