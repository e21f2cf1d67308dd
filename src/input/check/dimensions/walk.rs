//! The dimension of an expression, and the equations that it brings.

use std::collections::{BTreeSet, HashMap};

use super::super::Assembly;
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection, Condition, Requirement};
use crate::expression::operators::{Binary, Unary};
use crate::input::source::{Place, Written};
use crate::problem::Formula;
use crate::problem::names::Entity;
use crate::problem::resolve::Value;
use crate::sections;
use crate::units::inference::{Form, Inference};
use crate::units::{Dimension, Ratio, meant_by};

/// Where names are looked up: the items whose own names hold, and the dimension whose expression this is.
#[derive(Clone, Copy, Default)]
pub(super) struct Scope<'s> {
    pub holder: Option<Collection>,
    pub itself: Option<&'s str>,
}

/// Two dimensions that should be one.
pub(super) struct Disagreement {
    pub place: Place,
    pub message: String,
    pub help: Option<String>,
}

/// Goes through the file.
pub(super) struct Walk<'a, 's> {
    pub assembly: &'a Assembly<'s>,
    /// Kinds of the file's sections.
    pub kinds: Vec<&'static dyn sections::Kind>,
    pub inference: Inference,
    /// What rows measure, by the names of their constraints; and the objective.
    pub rows: Vec<(String, Form)>,
    pub objective: Option<Form>,
    /// Names that stand for whole numbers.
    pub indices: Vec<String>,
    unknowns: HashMap<String, Form>,
    /// Bare numbers that multiply something: plain ones, unless an equation says otherwise.
    factors: Vec<(Form, Place)>,
    /// Those of them that an equation gives a dimension.
    odd_factors: Vec<Disagreement>,
    disagreements: Vec<Disagreement>,
}

impl<'a, 's> Walk<'a, 's> {
    pub fn new(assembly: &'a Assembly<'s>) -> Self {
        let (inference, indices) = (Inference::default(), Vec::new());
        let (factors, odd_factors, disagreements) = (Vec::new(), Vec::new(), Vec::new());
        let (rows, objective, unknowns) = (Vec::new(), None, HashMap::new());
        let kinds: BTreeSet<u16> = assembly.problem.sections.form.iter().copied().collect();
        let kinds = kinds.into_iter().map(sections::kind_of).collect();
        Walk { assembly, kinds, inference, rows, objective, indices, unknowns, factors, odd_factors, disagreements }
    }

    /// What cannot be, and what is doubtful.
    pub fn finish(self) -> (Vec<Disagreement>, Vec<Disagreement>) {
        (self.disagreements, self.odd_factors)
    }

    /// What stands for a name, by its kind and name.
    pub fn unknown(&mut self, key: String) -> Form {
        self.unknowns.entry(key).or_insert_with(|| self.inference.unknown()).clone()
    }

    /// The dimension of a form, where it follows from the equations.
    pub fn known(&self, form: &Form) -> Option<Dimension> {
        self.inference.reduced(form)?.dimension()
    }

    /// Takes the numbers in products for plain ones as far as nothing else follows.
    pub fn settle_factors(&mut self) {
        for (factor, place) in std::mem::take(&mut self.factors) {
            match self.known(&factor) {
                // What is not determined cannot disagree.
                None => _ = self.inference.equal(&factor, &Dimension::NONE.into()),
                Some(dimension) if dimension.is_none() => {}
                Some(dimension) => {
                    let message = format!("the formula holds only if this number is {dimension}");
                    let help = "write its unit, or look for a factor that is missing".to_owned();
                    self.odd_factors.push(Disagreement { place, message, help: Some(help) });
                }
            }
        }
    }

    pub fn disagree(&mut self, place: Place, message: String, help: Option<String>) {
        self.disagreements.push(Disagreement { place, message, help });
    }

    /// The equation that an expression is what a place asks for.
    pub fn needed(&mut self, written: &Written, span: Span, form: &Form, needed: &Form, what: &str) {
        if let Err(difference) = self.inference.equal(form, needed) {
            let place = written.part(span.start, span.end);
            let found = self.known(form).map(|dimension| format!("this is {dimension}"));
            let asked = self.known(needed).map(|dimension| format!(": expected {dimension}"));
            let message = match (found, asked) {
                (Some(found), Some(asked)) => format!("{what}{asked}, but {found}"),
                _ => format!("{what} is of another dimension, by {difference}"),
            };
            self.disagree(place, message, Some("give it the unit it has, or look for a factor that is missing".into()));
        }
    }

