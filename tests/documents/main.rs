//! What a run leaves for others: schedules, structures for other programs, pictures, pages.

mod office;
mod pictures;
mod report_page;
mod saf;
#[path = "../support/mod.rs"]
mod support;
