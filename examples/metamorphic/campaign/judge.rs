//! Whether a run of a transformed problem says what is true of the file.

use ribopt::certificate::Extent;
use ribopt::crosscheck::Status;
use ribopt::model::Class;

use super::kinds::Done;
use super::solving::{InFile, Run};

/// Of an objective, relative to max(1, |optimum|).
const ACCURACY: f64 = 1e-6;
/// The same where the minimum has no multipliers: what feasibility tolerates enters by a root.
const ACCURACY_WITHOUT_MULTIPLIERS: f64 = 5e-3;
/// A certified point taken back to the file may miss its limits by this much: the tolerance 1e-8 and what the way back rounds.
pub const FEASIBLE_IN_FILE: f64 = 1e-6;
/// A dual infeasibility in the file that no rounding of the way back explains: optimality is accepted at 1e-6.
const NOT_STATIONARY: f64 = 1e-4;
/// Points that have run off have the objective's infimum to this; a local minimum seldom has.
const SETTLED: f64 = 1e-3;
/// Seconds a run may take beyond its limit.
const GRACE: f64 = 1.0;

/// Faults, gravest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    WronglyCertified,
    WronglyInfeasible,
    Different,
}

impl Grade {
    pub const ALL: [Grade; 3] = [Grade::WronglyCertified, Grade::WronglyInfeasible, Grade::Different];

    pub fn words(self) -> &'static str {
        match self {
            Grade::WronglyCertified => "wrongly certified",
            Grade::WronglyInfeasible => "wrongly infeasible",
            Grade::Different => "otherwise different",
        }
    }
}

/// What is true of a file: by its comments, else by a run of the file as it is.
#[derive(Debug, Clone)]
pub struct Truth {
    pub status: Status,
    /// The optimum (to be minimised) and further minima that are no worse an answer.
    pub minima: Vec<f64>,
    pub without_multipliers: bool,
    /// Where the minimum is not attained: the objective of the run of the file as it is.
    pub settles: Option<f64>,
    /// Of the run of the file as it is.
    pub class: Class,
    pub scope: Extent,
}

/// A fault and why it is one.
pub type Fault = (Grade, String);

/// `None`: the verdict is right.
pub fn judge(truth: &Truth, done: &Done, run: &Run) -> Option<Fault> {
    let verdict = match (truth.status, run.status) {
        (Status::Certified, Status::Certified) => minimum(truth, done, run),
        (Status::Infeasible, Status::Infeasible) => lost_class_or_scope(truth, done, run),
        (Status::Uncertified, Status::Certified) => None,
        (_, Status::Infeasible) if is_local_from_elsewhere(done, run) => {
            Some((Grade::Different, "locally infeasible from another start".into()))
        }
        (Status::Certified | Status::Unbounded | Status::NotAttained, Status::Infeasible) => {
            Some((Grade::WronglyInfeasible, format!("a feasible problem, said with {:?} scope", run.scope).to_lowercase()))
        }
        (_, Status::Certified) if is_one_of(&truth.minima, run, ACCURACY) => None,
        (_, Status::Certified) if may_be_a_minimum(truth, done, run) => None,
        (was, Status::Certified) => Some((Grade::WronglyCertified, format!("the problem is {}", was.as_str()))),
        (Status::Certified, Status::Uncertified)
            if truth.without_multipliers && is_one_of(&truth.minima, run, ACCURACY_WITHOUT_MULTIPLIERS) =>
        {
            None
        }
        (was, is) if was == is => None,
        (was, is) => Some((Grade::Different, format!("{} instead of {}", is.as_str(), was.as_str()))),
    };
    verdict.or_else(|| false_bound(truth, run))
}

/// A run that ends long after its limit.
pub fn is_late(run: &Run, limit: f64) -> bool {
    run.seconds > limit + GRACE
}

fn is_local_from_elsewhere(done: &Done, run: &Run) -> bool {
    done.moves_start && run.scope == Extent::Local && run.class == Class::Nonlinear
}

/// From another start a problem that is unbounded or not attained may have a local minimum. The file confirms it, and it is not where
/// the objective settles at as variables run off.
fn may_be_a_minimum(truth: &Truth, done: &Done, run: &Run) -> bool {
    let confirmed = run.in_file.as_ref().is_some_and(|in_file| in_file.certificate.certified);
    let settled = truth.settles.zip(run.objective).is_some_and(|(infimum, value)| near(value, infimum, SETTLED));
    is_local_from_elsewhere(done, run) && confirmed && truth.status != Status::Infeasible && !settled
}

fn near(value: f64, known: f64, accuracy: f64) -> bool {
    (value - known).abs() <= accuracy * known.abs().max(1.0)
}

