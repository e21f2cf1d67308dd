//! Which backends run, with which algorithm.

use super::RunError;
use crate::backends::Backend;
use crate::crosscheck::Task;
use crate::problem::Settings;
use crate::problem::settings::{AUTO, BACKENDS};

/// A backend and the algorithm asked of it.
#[derive(Clone)]
pub struct Choice {
    /// The backend.
    pub backend: &'static dyn Backend,
    /// `auto` or one of its algorithms.
    pub algorithm: String,
}

/// All backends that are built in, in the order they run.
pub fn built_in() -> &'static [&'static dyn Backend] {
    &[
        #[cfg(feature = "nlopt")]
        &crate::backends::nlopt::Nlopt,
        &crate::backends::argmin::Argmin,
    ]
}

/// The backends of the command line, else of the file, else all, with their algorithms.
///
/// # Errors
/// Where a backend is not built in, or none of them knows the algorithm.
pub fn choose(names: &[String], algorithm: Option<&str>, settings: &Settings) -> Result<Vec<Choice>, RunError> {
    let names = if names.is_empty() { &settings.backends } else { names };
    let mut backends: Vec<&'static dyn Backend> = Vec::new();
    for name in names {
        let found = built_in().iter().copied().find(|backend| backend.name() == name);
        let backend = found.ok_or_else(|| not_built_in(name))?;
        if !backends.iter().any(|chosen| chosen.name() == backend.name()) {
            backends.push(backend);
        }
    }
    if names.is_empty() {
        backends = built_in().to_vec();
    }
    let known = |backend: &dyn Backend, name: &str| name == AUTO || backend.algorithms().contains(&name);
    if let Some(name) = algorithm
        && !backends.iter().any(|backend| known(*backend, name))
    {
        return Err(unknown_algorithm(name, &backends));
    }
    let choice = |backend: &'static dyn Backend| {
        let asked = algorithm.filter(|name| known(backend, name));
        let algorithm = asked.unwrap_or_else(|| settings.algorithm(backend.name())).to_string();
        Choice { backend, algorithm }
    };
    Ok(backends.into_iter().map(choice).collect())
}

/// An error where every choice refuses the model; one that runs is enough to go on.
///
/// # Errors
/// With each one's reason.
pub fn refuse_if_none_accepts(choices: &[Choice], task: &Task<'_>) -> Result<(), RunError> {
    let refusal = |choice: &Choice| choice.backend.refusal(&choice.algorithm, task.model_for(choice.backend));
    let refusals: Vec<Option<String>> = choices.iter().map(refusal).collect();
    if refusals.iter().any(Option::is_none) {
        return Ok(());
    }
    let reasons: Vec<String> = refusals.into_iter().flatten().collect();
    Err(RunError::Choice(reasons.join("\n")))
}

/// Every backend with every algorithm.
pub fn all() -> Vec<Choice> {
    let choices = built_in()
        .iter()
        .flat_map(|&backend| backend.algorithms().iter().map(move |&algorithm| Choice { backend, algorithm: algorithm.into() }));
    choices.collect()
}

fn not_built_in(name: &str) -> RunError {
    let known: Vec<&str> = built_in().iter().map(|backend| backend.name()).collect();
    let is_left_out = BACKENDS.iter().any(|backend| backend.name == name);
    let hint = if is_left_out { format!("; this ribopt was built without its feature `{name}`") } else { String::new() };
    RunError::Choice(format!("there is no backend {name}{hint}; choose from: {}", known.join(", ")))
}

fn unknown_algorithm(name: &str, backends: &[&'static dyn Backend]) -> RunError {
    let known = backends.iter().map(|backend| format!("{}: auto, {}", backend.name(), backend.algorithms().join(", ")));
    let known: Vec<String> = known.collect();
    RunError::Choice(format!("there is no algorithm {name}; choose from\n  {}", known.join("\n  ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(names: &[&str], algorithm: Option<&str>) -> String {
        let names: Vec<String> = names.iter().map(|&name| name.into()).collect();
        choose(&names, algorithm, &Settings::default()).err().unwrap().to_string()
    }

    #[test]
    fn unknown_names_are_told_with_the_known_ones() {
        assert!(error(&["ipopt"], None).contains("choose from: "));
        assert!(error(&[], Some("simplex")).contains("argmin: auto, interior-point"));
    }

    #[test]
    fn an_algorithm_goes_to_the_backend_that_knows_it() {
        let choices = choose(&[], Some("interior-point"), &Settings::default()).unwrap();
        let asked = choices.iter().map(|choice| (choice.backend.name(), choice.algorithm.as_str()));
        assert!(asked.clone().any(|pair| pair == ("argmin", "interior-point")));
        assert!(asked.filter(|(backend, _)| *backend != "argmin").all(|(_, algorithm)| algorithm == "auto"));
    }

    #[test]
    fn files_and_the_command_line_know_the_backends_by_their_own_names() {
        for backend in built_in() {
            let names = BACKENDS.iter().find(|names| names.name == backend.name()).expect("a line in BACKENDS");
            assert_eq!(names.algorithms, backend.algorithms(), "{}", backend.name());
        }
        assert!(cfg!(not(feature = "nlopt")) || built_in().len() == BACKENDS.len());
    }

    #[test]
    fn a_backend_named_twice_runs_once() {
        let twice = ["argmin".to_string(), "argmin".to_string()];
        assert_eq!(choose(&twice, None, &Settings::default()).unwrap().len(), 1);
    }
}
