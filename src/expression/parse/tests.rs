use proptest::prelude::*;

use super::*;
use crate::expression::Span;
use crate::expression::ast::{AstKind, Collection};
use crate::expression::operators::{Binary, Comparison, Fold, Unary};

/// The value of an expression of numbers.
fn value(text: &str) -> f64 {
    evaluate(&parse(text).unwrap_or_else(|mistakes| panic!("{text}: {mistakes:?}")))
}

fn evaluate(ast: &Ast) -> f64 {
    match &ast.kind {
        AstKind::Number(value) => *value,
        AstKind::Name(parts) if parts == &["pi"] => std::f64::consts::PI,
        AstKind::Unary(op, inner) => op.evaluate(evaluate(inner)),
        AstKind::Binary(op, left, right) => op.evaluate(evaluate(left), evaluate(right)),
        AstKind::Fold(Fold::Sum, list) => list.iter().map(evaluate).sum(),
        AstKind::Fold(Fold::Min, list) => list.iter().map(evaluate).fold(f64::INFINITY, f64::min),
        AstKind::Fold(Fold::Max, list) => list.iter().map(evaluate).fold(f64::NEG_INFINITY, f64::max),
        other => panic!("no number: {other:?}"),
    }
}

#[test]
fn binds_as_in_mathematics() {
    for (text, expected) in [
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^3^2", 512.0),
        ("2^-3", 0.125),
        ("2^-2^2", 0.0625),
        ("8 - 3 - 2", 3.0),
        ("8/4/2", 1.0),
        ("2*-3", -6.0),
        ("-2*3 + 1", -5.0),
        ("1 - -1", 2.0),
        ("+3", 3.0),
        ("1e-3 + .5 + 1. + 1.e2", 101.501),
        ("min(3, 1, 2) + max(1, 2) + sum(1, 2, 3)", 9.0),
        ("atan2(1, 1)*4/pi", 1.0),
        ("sqrt(abs(-16))", 4.0),
    ] {
        assert!((value(text) - expected).abs() <= 1e-15 * expected.abs(), "{text} = {}", value(text));
    }
}

#[test]
fn every_node_knows_its_place() {
    let text = "a + sqrt(b.c[i + 1])^2";
    let at = |span: Span| &text[span.start..span.end];
    let AstKind::Binary(Binary::Add, _, right) = parse(text).unwrap().kind else { panic!() };
    assert_eq!(at(right.span), "sqrt(b.c[i + 1])^2");
    let AstKind::Binary(Binary::Power, base, _) = right.kind else { panic!() };
    let AstKind::Unary(Unary::Sqrt, inner) = base.kind else { panic!() };
    assert_eq!(at(inner.span), "b.c[i + 1]");
    let AstKind::Index(name, index) = inner.kind else { panic!() };
    assert_eq!(name.kind, AstKind::Name(vec!["b".into(), "c".into()]));
    assert_eq!(at(index.span), "i + 1");
}

#[test]
fn folds_over_collections() {
    let ast = parse("sum(sections where h > 0.2 and line == \"L0\": A*2)").unwrap();
    let AstKind::Over { fold: Fold::Sum, collection: Collection::Sections, filter: Some(filter), .. } = ast.kind else {
        panic!()
    };
    let Condition::And(left, right) = *filter else { panic!() };
    assert!(matches!(*left, Condition::Compare(Comparison::Greater, ..)));
    let Condition::Compare(Comparison::Equal, _, text) = *right else { panic!() };
    assert_eq!(text.kind, AstKind::Text("L0".into()));
    assert!(matches!(parse("max(ribs: length)").unwrap().kind, AstKind::Over { collection: Collection::Ribs, filter: None, .. }));
    assert!(matches!(parse("sum(ribs)").unwrap().kind, AstKind::Fold(..)), "a name like any other");
    assert!(
        matches!(parse("profile(depth, 0.25)").unwrap().kind, AstKind::Call(name, arguments) if name == "profile" && arguments.len() == 2)
    );
}

#[test]
fn conditions_take_parentheses_around_numbers_and_conditions() {
    for text in ["(h) > 2", "((h + 1)*2) > 2", "(h > 2)", "not (h > 2 or (k) == 3) and ((a) < 1)", "(h > 2) or not k != 1"] {
        assert!(parse_condition(text).is_ok(), "{text}: {:?}", parse_condition(text));
    }
}

#[test]
fn requirements_and_their_turned_ranges() {
    let two = parse_requirement("support.Ix >= 2.5e-4").unwrap();
    assert!(matches!(two, Requirement::Two { comparison: Comparison::GreaterOrEqual, .. }));
    let Requirement::Range { lower, upper, .. } = parse_requirement("3 >= a >= 1").unwrap() else { panic!() };
    assert_eq!((lower.kind, upper.kind), (AstKind::Number(1.0), AstKind::Number(3.0)));
}