fn is_one_of(minima: &[f64], run: &Run, accuracy: f64) -> bool {
    run.objective.is_some_and(|value| minima.iter().any(|&known| near(value, known, accuracy)))
}

fn minimum(truth: &Truth, done: &Done, run: &Run) -> Option<Fault> {
    let wrong = |why: String| Some((Grade::WronglyCertified, why));
    let value = run.objective.unwrap_or(f64::NAN);
    if let Some(why) = run.in_file.as_ref().and_then(|in_file| contradiction(value, in_file)) {
        return wrong(why);
    }
    if is_one_of(&truth.minima, run, ACCURACY) {
        return lost_class_or_scope(truth, done, run);
    }
    if truth.without_multipliers && is_one_of(&truth.minima, run, ACCURACY_WITHOUT_MULTIPLIERS) {
        return None;
    }
    let best = truth.minima.iter().copied().fold(f64::INFINITY, f64::min);
    if run.in_file.as_ref().is_some_and(|in_file| is_left_by_the_slope(value - best, in_file)) {
        return lost_class_or_scope(truth, done, run);
    }
    let off = (value - best) / best.abs().max(1.0);
    if off < 0.0 {
        return wrong(format!("below the optimum {best:?} by {:.1e}", -off));
    }
    if is_within_its_bound(run, best) {
        return Some((Grade::Different, format!("above the optimum {best:?} by {off:.1e}, as the lower bound printed says")));
    }
    if run.scope == Extent::Global || truth.class.is_global() {
        return wrong(format!("above the optimum {best:?} of a {} problem by {off:.1e}", truth.class));
    }
    another_minimum(run.in_file.as_ref(), &format!("above {best:?} by {off:.1e}"))
}

/// Whether this much above the minimum is what the accepted slope leaves: ACCURACY·σ beside a curvature of a quarter of σ leaves 2·ACCURACY²·σ.
/// (x − 5e9)² from x = 0 has σ = 5e19 to 1e20.
fn is_left_by_the_slope(gap: f64, in_file: &InFile) -> bool {
    let own = &in_file.certificate;
    own.certified && gap >= 0.0 && gap <= 2.0 * ACCURACY * ACCURACY * own.sigma
}

/// A global minimum is said with what is proved of it: a gap this small that the lower bound tells is no false word.
fn is_within_its_bound(run: &Run, best: f64) -> bool {
    let (Some(bound), Some(value)) = (run.lower_bound, run.objective) else { return false };
    bound <= best && near(value, bound, 10.0 * ACCURACY)
}

/// What the file itself has against a certified point.
fn contradiction(value: f64, in_file: &InFile) -> Option<String> {
    if in_file.misses > FEASIBLE_IN_FILE {
        return Some(format!("the point misses the file's limits by {:.1e}", in_file.misses));
    }
    let in_file = &in_file.certificate;
    let same = near(value, in_file.objective, 10.0 * ACCURACY);
    (!same).then(|| format!("the file's objective at the point is {:?}, not {value:?}", in_file.objective))
}

/// A certified value that is not among the known ones, in a problem whose minima are local: where the file certifies the point, too, it is an
/// acceptable local answer, whatever path has led there.
fn another_minimum(in_file: Option<&InFile>, off: &str) -> Option<Fault> {
    let Some(in_file) = in_file else { return Some((Grade::Different, format!("{off}, which the file cannot be asked about"))) };
    let in_file = &in_file.certificate;
    if in_file.certified {
        return None;
    }
    let measures =
        format!("dual infeasibility {:.1e}, negative curvature {}", in_file.dual_infeasibility, in_file.negative_curvature);
    let is_none = in_file.negative_curvature || in_file.descends_at_higher_order || in_file.dual_infeasibility > NOT_STATIONARY;
    let grade = if is_none { Grade::WronglyCertified } else { Grade::Different };
    Some((grade, format!("{off} and not certified in the file: {measures}")))
}

fn lost_class_or_scope(truth: &Truth, done: &Done, run: &Run) -> Option<Fault> {
    // A class that is recognised in the other form alone is a gain.
    if done.keeps_class && run.class != truth.class && truth.class.is_global() {
        return Some((Grade::Different, format!("class {} instead of {}", run.class, truth.class)));
    }
    let lost = truth.scope == Extent::Global && run.scope == Extent::Local && run.class.is_global();
    lost.then(|| (Grade::Different, format!("local instead of global in a {} problem", run.class)))
}

/// A lower bound above a value that is attained.
fn false_bound(truth: &Truth, run: &Run) -> Option<Fault> {
    let (bound, best) = (run.lower_bound?, truth.minima.iter().copied().reduce(f64::min)?);
    let is_false = bound - best > ACCURACY * best.abs().max(1.0);
    is_false.then(|| (Grade::WronglyCertified, format!("the lower bound {bound:?} lies above the optimum {best:?}")))
}
