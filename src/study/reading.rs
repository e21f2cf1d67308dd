//! A study file becomes a [`Study`]: its numbers computed, its points laid out, its names looked up in the problem.

use std::ops::Range;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use toml::Spanned;

use super::axis::{self, Axis};
use super::declaration::{Declaration, Method};
use super::layout::{self, Layout};
use super::mistakes::Mistakes;
use super::problem::{beside, computed};
use super::{MOST_LISTED, Options, Quantity, Study};
use crate::input::Document;
use crate::run::{RunError, Subject};

/// Every this many points of a chain a nonlinear problem also starts cold, where the file names no number.
const COLD_EVERY: u32 = 8;

impl Study {
    /// Reads a study file, its table of points and the problem it is about.
    ///
    /// # Errors
    /// All mistakes of the file; those of the problem with the values of the first point.
    pub fn read(file: &Path) -> Result<Study, RunError> {
        let document = Document::read(file)?;
        let mut mistakes = Mistakes::of(&document);
        let declared = match toml::from_str::<Declaration>(document.text()) {
            Ok(declared) => declared,
            Err(error) => {
                mistakes.tell(error.span().unwrap_or(0..0), error.message(), None);
                mistakes.end()?;
                return Err(RunError::Choice(format!("{}: {}", file.display(), error.message())));
            }
        };
        let problem = beside(file, declared.problem.get_ref());
        let layout = match &declared.pareto {
            Some(pareto) => layout::front(pareto, &declared, &mut mistakes),
            None if declared.design.method == Method::List => layout::listed(file, &problem, &declared, &mut mistakes)?,
            None => {
                let axes = axes(&problem, &declared, &mut mistakes)?;
                axes.and_then(|axes| layout::laid_out(axes, &declared, &mut mistakes))
            }
        };
        let options = options(&declared, layout.as_ref(), &mut mistakes);
        let quantities = quantities(&declared, layout.as_ref(), &mut mistakes);
        mistakes.end()?;
        // Without a mistake there is a layout.
        let Some(layout) = layout else { return Err(RunError::Choice(format!("{}: there are no points", file.display()))) };
        Study::of(file, problem, layout, options, quantities)
    }

    /// Looks at the problem as the first point has it.
    fn of(file: &Path, problem: PathBuf, layout: Layout, options: Options, quantities: Vec<Quantity>) -> Result<Study, RunError> {
        let mut study = Study { file: file.to_owned(), problem, layout, options, quantities, ..Study::default() };
        let subject = Subject::read_with(&study.problem, &study.additions(&study.layout.first()), &|_| {})?;
        let model = subject.shown();
        study.variables = (0..model.meta().variables().min(MOST_LISTED)).map(|j| model.variable_name(j)).collect();
        study.problem_sha256 = subject.about.sha256.clone();
        study.title = subject.about.title.clone();
        study.sense = subject.about.sense;
        study.class = subject.class();
        study.units = subject.about.units.clone();
        study.has_ribs = !subject.problem().ribs.names.is_empty();
        study.fingerprint = study.fingerprinted();
        Ok(study)
    }

    /// What decides every row: points, questions, the problem's own checksum and this program.
    fn fingerprinted(&self) -> String {
        let whole = format!(
            "{:?}{:?}{:?}{}{}",
            self.layout,
            self.options,
            self.quantities,
            self.problem_sha256,
            env!("CARGO_PKG_VERSION")
        );
        Sha256::digest(whole.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// The axes of `[vary]` in the order of the file; `None` where one is wrong.
fn axes(problem: &Path, declared: &Declaration, mistakes: &mut Mistakes<'_>) -> Result<Option<Vec<Axis>>, RunError> {
    let mut entries: Vec<_> = declared.vary.iter().collect();
    entries.sort_by_key(|(name, _)| name.span().start);
    if entries.is_empty() {
        let help = "as in [vary] span = { from = 6, to = 12, count = 7 }; or [pareto] minimize = [\"volume\", \"…\"]";
        mistakes.tell(declared.problem.span(), "the study varies nothing", Some(help));
        return Ok(None);
    }
    let texts: Vec<(String, Range<usize>)> = entries.iter().flat_map(|(_, axis)| axis::texts(axis)).collect();
    let mut computed = computed(problem, texts.into_iter().map(|(text, _)| text).collect())?.into_iter();
    let method = declared.design.method;
    let read =
        entries.iter().map(|(name, entry)| axis::read((name.get_ref(), name.span()), entry, method, &mut computed, mistakes));
    Ok(read.collect())
}

fn options(declared: &Declaration, layout: Option<&Layout>, mistakes: &mut Mistakes<'_>) -> Options {
    let run = &declared.run;
    let cold_every = run.cold_every.as_ref().map_or(COLD_EVERY, |given| *given.get_ref());
    if let Some(given) = run.cold_every.as_ref().filter(|given| *given.get_ref() == 0) {
        mistakes.tell(given.span(), "`cold_every` must be 1 or more", Some("1 starts every point cold as well"));
    }
    if let (Some(chain), Some(layout)) = (&run.chain, layout)
        && !layout.may_chain(chain.get_ref())
    {
        let names: Vec<String> = layout.names().iter().map(|name| format!("\"{name}\"")).collect();
        let help = format!("one of {}, or \"none\"", names.join(", "));
        mistakes.tell(chain.span(), format!("`{}` is not varied", chain.get_ref()), Some(&help));
    }
    Options { on_failure: run.on_failure, max_seconds: run.max_seconds, cold_every: cold_every.max(1) }
}

fn quantities(declared: &Declaration, layout: Option<&Layout>, mistakes: &mut Mistakes<'_>) -> Vec<Quantity> {
    let mut entries: Vec<(&Spanned<String>, &Spanned<String>)> = declared.report.quantities.iter().collect();
    entries.sort_by_key(|(name, _)| name.span().start);
    let mut list: Vec<Quantity> = layout.map(Layout::quantities).unwrap_or_default();
    for (name, text) in entries {
        let taken = super::table::COLUMNS.contains(&name.get_ref().as_str())
            || layout.is_some_and(|layout| layout.names().iter().any(|known| known == name.get_ref()));
        if taken {
            let message = format!("`{}` is a column of the table already", name.get_ref());
            mistakes.tell(name.span(), message, Some("give the quantity another name"));
        }
        list.push(Quantity { column: name.get_ref().clone(), name: name.get_ref().clone(), text: text.get_ref().clone() });
    }
    list
}
