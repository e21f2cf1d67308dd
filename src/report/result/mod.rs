//! `result.json`, format `ribopt-result/1`, written piece by piece: a million variables are never a tree in memory.
//! Numbers that are none become `null`.

mod conflict;
mod mistakes;
mod point;
mod solutions;

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::checks::Said;
use super::{Findings, Volumes};
use conflict::ConflictPart;
pub use mistakes::{Mistake, write_mistakes};
use point::{BoundsPart, ConstraintsPart, NamedValues, RibsPart};
use solutions::{AgreementPart, MinimaPart, SolutionsPart};

/// The `format` of the file.
pub const FORMAT: &str = "ribopt-result/1";

/// Beyond this many variables and rows the file is written without line breaks.
const MOST_PRETTY: usize = 10_000;

/// Writes the result.
///
/// # Errors
/// Whatever the writer says.
pub fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let meta = findings.model.meta();
    if meta.variables() + meta.rows() <= MOST_PRETTY {
        serde_json::to_writer_pretty(&mut *out, &ResultFile(findings))?;
        return out.write_all(b"\n");
    }
    let (head, tail) = (serde_json::to_vec(&Head(findings))?, serde_json::to_vec(&Tail(findings))?);
    out.write_all(head.strip_suffix(b"}").unwrap_or(&head))?;
    point::write_lists(findings, out)?;
    out.write_all(b",")?;
    out.write_all(tail.strip_prefix(b"{").unwrap_or(&tail))?;
    out.write_all(b"\n")
}

/// Writes any JSON value, indented.
///
/// # Errors
/// Whatever the writer says.
pub fn write_value(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    out.write_all(b"\n")
}

struct ResultFile<'a>(&'a Findings<'a>);

impl Serialize for ResultFile<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (findings, mut map) = (self.0, serializer.serialize_map(None)?);
        Head(findings).entries(&mut map)?;
        map.serialize_entry("variables", &NamedValues { findings, x: &findings.outcome.x })?;
        map.serialize_entry("bounds", &BoundsPart(findings))?;
        map.serialize_entry("constraints", &ConstraintsPart(findings))?;
        Tail(findings).entries(&mut map)?;
        map.end()
    }
}

/// What stands before the lists of variables and rows.
struct Head<'a>(&'a Findings<'a>);

impl Head<'_> {
    fn entries<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        let (findings, outcome) = (self.0, self.0.outcome);
        map.serialize_entry("format", FORMAT)?;
        map.serialize_entry("version", env!("CARGO_PKG_VERSION"))?;
        map.serialize_entry("problem", &ProblemPart::of(findings))?;
        map.serialize_entry("status", outcome.status.as_str())?;
        map.serialize_entry("scope", outcome.scope.as_str())?;
        map.serialize_entry("message", &outcome.message)?;
        map.serialize_entry("remedy", &outcome.remedy)?;
        map.serialize_entry("objective", &findings.objective())?;
        map.serialize_entry("lower_bound", &findings.lower_bound())?;
        map.serialize_entry("volume", &findings.volumes as &Option<Volumes>)?;
        map.serialize_entry("mass", &findings.mass)?;
        let chosen: BTreeMap<&str, &str> =
            findings.about.chosen.iter().map(|(name, row)| (name.as_str(), row.as_str())).collect();
        if chosen.is_empty() { Ok(()) } else { map.serialize_entry("chosen", &chosen) }
    }
}

impl Serialize for Head<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        self.entries(&mut map)?;
        map.end()
    }
}

/// What stands after them.
struct Tail<'a>(&'a Findings<'a>);

impl Tail<'_> {
    fn entries<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        let (findings, outcome) = (self.0, self.0.outcome);
        if let Some(table) = findings.utilisation.filter(|table| table.is_of_structure()) {
            map.serialize_entry("ribs", &RibsPart(table))?;
        }
        map.serialize_entry("solutions", &SolutionsPart(findings))?;
        map.serialize_entry("agreement", &outcome.agreement.map(AgreementPart::from))?;
        map.serialize_entry("conflict", &ConflictPart::of(findings))?;
        map.serialize_entry("direction", &outcome.direction.as_ref().map(|x| NamedValues { findings, x }))?;
        map.serialize_entry("runaway", &names(&outcome.runaway, |j| findings.model.variable_name(j)))?;
        map.serialize_entry("minima", &MinimaPart(findings))?;
        if !findings.about.checks.is_empty() {
            map.serialize_entry("checks", &Said(&findings.about.checks))?;
        }
        map.serialize_entry("warnings", &findings.about.warnings)?;
        map.serialize_entry("mistakes", &[(); 0])
    }
}

impl Serialize for Tail<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        self.entries(&mut map)?;
        map.end()
    }
}

fn names(indices: &[usize], name: impl Fn(usize) -> String) -> Vec<String> {
    indices.iter().map(|&at| name(at)).collect()
}

#[derive(Serialize)]
struct ProblemPart<'a> {
    title: &'a str,
    file: &'a str,
    sha256: &'a str,
    variables: usize,
    constraints: usize,
    class: String,
    sense: &'static str,
    objective: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    objective_unit: Option<String>,
    units: BTreeMap<&'a str, &'a str>,
    /// By own unit: the one that reports show instead, and how many of it one is.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    show: BTreeMap<String, (String, f64)>,
    changes: &'a [String],
}

impl<'a> ProblemPart<'a> {
    fn of(findings: &Findings<'a>) -> Self {
        let (about, meta) = (findings.about, findings.model.meta());
        ProblemPart {
            title: &about.title,
            file: &about.file,
            sha256: &about.sha256,
            variables: meta.variables(),
            constraints: meta.rows(),
            class: findings.class.to_string(),
            sense: if findings.sign() < 0.0 { "maximize" } else { "minimize" },
            objective: &about.objective,
            objective_unit: about.shown.own_of_objective(),
            units: about.units.iter().map(|(key, label)| (key.as_str(), label.as_str())).collect(),
            show: about.shown.instead().map(|(own, label)| (own, (label.name, label.factor))).collect(),
            changes: &about.changes,
        }
    }
}
