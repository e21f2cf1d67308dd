//! Sizes that cannot belong to the lengths: most often a file in two units of length.

use crate::problem::{Dimension, Problem};
use crate::report::number::short;
use crate::report::pictures::longest_line;
use crate::sections;

/// A line of ribs more than so many times as long as all its sections are deep and wide: a wire 2 mm thick over 10 m has 5000.
const SLIMMEST: f64 = 1e4;

/// Dimensions that are no lengths.
const NO_LENGTHS: [&str; 4] = ["r", "scale", "scale_x", "scale_y"];

/// The kind whose dimensions are areas, moments and moduli.
const NUMBERS_ALONE: &str = "general";

/// In words, one sentence at the most of each kind.
pub(super) fn warnings(problem: &Problem) -> Vec<String> {
    let Some(longest) = longest_line(problem).filter(|length| length.is_finite() && *length > 0.0) else { return Vec::new() };
    let lengths = Lengths::of(problem);
    let ribs = format!("the longest line of ribs, {}", short(longest));
    let mut found = Vec::new();
    if let Some((name, lower)) = lengths.largest_lower.filter(|(_, lower)| *lower > longest) {
        found.push(format!("{name} is at least {}, more than {ribs}: are sections and lengths in one unit?", short(lower)));
    }
    if let Some((name, upper)) = lengths.largest_upper.filter(|(_, upper)| *upper < longest / SLIMMEST) {
        found.push(format!(
            "no dimension exceeds {} ({name}), less than a ten-thousandth of {ribs}: are sections and lengths in one unit?",
            short(upper)
        ));
    }
    found
}

/// The largest bounds of all dimensions that are lengths, with their names. `None` where there are none, or some are computed.
struct Lengths {
    largest_lower: Option<(String, f64)>,
    largest_upper: Option<(String, f64)>,
}

impl Lengths {
    fn of(problem: &Problem) -> Lengths {
        let mut found = Lengths { largest_lower: None, largest_upper: None };
        let mut all_known = true;
        for section in 0..problem.sections.names.len() {
            let form = sections::form(problem.sections.form[section]);
            if form.kind == NUMBERS_ALONE {
                all_known = false;
                continue;
            }
            for (name, dimension) in form.dimensions.iter().zip(problem.dimensions(section)) {
                if NO_LENGTHS.contains(name) {
                    all_known &= *name == "r";
                    continue;
                }
                let [lower, upper] = match *dimension {
                    Dimension::Constant(value) => [value; 2],
                    Dimension::Variable(j) => [problem.variables.lower[j as usize], problem.variables.upper[j as usize]],
                    Dimension::Formula(_) => {
                        all_known = false;
                        continue;
                    }
                };
                let label = || format!("{}.{name}", &problem.sections.names[section]);
                raise(&mut found.largest_lower, label, lower);
                raise(&mut found.largest_upper, label, upper);
            }
        }
        found.largest_upper = found.largest_upper.filter(|_| all_known);
        found
    }
}

fn raise(largest: &mut Option<(String, f64)>, name: impl Fn() -> String, value: f64) {
    if largest.as_ref().is_none_or(|(_, known)| value > *known) {
        *largest = Some((name(), value));
    }
}
