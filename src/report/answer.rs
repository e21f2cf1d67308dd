//! Reads an answer back: a `result.json`, or a CSV with the columns `name,value`.

use std::collections::HashSet;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;

use super::named_numbers::{self, NamedNumbers};
use super::text::listing;
use crate::files;
use crate::math::within;
use crate::model::Model;

/// Values by variable name, and multipliers by row name where there are any.
#[derive(Debug, Default)]
pub struct EarlierAnswer {
    values: NamedNumbers,
    multipliers: NamedNumbers,
}

/// Why an answer cannot be used.
#[derive(Debug, Error)]
pub enum AnswerError {
    /// The file cannot be read.
    #[error("cannot read the answer {path}: {cause}; it must be a result.json or a CSV with the columns name,value")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        cause: String,
    },
    /// Variables of the problem have no value.
    #[error("the answer has no value for {0}; here it must have one for every variable of the problem")]
    Missing(String),
    /// Names that are no variables of the problem.
    #[error("the answer names {0}, which the problem does not have; is it the answer to another problem?")]
    Unknown(String),
}

#[derive(Deserialize)]
struct ResultFile {
    variables: NamedNumbers,
    #[serde(default, deserialize_with = "named_numbers::multipliers")]
    constraints: NamedNumbers,
}

impl EarlierAnswer {
    /// Reads a file, or standard input by the name `-`; what neither begins with a brace nor is called `.json` is taken for a CSV.
    ///
    /// # Errors
    /// Where it cannot be opened, is not of that form, or a value is not a finite number.
    pub fn read(path: &Path) -> Result<EarlierAnswer, AnswerError> {
        let unreadable = |cause: String| AnswerError::Unreadable { path: path.into(), cause };
        let file = files::open(path).map_err(|cause| unreadable(cause.to_string()))?;
        let mut file = BufReader::with_capacity(1 << 18, file);
        // Nothing but JSON begins with a brace.
        let is_json = file.fill_buf().map_err(|cause| unreadable(cause.to_string()))?.trim_ascii_start().starts_with(b"{");
        let is_json = is_json || path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
        let answer = if is_json { Self::from_json(file) } else { Self::from_csv(file) };
        answer.map_err(unreadable)
    }

    /// Reads the text of a `result.json`, or of its part `variables` alone.
    ///
    /// # Errors
    /// Where it is not of that form, or a value is not a finite number.
    ///
    /// ```
    /// use ribopt::report::answer::EarlierAnswer;
    /// assert!(EarlierAnswer::of_text(r#"{ "variables": { "depth": 0.3 } }"#).is_ok());
    /// assert!(EarlierAnswer::of_text(r#"{ "variables": { "depth": null } }"#).is_err());
    /// ```
    pub fn of_text(json: &str) -> Result<EarlierAnswer, AnswerError> {
        Self::from_json(json.as_bytes()).map_err(|cause| AnswerError::Unreadable { path: "given".into(), cause })
    }

    fn from_json(file: impl io::Read) -> Result<EarlierAnswer, String> {
        let ResultFile { variables, constraints } = serde_json::from_reader(file).map_err(|error| error.to_string())?;
        if let Some((name, _)) = variables.iter().find(|(_, value)| !value.is_finite()) {
            return Err(format!("{name} has no value"));
        }
        Ok(EarlierAnswer { values: variables, multipliers: constraints })
    }

