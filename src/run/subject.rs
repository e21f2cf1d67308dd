//! A problem file read, checked and assembled: what every command starts from.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::{RunError, plausible};
use crate::crosscheck::Task;
use crate::files::Inputs;
use crate::input::{self, Additions, Dimensions, Input, Progress};
use crate::model::structural::mechanism;
use crate::model::{AssemblyError, Class, Formulation, Lifted, Model, Reduced, Substitution, assemble_any, formulate, volumes};
use crate::problem::formula::Total;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::{Constraint, Formula, Problem, Scope, Settings};
use crate::report::result::Mistake;
use crate::report::{self, About, Volumes};
use crate::units::Shown;

/// A problem ready to be solved. A copy shares what was assembled and has settings of its own.
#[derive(Clone)]
pub struct Subject {
    /// Its origin and words.
    pub about: About,
    /// Tolerances and limits: the file's, unless the command line changed them.
    pub settings: Settings,
    /// The file and its tables.
    pub inputs: Inputs,
    /// What the file's numbers measure.
    pub dimensions: Dimensions,
    /// What the reader wants said, with lines and carets; [`About::warnings`] has the same in one line each.
    pub warnings: Vec<String>,
    /// The numbers of the additions' constants.
    pub constants: Vec<f64>,
    formulation: Arc<Formulation>,
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
        Subject::read_with(file, &Additions::changing(changes), watch)
    }

    /// [`Subject::read_watched`] with other additions besides.
    ///
    /// # Errors
    /// All mistakes of the file, its tables and the additions.
    pub fn read_with(file: &Path, additions: &Additions, watch: &dyn Fn(Progress<'_>)) -> Result<Subject, RunError> {
        Subject::of_input(input::read_with(file, additions, watch)?, file, &additions.changes)
    }

    /// Reads a problem from a text; `name` is what mistakes and reports call it.
    ///
    /// # Errors
    /// All mistakes of the text.
    pub fn of_text(name: &str, text: &str) -> Result<Subject, RunError> {
        Subject::of_text_in(name, text, Path::new(""), &[])
    }

    /// [`Subject::of_text`] with the changes of `--set`; the text's tables are looked for in `folder`.
    ///
    /// # Errors
    /// All mistakes of the text, its tables and the changes.
    pub fn of_text_in(name: &str, text: &str, folder: &Path, changes: &[String]) -> Result<Subject, RunError> {
        Subject::of_input(input::read_text_in(name, text, folder, changes)?, Path::new(name), changes)
    }

    fn of_input(input: Input, file: &Path, changes: &[String]) -> Result<Subject, RunError> {
        let mut subject = Subject::assemble(input.problem, file, input.sha256)?;
        subject.inputs = Inputs::new(input.files);
        subject.about.shown = input.dimensions.shown.clone();
        subject.dimensions = input.dimensions;
        subject.about.changes = changes.to_vec();
        subject.constants = input.constants;
        let doubts =
            plausible::warnings(subject.problem()).into_iter().map(|text| format!("warning[{}]: {text}", MistakeCode::TwoUnits));
        subject.warnings = input.warnings.iter().map(|warning| input::render(warning, "warning")).chain(doubts).collect();
        Ok(subject)
    }

    /// Assembles a checked declaration that was read from `file`.
    ///
    /// # Errors
    /// Where its second derivatives do not fit.
    pub fn assemble(problem: Problem, file: &Path, sha256: String) -> Result<Subject, RunError> {
        let file = file.display().to_string();
        let too_dense = |error: AssemblyError| {
            let code = MistakeCode::TooDense.name();
            let mistake = Mistake { file: Some(file.clone()), code: Some(code), ..Mistake::of_command(error.to_string()) };
            RunError::Input(format!("mistake[{code}]: {error}\n--> {file}"), vec![mistake])
        };
        let formulation = Arc::new(formulate(problem).map_err(too_dense)?);
        let problem = formulation.model.problem();
        let about = About {
            title: problem.title.clone(),
            file: file.clone(),
            sha256,
            sense: problem.sense,
            objective: problem.objective_text.clone(),
            units: problem.units.clone(),
            shown: Shown::default(),
            has_sections: !problem.sections.names.is_empty(),
            has_structure: problem.structure.is_some(),
            checks: problem.checks.clone(),
            warnings: problem.warnings.iter().cloned().chain(plausible::warnings(problem)).collect(),
            chosen: Vec::new(),
            changes: Vec::new(),
        };
        let settings = problem.settings.clone();
        let (inputs, dimensions) = (Inputs::new([file.into()]), Dimensions::default());
        Ok(Subject { about, settings, inputs, dimensions, warnings: Vec::new(), constants: Vec::new(), formulation })
    }

    /// The same file's problem after a change, with all that was said and set.
    ///
    /// # Errors
    /// Where its second derivatives do not fit.
    pub fn with_problem(&self, problem: Problem) -> Result<Subject, AssemblyError> {
        Ok(Subject {
            about: self.about.clone(),
            settings: self.settings.clone(),
            inputs: self.inputs.clone(),
            dimensions: self.dimensions.clone(),
            warnings: Vec::new(),
            constants: Vec::new(),
            formulation: Arc::new(formulate(problem)?),
        })
    }

    /// What is proved about the problem.
    pub fn class(&self) -> Class {
        self.formulation.class
    }

    /// Which terms keep it from being a geometric program, and from being convex.
    pub fn obstacles(&self) -> (Option<&str>, Option<&str>) {
        (self.formulation.not_geometric.as_deref(), self.formulation.not_convex.as_deref())
    }

    /// The problem in the user's variables, and auxiliaries where kinks were restated, minimised.
    pub fn model(&self) -> &dyn Model {
        self.formulation.model.judge()
    }

    /// The problem in the user's variables alone, with all its kinks: what reports speak of.
    pub fn shown(&self) -> &dyn Model {
        self.formulation.shown.model()
    }

    /// The same with the states of large structures beside the design: there, derivatives are sparse.
    pub fn shown_with_states(&self) -> &dyn Model {
        self.formulation.shown.judge()
    }

    /// Whether the model has variables of kinks that are restated.
    pub fn has_auxiliaries(&self) -> bool {
        !self.formulation.model.problem().auxiliaries.is_empty()
    }

    /// A point in the user's variables with the auxiliaries that follow from it.
    pub fn completed(&self, mut x: Vec<f64>) -> Vec<f64> {
        let model = self.model();
        x.extend(model.meta().start.iter().skip(x.len()));
        model.complete(&mut x);
        x
    }

    /// The declaration, as it was written.
    pub fn problem(&self) -> &Problem {
        self.formulation.shown.problem()
    }

    /// One run from this start, which has the model's variables.
    pub fn task<'a>(&'a self, start: &'a [f64], interrupt: Option<&'a AtomicBool>) -> Task<'a> {
        Task {
            model: self.model(),
            substitution: self.substitution(),
            class: self.class(),
            settings: &self.settings,
            start,
            start_multipliers: None,
            starts: 1,
            interrupt,
        }
    }

    /// The same in variables that are easier to solve in, where there are any.
    pub fn substitution(&self) -> Option<&dyn Substitution> {
        self.formulation.substitution.as_deref().map(|other| other as &dyn Substitution)
    }

    /// The structure's analysis, where the problem asks for any.
    pub fn analysis(&self) -> Option<&Reduced<Lifted>> {
        self.formulation.shown.analysis()
    }

    /// An error where the structure is a mechanism at the start: no design of this layout stands.
    ///
    /// # Errors
    /// With the directions that meet no resistance.
    pub fn refuse_mechanism(&self) -> Result<(), RunError> {
        let Some(model) = self.analysis() else { return Ok(()) };
        match mechanism(model.lifted(), &model.meta().start) {
            Ok(Some(words)) => Err(RunError::Choice(format!(
                "the structure is a mechanism: {words}; support it there, or brace it with another rib"
            ))),
            // What has no value at the start is told by whoever looks for a start.
            _ => Ok(()),
        }
    }

    /// Starting points where the user names no number: several for small structures, for which local minima are the rule.
    pub fn usual_starts(&self) -> usize {
        /// With more design variables every start costs too much to be tried unasked.
        const FEW_VARIABLES: usize = 10;
        match self.analysis() {
            Some(model) if model.meta().variables() <= FEW_VARIABLES && !self.class().is_global() => 4,
            _ => 1,
        }
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
        let rows = [Total::Own, Total::Frustum, Total::Prismatoid]
            .map(|total| Constraint::unlimited("", Scope::Once, Formula::Volume(total)));
        let objective = Formula::default();
        let problem = Problem { constraints: rows.into(), objective, ..self.problem().clone() };
        let assembled = assemble_any(&Arc::new(problem)).ok()?;
        let model = assembled.model();
        let mut totals = [0.0; 3];
        model.constraints(x, &mut totals).ok()?;
        Some(totals)
    }
}

/// A mistake of the reader as reports show it.
pub(super) fn reported(mistake: &input::Mistake) -> Mistake {
    let place = |number: usize| (number > 0).then_some(number);
    Mistake {
        code: mistake.code.map(MistakeCode::name),
        file: Some(mistake.file.clone()),
        line: place(mistake.line),
        column: place(mistake.column),
        message: mistake.message.clone(),
        help: mistake.help.clone(),
    }
}
