//! `ribopt analyse`

use super::arguments::Analyse;
use super::failure::Failure;
use super::{output, reading};
use ribopt::report::number::short;
use ribopt::run::RunError;
use ribopt::run::analyse::{Analysis, AnalysisError, analyse};

/// The exit code where the structure cannot be analysed.
const NOT_ANALYSED: u8 = 6;

/// Analyses the structure and shows what it does; exit code 6 where it cannot be analysed.
pub fn run(arguments: &Analyse) -> Result<u8, Failure> {
    let subject = reading::read(&arguments.file, &arguments.changes.set, false)?;
    output::tell(&subject.warnings);
    if subject.problem().structure.is_none() {
        let message = format!("{} has no structure: no rib has a start and an end node", subject.about.file);
        return Err(RunError::Choice(message).into());
    }
    let analysis = match analyse(&subject, arguments.answer.as_deref(), arguments.gradient) {
        Ok(analysis) => analysis,
        Err(AnalysisError::Run(error)) => return Err(error.into()),
        Err(error) => {
            output::tell(&[error.to_string()]);
            return Ok(NOT_ANALYSED);
        }
    };
    output::print(|out| if arguments.json { json(&analysis, out) } else { text(&analysis, out) })?;
    Ok(0)
}

fn json(analysis: &Analysis, out: &mut dyn std::io::Write) -> std::io::Result<()> {
    use serde_json::{Map, Value, json};
    let number = |value: f64| json!(value);
    let definitions: Map<String, Value> = analysis.definitions.iter().map(|(name, value)| (name.clone(), number(*value))).collect();
    let mut whole = json!({ "definitions": definitions });
    if !analysis.gradient.is_empty() {
        let of = |row: &Vec<f64>| -> Map<String, Value> {
            analysis.variables.iter().cloned().zip(row.iter().map(|&value| number(value))).collect()
        };
        let gradient: Map<String, Value> =
            analysis.definitions.iter().zip(&analysis.gradient).map(|((name, _), row)| (name.clone(), of(row).into())).collect();
        whole["gradient"] = gradient.into();
    }
    serde_json::to_writer_pretty(&mut *out, &whole)?;
    writeln!(out)
}

fn text(analysis: &Analysis, out: &mut dyn std::io::Write) -> std::io::Result<()> {
    analysis.definitions.iter().try_for_each(|(name, value)| writeln!(out, "{name}: {}", short(*value)))
}