    /// The equation that two parts of an expression are of one dimension.
    fn same(&mut self, written: &Written, span: Span, sides: [(&Ast, &Form); 2], verb: &str) {
        let [(left, left_form), (right, right_form)] = sides;
        let Err(difference) = self.inference.equal(left_form, right_form) else { return };
        let text = |ast: &Ast| written.text.get(ast.span.start..ast.span.end).unwrap_or_default().trim().to_owned();
        let (message, help) = match (self.known(left_form), self.known(right_form)) {
            (Some(first), Some(second)) => (
                format!("{first} and {second} cannot be {verb}"),
                format!("`{}` is {first}, `{}` is {second}", text(left), text(right)),
            ),
            _ => (
                format!("these cannot be {verb}: they differ by {difference}"),
                format!("`{}` is not of the dimension of `{}`", text(left), text(right)),
            ),
        };
        self.disagree(written.part(span.start, span.end), message, Some(help));
    }

    /// Both sides of a requirement; brings back what they measure.
    pub fn requirement(&mut self, requirement: &Requirement, written: &Written, scope: Scope) -> Form {
        let sides = match requirement {
            Requirement::Two { left, right, .. } => vec![left, right],
            Requirement::Range { lower, middle, upper } => vec![middle, lower, upper],
        };
        let forms: Vec<Form> = sides.iter().map(|side| self.expression(side, written, scope)).collect();
        for (side, form) in sides.iter().zip(&forms).skip(1) {
            let (start, end) = (sides[0].span.start.min(side.span.start), sides[0].span.end.max(side.span.end));
            self.same(written, Span { start, end }, [(sides[0], &forms[0]), (side, form)], "compared");
        }
        let bare = |at: &usize| !is_bare(sides[*at]);
        forms[(0..forms.len()).find(bare).unwrap_or(0)].clone()
    }

    pub fn condition(&mut self, condition: &Condition, written: &Written, scope: Scope) {
        match condition {
            Condition::Compare(_, left, right) => {
                let texts = |ast: &Ast| matches!(ast.kind, AstKind::Text(_) | AstKind::Name(_));
                if texts(left) && texts(right) {
                    return; // labels, for all that is known here
                }
                let forms = [left, right].map(|side| self.expression(side, written, scope));
                let span = Span { start: left.span.start, end: right.span.end };
                self.same(written, span, [(left, &forms[0]), (right, &forms[1])], "compared");
            }
            Condition::And(left, right) | Condition::Or(left, right) => {
                self.condition(left, written, scope);
                self.condition(right, written, scope);
            }
            Condition::Not(inner) => self.condition(inner, written, scope),
        }
    }

    /// The dimension of an expression.
    pub fn expression(&mut self, ast: &Ast, written: &Written, scope: Scope) -> Form {
        let plain = || Form::from(Dimension::NONE);
        if is_bare(ast) {
            return self.inference.unknown();
        }
        match &ast.kind {
            AstKind::Number(_) => self.inference.unknown(),
            AstKind::Text(_) => plain(),
            AstKind::Quantity(_, unit, _) => unit.dimension().into(),
            AstKind::ValueIn(inner, unit) => {
                let form = self.expression(inner, written, scope);
                self.needed(written, inner.span, &form, &unit.dimension().into(), "`value`");
                plain()
            }
            AstKind::OfUnit(inner, unit) => {
                let form = self.expression(inner, written, scope);
                self.needed(written, inner.span, &form, &plain(), "`quantity`");
                unit.dimension().into()
            }
            AstKind::Name(parts) => self.named(parts, scope),
            AstKind::Index(base, _) | AstKind::Slice(base, _) => self.expression(base, written, scope),
            AstKind::Unary(op, operand) => self.unary(*op, operand, written, scope),
            AstKind::Binary(op, left, right) => self.binary(*op, [left, right], ast.span, written, scope),
            AstKind::Fold(_, list) => {
                let forms: Vec<Form> = list.iter().map(|part| self.expression(part, written, scope)).collect();
                for (part, form) in list.iter().zip(&forms).skip(1) {
                    self.same(written, ast.span, [(&list[0], &forms[0]), (part, form)], "joined");
                }
                forms.into_iter().next().unwrap_or_else(plain)
            }
            AstKind::OverRange { index, ends, body, .. } => {
                ends.iter().for_each(|end| drop(self.expression(end, written, scope)));
                self.indices.push(index.clone());
                let form = self.expression(body, written, scope);
                self.indices.pop();
                form
            }
            AstKind::Over { collection, filter, body, .. } => {
                let inner = Scope { holder: Some(*collection), itself: None };
                if let Some(filter) = filter {
                    self.condition(filter, written, inner);
                }
                self.expression(body, written, inner)
            }
            AstKind::Call(name, arguments) => self.call(name, arguments, written, scope),
        }
    }

