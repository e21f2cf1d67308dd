//! `require`: what a row's value is, and what it is held against.

use super::Assembly;
use crate::expression::ast::{Ast, AstKind, Collection, Requirement};
use crate::expression::operators::{Binary, Comparison, Unary};
use crate::expression::parse::parse_requirement;
use crate::input::source::Written;
use crate::problem::cells::{Use, uses};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::mentions::mentions;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::resolve::{ItemScope, Stage, Value};
use crate::problem::{Cells, Column, Formula, Limit, Problem, Scope};

impl Assembly<'_> {
    /// The row's formula and limit, or one pair per element where a side is an array; none after a mistake, or where the row holds
    /// always and is left out.
    pub(super) fn requirement(
        &mut self,
        written: &Written,
        items: Option<&ItemScope>,
        scope: &Scope,
        name: &str,
    ) -> Vec<(String, Formula, Limit)> {
        let Some((requirement, sides)) = self.sides(written, items, scope, name) else { return Vec::new() };
        let single = sides.len() == 1;
        let mut rows = Vec::with_capacity(sides.len());
        for (at, formulas) in sides.into_iter().enumerate() {
            let name = if single { name.to_owned() } else { format!("{name}[{}]", at + 1) };
            rows.extend(self.row(written, &requirement, formulas, scope, &name).map(|(left, limit)| (name, left, limit)));
        }
        // Texts that checks write share a place, and are nobody's.
        if !self.quiet {
            self.requirements.insert(written.place, requirement);
        }
        rows
    }

    /// The formulas on the sides of each row.
    fn sides(
        &mut self,
        written: &Written,
        items: Option<&ItemScope>,
        scope: &Scope,
        name: &str,
    ) -> Option<(Requirement, Vec<Vec<Formula>>)> {
        let requirement = self.parsed(written, parse_requirement)?;
        let trees = match &requirement {
            Requirement::Two { left, right, .. } => vec![left, right],
            Requirement::Range { lower, middle, upper } => vec![lower, middle, upper],
        };
        let mut values = Vec::with_capacity(trees.len());
        for tree in &trees {
            let grouped = self.same_in_groups(written, tree, items, scope);
            let value = self.resolved(written, items, Stage::All, |resolver| resolver.value(tree));
            values.push(value.filter(|_| grouped));
        }
        let mut values: Vec<Value> = values.into_iter().collect::<Option<_>>()?;
        squared(&requirement, &mut values);
        let user = format!("constraint `{name}`");
        if !values.iter().flat_map(Value::formulas).all(|formula| self.cells_filled(formula, items, &user)) {
            return None;
        }
        let lengths: Vec<usize> =
            values.iter().filter_map(|value| if let Value::Array(list) = value { Some(list.len()) } else { None }).collect();
        let count = lengths.first().copied().unwrap_or(1);
        if let Some(other) = lengths.iter().find(|length| **length != count) {
            let message = format!("the sides are arrays of {count} and {other} elements");
            self.findings.mistake(
                MistakeCode::ArraySize,
                written.place,
                message,
                "both need the same size; single numbers are repeated",
            );
            return None;
        }
        let element = |value: &Value, at: usize| match value {
            Value::Scalar(formula) => formula.clone(),
            Value::Array(list) => list[at].clone(),
        };
        let rows = (0..count).map(|at| values.iter().map(|value| element(value, at)).collect()).collect();
        Some((requirement, rows))
    }

    fn row(
        &mut self,
        written: &Written,
        requirement: &Requirement,
        formulas: Vec<Formula>,
        scope: &Scope,
        name: &str,
    ) -> Option<(Formula, Limit)> {
        let constant: Vec<bool> = formulas.iter().map(|formula| constant(&self.problem, formula, scope)).collect();
        if constant.iter().all(|&constant| constant) {
            self.decided(written, requirement, &formulas, scope, name);
            return None;
        }
        match requirement {
            Requirement::Two { comparison, .. } => {
                let [left, right]: [Formula; 2] = formulas.try_into().ok()?;
                Some(two(*comparison, left, right, constant[0], constant[1]))
            }
            Requirement::Range { lower, upper, .. } => {
                for (tree, constant) in [(lower, constant[0]), (upper, constant[2])] {
                    if !constant {
                        let place = written.part(tree.span.start, tree.span.end);
                        let help = "the ends of a range are constant; write two constraints";
                        self.findings.mistake(MistakeCode::NotConstant, place, "this end of the range varies", help);
                    }
                }
                let [lower, middle, upper]: [Formula; 3] = formulas.try_into().ok()?;
                self.ends_in_order(written, &lower, &upper);
                Some((middle, Limit::Between(lower, upper)))
            }
        }
    }

    fn ends_in_order(&mut self, written: &Written, lower: &Formula, upper: &Formula) {
        if let (Formula::Constant(lower), Formula::Constant(upper)) = (lower, upper)
            && lower > upper
        {
            let message = format!("no number lies between {lower} and {upper}");
            self.findings.mistake(MistakeCode::NeverTrue, written.place, message, "exchange the ends of the range");
        }
    }

    /// A row without variables: idle where it holds everywhere, a mistake where it does not.
    fn decided(&mut self, written: &Written, requirement: &Requirement, formulas: &[Formula], scope: &Scope, name: &str) {
        let holds = |item: Item, group: Option<&[u32]>| {
            let evaluation = Evaluation::of_group(&self.problem, group);
            let values: Option<Vec<f64>> = formulas.iter().map(|formula| evaluation.value(formula, item)).collect();
            match (requirement, values.as_deref()) {
                (Requirement::Two { comparison, .. }, Some([left, right])) => compare(*comparison, *left, *right),
                (_, Some([lower, middle, upper])) => lower <= middle && middle <= upper,
                _ => false,
            }
        };
        let failing = rows(scope).find(|(item, group)| !holds(*item, *group)).map(|(item, _)| item);
        match failing {
            None if self.quiet => {}
            None => {
                let message = format!("constraint `{name}` has no variables and always holds");
                self.findings.warning(MistakeCode::AlwaysTrue, written.place, message, "it is left out");
            }
            Some(item) => {
                let row = match item {
                    Item::None => String::new(),
                    Item::Section(s) => format!(" (section `{}`)", self.problem.item_name(Collection::Sections, s)),
                    Item::Rib(r) => format!(" (rib `{}`)", self.problem.item_name(Collection::Ribs, r)),
                    Item::Node(n) => format!(" (node `{}`)", self.problem.item_name(Collection::Nodes, n)),
                };
                let message = format!("constraint `{name}` has no variables and can never hold{row}");
                self.findings.mistake(
                    MistakeCode::NeverTrue,
                    written.place,
                    message,
                    "it needs a design variable, or another limit",
                );
            }
        }
    }

    /// Outside sums, rows of groups use only data that are the same throughout each group.
    fn same_in_groups(&mut self, written: &Written, tree: &Ast, items: Option<&ItemScope>, scope: &Scope) -> bool {
        let (Some(items), Scope::RibGroups(groups) | Scope::SectionGroups(groups) | Scope::NodeGroups(groups)) = (items, scope)
        else {
            return true;
        };
        let mut same = true;
        for mention in mentions(tree).0.iter().filter(|mention| !mention.in_fold) {
            let name = mention.parts.join(".");
            let is_own = |column: &Column| {
                column.name == name || column.name.strip_prefix(&name).is_some_and(|rest| rest.starts_with('['))
            };
            let column = self.problem.columns(items.collection).iter().position(is_own);
            let offending = match column {
                Some(at) => groups.iter().find(|(_, list)| !equal_cells(&self.problem, items.collection, at, list)),
                None if own_name(items, mention.parts) => groups.iter().find(|(_, list)| list.len() > 1),
                None => None,
            };
            if let Some((label, _)) = offending {
                let place = written.part(mention.span.start, mention.span.end);
                let message = format!("`{name}` differs within group `{label}`");
                self.findings.mistake(
                    MistakeCode::Group,
                    place,
                    message,
                    "use it inside sum(…), min(…) or max(…) over the group",
                );
                same = false;
            }
        }
        same
    }

    /// Every data cell the formula uses is filled.
    pub(super) fn cells_filled(&mut self, formula: &Formula, items: Option<&ItemScope>, user: &str) -> bool {
        let mut filled = true;
        for Use { collection, column, empty } in uses(&self.problem, formula, items) {
            if let Some(&first) = empty.first() {
                let label = self.problem.columns(collection)[column as usize].name.clone();
                self.empty_cell(collection, first, &label, empty.len(), user);
                filled = false;
            }
        }
        filled
    }
}

