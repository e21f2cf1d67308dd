//! A problem file read, checked and assembled: what every command starts from.

use std::path::Path;
use std::sync::Arc;

use super::RunError;
use crate::model::{Class, Model, RibModel, Substitution, assemble};
use crate::problem::formula::Total;
use crate::problem::{Constraint, Formula, Limit, Problem, Scope, Settings};
use crate::report::result::Mistake;
use crate::report::{self, About, Volumes};

/// A problem ready to be solved.
pub struct Subject {
    /// Its origin and words.
    pub about: About,
    /// What is proved about it.
    pub class: Class,
    /// Tolerances and limits: the file's, unless the command line changed them.
    pub settings: Settings,
    problem: Arc<Problem>,
    model: RibModel,
}

impl Subject {
    /// Reads a file with the changes of `--set`.
    ///
    /// # Errors
    /// All mistakes of the file, its tables and the changes.
    pub fn read(file: &Path, changes: &[String]) -> Result<Subject, RunError> {
        let _ = (file, changes);
        Err(RunError::Input("not yet".into(), Vec::new()))
    }

    /// Assembles a checked declaration that was read from `file`.
    ///
    /// # Errors
    /// Where its second derivatives do not fit.
    pub fn assemble(problem: Problem, file: &Path, sha256: String) -> Result<Subject, RunError> {
        let problem = Arc::new(problem);
        let about = About {
            title: problem.title.clone(),
            file: file.display().to_string(),
            sha256,
            sense: problem.sense,
            objective: problem.objective_text.clone(),
            units: problem.units.clone(),
            has_sections: !problem.sections.names.is_empty(),
            warnings: problem.warnings.clone(),
        };
        let model = assemble(&problem).map_err(|error| {
            let mistake = Mistake { file: Some(about.file.clone()), ..Mistake::of_command(error.to_string()) };
            RunError::Input(format!("mistake: {error}\n--> {}", about.file), vec![mistake])
        })?;
        Ok(Subject { about, class: Class::default(), settings: problem.settings.clone(), problem, model })
    }

    /// The problem in the user's variables, minimised.
    pub fn model(&self) -> &dyn Model {
        &self.model
    }

    /// The declaration.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The same in variables that are easier to solve in, where there are any.
    pub fn substitution(&self) -> Option<&dyn Substitution> {
        None
    }

    /// −1 where the user maximises.
    pub fn sign(&self) -> f64 {
        report::sign(self.problem.sense)
    }

    /// Total volumes at a point, where there are ribs and they have a volume there.
    pub fn volumes(&self, x: &[f64]) -> Option<Volumes> {
        if self.problem.ribs.names.is_empty() {
            return None;
        }
        let rows = [Total::Own, Total::Frustum, Total::Prismatoid].map(volume_row);
        let objective = Formula::default();
        let problem = Problem { constraints: rows.into(), objective, ..Problem::clone(&self.problem) };
        let model = assemble(&Arc::new(problem)).ok()?;
        let mut totals = [0.0; 3];
        model.constraints(x, &mut totals).ok()?;
        let [total, frustum, prismatoid] = totals;
        Some(Volumes { total, frustum, prismatoid })
    }
}

/// A row whose value is a total volume.
fn volume_row(total: Total) -> Constraint {
    let (left, right) = (Formula::Volume(total), Limit::AtMost(Formula::Constant(f64::INFINITY)));
    Constraint { name: String::new(), place: String::new(), text: String::new(), scope: Scope::Once, left, right }
}
