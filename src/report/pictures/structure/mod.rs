//! A structure at a design: its displaced shape, and the course of its forces along the ribs, case by case.

mod displaced;
mod drawing;
mod forces;
mod labels;

pub use displaced::displaced;
pub use forces::forces;

use crate::report::structure::Courses;

/// Width of the sheet.
const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 24.0;
/// Where the first panel begins.
const TOP: f64 = 70.0;
/// Room above a panel for what it is called.
const NAME: f64 = 34.0;

/// Cases and combinations, drawn at the most.
const MOST_CASES: usize = 6;

/// The same of structures with many ribs, whose pictures would be megabytes.
const FEW_CASES: usize = 2;

/// Structures with more ribs than this have many.
const MANY_RIBS: usize = 150;

/// Which are drawn: combinations before cases, for they are what limits speak of.
fn chosen(courses: &Courses) -> Vec<usize> {
    let (cases, all) = (courses.simple_cases.min(courses.cases.len()), courses.cases.len());
    let most = if courses.members.len() > MANY_RIBS { FEW_CASES } else { MOST_CASES };
    (cases..all).chain(0..cases).take(most).collect()
}

/// `3 of 8 cases and combinations`.
fn of_cases(courses: &Courses, drawn: usize) -> String {
    let all = courses.cases.len();
    let what = if courses.simple_cases < all { "cases and combinations" } else { "cases" };
    match (drawn < all, all) {
        (true, _) => format!("{drawn} of {all} {what}"),
        (false, 1) => courses.cases[0].name.clone(),
        (false, _) => format!("{all} {what}"),
    }
}

#[cfg(test)]
mod tests;
