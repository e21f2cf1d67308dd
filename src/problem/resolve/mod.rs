//! Looks up every name of an expression: [`Ast`] → [`Formula`], constants folded, arrays element by element.

mod arrays;
mod condition;
mod name;
pub mod outer;
mod over;
mod profile;
mod quantity;
mod range;
pub mod response;
mod world;

use super::Formula;
use super::evaluate::{Evaluation, Item};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::problem::mistake_code::MistakeCode;
pub use world::{Chosen, Open, Remark, Report, Stage, World};

pub use super::item_scope::ItemScope;
pub use condition::ItemFilter;

/// One number's formula, or an array of them.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs)]
pub enum Value {
    Scalar(Formula),
    Array(Vec<Formula>),
}

/// Resolves expressions in one scope.
pub struct Resolver<'a, 'r> {
    world: World<'a>,
    /// The items whose own names hold.
    scope: Option<&'r ItemScope>,
    /// The one item whose own names hold, where it is one.
    item: Option<(Collection, u32)>,
    /// The one item outside the sum this stands in, where it is one: `outer`.
    outer: Option<(Collection, u32)>,
    /// The collection whose groups make the rows.
    group: Option<Collection>,
    /// Names that stand for a whole number here, the inner ones last.
    indices: Vec<(String, f64)>,
    report: &'r mut Report,
}

impl<'a, 'r> Resolver<'a, 'r> {
    /// A resolver; without a scope only global names hold.
    pub fn new(world: World<'a>, scope: Option<&'r ItemScope>, report: &'r mut Report) -> Self {
        let group = scope.filter(|scope| scope.grouped).map(|scope| scope.collection);
        let indices = world.chosen.index.iter().map(|(name, number)| ((*name).to_owned(), *number)).collect();
        Resolver { world, scope, item: world.chosen.item, outer: None, group, indices, report }
    }

    /// The formula of a number; `None` after a mistake.
    pub fn scalar(&mut self, ast: &Ast) -> Option<Formula> {
        match self.value(ast)? {
            Value::Scalar(formula) => Some(formula),
            Value::Array(list) => {
                let message = format!("this is an array of {}, where one number is needed", list.len());
                self.mistake(
                    MistakeCode::ArraySize,
                    ast.span,
                    message,
                    Some("index it, as in x[1], or join it: sum(…), min(…), max(…)".into()),
                )
            }
        }
    }

    /// The formula or the formulas; `None` after a mistake.
    pub fn value(&mut self, ast: &Ast) -> Option<Value> {
        match &ast.kind {
            AstKind::Number(number) => Some(Value::Scalar(Formula::Constant(*number))),
            AstKind::Quantity(value, unit, written) => {
                self.say_hidden(written, ast.span);
                let value = self.own_units(**unit, ast.span, |units| units.own(*value, **unit))?;
                Some(Value::Scalar(Formula::Constant(value)))
            }
            AstKind::ValueIn(inner, unit) => self.measured(inner, **unit, Binary::Divide, ast.span),
            AstKind::OfUnit(inner, unit) => self.measured(inner, **unit, Binary::Multiply, ast.span),
            AstKind::Text(_) => {
                self.mistake(MistakeCode::TextAndNumber, ast.span, "text is no number", Some("compare it in a `where`".into()))
            }
            AstKind::Name(parts) => self.name(parts, ast.span),
            AstKind::Index(base, index) => self.index(base, index, ast.span),
            AstKind::Slice(base, ends) => self.slice(base, ends, ast.span),
            AstKind::Unary(op, operand) => {
                let value = self.value(operand)?;
                self.each(value, |formula| unary(*op, formula), ast.span)
            }
            AstKind::Binary(op, left, right) => {
                // Both sides are looked at, so that mistakes on either are found.
                let (left, right) = (self.value(left), self.value(right));
                self.binary(*op, left?, right?, ast.span)
            }
            AstKind::Fold(fold, arguments) => {
                let values: Vec<Option<Value>> = arguments.iter().map(|argument| self.value(argument)).collect();
                let values: Option<Vec<Value>> = values.into_iter().collect();
                let list: Vec<Formula> = values?.into_iter().flat_map(Value::into_list).collect();
                self.known(join(*fold, list), ast.span).map(Value::Scalar)
            }
            AstKind::Over { fold, collection, filter, body } => {
                self.over(*fold, *collection, filter.as_deref(), body, ast.span).map(Value::Scalar)
            }
            AstKind::OverRange { fold, index, ends, body } => {
                self.over_range(*fold, index, ends, body, ast.span).map(Value::Scalar)
            }
            AstKind::Call(name, arguments) if crate::expression::parse::RESPONSES.contains(&name.as_str()) => {
                self.response(name, arguments, ast.span)
            }
            AstKind::Call(name, arguments) if name == "profile" => self.profile(arguments, ast.span).map(Value::Scalar),
            AstKind::Call(name, arguments) if name == "quadratic" => self.quadratic(arguments, ast.span).map(Value::Scalar),
            AstKind::Call(name, arguments) => self.call(name, arguments, ast.span),
        }
    }

