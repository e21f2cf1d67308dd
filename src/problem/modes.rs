//! Eigenvalues of the structure that a problem asks for: buckling factors and natural frequencies.

use std::sync::Arc;

use super::formula::{Response, What};
use super::{Constraint, Formula, Limit, Problem, Scope};

/// The case of a response that has none.
pub const NO_SET: u32 = u32::MAX;

/// The matrices whose eigenvalues are asked for: K φ = −λ G φ of a case or combination, or K φ = ω² M φ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pencil {
    /// Linear buckling under a case or combination.
    Buckling(u32),
    /// Free vibration.
    Vibration,
}

/// An eigenvalue, as the model computes one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Eigenvalue {
    /// By its number, counted from the lowest, 1 the first.
    Number(Pencil, u32),
    /// By a cut of the problem's.
    Cut(u32),
}

/// A limit from below on several eigenvalues that coincide or nearly do, seen in one direction.
///
/// S = K − σ·B with B = −G or M, and σ the limit, is to be positive semidefinite but for the modes below those limited. With the columns C = K₀·V of
/// a basis V of the nearly coinciding modes at a reference design, and a direction v among them, the smallest wᵀSw over Cᵀw = v is vᵀ·T·v with
/// the Schur complement T of S: smooth however many eigenvalues coincide, and S has the wanted inertia where T is positive semidefinite
/// (Haynsworth 1968). Each direction v is one smooth row.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Whose eigenvalues.
    pub pencil: Pencil,
    /// The limit on the factor, or on the frequency in cycles per time.
    pub limit: f64,
    /// C, by column.
    pub basis: Arc<Vec<Vec<f64>>>,
    /// v, of length 1.
    pub direction: Vec<f64>,
}

impl Pencil {
    /// The response that is its eigenvalue of this number.
    pub fn response(self, number: u32) -> Response {
        let (set, what) = match self {
            Pencil::Buckling(set) => (set, What::Buckling(number)),
            Pencil::Vibration => (NO_SET, What::Frequency(number)),
        };
        Response { set, subject: super::formula::Subject::Whole, what }
    }

    /// The eigenvalue that users know, from μ of B φ = μ K φ: 1/μ as a factor, 1/(2π√μ) as a frequency.
    pub fn shown(self, mu: f64) -> f64 {
        match self {
            Pencil::Buckling(_) => 1.0 / mu,
            Pencil::Vibration => 1.0 / (std::f64::consts::TAU * mu.sqrt()),
        }
    }

    /// μ of a factor or frequency.
    pub fn inverse(self, shown: f64) -> f64 {
        match self {
            Pencil::Buckling(_) => 1.0 / shown,
            Pencil::Vibration => (std::f64::consts::TAU * shown).powi(-2),
        }
    }

    /// The first and second derivative of [`Pencil::shown`].
    pub fn slopes(self, mu: f64) -> [f64; 2] {
        let value = self.shown(mu);
        match self {
            Pencil::Buckling(_) => [-value / mu, 2.0 * value / (mu * mu)],
            Pencil::Vibration => [-0.5 * value / mu, 0.75 * value / (mu * mu)],
        }
    }
}

impl Response {
    /// The eigenvalue it is, where it is one.
    pub fn eigenvalue(&self) -> Option<Eigenvalue> {
        match self.what {
            What::Buckling(number) => Some(Eigenvalue::Number(Pencil::Buckling(self.set), number)),
            What::Frequency(number) => Some(Eigenvalue::Number(Pencil::Vibration, number)),
            What::Cut(cut) => Some(Eigenvalue::Cut(cut)),
            _ => None,
        }
    }
}

/// The eigenvalues that objective and rows ask for, each once.
pub fn eigenvalues(problem: &Problem) -> Vec<Eigenvalue> {
    found(problem, &[])
}

/// Those that definitions ask for, too, be they used or not.
pub fn defined(problem: &Problem) -> Vec<Eigenvalue> {
    found(problem, &problem.definitions)
}

fn found(problem: &Problem, definitions: &[(String, Formula)]) -> Vec<Eigenvalue> {
    let mut walk = Walk { problem, seen: vec![false; problem.definitions.len()], found: Vec::new() };
    definitions.iter().for_each(|(_, formula)| walk.visit(formula));
    walk.visit(&problem.objective);
    for constraint in &problem.constraints {
        walk.visit(&constraint.left);
        constraint.right.formulas().for_each(|formula| walk.visit(formula));
    }
    problem.dimension_formulas.iter().for_each(|formula| walk.visit(formula));
    walk.found
}

