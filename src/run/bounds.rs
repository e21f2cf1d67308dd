//! `bounds`: the note's bound-convergence test (§4.1.2). Only bounds remain; every variable's end is proved by the sign of the
//! exact gradient there.

use std::sync::atomic::AtomicBool;

use super::unobserved::unobserved;
use super::{Choice, Subject};
use crate::crosscheck::{Outcome, Task};
use crate::model::views::bounds_only::BoundsOnly;
use crate::model::{EvaluationError, Model};
use crate::problem::{Origin, Problem};
use crate::report::bounds::{End, Where};
use crate::sections;

/// A variable this close to a bound, relative to its size, has gone there.
const AT_BOUND: f64 = 1e-5;

/// A derivative below this, relative to the largest one, has no sign that rounding leaves beyond doubt.
const SIGN_IN_DOUBT: f64 = 1e-13;

/// Where every variable went.
pub struct BoundTest {
    /// The run without rows.
    pub outcome: Outcome,
    /// One end per variable, or the term that has no value there.
    pub ends: Result<Vec<End>, EvaluationError>,
}

impl BoundTest {
    /// The exit code of `bounds`: 0 where every end is proved (and, if strict, is the lower bound).
    pub fn exit_code(&self, strict: bool) -> u8 {
        let holds = |end: &End| end.proved && (!strict || matches!(end.at, Where::Lower | Where::Fixed));
        u8::from(!self.ends.as_ref().is_ok_and(|ends| ends.iter().all(holds)))
    }
}

/// Drops the rows, solves, and proves where the variables went.
pub fn bounds(subject: &Subject, choices: &[Choice], interrupt: Option<&AtomicBool>) -> BoundTest {
    let model = BoundsOnly::new(subject.shown());
    let task = Task {
        model: &model,
        substitution: None,
        class: subject.class(),
        settings: &subject.settings,
        start: &model.meta().start,
        start_multipliers: None,
        starts: 1,
        interrupt,
    };
    let outcome = unobserved(&task, choices);
    let ends = ends(&model, &outcome.x, subject.sign()).map(|mut ends| {
        for (j, end) in ends.iter_mut().enumerate() {
            end.reason = reason(subject.problem(), j, end);
        }
        ends
    });
    BoundTest { outcome, ends }
}

/// Puts every variable that is near a bound exactly there and looks at the signs of the exact gradient at that point.
fn ends(model: &dyn Model, x: &[f64], sign: f64) -> Result<Vec<End>, EvaluationError> {
    let meta = model.meta();
    let places: Vec<(Where, f64)> = (0..x.len()).map(|j| place(meta.lower[j], meta.upper[j], meta.start[j], x[j])).collect();
    let corner: Vec<f64> = places.iter().map(|&(_, value)| value).collect();
    let mut gradient = vec![0.0; x.len()];
    model.gradient(&corner, &mut gradient)?;
    let scale = |j: usize| if corner[j] == 0.0 && meta.start[j] == 0.0 { 1.0 } else { corner[j].abs().max(meta.start[j].abs()) };
    let largest = gradient.iter().enumerate().fold(0.0, |most: f64, (j, slope)| most.max(slope.abs() * scale(j)));
    let end = |(j, &(at, value)): (usize, &(Where, f64))| {
        let slope = gradient[j];
        let certain = slope.abs() * scale(j) > SIGN_IN_DOUBT * largest;
        let proved = match at {
            Where::Fixed => true,
            Where::Lower => certain && slope > 0.0,
            Where::Upper => certain && slope < 0.0,
            Where::Inside => false,
        };
        End { name: model.variable_name(j), value, at, derivative: sign * slope, proved, reason: None }
    };
    Ok(places.iter().enumerate().map(end).collect())
}

fn place(lower: f64, upper: f64, start: f64, x: f64) -> (Where, f64) {
    let near = |bound: f64| (x - bound).abs() <= AT_BOUND * bound.abs().max(start.abs()).max(f64::MIN_POSITIVE);
    if lower == upper {
        (Where::Fixed, lower)
    } else if near(lower) && (x - lower).abs() <= (upper - x).abs() {
        (Where::Lower, lower)
    } else if near(upper) {
        (Where::Upper, upper)
    } else {
        (Where::Inside, x)
    }
}

/// Why a variable ends elsewhere than at its lower bound, where the shape of its section explains it.
fn reason(problem: &Problem, j: usize, end: &End) -> Option<String> {
    let Origin::Dimension(section, position) = *problem.variables.origin.get(j)? else {
        return match end.at {
            Where::Inside if end.derivative == 0.0 => Some("nothing depends on it".into()),
            _ => None,
        };
    };
    let form = sections::form(*problem.sections.form.get(section as usize)?);
    let dimension = *form.dimensions.get(usize::from(position))?;
    if end.at == Where::Upper
        && let Some(kind) = sections::kind(form.kind)
        && let Some(why) = kind.explain_upper_bound(form, dimension, &problem.sections.names[section as usize])
    {
        return Some(why);
    }
    (end.at == Where::Inside && end.derivative == 0.0).then(|| "no rib depends on it".into())
}
