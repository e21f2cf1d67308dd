//! Linear, geometric program, convex or nonlinear: the first that the structure proves.

use std::sync::Arc;

use super::dependence::Dependence;
use super::expression_graph::Context;
use super::structure_of_rows::{Bend, RowStructure};
use super::walk::Walk;
use super::{AssemblyError, context};
use crate::expression::operators::{Binary, Unary};
use crate::expression::structure::Wanted;
use crate::model::views::logarithmic::Logarithmic;
use crate::model::{Class, Model, RibModel};
use crate::problem::ratio::Ratio;
use crate::problem::{Constraint, Formula, Limit, Problem, Sense};

/// What is proved about a problem.
pub struct Classification {
    /// The class.
    pub class: Class,
    /// For geometric programs: the same problem in the logarithms of its variables.
    pub logarithmic: Option<Logarithmic>,
    /// Which term keeps it from being a geometric program.
    pub not_geometric: Option<String>,
    /// Which term keeps it from being convex.
    pub not_convex: Option<String>,
}

impl Classification {
    /// Nothing is proved.
    pub fn nonlinear() -> Self {
        Classification { class: Class::Nonlinear, logarithmic: None, not_geometric: None, not_convex: None }
    }
}

/// Classifies the problem `model` was assembled from. Definitions and section properties are seen through.
///
/// # Errors
/// As [`super::assemble`], for the rows restated as ratios.
pub fn classify(model: &RibModel) -> Result<Classification, AssemblyError> {
    let problem = model.problem();
    let facts = Dependence::of(problem);
    let judge = Judge { problem, facts: &facts };
    let not_convex = judge.not_convex()?;
    let meta = model.meta();
    let linear = meta.objective_is_linear && meta.row_is_linear.iter().all(|linear| *linear);
    if linear {
        return Ok(Classification { class: Class::Linear, logarithmic: None, not_geometric: None, not_convex: None });
    }
    let (not_geometric, logarithmic) = match judge.geometric()? {
        Ok(geometric) => (None, geometric.logarithmic(problem)?),
        Err(reason) => (Some(reason), None),
    };
    let class = match (&not_geometric, &not_convex) {
        (None, _) => Class::GeometricProgram,
        (_, None) => Class::Convex,
        _ => Class::Nonlinear,
    };
    Ok(Classification { class, logarithmic, not_geometric, not_convex })
}

/// Which constraints are shown to be convex; `None` where the objective is not.
///
/// # Errors
/// As [`super::assemble`].
pub fn convex_constraints(problem: &Arc<Problem>) -> Result<Option<Vec<bool>>, AssemblyError> {
    let facts = Dependence::of(problem);
    let judge = Judge { problem, facts: &facts };
    if judge.not_convex_objective()?.is_some() {
        return Ok(None);
    }
    let convex = |constraint: &Constraint| Ok(judge.not_convex_constraint(constraint)?.is_none());
    problem.constraints.iter().map(convex).collect::<Result<_, _>>().map(Some)
}

struct Judge<'a> {
    problem: &'a Arc<Problem>,
    facts: &'a Dependence,
}

/// One constraint as a ratio against a limit.
struct GeometricRow {
    ratio: Formula,
    limit: Limit,
    monomial: bool,
}

/// A geometric program's rows as ratios.
struct Geometric {
    rows: Vec<(Formula, Limit)>,
    monomial: Vec<bool>,
    /// The objective is minimised as it stands, not the inverse of one that is maximised.
    direct: bool,
}

