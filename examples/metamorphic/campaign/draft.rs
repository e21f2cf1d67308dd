//! A problem file as its author could have written it: taken apart, changed, written again.

use std::collections::HashMap;
use std::fmt::Write;

use toml::Value;

/// Beyond this, times 10^±6 and a formula's own numbers, an overflow is near.
const LAST_NUMBERS: f64 = 1e290;

/// Keys and values of one table, in the file's order.
pub type Entries = Vec<(String, Value)>;

/// One entry of `[variables]`, its bounds and starts as numbers, one per element.
#[derive(Debug, Clone)]
pub struct Variable {
    pub name: String,
    pub is_array: bool,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    /// `None`: left out.
    pub start: Option<Vec<f64>>,
    /// Of a row: counted from elsewhere it would take the row's tolerance with it.
    pub is_slack: bool,
}

impl Variable {
    pub fn scalar(name: String, [lower, upper]: [f64; 2], start: Option<f64>) -> Variable {
        Variable {
            name,
            is_array: false,
            lower: vec![lower],
            upper: vec![upper],
            start: start.map(|start| vec![start]),
            is_slack: false,
        }
    }

    /// What element `i` is called.
    pub fn element(&self, i: usize) -> String {
        if self.is_array { format!("{}[{}]", self.name, i + 1) } else { self.name.clone() }
    }

    /// How large element `i` is: its start, else its nearest bound, where they tell.
    pub fn size(&self, i: usize) -> Option<f64> {
        let start = self.start.as_ref().map_or(0.0, |start| start[i]);
        let sizes = [start, self.lower[i], self.upper[i]];
        sizes.into_iter().map(f64::abs).find(|&size| size > 0.0 && size.is_finite())
    }
}

/// One `[[constraints]]` entry.
#[derive(Debug, Clone)]
pub struct Row {
    pub name: String,
    pub require: String,
    /// `for`, `only`, `where`, `by`, …
    pub scope: Entries,
}

/// How a value of the file follows from one of the draft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// factor·v + shift
    Affine(f64, f64),
    /// 1/v
    Reciprocal,
}

impl Step {
    pub fn apply(self, value: f64) -> f64 {
        match self {
            Step::Affine(factor, shift) => factor * value + shift,
            Step::Reciprocal => value.recip(),
        }
    }
}

/// Where a scalar variable of the file is now.
#[derive(Debug, Clone)]
pub struct Origin {
    pub in_file: String,
    pub now: String,
    /// The latest first: from the draft's value back to the file's.
    pub steps: Vec<Step>,
    /// How large the file's own answer makes it; 1 where it is 0 there, or nothing is known.
    pub size: f64,
}

impl Origin {
    /// Its size in the draft's units.
    pub fn size_in_draft(&self) -> f64 {
        let factor = |step: &Step| if let Step::Affine(factor, _) = step { factor.abs() } else { 1.0 };
        self.size / self.steps.iter().map(factor).product::<f64>()
    }

    /// How far the draft's zero lies from the file's, in the file's unit.
    pub fn offset(&self) -> f64 {
        let is_affine = self.steps.iter().all(|step| *step != Step::Reciprocal);
        if is_affine { self.steps.iter().fold(0.0, |value, step| step.apply(value)).abs() } else { 0.0 }
    }
}

/// The whole file.
#[derive(Debug, Clone)]
pub struct Draft {
    pub maximize: bool,
    pub objective: String,
    pub parameters: Entries,
    pub definitions: Entries,
    pub sections: Entries,
    pub variables: Vec<Variable>,
    pub rows: Vec<Row>,
    /// Everything else, as it stands in the file.
    pub rest: Entries,
    /// Bounds and start of variables that sections declare, by `SECTION.DIMENSION`.
    pub ranges: HashMap<String, [f64; 3]>,
    /// Every scalar variable of the file.
    pub origins: Vec<Origin>,
    /// The draft's objective is this many times the file's, both to be minimised.
    pub factor: f64,
}

