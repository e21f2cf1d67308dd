//! What the solvers did, last of all.

use std::io::{self, Write};

use super::LONGEST_MESSAGE;
use crate::backends::Termination;
use crate::crosscheck::Answer;
use crate::report::Findings;
use crate::report::number::significant;
use crate::report::text::{TextTable, shortened};

/// A row per backend, its words, and whether they agree; of a point that no backend found, its certificate.
///
/// # Errors
/// Whatever the writer says.
pub(super) fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let outcome = findings.outcome;
    if outcome.answers.is_empty() {
        return measures(findings, out);
    }
    let header =
        ["backend", "algorithm", "point", "objective", "iterations", "evaluations", "seconds", "primal", "dual", "compl."];
    let mut table = TextTable::new(3, &header);
    for answer in &outcome.answers {
        table.add(backend_row(findings, answer));
    }
    write!(out, "\n{table}")?;
    for answer in &outcome.answers {
        writeln!(out, "  {}: {}", answer.backend, shortened(&answer.solution.message, LONGEST_MESSAGE))?;
        for remark in &answer.remarks {
            writeln!(out, "    {remark}")?;
        }
    }
    if let Some(agreement) = outcome.agreement {
        let word = if agreement.agree { "agree" } else { "do not agree" };
        let size = outcome.objective.map_or(1.0, f64::abs).max(f64::MIN_POSITIVE);
        let (f, x) = (significant(agreement.objective_difference / size, 2), significant(agreement.variable_difference, 2));
        writeln!(out, "  the backends {word}: relative to their sizes, objectives differ by {f}, variables by up to {x}")?;
    }
    Ok(())
}

/// The certificate of a point that no backend found.
fn measures(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(certificate) = &findings.outcome.certificate else { return Ok(()) };
    let measures = [certificate.primal_infeasibility, certificate.dual_infeasibility, certificate.complementarity];
    let [primal, dual, complementarity] = measures.map(|value| significant(value, 3));
    writeln!(out, "primal infeasibility {primal}, dual infeasibility {dual}, complementarity {complementarity}")?;
    for message in &certificate.messages {
        writeln!(out, "  {message}")?;
    }
    Ok(())
}

fn backend_row(findings: &Findings<'_>, answer: &Answer) -> Vec<String> {
    let solution = &answer.solution;
    let measure = |get: fn(&crate::certificate::Certificate) -> f64| {
        answer.certificate.as_ref().map_or("-".into(), |certificate| significant(get(certificate), 2))
    };
    if solution.termination == Termination::Refused {
        let mut row = vec![answer.backend.into(), solution.algorithm.clone(), "refused".into()];
        row.resize(10, "-".into());
        return row;
    }
    let certified = answer.is_certified();
    vec![
        answer.backend.into(),
        solution.algorithm.clone(),
        if certified { "certified".into() } else { "not certified".into() },
        answer.objective.map_or("-".into(), |value| significant(findings.in_users_sense(value), 10)),
        solution.iterations.map_or("-".into(), |iterations| iterations.to_string()),
        solution.evaluations.to_string(),
        significant(solution.seconds, 3),
        measure(|certificate| certificate.primal_infeasibility),
        measure(|certificate| certificate.dual_infeasibility),
        measure(|certificate| certificate.complementarity),
    ]
}