struct Walk<'a> {
    problem: &'a Problem,
    seen: Vec<bool>,
    found: Vec<Eigenvalue>,
}

impl Walk<'_> {
    fn visit(&mut self, formula: &Formula) {
        match formula {
            Formula::Response(response) => {
                if let Some(eigenvalue) = response.eigenvalue().filter(|one| !self.found.contains(one)) {
                    self.found.push(eigenvalue);
                }
            }
            Formula::Definition(definition) => {
                if !std::mem::replace(&mut self.seen[*definition as usize], true) {
                    self.visit(&self.problem.definitions[*definition as usize].1);
                }
            }
            other => other.children().for_each(|one| self.visit(one)),
        }
    }
}

/// A constraint that limits an eigenvalue from below by a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limited {
    /// Which constraint.
    pub constraint: usize,
    /// Whose eigenvalue.
    pub pencil: Pencil,
    /// Its number.
    pub number: u32,
    /// The limit.
    pub limit: f64,
}

impl Limited {
    /// Whether this limit holds wherever another does.
    pub fn follows_from(&self, other: &Limited) -> bool {
        self.pencil == other.pencil && self.number >= other.number && self.limit <= other.limit
    }
}

/// The constraints that limit eigenvalues from below by numbers.
pub fn limited(problem: &Problem) -> Vec<Limited> {
    let constants = super::evaluate::Evaluation::constants(problem);
    let of = |(at, constraint): (usize, &Constraint)| {
        let (Formula::Response(response), Limit::AtLeast(limit), Scope::Once) =
            (&constraint.left, &constraint.right, &constraint.scope)
        else {
            return None;
        };
        let Some(Eigenvalue::Number(pencil, number)) = response.eigenvalue() else { return None };
        let limit = constants.value(limit, super::evaluate::Item::None).filter(|limit| *limit > 0.0)?;
        Some(Limited { constraint: at, pencil, number, limit })
    };
    problem.constraints.iter().enumerate().filter_map(of).collect()
}

/// Modes above a limited one that are followed with it: at an optimum they tend to come down to it.
const FOLLOWED: u32 = 2;

/// Limits the next modes likewise wherever an eigenvalue is limited from below: redundant, as they are no lower, but solvers see them come.
pub fn follow(problem: &mut Problem) {
    let all = limited(problem);
    for limit in &all {
        for number in limit.number + 1..=limit.number + FOLLOWED {
            let next = Limited { number, ..*limit };
            if all.iter().any(|other| other.number == number && next.follows_from(other)) {
                continue;
            }
            let own = problem.constraints[limit.constraint].clone();
            let detail = format!("mode {number}").into();
            let left = Formula::Response(Arc::new(limit.pencil.response(number)));
            problem.constraints.push(Constraint { detail, left, ..own });
        }
    }
}

/// The problem with cuts in the place of limits: those at `replaced` and what follows from them go, each cut is a row named like the
/// constraint it stands for.
pub fn with_cuts(problem: &Problem, replaced: &[Limited], cuts: Vec<(usize, Box<str>, Cut)>) -> Problem {
    let gone: Vec<usize> = limited(problem)
        .iter()
        .filter(|limit| replaced.iter().any(|other| limit.follows_from(other)))
        .map(|limit| limit.constraint)
        .collect();
    let mut cut = without(problem, &gone);
    for (number, (constraint, detail, _)) in cuts.iter().enumerate() {
        let own = problem.constraints[*constraint].clone();
        let response = Response { what: What::Cut(number as u32), ..cuts[number].2.pencil.response(1) };
        cut.constraints.push(Constraint { detail: detail.clone(), left: Formula::Response(Arc::new(response)), ..own });
    }
    cut.cuts = Arc::new(cuts.into_iter().map(|(.., cut)| cut).collect());
    cut
}

/// The problem without the constraints at these places.
pub fn without(problem: &Problem, gone: &[usize]) -> Problem {
    let kept = problem.constraints.iter().enumerate().filter(|(at, _)| !gone.contains(at));
    Problem { constraints: kept.map(|(_, constraint)| constraint.clone()).collect(), ..problem.clone() }
}
