//! What the bound-convergence test found, as a table.

use std::io::{self, Write};

use super::number::short;
use super::text::{TextTable, count, shown};

/// At most this many variables are shown one by one; those that are not at their lower bounds come first.
const MOST_LINES: usize = 40;

/// Where a variable went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Where {
    /// To neither bound.
    Inside,
    /// To its upper bound.
    Upper,
    /// To its lower bound.
    Lower,
    /// Its bounds are equal.
    Fixed,
}

impl Where {
    fn as_str(self) -> &'static str {
        match self {
            Where::Inside => "inside",
            Where::Upper => "upper",
            Where::Lower => "lower",
            Where::Fixed => "fixed",
        }
    }
}

/// One variable's end.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// The variable.
    pub name: String,
    /// Its value there.
    pub value: f64,
    /// Where that is.
    pub at: Where,
    /// The exact derivative of the objective (in the user's sense) there.
    pub derivative: f64,
    /// Its sign proves that the variable wants to go no further and no way back.
    pub proved: bool,
    /// Why it did not go to its lower bound, where that is known.
    pub reason: Option<String>,
}

/// Writes the table of ends and one sentence that sums it up.
///
/// # Errors
/// Whatever the writer says.
pub fn write(ends: &[End], objective: &str, out: &mut dyn Write) -> io::Result<()> {
    let derivative = format!("∂({objective})");
    let mut table = TextTable::new(1, &["variable", "ends at", "value", &derivative, "proved"]);
    let mut order: Vec<&End> = ends.iter().collect();
    if ends.len() > MOST_LINES {
        order.sort_by_key(|end| (end.proved, end.at));
    }
    for end in order.iter().take(MOST_LINES) {
        let proved = if end.proved { "yes" } else { "no" };
        table.add(vec![end.name.clone(), end.at.as_str().into(), short(end.value), short(end.derivative), proved.into()]);
    }
    write!(out, "{table}")?;
    if ends.len() > MOST_LINES {
        writeln!(out, "  … {} more", ends.len() - MOST_LINES)?;
    }
    for end in order.iter().take(MOST_LINES) {
        if let Some(reason) = &end.reason {
            writeln!(out, "  {}: {reason}", shown(&end.name))?;
        }
    }
    writeln!(out, "{}", conclusion(ends))
}

fn conclusion(ends: &[End]) -> String {
    let number = |at: Where| ends.iter().filter(|end| end.at == at).count();
    let doubtful = ends.iter().filter(|end| !end.proved).count();
    let (lower, upper, inside, fixed) = (number(Where::Lower), number(Where::Upper), number(Where::Inside), number(Where::Fixed));
    let proof = match doubtful {
        0 => "every end is proved by the sign of the exact gradient".into(),
        _ => format!("{} not proved", count(doubtful, "end")),
    };
    if upper + inside == 0 && doubtful == 0 {
        return format!("Every variable ends at its lower bound; {proof}.");
    }
    format!("{} at lower bounds, {upper} at upper bounds, {inside} inside, {fixed} fixed; {proof}.", count(lower, "variable"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end(at: Where, proved: bool) -> End {
        End { name: "s.b".into(), value: 1.0, at, derivative: 2.0, proved, reason: None }
    }

    #[test]
    fn the_conclusion_counts_the_ends() {
        assert!(conclusion(&[end(Where::Lower, true), end(Where::Fixed, true)]).starts_with("Every variable ends at its lower"));
        let mixed = conclusion(&[end(Where::Lower, true), end(Where::Upper, true), end(Where::Inside, false)]);
        assert_eq!(mixed, "1 variable at lower bounds, 1 at upper bounds, 1 inside, 0 fixed; 1 end not proved.");
    }
}
