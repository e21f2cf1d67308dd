//! Problem files as they are read: what the language means, what a mistake is told as, what the schema says of both.

mod bad_files;
mod input_properties;
mod language;
mod mistakes;
mod problem_files;
mod quantities;
mod ranges;
mod schema;
mod structure_files;
