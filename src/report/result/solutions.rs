//! What each backend brought, how far they agree, and the minima of a multi-start.

use serde::{Serialize, Serializer};

use super::super::Findings;
use super::point::NamedValues;
use crate::backends::Termination;
use crate::crosscheck::{Agreement, Answer};

/// The word for why a run stopped.
fn termination(termination: Termination) -> &'static str {
    match termination {
        Termination::Converged => "converged",
        Termination::LimitReached => "limit-reached",
        Termination::Interrupted => "interrupted",
        Termination::Failed => "failed",
        Termination::Refused => "refused",
    }
}

pub(super) struct SolutionsPart<'a>(pub &'a Findings<'a>);

impl Serialize for SolutionsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.outcome.answers.iter().map(|answer| SolutionPart::of(self.0, answer)))
    }
}

#[derive(Serialize)]
struct SolutionPart<'a> {
    backend: &'static str,
    attempt: usize,
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
            attempt: answer.attempt,
            algorithm: &solution.algorithm,
            termination: termination(solution.termination),
            message: &solution.message,
            objective: answer.objective.map(|value| findings.in_users_sense(value)),
            iterations: solution.iterations,
            evaluations: solution.evaluations,
            seconds: solution.seconds,
            certificate: answer.certificate.as_ref().map(|certificate| CertificatePart {
                certified: certificate.certified,
                scope: certificate.scope.as_str(),
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
pub(super) struct AgreementPart {
    agree: bool,
    objective_difference: f64,
    variable_difference: f64,
}

impl From<Agreement> for AgreementPart {
    fn from(agreement: Agreement) -> Self {
        let Agreement { agree, objective_difference, variable_difference } = agreement;
        AgreementPart { agree, objective_difference, variable_difference }
    }
}

pub(super) struct MinimaPart<'a>(pub &'a Findings<'a>);

impl Serialize for MinimaPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct MinimumPart<'a> {
            objective: f64,
            count: usize,
            variables: NamedValues<'a>,
        }
        let findings = self.0;
        serializer.collect_seq(findings.outcome.minima.iter().map(|minimum| MinimumPart {
            objective: findings.in_users_sense(minimum.objective),
            count: minimum.count,
            variables: NamedValues { findings, x: &minimum.x },
        }))
    }
}