impl Judge<'_> {
    /// What every row of a constraint (with this left side) is.
    fn rows<'s>(&'s self, constraint: &Constraint, left: &'s Formula) -> Result<RowStructure<'s>, AssemblyError> {
        let (mut walk, mut survey) = (Walk::new(self.problem, self.facts), RowStructure::new(self.problem));
        for item in 0..constraint.scope.rows() {
            survey.add(left, &mut walk, context(&constraint.scope, item)).map_err(|cause| AssemblyError {
                place: format!("{} (constraint {})", constraint.place, constraint.name),
                cause,
            })?;
        }
        Ok(survey)
    }

    fn objective<'s>(&'s self, formula: &'s Formula) -> Result<RowStructure<'s>, AssemblyError> {
        let (mut walk, mut survey) = (Walk::new(self.problem, self.facts), RowStructure::new(self.problem));
        let surveyed = survey.add(formula, &mut walk, Context::GLOBAL);
        surveyed.map_err(|cause| AssemblyError { place: "the objective".into(), cause })?;
        Ok(survey)
    }

    /// Why the problem is not convex; `None` where it is.
    fn not_convex(&self) -> Result<Option<String>, AssemblyError> {
        if let Some(reason) = self.not_convex_objective()? {
            return Ok(Some(reason));
        }
        for constraint in &self.problem.constraints {
            if let Some(reason) = self.not_convex_constraint(constraint)? {
                return Ok(Some(reason));
            }
        }
        Ok(None)
    }

    fn not_convex_objective(&self) -> Result<Option<String>, AssemblyError> {
        let survey = self.objective(&self.problem.objective)?;
        let wanted = match self.problem.sense {
            Sense::Minimize => Wanted::Convex,
            Sense::Maximize => Wanted::Concave,
        };
        Ok((!holds(wanted, survey.bend())).then(|| words("the objective", &survey, wanted)))
    }

    fn not_convex_constraint(&self, constraint: &Constraint) -> Result<Option<String>, AssemblyError> {
        let survey = self.rows(constraint, &constraint.left)?;
        let wanted: &[Wanted] = match constraint.right {
            Limit::AtMost(_) => &[Wanted::Convex],
            Limit::AtLeast(_) => &[Wanted::Concave],
            Limit::Equal(_) | Limit::Between(..) => &[Wanted::Convex, Wanted::Concave],
        };
        let missing = wanted.iter().find(|&&wanted| !holds(wanted, survey.bend()));
        Ok(missing.map(|&missing| words(&format!("constraint {}", constraint.name), &survey, missing)))
    }

    /// The rows as ratios, or why the problem is no geometric program.
    fn geometric(&self) -> Result<Result<Geometric, String>, AssemblyError> {
        if let Some(j) = self.problem.variables.lower.iter().position(|&lower| lower < 0.0) {
            return Ok(Err(format!("{} may be negative", self.problem.variable_name(j))));
        }
        // Minimising −f is maximising f, and the other way round.
        let (mut objective, mut direct) = (self.problem.objective.clone(), self.problem.sense == Sense::Minimize);
        while let Some(opposite) = negated(&objective) {
            (objective, direct) = (opposite, !direct);
        }
        let wanted = if direct { Wanted::LogConvex } else { Wanted::LogConcave };
        let survey = self.objective(&objective)?;
        if !holds(wanted, survey.bend()) {
            return Ok(Err(words("the objective", &survey, wanted)));
        }
        let mut geometric = Geometric { rows: Vec::new(), monomial: Vec::new(), direct };
        for constraint in &self.problem.constraints {
            match self.geometric_row(constraint)? {
                Ok(GeometricRow { ratio, limit, monomial }) => {
                    geometric.rows.push((ratio, limit));
                    geometric.monomial.extend(std::iter::repeat_n(monomial, constraint.scope.rows()));
                }
                Err(reason) => return Ok(Err(reason)),
            }
        }
        Ok(Ok(geometric))
    }

    fn geometric_row(&self, constraint: &Constraint) -> Result<Result<GeometricRow, String>, AssemblyError> {
        let name = format!("constraint {}", constraint.name);
        let right = self.one_limit(constraint)?;
        let (ratio, limit) = match self.problem.ratio(&constraint.left, &right) {
            Ratio::Row(ratio, limit) => (ratio, limit),
            Ratio::NotNegative(formula) => return self.always_met(constraint, &formula),
            Ratio::None => return Ok(Err(format!("{name}: it holds a sum of positive terms below zero"))),
        };
        if let Limit::Between(_, upper) = &limit
            && !self.rows(constraint, upper)?.is_positive()
        {
            return Ok(Err(format!("{name}: its upper limit leaves no room for a positive term")));
        }
        let survey = self.rows(constraint, &ratio)?;
        let bend = survey.bend();
        let two_sided = matches!(limit, Limit::Equal(_) | Limit::Between(..));
        if !bend.log_curvature.is_convex() {
            return Ok(Err(words(&name, &survey, Wanted::LogConvex)));
        }
        if two_sided && !bend.log_curvature.is_affine() {
            return Ok(Err(format!("{name}: a row with two limits must be a monomial")));
        }
        let monomial = bend.log_curvature == crate::expression::structure::Curvature::Affine;
        Ok(Ok(GeometricRow { ratio, limit, monomial }))
    }

    /// The limits without one that the left side cannot reach, both being proved to have one sign between the variables' bounds.
    fn one_limit(&self, constraint: &Constraint) -> Result<Limit, AssemblyError> {
        let Limit::Between(lower, upper) = &constraint.right else { return Ok(constraint.right.clone()) };
        let opposite = |formula: &Formula| Formula::Unary(Unary::Negate, Box::new(formula.clone()));
        let is_non_negative = |formula: &Formula| Ok(self.rows(constraint, formula)?.is_non_negative());
        if is_non_negative(&opposite(lower))? && is_non_negative(&constraint.left)? {
            return Ok(Limit::AtMost(upper.clone()));
        }
        if is_non_negative(upper)? && is_non_negative(&opposite(&constraint.left))? {
            return Ok(Limit::AtLeast(lower.clone()));
        }
        Ok(constraint.right.clone())
    }

    /// The row says that `formula` is not negative: it has no place in a geometric program, unless it is proved that it never is
    /// between the variables' bounds. Then 0 ≤ 1 says the same.
    fn always_met(&self, constraint: &Constraint, formula: &Formula) -> Result<Result<GeometricRow, String>, AssemblyError> {
        if self.rows(constraint, formula)?.is_non_negative() {
            let (ratio, limit) = (Formula::Constant(0.0), Limit::AtMost(Formula::Constant(1.0)));
            return Ok(Ok(GeometricRow { ratio, limit, monomial: false }));
        }
        Ok(Err(format!("constraint {}: the term it holds above a limit is not shown to be positive", constraint.name)))
    }
}

