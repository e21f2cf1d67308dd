//! What a certificate was measured by.

use std::io::{self, Write};

use crate::certificate::{Tolerances, parameters};
use crate::math::parameters::Parameter;
use crate::recession;

/// Every number that decides a verdict: the test and name, the value, the inequality.
pub fn all() -> impl Iterator<Item = &'static Parameter> {
    parameters::PARAMETERS.iter().chain(recession::parameters::PARAMETERS)
}

/// The accepted residuals, then the numbers of every test, one a line.
///
/// # Errors
/// Of the writer.
pub fn write(tolerances: &Tolerances, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "\nMeasured by (docs/certificate.md)")?;
    writeln!(
        out,
        "  {:<32} {:<24} accepted violation of limits",
        "constraint_tolerance",
        format!("{:?}", tolerances.constraint)
    )?;
    writeln!(
        out,
        "  {:<32} {:<24} accepted slope and complementarity",
        "optimality_tolerance",
        format!("{:?}", tolerances.optimality)
    )?;
    for parameter in all() {
        let (name, value) = (format!("{}.{}", parameter.group, parameter.name), (parameter.value)());
        writeln!(out, "  {name:<32} {value:<24}{}", parameter.meaning)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_its_line() {
        let mut text = Vec::new();
        write(&Tolerances::default(), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text.lines().count(), all().count() + 4);
        let weak = text.lines().find(|line| line.contains("second_order.WEAK")).unwrap();
        assert!(weak.contains(" 1e-6 ") && weak.ends_with("weakly active."), "{weak}");
    }
}
