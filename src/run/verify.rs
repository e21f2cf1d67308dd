//! `verify`: what a point found elsewhere is.

use std::path::Path;

use super::coinciding;
use super::present::present;
use super::vanished::without_vanished;
use super::{RunError, Subject, sizes, utilisation};
use crate::certificate::{Certificate, Extent, Tolerances, certify};
use crate::crosscheck::{Outcome, Status};
use crate::report::answer::EarlierAnswer;
use crate::report::{Findings, Volumes};

/// What was found of a point.
pub struct Verified {
    /// The verdict; it has no solutions.
    pub outcome: Outcome,
    volumes: Option<Volumes>,
    mass: Option<f64>,
    utilisation: Option<utilisation::Table>,
}

impl Verified {
    /// What reports speak of.
    pub fn findings<'a>(&'a self, subject: &'a Subject) -> Findings<'a> {
        Findings {
            about: &subject.about,
            model: subject.shown(),
            class: subject.class(),
            outcome: &self.outcome,
            volumes: self.volumes,
            mass: self.mass,
            utilisation: self.utilisation.as_ref(),
        }
    }
}

/// Certifies the point of an answer file, and measures it.
///
/// # Errors
/// Where the answer cannot be read or is not a point of this problem.
pub fn verify(subject: &Subject, answer: &Path) -> Result<Verified, RunError> {
    verify_answer(subject, &EarlierAnswer::read(answer)?)
}

/// The same of an answer that was read.
///
/// # Errors
/// Where it is not a point of this problem.
pub fn verify_answer(subject: &Subject, answer: &EarlierAnswer) -> Result<Verified, RunError> {
    let outcome = certified(subject, answer)?;
    let volumes = subject.volumes(&outcome.x);
    let (mass, utilisation) = (sizes::mass(subject.problem(), &outcome.x), utilisation::table(subject, &outcome.x).ok());
    Ok(Verified { outcome, volumes, mass, utilisation })
}

fn certified(subject: &Subject, answer: &EarlierAnswer) -> Result<Outcome, RunError> {
    let point = answer.point(subject.shown())?;
    if let Some((rest, x, remark)) = without_vanished(subject, &point) {
        let found = judged(&rest, &x);
        let message = format!("{remark}. Of the structure without them: {}", found.message);
        return Ok(Outcome { message, scope: Extent::Local, ..found });
    }
    if let Some((refined, words)) = coinciding::refined(subject, &point) {
        let found = coinciding::unless_undecided(&refined, judged(&refined, &point));
        let message = format!("{words} {}", found.message);
        return Ok(Outcome { message, scope: Extent::Local, ..found });
    }
    Ok(coinciding::unless_undecided(subject, judged(subject, &point)))
}

/// What a point of the user's variables is.
fn judged(subject: &Subject, point: &[f64]) -> Outcome {
    let x = subject.completed(point.to_vec());
    let settings = &subject.settings;
    let tolerances = Tolerances { optimality: settings.optimality_tolerance, constraint: settings.constraint_tolerance };
    let outcome = match certify(subject.model(), subject.class(), &x, None, tolerances) {
        Err(error) => Outcome { status: Status::InvalidValue, message: error.to_string(), x, ..Outcome::default() },
        Ok(certificate) => Outcome {
            status: if certificate.certified { Status::Certified } else { Status::Uncertified },
            scope: certificate.scope,
            message: message(&certificate, subject.sign()),
            objective: Some(certificate.objective),
            certificate: Some(certificate),
            x,
            ..Outcome::default()
        },
    };
    present(subject, outcome)
}

fn message(certificate: &Certificate, sign: f64) -> String {
    let optimum = if sign < 0.0 { "maximum" } else { "minimum" };
    match (certificate.certified, certificate.scope) {
        (true, Extent::Global) => format!("The point is the global {optimum}."),
        (true, Extent::Local) => format!("The point is a local {optimum}."),
        (false, _) => "The point does not pass the certificate.".into(),
    }
}