/// `vonmises(…) <= f` is held as σ² + 3τ² ≤ f²: a polynomial, smooth where both stresses vanish.
fn squared(requirement: &Requirement, values: &mut [Value]) {
    let Requirement::Two { comparison: Comparison::LessOrEqual, left, .. } = requirement else { return };
    let is_equivalent_stress = matches!(&left.kind, AstKind::Call(name, _) if name == "vonmises");
    if let ([Value::Scalar(left), Value::Scalar(right)], true) = (values, is_equivalent_stress)
        && let Formula::Unary(Unary::Sqrt, square) = left
    {
        *left = std::mem::take(square.as_mut());
        *right = Formula::Binary(Binary::Multiply, Box::new(right.clone()), Box::new(right.clone()));
    }
}

/// A side without variables is the limit; otherwise left − right is held against 0.
fn two(comparison: Comparison, left: Formula, right: Formula, left_constant: bool, right_constant: bool) -> (Formula, Limit) {
    let limit = |comparison, formula| match comparison {
        Comparison::LessOrEqual => Limit::AtMost(formula),
        Comparison::GreaterOrEqual => Limit::AtLeast(formula),
        _ => Limit::Equal(formula),
    };
    let turned = match comparison {
        Comparison::LessOrEqual => Comparison::GreaterOrEqual,
        Comparison::GreaterOrEqual => Comparison::LessOrEqual,
        other => other,
    };
    match (left_constant, right_constant) {
        (_, true) => (left, limit(comparison, right)),
        (true, false) => (right, limit(turned, left)),
        (false, false) => {
            let difference = Formula::Binary(Binary::Subtract, Box::new(left), Box::new(right));
            (difference, limit(comparison, Formula::Constant(0.0)))
        }
    }
}

