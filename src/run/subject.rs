//! A problem file read, checked and assembled: what every command starts from.

use std::path::Path;
use std::sync::Arc;

use super::{RunError, plausible};
use crate::files::Inputs;
use crate::input::{self, Progress};
use crate::model::views::flange_substitution::FlangeSubstitution;
use crate::model::{AssemblyError, Class, Classification, Model, RibModel, Substitution, assemble, classify, volumes};
use crate::problem::formula::Total;
use crate::problem::{Constraint, Formula, Limit, Problem, Scope, Settings};
use crate::report::result::Mistake;
use crate::report::{self, About, Volumes};

/// From this size on a model is looked at for components,
const FEWEST_VARIABLES: usize = 200;
/// of no more variables than this.
const SMALL_COMPONENT: usize = 64;

/// A problem ready to be solved.
pub struct Subject {
    /// Its origin and words.
    pub about: About,
    /// What is proved about it.
    pub class: Class,
    /// Tolerances and limits: the file's, unless the command line changed them.
    pub settings: Settings,
    /// The file and its tables.
    pub inputs: Inputs,
    /// What the reader wants said, with lines and carets; [`About::warnings`] has the same in one line each.
    pub warnings: Vec<String>,
    /// The model that is solved.
    model: Arc<RibModel>,
    /// The same as it was written: kinks stay, and there are no auxiliaries.
    shown: Arc<RibModel>,
    /// Which terms keep it from being a geometric program and from being convex.
    pub not_geometric: Option<String>,
    /// Which term keeps it from being convex.
    pub not_convex: Option<String>,
    substitution: Option<Box<dyn Substitution + Send>>,
}

impl Subject {
    /// Reads a file with the changes of `--set`.
    ///
    /// # Errors
    /// All mistakes of the file, its tables and the changes.
    pub fn read(file: &Path, changes: &[String]) -> Result<Subject, RunError> {
        Subject::read_watched(file, changes, &|_| {})
    }

    /// [`Subject::read`], calling `watch` every now and then while tables are read.
    ///
    /// # Errors
    /// All mistakes of the file, its tables and the changes.
    pub fn read_watched(file: &Path, changes: &[String], watch: &dyn Fn(Progress<'_>)) -> Result<Subject, RunError> {
        let input = input::read_watched(file, changes, watch).map_err(|mistakes| {
            let list = mistakes.list.iter().map(reported).collect();
            RunError::Input(mistakes.to_string(), list)
        })?;
        let mut subject = Subject::assemble(input.problem.without_kinks(), file, input.sha256)?;
        subject.inputs = Inputs::new(input.files);
        subject.about.changes = changes.to_vec();
        let doubts = plausible::warnings(subject.problem()).into_iter().map(|text| format!("warning: {text}"));
        subject.warnings = input.warnings.iter().map(|warning| input::render(warning, "warning")).chain(doubts).collect();
        Ok(subject)
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
            warnings: problem.warnings.iter().cloned().chain(plausible::warnings(&problem)).collect(),
            changes: Vec::new(),
        };
        let too_dense = |error: AssemblyError| {
            let mistake = Mistake { file: Some(about.file.clone()), ..Mistake::of_command(error.to_string()) };
            RunError::Input(format!("mistake: {error}\n--> {}", about.file), vec![mistake])
        };
        let model = Arc::new(assemble(&problem).map_err(too_dense)?);
        let shown = match problem.auxiliaries.is_empty() {
            true => Arc::clone(&model),
            false => Arc::new(assemble(&Arc::new(problem.with_kinks())).map_err(too_dense)?),
        };
        let Classification { class, logarithmic, not_geometric, not_convex } = classify(&model).map_err(too_dense)?;
        let substitution = match logarithmic {
            _ if is_dust(&model) => None,
            Some(logarithmic) => Some(Box::new(logarithmic) as Box<dyn Substitution + Send>),
            None => differences(&problem, &model),
        };
        Ok(Subject {
            class,
            settings: problem.settings.clone(),
            inputs: Inputs::new([file.to_path_buf()]),
            warnings: Vec::new(),
            about,
            model,
            shown,
            not_geometric,
            not_convex,
            substitution,
        })
    }

    /// The problem in the user's variables, and auxiliaries where kinks were restated, minimised.
    pub fn model(&self) -> &dyn Model {
        self.model.as_ref()
    }

    /// The problem in the user's variables alone, with all its kinks: what reports speak of.
    pub fn shown(&self) -> &dyn Model {
        self.shown.as_ref()
    }

    /// A point in the user's variables with the auxiliaries that follow from it.
    pub fn completed(&self, mut x: Vec<f64>) -> Vec<f64> {
        x.extend(self.model.meta().start.iter().skip(x.len()));
        self.model.complete(&mut x);
        x
    }

    /// The declaration, as it was written.
    pub fn problem(&self) -> &Problem {
        self.shown.problem()
    }

    /// The same in variables that are easier to solve in, where there are any.
    pub fn substitution(&self) -> Option<&dyn Substitution> {
        self.substitution.as_deref().map(|other| other as &dyn Substitution)
    }

    /// −1 where the user maximises.
    pub fn sign(&self) -> f64 {
        report::sign(self.problem().sense)
    }

    /// Total volumes at a point, where there are ribs and they have a volume there.
    pub fn volumes(&self, x: &[f64]) -> Option<Volumes> {
        let problem = self.problem();
        if problem.ribs.names.is_empty() {
            return None;
        }
        let totals = volumes(problem, x, [Total::Own, Total::Frustum, Total::Prismatoid]);
        let [total, frustum, prismatoid] = totals.or_else(|| self.assembled_volumes(x))?;
        Some(Volumes { total, frustum, prismatoid })
    }

    /// The same where dimensions are computed, through a model.
    fn assembled_volumes(&self, x: &[f64]) -> Option<[f64; 3]> {
        let rows = [Total::Own, Total::Frustum, Total::Prismatoid].map(volume_row);
        let objective = Formula::default();
        let problem = Problem { constraints: rows.into(), objective, ..self.problem().clone() };
        let model = assemble(&Arc::new(problem)).ok()?;
        let mut totals = [0.0; 3];
        model.constraints(x, &mut totals).ok()?;
        Some(totals)
    }
}

/// Whether the model falls into so many small components that it is solved piece by piece, each in variables that suit it.
fn is_dust(model: &RibModel) -> bool {
    let large = model.meta().variables() >= FEWEST_VARIABLES;
    large && model.components().is_some_and(|components| components.partition().largest() <= SMALL_COMPONENT)
}

/// H beams given by two heights are solved in the flange thickness, where the bounds let it vanish.
fn differences(problem: &Problem, model: &Arc<RibModel>) -> Option<Box<dyn Substitution + Send>> {
    let pairs = FlangeSubstitution::pairs(problem);
    (!pairs.is_empty()).then(|| Box::new(FlangeSubstitution::new(Arc::clone(model) as _, &pairs)) as Box<dyn Substitution + Send>)
}

/// A row whose value is a total volume.
fn volume_row(total: Total) -> Constraint {
    let (left, right) = (Formula::Volume(total), Limit::AtMost(Formula::Constant(f64::INFINITY)));
    Constraint { name: String::new(), place: String::new(), text: String::new(), scope: Scope::Once, left, right }
}

/// A mistake of the reader as reports show it.
fn reported(mistake: &input::Mistake) -> Mistake {
    let place = |number: usize| (number > 0).then_some(number);
    Mistake {
        file: Some(mistake.file.clone()),
        line: place(mistake.line),
        column: place(mistake.column),
        message: mistake.message.clone(),
        help: mistake.help.clone(),
    }
}
