//! Verdicts as a user meets them: small files, the whole program, exit codes and what is said.

#[cfg(feature = "nlopt")]
mod nlopt;
mod scaling;
mod statuses;
mod whole_program;