/// The rows of a scope: the item whose names hold, and the group.
fn rows(scope: &Scope) -> Box<dyn Iterator<Item = (Item, Option<&[u32]>)> + '_> {
    let first = |list: &[u32]| list.first().copied().unwrap_or(0);
    match scope {
        Scope::Once => Box::new(std::iter::once((Item::None, None))),
        Scope::Sections(list) => Box::new(list.iter().map(|&s| (Item::Section(s), None))),
        Scope::Ribs(list) => Box::new(list.iter().map(|&r| (Item::Rib(r), None))),
        Scope::SectionGroups(groups) => {
            Box::new(groups.iter().map(move |(_, list)| (Item::Section(first(list)), Some(&list[..]))))
        }
        Scope::RibGroups(groups) => Box::new(groups.iter().map(move |(_, list)| (Item::Rib(first(list)), Some(&list[..])))),
        Scope::Nodes(list) => Box::new(list.iter().map(|&n| (Item::Node(n), None))),
        Scope::NodeGroups(groups) => Box::new(groups.iter().map(move |(_, list)| (Item::Node(first(list)), Some(&list[..])))),
    }
}

/// True where the formula has a value in every row whatever the variables are.
fn constant(problem: &Problem, formula: &Formula, scope: &Scope) -> bool {
    rows(scope).all(|(item, group)| Evaluation::of_group(problem, group).value(formula, item).is_some())
}

fn compare(comparison: Comparison, left: f64, right: f64) -> bool {
    match comparison {
        Comparison::LessOrEqual => left <= right,
        Comparison::GreaterOrEqual => left >= right,
        _ => left == right,
    }
}

fn equal_cells(problem: &Problem, collection: Collection, column: usize, list: &[u32]) -> bool {
    let first = list.first().copied().unwrap_or(0) as usize;
    match &problem.columns(collection)[column].cells {
        Cells::Numbers(numbers) => list.iter().all(|&at| numbers[at as usize].to_bits() == numbers[first].to_bits()),
        Cells::Labels { of, .. } => list.iter().all(|&at| of[at as usize] == of[first]),
    }
}

/// A name of the items themselves that may differ from one to the next.
fn own_name(items: &ItemScope, parts: &[String]) -> bool {
    match (items.collection, parts.first().map(String::as_str)) {
        (Collection::Ribs, Some("from" | "to")) => parts.len() == 2,
        (Collection::Ribs, Some("length" | "volume")) => parts.len() == 1,
        (Collection::Sections, Some(name)) => parts.len() == 1 && items.offers(name),
        _ => false,
    }
}