    /// A call of something that is no function.
    fn call(&mut self, name: &str, arguments: &[Ast], span: Span) -> Option<Value> {
        arguments.iter().for_each(|argument| drop(self.value(argument)));
        let span = Span { start: span.start, end: span.start + name.len() };
        let functions =
            Unary::NAMED.iter().map(|(name, _)| *name).chain(["atan2", "dot", "max", "min", "profile", "quadratic", "sum"]);
        if self.world.names.find(self.world.problem, name).is_some() {
            let help = format!("write `{name}*(…)` for a product, `{name}[…]` for an element");
            return self.mistake(MistakeCode::UnknownFunction, span, format!("`{name}` is no function"), Some(help));
        }
        let help = super::nearest::did_you_mean(name, functions.clone());
        let known = || format!("known: {}", functions.collect::<Vec<_>>().join(", "));
        self.mistake(MistakeCode::UnknownFunction, span, format!("unknown function `{name}`"), Some(help.unwrap_or_else(known)))
    }

    /// `x[3]`
    fn index(&mut self, base: &Ast, index: &Ast, span: Span) -> Option<Value> {
        if let AstKind::Name(parts) = &base.kind
            && self.lists_dimensions(parts)
        {
            return self.listed_dimension(parts, index, span);
        }
        // An array of variables is not written out for each of its elements.
        if let Some((first, size)) = self.array_of_variables(base) {
            let position = self.scalar(index)?;
            let at = self.position(position, size, index.span, span)?;
            return Some(Value::Scalar(Formula::Variable(first + at as u32)));
        }
        let (base_value, position) = (self.value(base), self.scalar(index));
        let Value::Array(mut list) = base_value? else {
            return self.mistake(
                MistakeCode::ArraySize,
                base.span,
                "this is one number, not an array",
                Some("leave the index out".into()),
            );
        };
        let at = self.position(position?, list.len(), index.span, span)?;
        Some(Value::Scalar(list.swap_remove(at)))
    }

    /// The place, counted from 0, that an index names among so many.
    fn position(&mut self, index: Formula, size: usize, at: Span, span: Span) -> Option<usize> {
        let Formula::Constant(position) = index else {
            let help = "an index is a number or an expression in parameters";
            return self.mistake(MistakeCode::NotConstant, at, "this index is not constant", Some(help.into()));
        };
        if position.fract() != 0.0 || position < 1.0 || position > size as f64 {
            let message = format!("there is no element {position}");
            return self.mistake(MistakeCode::ArraySize, span, message, Some(format!("elements are counted from 1 to {size}")));
        }
        Some(position as usize - 1)
    }