/// Text, the byte the caret points at, and a part of the message or help.
#[test]
fn mistakes_say_where_and_what_instead() {
    type Rule = fn(&str) -> Vec<SyntaxError>;
    let expression: Rule = |text| parse(text).unwrap_err();
    let requirement: Rule = |text| parse_requirement(text).unwrap_err();
    let condition: Rule = |text| parse_condition(text).unwrap_err();
    for (rule, text, place, part) in [
        (expression, "", 0, "the text is empty"),
        (expression, "  ", 2, "the text is empty"),
        (expression, "a +", 3, "the text ends here"),
        (expression, "sqrt(a", 4, "never closed"),
        (expression, "a)", 1, "closes nothing"),
        (expression, "x[1)", 3, "expected `]`"),
        (expression, "2 x", 2, "`*`"),
        (expression, "2x", 1, "`*`"),
        (expression, "0,5", 1, "point"),
        (expression, "a ≤ b", 2, "write `<=`"),
        (expression, "a**2", 1, "write `^`"),
        (expression, "1e999", 0, "too large"),
        (expression, "a <= b", 2, "a comparison cannot stand here"),
        (expression, "a.", 1, "after the dot"),
        (expression, "sqrt(1, 2)", 0, "takes 1 argument, not 2"),
        (expression, "atan2(1)", 0, "takes 2 arguments, not 1"),
        (expression, "min()", 0, "at least 1 argument, not 0"),
        (expression, "\"L0\"", 0, "text"),
        (expression, "\"L0", 0, "never closed"),
        (expression, "a where b", 2, "`*`"),
        (expression, "sum(ribs where a: 1)", 16, "comparison"),
        (requirement, "a", 1, "a <= b"),
        (requirement, "a < b", 2, "<="),
        (requirement, "a > b", 2, ">="),
        (requirement, "a = b", 2, "=="),
        (requirement, "a != b", 2, "cannot be required"),
        (requirement, "1 <= a >= 2", 7, "lo <= a <= hi"),
        (requirement, "1 <= a <= 2 <= 3", 7, "more than two"),
        (condition, "a < b < c", 6, "`and`"),
        (condition, "a", 1, "comparison"),
    ] {
        let mistakes = rule(text);
        let first = &mistakes[0];
        let all = format!("{} {}", first.message, first.help.as_deref().unwrap_or(""));
        assert!(first.span.start == place && all.contains(part), "{text}: {mistakes:?}");
    }
}

#[test]
fn several_mistakes_in_one_go() {
    assert_eq!(parse("a ? b § c").unwrap_err().len(), 2);
    assert_eq!(parse("sqrt() + log(1, 2) + )").unwrap_err().len(), 1);
    assert_eq!(parse("sqrt() + log(1, 2) + atan2(1)").unwrap_err().len(), 3);
}

#[test]
fn deep_nesting_is_refused_and_long_chains_are_not() {
    for text in ["(".repeat(100_000), "-".repeat(100_000), "2^".repeat(100_000), "sin(".repeat(5_000) + "1" + &")".repeat(5_000)]
    {
        assert!(parse(&text).is_err());
    }
    let sum = "1 - 2".to_string() + &" + 3 - 3".repeat(50_000);
    assert_eq!(value(&sum), -1.0);
    let product = "3".to_string() + &"*2/2".repeat(50_000);
    assert_eq!(value(&product), 3.0);
    let deepest = "(".repeat(127) + "1" + &(format!("{}{})", "*1".repeat(7), "+0".repeat(7))).repeat(127);
    assert_eq!(value(&deepest), 1.0, "walked and dropped on the stack of a thread");
    let condition = "a == 1".to_string() + &" or b == 2 and not c == 3".repeat(50_000);
    assert!(parse_condition(&condition).is_ok());
    assert!(parse(&("(".repeat(100) + "1" + &")".repeat(100))).is_ok());
}

const WORDS: [&str; 34] = [
    "a", "x", "1", "2.5e-3", ".", "+", "-", "*", "/", "^", "(", ")", "[", "]", ",", ":", "<=", ">=", "==", "=", "!=", "<",
    "sum(", "ribs", "where", "and", "or", "not", "\"L0\"", "min(", "sqrt(", " ", "atan2(", "§",
];

proptest! {
    #[test]
    fn never_panics_on_any_text(text in any::<String>()) {
        check(&text);
    }

    #[test]
    fn never_panics_on_shuffled_words(words in prop::collection::vec(prop::sample::select(&WORDS[..]), 0..40)) {
        check(&words.concat());
    }

    #[test]
    fn never_panics_on_mutated_text(at in 0_usize..60, byte in any::<u8>(), cut in 0_usize..60) {
        let mut bytes = b"lo <= sum(ribs where line == \"L0\": c*x[3]^-2/(E*from.Ix)) + 1e-3".to_vec();
        let length = bytes.len();
        bytes[at % length] = byte;
        bytes.drain(cut % length..(cut + 3).min(length));
        check(&String::from_utf8_lossy(&bytes));
    }
}

/// Every rule answers; a mistake lies inside the text, on character boundaries.
fn check(text: &str) {
    let mistakes = [parse(text).err(), parse_requirement(text).err(), parse_condition(text).err()];
    for list in mistakes.into_iter().flatten() {
        assert!(!list.is_empty());
        for mistake in list {
            assert!(text.get(mistake.span.start..mistake.span.end).is_some(), "{text:?} {mistake:?}");
        }
    }
}