    fn unary(&mut self, op: Unary, operand: &Ast, written: &Written, scope: Scope) -> Form {
        let form = self.expression(operand, written, scope);
        match op {
            Unary::Negate | Unary::Abs => form,
            Unary::Sqrt => self.raised(&form, Some(Ratio::new(1, 2))),
            _ => {
                self.needed(written, operand.span, &form, &Dimension::NONE.into(), "an argument of a function");
                Dimension::NONE.into()
            }
        }
    }

    fn binary(&mut self, op: Binary, [left, right]: [&Ast; 2], span: Span, written: &Written, scope: Scope) -> Form {
        let first = self.expression(left, written, scope);
        if op == Binary::Power {
            return self.power(first, [left, right], written, scope);
        }
        let second = self.expression(right, written, scope);
        match op {
            Binary::Multiply | Binary::Divide => {
                for (side, form) in [(left, &first), (right, &second)] {
                    if is_bare(side) {
                        self.factors.push((form.clone(), written.part(side.span.start, side.span.end)));
                    }
                }
                let power = if op == Binary::Multiply { Ratio::ONE } else { Ratio::from_integer(-1) };
                first.times(&second, power).unwrap_or_else(|| self.inference.unknown())
            }
            Binary::Atan2 => {
                self.same(written, span, [(left, &first), (right, &second)], "compared");
                Dimension::NONE.into()
            }
            _ => {
                let verb = if matches!(op, Binary::Add | Binary::Subtract) { "added" } else { "compared" };
                self.same(written, span, [(left, &first), (right, &second)], verb);
                // A bare number says less than what it is added to.
                if is_bare(left) { second } else { first }
            }
        }
    }

    /// A power: its exponent is a plain number, and a constant unless the base is one, too.
    fn power(&mut self, base: Form, [left, right]: [&Ast; 2], written: &Written, scope: Scope) -> Form {
        if let Some(exponent) = self.constant(right).and_then(meant_by) {
            return self.raised(&base, Some(exponent));
        }
        let exponent = self.expression(right, written, scope);
        let plain = Form::from(Dimension::NONE);
        self.needed(written, right.span, &exponent, &plain, "an exponent");
        self.needed(written, left.span, &base, &plain, "the base of a power whose exponent varies");
        plain
    }

    fn raised(&mut self, form: &Form, exponent: Option<Ratio>) -> Form {
        let raised = exponent.and_then(|exponent| Form::from(Dimension::NONE).times(form, exponent));
        raised.unwrap_or_else(|| self.inference.unknown())
    }

    /// The value of an exponent made of numbers and parameters.
    fn constant(&self, ast: &Ast) -> Option<f64> {
        match &ast.kind {
            AstKind::Number(value) => Some(*value),
            AstKind::Unary(op, operand) => Some(op.evaluate(self.constant(operand)?)),
            AstKind::Binary(op, left, right) => Some(op.evaluate(self.constant(left)?, self.constant(right)?)),
            AstKind::Name(parts) => {
                let [name] = &parts[..] else { return None };
                let Some(Entity::Parameter(at)) = self.assembly.names.find(&self.assembly.problem, name) else { return None };
                match self.assembly.parameters.get(at as usize)?.as_ref()? {
                    Value::Scalar(Formula::Constant(value)) => Some(*value),
                    _ => None,
                }
            }
            _ => None,
        }
    }
}

/// Whether it is made of bare numbers alone: `500/5` is one number like another.
fn is_bare(ast: &Ast) -> bool {
    match &ast.kind {
        AstKind::Number(_) => true,
        AstKind::Unary(_, operand) => is_bare(operand),
        AstKind::Binary(_, left, right) => is_bare(left) && is_bare(right),
        _ => false,
    }
}
