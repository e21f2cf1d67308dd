//! `result.json`, format `ribopt-result/1`, written piece by piece: a million variables are never a tree in memory.
//! Numbers that are none become `null`.

use std::io::{self, Write};

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::{Findings, Volumes};
use crate::backends::Termination;
use crate::certificate::Scope;
use crate::crosscheck::Answer;

/// The `format` of the file.
pub const FORMAT: &str = "ribopt-result/1";

/// Beyond this many variables and rows the file is written without line breaks.
const MOST_PRETTY: usize = 10_000;

/// A mistake of the command line or the problem file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mistake {
    /// The file it is in.
    pub file: Option<String>,
    /// Line, counted from 1.
    pub line: Option<usize>,
    /// Column, counted from 1 in characters.
    pub column: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What was expected, the nearest known name, the remedy.
    pub help: Option<String>,
}

impl Mistake {
    /// A mistake that is in no file.
    pub fn of_command(message: String) -> Mistake {
        Mistake { file: None, line: None, column: None, message, help: None }
    }
}

/// Writes the result.
///
/// # Errors
/// Whatever the writer says.
pub fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let meta = findings.model.meta();
    if meta.variables() + meta.rows() <= MOST_PRETTY {
        serde_json::to_writer_pretty(&mut *out, &ResultFile(findings))?;
    } else {
        serde_json::to_writer(&mut *out, &ResultFile(findings))?;
    }
    out.write_all(b"\n")
}

/// Writes the object that stands for a run that could not begin.
///
/// # Errors
/// Whatever the writer says.
pub fn write_mistakes(message: &str, mistakes: &[Mistake], out: &mut dyn Write) -> io::Result<()> {
    #[derive(Serialize)]
    struct Refused<'a> {
        format: &'static str,
        version: &'static str,
        status: &'static str,
        message: &'a str,
        mistakes: &'a [Mistake],
    }
    let version = env!("CARGO_PKG_VERSION");
    let refused = Refused { format: FORMAT, version, status: "invalid-input", message, mistakes };
    serde_json::to_writer_pretty(&mut *out, &refused)?;
    out.write_all(b"\n")
}

/// The word for why a run stopped.
pub fn termination(termination: Termination) -> &'static str {
    match termination {
        Termination::Converged => "converged",
        Termination::LimitReached => "limit-reached",
        Termination::Interrupted => "interrupted",
        Termination::Failed => "failed",
        Termination::Refused => "refused",
    }
}

/// The word for how far a certificate reaches.
pub fn scope(scope: Scope) -> &'static str {
    match scope {
        Scope::Global => "global",
        Scope::Local => "local",
    }
}

struct ResultFile<'a>(&'a Findings<'a>);

impl Serialize for ResultFile<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (findings, outcome) = (self.0, self.0.outcome);
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("format", FORMAT)?;
        map.serialize_entry("version", env!("CARGO_PKG_VERSION"))?;
        map.serialize_entry("problem", &ProblemPart::of(findings))?;
        map.serialize_entry("status", outcome.status.as_str())?;
        map.serialize_entry("scope", scope(outcome.scope))?;
        map.serialize_entry("message", &outcome.message)?;
        map.serialize_entry("remedy", &outcome.remedy)?;
        map.serialize_entry("objective", &findings.objective())?;
        map.serialize_entry("lower_bound", &findings.lower_bound())?;
        map.serialize_entry("volume", &findings.volumes as &Option<Volumes>)?;
        map.serialize_entry("variables", &Point { findings, x: &outcome.x })?;
        map.serialize_entry("bounds", &BoundsPart(findings))?;
        map.serialize_entry("constraints", &ConstraintsPart(findings))?;
        map.serialize_entry("solutions", &SolutionsPart(findings))?;
        map.serialize_entry("agreement", &outcome.agreement.map(AgreementPart::from))?;
        map.serialize_entry("conflict", &ConflictPart::of(findings))?;
        map.serialize_entry("direction", &outcome.direction.as_ref().map(|x| Point { findings, x }))?;
        map.serialize_entry("runaway", &names(&outcome.runaway, |j| findings.model.variable_name(j)))?;
        map.serialize_entry("minima", &MinimaPart(findings))?;
        map.serialize_entry("warnings", &findings.about.warnings)?;
        map.serialize_entry("mistakes", &[(); 0])?;
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
        }
    }
}

/// Values by variable name.
struct Point<'a> {
    findings: &'a Findings<'a>,
    x: &'a [f64],
}

impl Serialize for Point<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.x.iter().enumerate().map(|(j, value)| (self.findings.model.variable_name(j), value)))
    }
}

struct BoundsPart<'a>(&'a Findings<'a>);

