//! Eigenvalues of the structure that a problem asks for: buckling factors and natural frequencies.

mod followed;
mod least;
mod limits;
mod replaced;

use std::sync::Arc;

pub use followed::{Followed, followed, with_cuts, without};
pub use least::{Helped, Least};
pub use limits::{Limited, limited};

use super::formula::{Response, What};
use super::{Constraint, Formula, Problem};

/// The factor of a mode that does not buckle under any multiple of the loads: beyond any load, and still a number.
pub const NEVER: f64 = 1e30;

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

/// Several eigenvalues that coincide or nearly do, seen in one direction.
///
/// S = K − σ·B with B = −G or M is positive semidefinite but for the modes below where σ is at most the lowest of them. With the columns C = K₀·V of
/// a basis V of the nearly coinciding modes at a reference design, and a direction v among them, the smallest wᵀSw over Cᵀw = v is vᵀ·T·v with
/// the Schur complement T of S: smooth however many eigenvalues coincide, and S has the wanted inertia where T is positive semidefinite
/// (Haynsworth 1968). Each direction v so has one smooth function: what is left of S at a limit, or the σ at which nothing is left.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Whose eigenvalues.
    pub pencil: Pencil,
    /// The factor, or the frequency in cycles per time, that it is taken at.
    pub level: Level,
    /// C, by column.
    pub basis: Arc<Vec<Vec<f64>>>,
    /// v, of length 1.
    pub direction: Vec<f64>,
}

/// Where a cut is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Level {
    /// At a limit: its value is that of the eigenvalue where that is the limit, and to first order near it.
    Limit(f64),
    /// At itself: the eigenvalues' values in this direction, the lowest of which over all directions is the lowest eigenvalue. They are
    /// sought from this one on.
    Itself(f64),
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

    /// What happens in its modes.
    pub fn name(self) -> &'static str {
        match self {
            Pencil::Buckling(_) => "buckling",
            Pencil::Vibration => "vibration",
        }
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

/// Makes solvers see the next modes come where an eigenvalue may be the least of several: at an optimum they tend to come down to it.
pub fn follow(problem: &mut Problem) {
    if eigenvalues(problem).is_empty() {
        return;
    }
    limits::split_ranges(problem);
    least::follow_elsewhere(problem);
    limits::follow_limits(problem);
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
    let definitions = definitions.iter().map(|(_, formula)| formula);
    let rows = problem.constraints.iter().flat_map(Constraint::formulas);
    let all = definitions.chain(std::iter::once(&problem.objective)).chain(rows).chain(&problem.dimension_formulas);
    eigenvalues_in(problem, all)
}

/// The eigenvalues in formulas, definitions seen through, each once.
pub fn eigenvalues_in<'f>(problem: &Problem, formulas: impl Iterator<Item = &'f Formula>) -> Vec<Eigenvalue> {
    let mut walk = Walk { problem, seen: vec![false; problem.definitions.len()], found: Vec::new() };
    formulas.for_each(|formula| walk.visit(formula));
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