    fn from_csv(file: impl io::Read) -> Result<EarlierAnswer, String> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
        let header = reader.headers().map_err(|error| error.to_string())?.clone();
        let column = |wanted: &str| {
            let found = header.iter().position(|name| name.trim_start_matches('\u{feff}') == wanted);
            found.ok_or_else(|| format!("its first line has no column {wanted}"))
        };
        let (name, value) = (column("name")?, column("value")?);
        let (mut values, mut known) = (NamedNumbers::default(), HashSet::new());
        for record in reader.records() {
            let record = record.map_err(|error| error.to_string())?;
            let line = record.position().map_or(0, csv::Position::line);
            let (name, text) = (record.get(name).unwrap_or_default(), record.get(value).unwrap_or_default());
            let name = unquoted(name);
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            let number = number.ok_or_else(|| format!("line {line}: the value of {name} is {text:?}, not a finite number"))?;
            if !known.insert(name.to_string()) {
                return Err(format!("line {line}: {name} is given twice"));
            }
            values.push(name, number);
        }
        Ok(EarlierAnswer { values, multipliers: NamedNumbers::default() })
    }

    /// The point itself.
    ///
    /// # Errors
    /// Where a variable has no value, or a name is no variable.
    pub fn point(&self, model: &dyn Model) -> Result<Vec<f64>, AnswerError> {
        let (x, missing) = self.values_or(model, &model.meta().start);
        if !missing.is_empty() {
            return Err(AnswerError::Missing(listing(missing.into_iter(), 5)));
        }
        if x.len() < self.values.len() {
            return Err(AnswerError::Unknown(listing(self.unknown(model).into_iter(), 5)));
        }
        Ok(x)
    }

    /// The point as a start: what it does not give stays as it is, what lies outside the bounds is moved inside. Also says
    /// what was done, in sentences.
    pub fn start(&self, model: &dyn Model) -> (Vec<f64>, Vec<String>) {
        let meta = model.meta();
        let (mut x, missing) = self.values_or(model, &meta.start);
        let mut remarks = Vec::new();
        if !missing.is_empty() {
            remarks.push(format!("the answer started from has no value for {}", listing(missing.into_iter(), 5)));
        } else if x.len() < self.values.len() {
            remarks.push(format!("the answer started from also names {}", listing(self.unknown(model).into_iter(), 5)));
        }
        let mut moved = Vec::new();
        for (j, value) in x.iter_mut().enumerate() {
            // Bounds are ordered and no NaN by the time a model exists.
            let inside = within(*value, meta.lower[j], meta.upper[j]);
            if inside != *value {
                moved.push(model.variable_name(j));
                *value = inside;
            }
        }
        if !moved.is_empty() {
            remarks.push(format!("the start was moved inside the bounds: {}", listing(moved.into_iter(), 5)));
        }
        (x, remarks)
    }

    /// Row multipliers of the minimised form, where the answer has one for every row; `sign` is −1 where the user maximises.
    pub fn multipliers(&self, model: &dyn Model, sign: f64) -> Option<Vec<f64>> {
        let rows = 0..model.meta().rows();
        if self.multipliers.is_empty() {
            return None;
        }
        rows.map(|i| self.multipliers.get(i, &model.row_name(i)).map(|y| sign * y)).collect()
    }

    /// Values in the model's order, the others from `otherwise`, and the names of those.
    fn values_or(&self, model: &dyn Model, otherwise: &[f64]) -> (Vec<f64>, Vec<String>) {
        let mut missing = Vec::new();
        let value = |(j, &otherwise): (usize, &f64)| {
            let name = model.variable_name(j);
            self.values.get(j, &name).unwrap_or_else(|| {
                missing.push(name);
                otherwise
            })
        };
        (otherwise.iter().enumerate().map(value).collect(), missing)
    }

    fn unknown(&self, model: &dyn Model) -> Vec<String> {
        let known: HashSet<String> = (0..model.meta().variables()).map(|j| model.variable_name(j)).collect();
        let mut unknown: Vec<String> =
            self.values.iter().map(|(name, _)| name).filter(|name| !known.contains(*name)).map(str::to_string).collect();
        unknown.sort();
        unknown
    }
}

/// A name without the apostrophe that keeps a spreadsheet from reading it as a formula, see [`super::text::cell`].
fn unquoted(name: &str) -> &str {
    name.strip_prefix('\'').filter(|rest| rest.starts_with(['=', '+', '-', '@'])).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{EvaluationError, Meta};

    struct Three(Meta);

    impl Model for Three {
        fn meta(&self) -> &Meta {
            &self.0
        }
        fn objective(&self, _: &[f64]) -> Result<f64, EvaluationError> {
            Ok(0.0)
        }
        fn gradient(&self, _: &[f64], _: &mut [f64]) -> Result<f64, EvaluationError> {
            Ok(0.0)
        }
        fn constraints(&self, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
            Ok(())
        }
        fn jacobian(&self, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
            Ok(())
        }
        fn hessian(&self, _: &[f64], _: f64, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
            Ok(())
        }
    }

    fn three() -> Three {
        let (lower, upper, start) = (vec![0.0; 3], vec![1.0; 3], vec![0.5; 3]);
        let (row_lower, row_upper) = (vec![0.0], vec![1.0]);
        Three(Meta { lower, upper, start, row_lower, row_upper, ..Meta::default() })
    }

    fn csv(text: &str) -> Result<EarlierAnswer, String> {
        EarlierAnswer::from_csv(text.as_bytes())
    }

    #[test]
    fn a_csv_gives_the_point() {
        let answer = csv("name,value\nx[3],0.25\nx[1],1\nx[2], 1e-3\n").unwrap();
        assert_eq!(answer.point(&three()).unwrap(), [1.0, 1e-3, 0.25]);
    }

    #[test]
    fn a_result_gives_point_and_multipliers() {
        let text = r#"{"variables": {"x[1]": 0.5, "x[2]": 0.25, "x[3]": 1}, "constraints": [{"name": "c1", "multiplier": 2.5}]}"#;
        let answer = EarlierAnswer::from_json(text.as_bytes()).unwrap();
        assert_eq!(answer.point(&three()).unwrap(), [0.5, 0.25, 1.0]);
        assert_eq!(answer.multipliers(&three(), -1.0), Some(vec![-2.5]));
    }

    #[test]
    fn mistakes_name_line_and_variable() {
        assert_eq!(csv("name,value\nx[1],nan\n").unwrap_err(), "line 2: the value of x[1] is \"nan\", not a finite number");
        assert_eq!(csv("name,value\na,1\na,2\n").unwrap_err(), "line 3: a is given twice");
        assert_eq!(csv("variable,value\na,1\n").unwrap_err(), "its first line has no column name");
        let missing = csv("name,value\nx[1],1\n").unwrap().point(&three()).unwrap_err().to_string();
        assert!(missing.contains("no value for x[2], x[3]"), "{missing}");
        let unknown = csv("name,value\nx[1],1\nx[2],1\nx[3],1\ny,1\n").unwrap().point(&three()).unwrap_err().to_string();
        assert!(unknown.contains("names y,"), "{unknown}");
    }

    #[test]
    fn a_start_is_completed_and_moved_inside() {
        let (x, remarks) = csv("name,value\nx[1],7\n").unwrap().start(&three());
        assert_eq!(x, [1.0, 0.5, 0.5]);
        assert_eq!(remarks.len(), 2, "{remarks:?}");
    }
}