impl Serialize for BoundsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Bound {
            name: String,
            active: &'static str,
            multiplier: f64,
            sensitivity: f64,
        }
        serializer.collect_seq((0..self.0.model.meta().variables()).map(|j| {
            let held = self.0.bound(j);
            let (multiplier, sensitivity) = (held.multiplier, held.sensitivity);
            Bound { name: self.0.model.variable_name(j), active: held.side.as_str(), multiplier, sensitivity }
        }))
    }
}

struct ConstraintsPart<'a>(&'a Findings<'a>);

impl Serialize for ConstraintsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Row {
            name: String,
            value: f64,
            lower: f64,
            upper: f64,
            active: &'static str,
            multiplier: f64,
            sensitivity: f64,
        }
        let meta = self.0.model.meta();
        serializer.collect_seq((0..meta.rows()).map(|i| {
            let held = self.0.row(i);
            Row {
                name: self.0.model.row_name(i),
                value: self.0.row_value(i),
                lower: meta.row_lower[i],
                upper: meta.row_upper[i],
                active: held.side.as_str(),
                multiplier: held.multiplier,
                sensitivity: held.sensitivity,
            }
        }))
    }
}

struct SolutionsPart<'a>(&'a Findings<'a>);

impl Serialize for SolutionsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.outcome.answers.iter().map(|answer| SolutionPart::of(self.0, answer)))
    }
}

#[derive(Serialize)]
struct SolutionPart<'a> {
    backend: &'static str,
    algorithm: &'a str,
    termination: &'static str,
    message: &'a str,
    objective: Option<f64>,
    iterations: Option<u64>,
    evaluations: u64,
    seconds: f64,
    certificate: Option<CertificatePart<'a>>,
    remarks: &'a [String],
}

#[derive(Serialize)]
struct CertificatePart<'a> {
    certified: bool,
    scope: &'static str,
    primal_infeasibility: f64,
    dual_infeasibility: f64,
    complementarity: f64,
    negative_curvature: bool,
    messages: &'a [String],
}

impl<'a> SolutionPart<'a> {
    fn of(findings: &Findings<'_>, answer: &'a Answer) -> Self {
        let solution = &answer.solution;
        SolutionPart {
            backend: answer.backend,
            algorithm: &solution.algorithm,
            termination: termination(solution.termination),
            message: &solution.message,
            objective: answer.objective.map(|value| findings.in_users_sense(value)),
            iterations: solution.iterations,
            evaluations: solution.evaluations,
            seconds: solution.seconds,
            certificate: answer.certificate.as_ref().map(|certificate| CertificatePart {
                certified: certificate.certified,
                scope: scope(certificate.scope),
                primal_infeasibility: certificate.primal_infeasibility,
                dual_infeasibility: certificate.dual_infeasibility,
                complementarity: certificate.complementarity,
                negative_curvature: certificate.negative_curvature,
                messages: &certificate.messages,
            }),
            remarks: &answer.remarks,
        }
    }
}

#[derive(Serialize)]
struct AgreementPart {
    agree: bool,
    objective_difference: f64,
    variable_difference: f64,
}

impl From<crate::crosscheck::Agreement> for AgreementPart {
    fn from(agreement: crate::crosscheck::Agreement) -> Self {
        let crate::crosscheck::Agreement { agree, objective_difference, variable_difference } = agreement;
        AgreementPart { agree, objective_difference, variable_difference }
    }
}

#[derive(Serialize)]
struct Amount {
    name: String,
    amount: f64,
}

#[derive(Serialize)]
struct ConflictPart {
    violated: Vec<Amount>,
    constraints: Vec<String>,
    bounds: Vec<String>,
    relaxations: Vec<Amount>,
    minimal: bool,
}

impl ConflictPart {
    fn of(findings: &Findings<'_>) -> Option<Self> {
        let (conflict, model) = (findings.outcome.conflict.as_ref()?, findings.model);
        let amounts = |list: &[(usize, f64)]| {
            list.iter().map(|&(i, amount)| Amount { name: model.row_name(i), amount }).collect::<Vec<_>>()
        };
        let side = |upper| if upper { "upper" } else { "lower" };
        Some(ConflictPart {
            violated: amounts(&conflict.violated_rows),
            constraints: names(&conflict.rows, |i| model.row_name(i)),
            bounds: conflict.bounds.iter().map(|&(j, upper)| format!("{}.{}", model.variable_name(j), side(upper))).collect(),
            relaxations: amounts(&conflict.relaxations),
            minimal: conflict.minimal,
        })
    }
}

struct MinimaPart<'a>(&'a Findings<'a>);

impl Serialize for MinimaPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct MinimumPart<'a> {
            objective: f64,
            count: usize,
            variables: Point<'a>,
        }
        let findings = self.0;
        serializer.collect_seq(findings.outcome.minima.iter().map(|minimum| MinimumPart {
            objective: findings.in_users_sense(minimum.objective),
            count: minimum.count,
            variables: Point { findings, x: &minimum.x },
        }))
    }
}