impl Draft {
    /// Whether formulas and variables are all there is: no item's own names can hide a variable's.
    pub fn is_algebraic(&self) -> bool {
        let known = ["title", "units", "solver"];
        self.sections.is_empty() && self.rest.iter().all(|(key, _)| known.contains(&key.as_str()))
    }

    /// Whether bounds are so far out that in other units there are no numbers for what lies there.
    pub fn goes_to_the_end_of_numbers(&self) -> bool {
        let bounds = self.variables.iter().flat_map(|variable| variable.lower.iter().chain(&variable.upper));
        bounds.map(|bound| bound.abs()).any(|bound| bound.is_finite() && bound > LAST_NUMBERS)
    }

    /// A name like the wish that stands nowhere yet.
    pub fn fresh(&self, wish: &str) -> String {
        let (text, letter) = (self.text(), |c: char| if c.is_ascii_alphanumeric() { c } else { '_' });
        let mut name: String = wish.chars().map(letter).collect::<String>() + "_";
        while text.contains(&name) {
            name.push('_');
        }
        name
    }

    /// Variable `old` (a scalar of the draft) is now `step` of variable `new`.
    pub fn track(&mut self, old: &str, new: &str, step: Step) {
        for origin in self.origins.iter_mut().filter(|origin| origin.now == old) {
            origin.now = new.into();
            if step != Step::Affine(1.0, 0.0) {
                origin.steps.insert(0, step);
            }
        }
    }

    /// What a solve of the file itself is taken back by.
    pub fn untransformed(&self) -> Draft {
        let as_it_is = |origin: &Origin| Origin { now: origin.in_file.clone(), steps: Vec::new(), ..origin.clone() };
        Draft { origins: self.origins.iter().map(as_it_is).collect(), factor: 1.0, ..self.clone() }
    }

    /// The file.
    pub fn text(&self) -> String {
        let mut out = String::new();
        for (key, value) in &self.rest {
            line(&mut out, key, value);
        }
        line(&mut out, if self.maximize { "maximize" } else { "minimize" }, &self.objective.as_str().into());
        for (title, entries) in [("parameters", &self.parameters), ("definitions", &self.definitions)] {
            if !entries.is_empty() {
                let _ = write!(out, "\n[{title}]\n");
            }
            entries.iter().for_each(|(key, value)| line(&mut out, key, value));
        }
        if !self.variables.is_empty() {
            out.push_str("\n[variables]\n");
        }
        self.variables.iter().for_each(|variable| line(&mut out, &variable.name, &declaration(variable)));
        for (name, section) in &self.sections {
            let _ = write!(out, "\n[sections.{}]\n", key_text(name));
            let fields = section.as_table().into_iter().flatten();
            fields.for_each(|(key, value)| line(&mut out, key, value));
        }
        for row in &self.rows {
            out.push_str("\n[[constraints]]\n");
            line(&mut out, "name", &row.name.as_str().into());
            row.scope.iter().for_each(|(key, value)| line(&mut out, key, value));
            line(&mut out, "require", &row.require.as_str().into());
        }
        out
    }
}

fn line(out: &mut String, key: &str, value: &Value) {
    let _ = writeln!(out, "{} = {value}", key_text(key));
}

fn key_text(key: &str) -> String {
    let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { key.into() } else { Value::from(key).to_string() }
}

fn declaration(variable: &Variable) -> Value {
    let numbers = |values: &[f64]| match variable.is_array {
        true => Value::from(values.to_vec()),
        false => Value::from(values[0]),
    };
    let mut fields = toml::Table::new();
    if variable.is_array {
        fields.insert("size".into(), Value::Integer(variable.lower.len() as i64));
    }
    fields.insert("lower".into(), numbers(&variable.lower));
    fields.insert("upper".into(), numbers(&variable.upper));
    if let Some(start) = &variable.start {
        fields.insert("start".into(), numbers(start));
    }
    Value::Table(fields)
}