    fn binary(&mut self, op: Binary, left: Value, right: Value, span: Span) -> Option<Value> {
        use Value::{Array, Scalar};
        match (left, right) {
            (Scalar(left), Scalar(right)) => self.known(binary(op, left, right), span).map(Scalar),
            (left, Scalar(right)) => self.each(left, |left| binary(op, left, right.clone()), span),
            (Scalar(left), right) => self.each(right, |right| binary(op, left.clone(), right), span),
            (Array(left), Array(right)) if left.len() == right.len() => {
                let pairs = left.into_iter().zip(right);
                pairs.map(|(left, right)| self.known(binary(op, left, right), span)).collect::<Option<_>>().map(Array)
            }
            (Array(left), Array(right)) => {
                let message = format!("arrays of {} and {} elements do not go together", left.len(), right.len());
                self.mistake(
                    MistakeCode::ArraySize,
                    span,
                    message,
                    Some("both need the same size; single numbers are repeated".into()),
                )
            }
        }
    }

    /// Element by element.
    fn each(&mut self, value: Value, apply: impl Fn(Formula) -> Formula, span: Span) -> Option<Value> {
        match value {
            Value::Scalar(formula) => self.known(apply(formula), span).map(Value::Scalar),
            Value::Array(list) => {
                let list = list.into_iter().map(|formula| self.known(apply(formula), span));
                list.collect::<Option<_>>().map(Value::Array)
            }
        }
    }

    /// The formula, unless it is a constant that is no number.
    fn known(&mut self, formula: Formula, span: Span) -> Option<Formula> {
        match formula {
            Formula::Constant(value) if value.is_nan() => self.mistake(
                MistakeCode::NoValue,
                span,
                "this has no value",
                Some("it leaves the domain, as 0/0 or log(-1) do".into()),
            ),
            formula => Some(formula),
        }
    }

    fn mistake<T>(&mut self, code: MistakeCode, span: Span, message: impl Into<String>, help: Option<String>) -> Option<T> {
        self.report.mistakes.push((code, Remark { span, message: message.into(), help }));
        None
    }

    fn warning(&mut self, code: MistakeCode, span: Span, message: String, help: &str) {
        if self.report.warnings.iter().all(|(_, remark)| remark.message != message) {
            self.report.warnings.push((code, Remark { span, message, help: Some(help.into()) }));
        }
    }

    /// A global formula as a constant where it depends on no variable.
    fn folded(&self, formula: Formula) -> Formula {
        match Evaluation::constants(self.world.problem).value(&formula, Item::None) {
            Some(value) if !value.is_nan() => Formula::Constant(value),
            _ => formula,
        }
    }
}

impl Value {
    /// The formula, or the elements' formulas.
    pub fn formulas(&self) -> &[Formula] {
        match self {
            Value::Scalar(formula) => std::slice::from_ref(formula),
            Value::Array(list) => list,
        }
    }

    fn into_list(self) -> Vec<Formula> {
        match self {
            Value::Scalar(formula) => vec![formula],
            Value::Array(list) => list,
        }
    }
}

fn unary(op: Unary, operand: Formula) -> Formula {
    match operand {
        Formula::Constant(value) => Formula::Constant(op.evaluate(value)),
        operand => Formula::Unary(op, Box::new(operand)),
    }
}

fn binary(op: Binary, left: Formula, right: Formula) -> Formula {
    match (left, right) {
        (Formula::Constant(left), Formula::Constant(right)) => Formula::Constant(op.evaluate(left, right)),
        (left, right) => Formula::Binary(op, Box::new(left), Box::new(right)),
    }
}

/// The list joined; a number where all are numbers.
fn join(fold: Fold, mut list: Vec<Formula>) -> Formula {
    let number = |formula: &Formula| if let Formula::Constant(value) = formula { Some(*value) } else { None };
    if list.len() == 1 {
        return list.swap_remove(0);
    }
    let Some(numbers) = list.iter().map(number).collect::<Option<Vec<f64>>>() else { return Formula::Fold(fold, list) };
    let op = match fold {
        Fold::Sum => Binary::Add,
        Fold::Min => Binary::Min,
        Fold::Max => Binary::Max,
    };
    Formula::Constant(numbers.into_iter().reduce(|left, right| op.evaluate(left, right)).unwrap_or(f64::NAN))
}

/// The collection's word in files.
fn word(collection: Collection) -> &'static str {
    match collection {
        Collection::Ribs => "ribs",
        Collection::Sections => "sections",
        Collection::Nodes => "nodes",
    }
}
