use super::*;
use crate::problem::Origin;

fn variable(index: u32) -> Box<Formula> {
    Box::new(Formula::Variable(index))
}

fn number(value: f64) -> Box<Formula> {
    Box::new(Formula::Constant(value))
}

fn abs(inner: Formula) -> Formula {
    Formula::Unary(Unary::Abs, Box::new(inner))
}

fn maximum(a: Formula, b: Formula) -> Formula {
    Formula::Fold(Fold::Max, vec![a, b])
}

fn minimum(a: Formula, b: Formula) -> Formula {
    Formula::Fold(Fold::Min, vec![a, b])
}

/// Three variables between these bounds.
fn problem(objective: Formula, lower: f64, upper: f64) -> Problem {
    let mut problem = Problem { objective, ..Problem::default() };
    problem.variables.origin = (0..3).map(Origin::Scalar).collect();
    problem.variables.declared = ["a", "b", "c"].map(Into::into).to_vec();
    (problem.variables.lower, problem.variables.upper) = (vec![lower; 3], vec![upper; 3]);
    problem.variables.start = vec![0.5 * (lower + upper); 3];
    problem
}

fn once(left: Formula, right: Limit) -> Problem {
    let constraint = Constraint {
        name: "c".into(),
        detail: Box::default(),
        place: String::new(),
        text: String::new(),
        scope: Scope::Once,
        left,
        right,
        asked: Vec::new(),
    };
    Problem { constraints: vec![constraint], ..problem(Formula::Constant(0.0), -1.0, 1.0) }.without_kinks()
}

#[test]
fn convex_kinks_become_rows() {
    let limit = || Formula::Constant(1.0);
    let rows = once(abs(*variable(0)), Limit::AtMost(limit())).constraints;
    assert_eq!(rows.iter().map(|row| row.name.as_str()).collect::<Vec<_>>(), ["c#1", "c#2"]);
    assert_eq!(rows[1].left, Formula::Unary(Unary::Negate, variable(0)));
    let kept = once(abs(*variable(0)), Limit::AtLeast(limit()));
    assert_eq!((kept.constraints.len(), kept.auxiliaries.len()), (1, 0), "not convex: the kink stays");
    let growing = |inner| Formula::Unary(Unary::Exp, Box::new(inner));
    let rows = once(growing(abs(*variable(0))), Limit::AtMost(limit())).constraints;
    assert_eq!(rows[0].left, growing(*variable(0)));
}

#[test]
fn sums_of_kinks_get_one_variable_each() {
    let sum = Formula::Binary(Binary::Add, Box::new(abs(*variable(0))), Box::new(maximum(*variable(1), *variable(2))));
    let restated = once(sum.clone(), Limit::AtMost(Formula::Constant(1.0)));
    assert_eq!((restated.auxiliaries.len(), restated.constraints.len()), (2, 5));
    assert_eq!(restated.auxiliaries[0].constraints, 1..3);
    let written = restated.with_kinks();
    assert_eq!((written.constraints.len(), written.variables.lower.len()), (1, 3));
    assert_eq!(written.constraints[0].left, sum);
    let terms = (0..300).map(|_| abs(*variable(0))).collect();
    assert_eq!(once(Formula::Fold(Fold::Sum, terms), Limit::AtMost(Formula::Constant(1.0))).auxiliaries.len(), 300);
}

#[test]
fn a_minimised_maximum_becomes_a_bound_above_its_pieces() {
    let restated = problem(maximum(*variable(0), *variable(1)), 0.0, 9.0).without_kinks();
    assert_eq!(restated.objective, Formula::Variable(3));
    assert_eq!((restated.constraints.len(), restated.variables.lower[3]), (2, 0.0));
    let turned = problem(minimum(*variable(0), *variable(1)), 0.0, 9.0).without_kinks();
    assert!(turned.auxiliaries.is_empty(), "minimising a minimum is not convex");
}

#[test]
fn kinks_go_through_what_rises_or_falls_over_their_range() {
    let power = |inner, exponent| Formula::Binary(Binary::Power, Box::new(inner), number(exponent));
    let pair = || maximum(*variable(0), *variable(1));
    let low = || minimum(*variable(0), *variable(1));
    let inverse = |inner| Formula::Binary(Binary::Divide, number(1.0), Box::new(inner));
    let log = |inner| Formula::Unary(Unary::Log, Box::new(inner));
    let negative = |inner| Formula::Unary(Unary::Negate, Box::new(inner));
    let count = |objective: Formula, lower, upper| {
        let restated = problem(objective, lower, upper).without_kinks();
        (restated.auxiliaries.len(), restated.variables.lower.get(3).copied(), restated.variables.upper.get(3).copied())
    };
    assert_eq!(count(power(pair(), 2.0), 0.01, 0.9), (1, Some(0.005), Some(0.9)));
    assert_eq!(count(power(pair(), 2.0), -1.0, 0.9), (0, None, None), "a square falls left of zero");
    assert_eq!(count(power(pair(), 3.0), -1.0, 0.9), (1, Some(f64::NEG_INFINITY), Some(f64::INFINITY)));
    assert_eq!(count(power(abs(*variable(0)), 2.0), -1.0, 0.9).0, 1);
    assert_eq!(count(inverse(low()), 0.01, 0.9), (1, Some(0.005), Some(0.9)));
    assert_eq!(count(inverse(low()), -0.01, 0.9).0, 0);
    assert_eq!(count(inverse(pair()), 0.01, 0.9).0, 0, "the smaller the better");
    assert_eq!(count(negative(log(low())), -0.5, 0.9).0, 1);
    assert_eq!(count(log(pair()), -0.5, 0.9).0, 0, "the variable above could lie in the domain where the maximum does not");
    let product = Formula::Binary(Binary::Multiply, Box::new(pair()), Box::new(abs(*variable(2))));
    assert_eq!(count(product.clone(), 0.1, 0.9).0, 1, "an absolute value of one sign is none");
    assert_eq!(count(product, -0.1, 0.9).0, 1, "the maximum may be negative: only it is replaced, for |c| never is");
}

#[test]
fn a_kink_beside_itself_is_turned_where_it_is_subtracted() {
    let pair = || Box::new(maximum(*variable(0), *variable(1)));
    let difference = Formula::Binary(Binary::Subtract, pair(), pair());
    let restated = problem(difference.clone(), 0.0, 1.0).without_kinks();
    assert_eq!(restated.auxiliaries.len(), 1);
    assert_eq!(restated.with_kinks().objective, difference);
}

#[test]
fn nesting_costs_no_more_than_its_depth() {
    let mut nested = *variable(0);
    for _ in 0..60 {
        let inner = Formula::Binary(Binary::Subtract, Box::new(nested), number(0.25));
        nested = Formula::Unary(Unary::Sqrt, Box::new(abs(inner)));
    }
    let restated = problem(nested, -1.0, 1.0).without_kinks();
    assert!(restated.auxiliaries.len() <= 60);
}
