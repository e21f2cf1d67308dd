//! Certified points that rest on a single one of coinciding eigenvalues: it has no derivative there, and nothing is proved.

use super::super::Subject;
use super::clusters::tight_pair;
use crate::certificate::Extent;
use crate::crosscheck::{Outcome, Status};
use crate::model::EvaluationError;
use crate::problem::Constraint;
use crate::problem::modes::{Eigenvalue, Pencil, eigenvalues_in};

/// A certified outcome as it was, or uncertified where the objective or an active row of the problem it was judged in rests on such an eigenvalue.
pub(in super::super) fn unless_undecided(subject: &Subject, mut outcome: Outcome) -> Outcome {
    if outcome.status != Status::Certified {
        return outcome;
    }
    let words = match undecided(subject, &outcome) {
        Ok(None) => return outcome,
        Ok(Some(words)) => words,
        Err(error) => error.to_string(),
    };
    refuse(&mut outcome, &words);
    outcome
}

/// Takes back what was said of a point, and of those of all backends: they are judged by the same rows.
pub(super) fn refuse(outcome: &mut Outcome, words: &str) {
    (outcome.status, outcome.scope, outcome.lower_bound) = (Status::Uncertified, Extent::Local, None);
    outcome.message = format!("The point is not certified: {words}.");
    let of_answers = outcome.answers.iter_mut().filter_map(|answer| answer.certificate.as_mut());
    for certificate in of_answers.chain(outcome.certificate.as_mut()).filter(|certificate| certificate.certified) {
        certificate.certified = false;
        certificate.scope = Extent::Local;
        certificate.messages.push(words.to_owned());
    }
}

fn undecided(subject: &Subject, outcome: &Outcome) -> Result<Option<String>, EvaluationError> {
    let Some(model) = subject.analysis() else { return Ok(None) };
    let numbers = rested_on(subject, outcome);
    if numbers.is_empty() {
        return Ok(None);
    }
    let z = model.solved(&outcome.x)?;
    for (pencil, number) in numbers {
        if let Some(first) = tight_pair(model, &z, pencil, number)? {
            let (what, next) = (pencil.name(), first + 1);
            return Ok(Some(format!(
                "modes {first} and {next} of {what} coincide, and mode {number} alone has no derivative there"
            )));
        }
    }
    Ok(None)
}

/// The single eigenvalues in the objective and in rows with multipliers.
fn rested_on(subject: &Subject, outcome: &Outcome) -> Vec<(Pencil, u32)> {
    let problem = subject.problem();
    let multipliers = outcome.certificate.as_ref().map_or(&[][..], |certificate| &certificate.row_multipliers);
    let told = multipliers.len() == problem.constraints.iter().map(|constraint| constraint.scope.rows()).sum::<usize>();
    let mut row = 0;
    let mut is_active = |constraint: &&Constraint| {
        let first = row;
        row += constraint.scope.rows();
        !told || multipliers[first..row].iter().any(|multiplier| *multiplier != 0.0)
    };
    let active: Vec<&Constraint> = problem.constraints.iter().filter(&mut is_active).collect();
    let formulas = active.into_iter().flat_map(Constraint::formulas);
    let single = |one: Eigenvalue| match one {
        Eigenvalue::Number(pencil, number) => Some((pencil, number)),
        Eigenvalue::Cut(_) => None,
    };
    eigenvalues_in(problem, std::iter::once(&problem.objective).chain(formulas)).into_iter().filter_map(single).collect()
}
