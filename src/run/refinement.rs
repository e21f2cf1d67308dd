//! How much finer pieces of the ribs would change factors and frequencies: what the shapes within a piece leave out.

use std::sync::Arc;

use super::Subject;
use crate::model::{EvaluationError, Lifted, Reduced};
use crate::problem::modes::{Eigenvalue, NEVER, Pencil, defined, eigenvalues};
use crate::problem::{Constraint, Formula, Problem, Scope};
use crate::report::number::significant;

/// The lowest factors or frequencies of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Lowest {
    /// The case or combination of buckling factors; `None` for frequencies.
    pub case: Option<String>,
    /// With the pieces of the file, the lowest first.
    pub values: Vec<f64>,
    /// With twice as many.
    pub refined: Vec<f64>,
    /// Pieces per rib.
    pub pieces: u32,
}

/// Eigenvalues listed per case.
const LISTED: usize = 3;

/// More members than this are not looked at again unasked: with twice the pieces modes crowd, and 820 ribs took thirteen times as long.
const MOST_MEMBERS: usize = 200;

/// Structures of so many members have their eigenvalues told unasked.
const FEW_MEMBERS: usize = 40;

/// Those that the problem asks for, and of small structures all there are: a factor for every case and combination, and the frequencies.
pub fn all(problem: &Problem, x: &[f64]) -> Vec<Lowest> {
    let mut pencils = asked(problem);
    let Some(structure) = problem.structure.as_deref() else { return Vec::new() };
    if structure.members.len() <= FEW_MEMBERS {
        let weighs = structure.members.iter().all(|member| structure.materials[member.material as usize].density.is_some());
        let others = (0..structure.load_sets() as u32).map(Pencil::Buckling).chain(weighs.then_some(Pencil::Vibration));
        let others: Vec<Pencil> = others.filter(|pencil| !pencils.contains(pencil)).collect();
        pencils.extend(others);
    }
    pencils.into_iter().filter_map(|pencil| of_pencil(problem, pencil, x)).filter(|found| !found.values.is_empty()).collect()
}

/// The pencils that the problem (its definitions, too) asks for.
pub(super) fn asked(problem: &Problem) -> Vec<Pencil> {
    let mut pencils: Vec<Pencil> = Vec::new();
    for one in defined(problem) {
        if let Eigenvalue::Number(pencil, _) = one
            && !pencils.contains(&pencil)
        {
            pencils.push(pencil);
        }
    }
    pencils
}

/// In words, where ribs are cut into pieces and limits rest on these values.
pub(super) fn remarks(subject: &Subject, x: &[f64]) -> Vec<String> {
    let in_pieces =
        subject.problem().structure.as_deref().is_some_and(|structure| structure.members.iter().any(|member| !member.pinned));
    if !in_pieces || eigenvalues(subject.problem()).is_empty() {
        return Vec::new();
    }
    let word = |found: &Lowest| {
        let (first, finer) = (found.values.first()?, found.refined.first()?);
        let what = match &found.case {
            Some(case) => format!("the lowest buckling factor under {case}"),
            None => "the lowest frequency".into(),
        };
        let (pieces, twice) = (found.pieces, 2 * found.pieces);
        Some(format!(
            "{what} is {} with {pieces} pieces per rib, {} with {twice} ({:+.2} %)",
            significant(*first, 7),
            significant(*finer, 7),
            100.0 * (finer / first - 1.0)
        ))
    };
    let problem = subject.problem();
    asked(problem).into_iter().filter_map(|pencil| of_pencil(problem, pencil, x)).filter_map(|found| word(&found)).collect()
}

fn of_pencil(problem: &Problem, pencil: Pencil, x: &[f64]) -> Option<Lowest> {
    let structure = problem.structure.as_deref()?;
    let values = solved(problem, pencil, x).ok()?;
    let refined = match structure.members.len() <= MOST_MEMBERS {
        true => {
            let finer = crate::problem::Structure { buckling_pieces: 2 * structure.buckling_pieces, ..structure.clone() };
            let mut problem = Problem { structure: Some(Arc::new(finer)), ..problem.clone() };
            problem.prepare();
            solved(&problem, pencil, x).ok()?
        }
        false => Vec::new(),
    };
    let case = match pencil {
        Pencil::Buckling(set) => Some(structure.load_set_name(set).to_owned()),
        Pencil::Vibration => None,
    };
    Some(Lowest { case, values, refined, pieces: structure.buckling_pieces })
}

fn solved(problem: &Problem, pencil: Pencil, x: &[f64]) -> Result<Vec<f64>, EvaluationError> {
    let constraints = vec![Constraint::unlimited("", Scope::Once, Formula::Response(Arc::new(pencil.response(1))))];
    let objective = Formula::default();
    let asked = Problem { constraints, objective, auxiliaries: Vec::new(), cuts: Arc::default(), ..problem.clone() };
    let failed = |cause: String| EvaluationError::Invalid { term: "modes of the structure".into(), cause };
    let lifted = Lifted::of(&Arc::new(asked)).map_err(|error| failed(error.to_string()))?;
    let model = Reduced::of(lifted, false).ok_or_else(|| failed("there are no states".into()))?;
    let spectrum = model.lifted().modes()?.spectrum(&model.solved(x)?, pencil, LISTED)?;
    let shown = spectrum.values.iter().map(|&mu| pencil.shown(mu));
    Ok(shown.filter(|value| *value < NEVER).take(LISTED).collect())
}
