//! A problem file becomes a [`Draft`].

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use ribopt::input;
use ribopt::problem::{Origin as Declared, Problem, Sense};
use toml::de::DeTable;
use toml::{Table, Value};

use super::draft::{Draft, Entries, Origin, Row, Variable};
use super::words::replace_names;

/// Reads a file; its numbers are ribopt's own reading of it.
pub fn read(path: &Path) -> Result<Draft, String> {
    let text = fs::read_to_string(path).map_err(|cause| cause.to_string())?;
    let problem = input::read(path).map_err(|mistakes| mistakes.to_string())?.problem;
    let mut table: Table = text.parse().map_err(|cause: toml::de::Error| cause.to_string())?;
    let (document, _) = DeTable::parse_recoverable(&text);
    let mut entries = |key: &str| -> Entries {
        let Some(Value::Table(fields)) = table.remove(key) else { return Vec::new() };
        let mut fields: Entries = fields.into_iter().collect();
        let inner = document.get_ref().get(key).and_then(|inner| inner.get_ref().as_table());
        let place = |name: &str| inner?.get_key_value(name).map(|(key, _)| key.span().start);
        fields.sort_by_key(|(name, _)| place(name));
        fields
    };
    let (parameters, definitions, sections) = (entries("parameters"), entries("definitions"), entries("sections"));
    let variables = entries("variables").into_iter().map(|(name, value)| variable(&problem, name, &value)).collect();
    let rows = match table.remove("constraints") {
        Some(Value::Array(rows)) => rows.into_iter().enumerate().filter_map(row).collect(),
        _ => Vec::new(),
    };
    let written = table.remove("minimize").or_else(|| table.remove("maximize"));
    let objective = written.and_then(|text| text.as_str().map(str::to_string)).unwrap_or_else(|| "volume".into());
    let names = (0..problem.variables.start.len()).map(|j| problem.variable_name(j));
    let mut draft = Draft {
        maximize: problem.sense == Sense::Maximize,
        objective,
        parameters,
        definitions,
        sections,
        variables,
        rows,
        rest: rest(table, path.parent().unwrap_or(Path::new(""))),
        ranges: dimension_ranges(&problem),
        origins: names.map(|name| Origin { in_file: name.clone(), now: name, steps: Vec::new(), size: 1.0 }).collect(),
        factor: 1.0,
    };
    write_out_arrays(&mut draft);
    Ok(draft)
}

fn variable(problem: &Problem, name: String, written: &Value) -> Variable {
    let declared = &problem.variables;
    let is_own = |origin: &Declared| match *origin {
        Declared::Scalar(entry) | Declared::Element(entry, _) => *declared.declared[entry as usize] == *name,
        Declared::Dimension(..) | Declared::Input(_) => false,
    };
    let own: Vec<usize> = (0..declared.origin.len()).filter(|&j| is_own(&declared.origin[j])).collect();
    let pick = |values: &[f64]| own.iter().map(|&j| values[j]).collect();
    let is_array = own.iter().any(|&j| matches!(declared.origin[j], Declared::Element(..)));
    let has_start = written.get("start").is_some();
    let start = has_start.then(|| pick(&declared.start));
    Variable { is_array, lower: pick(&declared.lower), upper: pick(&declared.upper), start, name, is_slack: false }
}

fn row((at, row): (usize, Value)) -> Option<Row> {
    let Value::Table(mut fields) = row else { return None };
    let text = |value: Value| value.as_str().map(str::to_string);
    let require = fields.remove("require").and_then(text)?;
    let name = fields.remove("name").and_then(text).unwrap_or_else(|| format!("c{}", at + 1));
    Some(Row { name, require, scope: fields.into_iter().collect() })
}

/// CSV tables lie beside the file; the draft will lie elsewhere.
fn rest(mut table: Table, folder: &Path) -> Entries {
    if let Some(Value::Table(tables)) = table.get_mut("tables") {
        for (_, file) in tables.iter_mut() {
            let beside = file.as_str().map(|file| folder.join(file)).and_then(|path| path.canonicalize().ok());
            if let Some(path) = beside {
                *file = path.display().to_string().into();
            }
        }
    }
    table.into_iter().collect()
}

fn dimension_ranges(problem: &Problem) -> HashMap<String, [f64; 3]> {
    let variables = &problem.variables;
    let of_sections = (0..variables.origin.len()).filter(|&j| matches!(variables.origin[j], Declared::Dimension(..)));
    let range = |j: usize| (problem.variable_name(j), [variables.lower[j], variables.upper[j], variables.start[j]]);
    of_sections.map(range).collect()
}

/// Arrays that are used element by element become scalar variables, each with a transformation of its own.
fn write_out_arrays(draft: &mut Draft) {
    if !draft.is_algebraic() {
        return;
    }
    for at in (0..draft.variables.len()).rev() {
        let array = draft.variables[at].clone();
        let element = |index: &str| index.strip_prefix('[')?.strip_suffix(']')?.trim().parse::<usize>().ok();
        let used_whole = std::cell::Cell::new(false);
        let look = |word: &str, index: &str| {
            if word == array.name && element(index).is_none() {
                used_whole.set(true);
            }
            None
        };
        draft.formulas().for_each(|formula| drop(replace_names(formula, &look)));
        if !array.is_array || used_whole.get() {
            continue;
        }
        let stem = draft.fresh(&array.name);
        let name = |i: usize| format!("{stem}{i}");
        let write = |word: &str, index: &str| if word == array.name { element(index).map(name) } else { None };
        draft.rewrite_formulas(&|formula| replace_names(formula, &write));
        let scalar = |i: usize| {
            let start = array.start.as_ref().map(|start| start[i]);
            Variable::scalar(name(i + 1), [array.lower[i], array.upper[i]], start)
        };
        draft.variables.splice(at..=at, (0..array.lower.len()).map(scalar));
        for i in 1..=array.lower.len() {
            draft.track(&format!("{}[{i}]", array.name), &name(i), super::draft::Step::Affine(1.0, 0.0));
        }
    }
}

impl Draft {
    /// Every formula that may name a variable, sections' dimensions aside.
    fn formulas(&self) -> impl Iterator<Item = &str> {
        let definitions = self.definitions.iter().filter_map(|(_, value)| value.as_str());
        let rows = self.rows.iter().map(|row| row.require.as_str());
        std::iter::once(self.objective.as_str()).chain(definitions).chain(rows)
    }

    /// Rewrites every formula that may name a variable, sections' dimensions aside.
    pub fn rewrite_formulas(&mut self, rewrite: &dyn Fn(&str) -> String) {
        self.objective = rewrite(&self.objective);
        for (_, value) in &mut self.definitions {
            if let Value::String(formula) = value {
                *formula = rewrite(formula);
            }
        }
        for row in &mut self.rows {
            row.require = rewrite(&row.require);
        }
    }
}

/// The start of element `i`, where it is left out: the middle of two bounds, else one bound moved inwards, else 0.
pub fn resolved_start(variable: &Variable, i: usize) -> f64 {
    let (lower, upper) = (variable.lower[i], variable.upper[i]);
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => lower + 0.5 * (upper - lower),
        (true, false) => lower + lower.abs().max(1.0),
        (false, true) => upper - upper.abs().max(1.0),
        (false, false) => 0.0,
    }
}
