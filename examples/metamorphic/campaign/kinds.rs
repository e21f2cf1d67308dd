//! The transformations by name, and what each may change besides the text.

use ribopt::model::Class;

use super::draft::Draft;
use super::random::Random;
use super::{rows, variables};

/// Changes a draft; false where it has nothing to change.
type Apply = fn(&mut Draft, &mut Random) -> bool;

/// One transformation.
#[derive(Clone, Copy)]
pub struct Kind {
    pub name: &'static str,
    apply: Apply,
    /// The classes a problem keeps; the others are recognised by their form, which is lost.
    keeps: &'static [Class],
}

const EVERY: &[Class] = &[Class::Linear, Class::GeometricProgram, Class::Convex, Class::Nonlinear];
const NOT_GEOMETRIC: &[Class] = &[Class::Linear, Class::Convex, Class::Nonlinear];
const LINEAR: &[Class] = &[Class::Linear];

/// All of them.
pub const KINDS: &[Kind] = &[
    Kind { name: "scale-variables", apply: variables::scale_all, keeps: EVERY },
    Kind { name: "scale-variable", apply: variables::scale_one, keeps: EVERY },
    Kind { name: "scale-rows", apply: rows::scale_all, keeps: EVERY },
    Kind { name: "scale-row", apply: rows::scale_one, keeps: EVERY },
    Kind { name: "scale-objective", apply: rows::scale_objective, keeps: EVERY },
    Kind { name: "scale-everything", apply: scale_everything, keeps: EVERY },
    Kind { name: "translate", apply: variables::translate, keeps: NOT_GEOMETRIC },
    Kind { name: "permute-variables", apply: variables::permute, keeps: EVERY },
    Kind { name: "permute-rows", apply: rows::permute, keeps: EVERY },
    Kind { name: "duplicate-rows", apply: rows::duplicate, keeps: EVERY },
    Kind { name: "redundant-rows", apply: rows::add_redundant, keeps: LINEAR },
    Kind { name: "split-rows", apply: rows::split, keeps: EVERY },
    Kind { name: "fixed-variables", apply: variables::add_fixed, keeps: NOT_GEOMETRIC },
    Kind { name: "fixed-factors", apply: variables::multiply_by_fixed, keeps: &[Class::GeometricProgram] },
    Kind { name: "slacks", apply: rows::write_out_slacks, keeps: LINEAR },
    Kind { name: "start-elsewhere", apply: variables::start_elsewhere, keeps: EVERY },
    Kind { name: "start-left-out", apply: variables::leave_out_starts, keeps: EVERY },
    Kind { name: "reciprocal", apply: variables::reciprocal, keeps: &[Class::GeometricProgram] },
    Kind { name: "maximize", apply: rows::turn_objective, keeps: EVERY },
];

/// Several of the others, one after the other.
pub const MIXED: &str = "mixed";

fn scale_everything(draft: &mut Draft, random: &mut Random) -> bool {
    let scaled = variables::scale_all(draft, random);
    rows::scale_all(draft, random);
    rows::scale_objective(draft, random) && scaled
}

/// Whether two kinds scale the same things: together they would exceed 10^±6.
fn scale_the_same(one: &str, other: &str) -> bool {
    let scaled = |name: &str| name.strip_prefix("scale-").map(|what| what.trim_end_matches('s').to_string());
    let every = |what: &str| what == "everything";
    scaled(one).zip(scaled(other)).is_some_and(|(one, other)| one == other || every(&one) || every(&other))
}

/// What was done to a draft.
#[derive(Debug, Clone, Default)]
pub struct Done {
    pub names: Vec<&'static str>,
    /// Whether the class of the problem must still be this.
    pub keeps_class: bool,
    /// Whether a nonlinear problem may end in another of its minima.
    pub moves_start: bool,
}

impl Done {
    pub fn name(&self) -> String {
        self.names.join("+")
    }
}

/// Transforms a draft of a problem of this class by the kind of this name, or by one that applies.
pub fn transform(draft: &mut Draft, class: Class, only: Option<&str>, random: &mut Random) -> Option<Done> {
    let (mut done, mut left) = (Done { keeps_class: true, ..Done::default() }, 1);
    let mut kinds: Vec<Kind> = KINDS.iter().filter(|kind| only.is_none_or(|only| only == kind.name)).copied().collect();
    if only == Some(MIXED) || (only.is_none() && random.below(KINDS.len() + 3) < 3) {
        (kinds, left) = (KINDS.to_vec(), 2 + random.below(3));
    }
    random.shuffle(&mut kinds);
    let scales = |kind: &Kind| kind.name.starts_with("scale-");
    for kind in kinds {
        if scales(&kind) && draft.goes_to_the_end_of_numbers() {
            continue;
        }
        if done.names.iter().any(|name| scale_the_same(name, kind.name)) {
            continue;
        }
        let before = draft.clone();
        if !(kind.apply)(draft, random) {
            *draft = before;
            continue;
        }
        done.names.push(kind.name);
        done.keeps_class &= kind.keeps.contains(&class);
        done.moves_start |= kind.name.starts_with("start-");
        left -= 1;
        if left == 0 {
            break;
        }
    }
    (!done.names.is_empty()).then_some(done)
}
