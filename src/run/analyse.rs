//! `analyse`: what the structure does at a point; nothing is optimised.

mod json;
pub(super) mod responses;

use std::io::{self, Write};
use std::sync::Arc;

use super::refinement::{self, Lowest};
use super::{RunError, Subject};
use crate::model::{Assembled, AssemblyError, EvaluationError, assemble_any};
use crate::problem::{Constraint, Formula, Problem, Scope};
use crate::report::answer::EarlierAnswer;
use crate::report::text::listing;
use responses::Responses;
pub use responses::{CaseResponses, Extreme};

/// What was found.
#[derive(Debug, Default)]
pub struct Analysis {
    /// Definitions and their values.
    pub definitions: Vec<(String, f64)>,
    /// Their derivatives, one list per definition in the order of the variables; where they were asked for.
    pub gradient: Vec<Vec<f64>>,
    /// Names of the variables.
    pub variables: Vec<String>,
    /// What the structure does, by case and combination.
    pub cases: Vec<CaseResponses>,
    /// The lowest buckling factors and frequencies.
    pub modes: Vec<Lowest>,
    /// The point that was analysed, by variable.
    pub x: Vec<f64>,
    /// What is odd about it, in sentences.
    pub remarks: Vec<String>,
    /// The largest residual of an equilibrium equation over the largest sum of its terms.
    pub equilibrium_residual: f64,
}

/// Why there is none.
#[derive(Debug, thiserror::Error)]
pub enum AnalysisError {
    /// The file, the answer or the command.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A motion meets no resistance.
    #[error("the structure is a mechanism: {0}")]
    Mechanism(String),
    /// There is no value.
    #[error("{0}")]
    Value(#[from] EvaluationError),
    /// The model is too large.
    #[error(transparent)]
    Assembly(#[from] AssemblyError),
}

impl Analysis {
    /// Writes everything as one JSON object.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_json(&self, problem: &Problem, out: &mut dyn Write) -> io::Result<()> {
        json::write(self, problem, out)
    }
}

/// Analyses the structure at an answer, or at the start.
///
/// # Errors
/// No structure, an answer to another problem, a mechanism, a value that does not exist.
pub fn analyse(subject: &Subject, answer: Option<&EarlierAnswer>, gradient: bool) -> Result<Analysis, AnalysisError> {
    if subject.problem().structure.is_none() {
        let message = format!("{} has no structure: no rib has a start and an end node", subject.about.file);
        return Err(RunError::Choice(message).into());
    }
    let x = match answer {
        Some(answer) => answer.point(subject.shown()).map_err(RunError::from)?,
        None => subject.shown().meta().start.clone(),
    };
    let problem = subject.problem();
    // Without a case there are no displacements to ask for.
    let acted_on = problem.structure.as_deref().is_some_and(|structure| structure.load_sets() > 0);
    let responses = if acted_on { Responses::of(problem)? } else { None };
    if let Some(words) = responses.as_ref().map(|all| all.mechanism(&x)).transpose()?.flatten() {
        return Err(AnalysisError::Mechanism(words));
    }
    let assembled = of_definitions(problem)?;
    let model = assembled.model();
    let mut values = vec![0.0; model.meta().rows()];
    model.constraints(&x, &mut values)?;
    let definitions = problem.definitions.iter().zip(values).map(|((name, _), value)| (name.clone(), value)).collect();
    let mut analysis = Analysis { definitions, ..Analysis::default() };
    if gradient {
        let pattern = &model.meta().jacobian;
        let mut jacobian = vec![0.0; pattern.len()];
        model.jacobian(&x, &mut jacobian)?;
        analysis.gradient = vec![vec![0.0; x.len()]; pattern.rows()];
        for (at, (row, column)) in pattern.iter().enumerate() {
            analysis.gradient[row][column] = jacobian[at];
        }
        analysis.variables = (0..x.len()).map(|j| model.variable_name(j)).collect();
    }
    analysis.remarks = remarks(subject, &x);
    if let Some(responses) = &responses {
        analysis.cases = responses.by_case(&x)?;
        analysis.equilibrium_residual = responses.residual(&x)?;
    }
    analysis.modes = refinement::all(problem, &x);
    analysis.x = x;
    Ok(analysis)
}

/// All definitions and their values at x.
///
/// # Errors
/// A term that is too dense; a definition without a value.
pub fn definitions(subject: &Subject, x: &[f64]) -> Result<Vec<(String, f64)>, AnalysisError> {
    let problem = subject.problem();
    let assembled = of_definitions(problem)?;
    let mut values = vec![0.0; assembled.model().meta().rows()];
    assembled.model().constraints(x, &mut values)?;
    Ok(problem.definitions.iter().zip(values).map(|((name, _), value)| (name.clone(), value)).collect())
}

/// Variables outside their bounds, and a structure on which nothing acts.
fn remarks(subject: &Subject, x: &[f64]) -> Vec<String> {
    let (model, mut remarks) = (subject.shown(), Vec::new());
    let meta = model.meta();
    let outside = (0..x.len()).filter(|&j| x[j] < meta.lower[j] || x[j] > meta.upper[j]);
    let outside: Vec<String> = outside.map(|j| model.variable_name(j)).collect();
    if !outside.is_empty() {
        let names = listing(outside.into_iter(), 5);
        remarks.push(format!("warning: the answer is outside the bounds of {names}; it is analysed all the same"));
    }
    let asks_for_modes = !refinement::asked(subject.problem()).is_empty();
    if subject.problem().structure.as_deref().is_some_and(|structure| structure.load_sets() == 0) && !asks_for_modes {
        remarks.push("warning: nothing acts on the structure: the file has no [[loads]], and so no case to analyse".into());
    }
    remarks
}

/// The problem with one row per definition.
fn of_definitions(problem: &Problem) -> Result<Assembled, AssemblyError> {
    let row = |at: usize| Constraint::unlimited(problem.definitions[at].0.clone(), Scope::Once, Formula::Definition(at as u32));
    let constraints = (0..problem.definitions.len()).map(row).collect();
    let objective = Formula::default();
    assemble_any(&Arc::new(Problem { constraints, objective, ..problem.clone() }))
}