impl Geometric {
    /// The problem in log variables; `None` where it is not solved that way.
    fn logarithmic(self, problem: &Arc<Problem>) -> Result<Option<Logarithmic>, AssemblyError> {
        if !self.direct {
            return Ok(None);
        }
        let ratios = super::assemble_rows(problem, &self.rows)?;
        Ok(Logarithmic::new(Arc::new(ratios), self.monomial))
    }
}

/// The formula without the minus it is written with; `None` where it has none.
fn negated(formula: &Formula) -> Option<Formula> {
    let both = |operator: Binary, a: Formula, b: Formula| Formula::Binary(operator, Box::new(a), Box::new(b));
    match formula {
        Formula::Unary(Unary::Negate, inner) => Some((**inner).clone()),
        Formula::Constant(value) if *value < 0.0 => Some(Formula::Constant(-value)),
        Formula::Binary(Binary::Add, a, b) => Some(both(Binary::Add, negated(a)?, negated(b)?)),
        Formula::Binary(Binary::Subtract, a, b) => Some(both(Binary::Add, negated(a)?, (**b).clone())),
        Formula::Binary(operator @ (Binary::Multiply | Binary::Divide), a, b) => match (negated(a), negated(b)) {
            (Some(a), None) => Some(both(*operator, a, (**b).clone())),
            (None, Some(b)) => Some(both(*operator, (**a).clone(), b)),
            _ => None,
        },
        _ => None,
    }
}

fn holds(wanted: Wanted, bend: Bend) -> bool {
    match wanted {
        Wanted::Convex => bend.curvature.is_convex(),
        Wanted::Concave => bend.curvature.is_concave(),
        Wanted::LogConvex => bend.log_curvature.is_convex(),
        Wanted::LogConcave => bend.log_curvature.is_concave(),
    }
}

fn words(place: &str, survey: &RowStructure, wanted: Wanted) -> String {
    let property = match wanted {
        Wanted::Convex => "convex",
        Wanted::Concave => "concave",
        Wanted::LogConvex => "a posynomial (log-log convex)",
        Wanted::LogConcave => "a monomial (log-log concave)",
    };
    match survey.blame(wanted) {
        Some(term) => format!("{place}: no rule shows that {term} is {property}"),
        None => format!("{place}: the sum of its terms is not shown to be {property}"),
    }
}
