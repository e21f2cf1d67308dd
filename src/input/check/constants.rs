//! Expressions of the file: parsed, looked up, and the constant ones computed.

use super::Assembly;
use super::overrides::Overrides;
use crate::expression::ast::Ast;
use crate::expression::parse::{SyntaxError, parse};
use crate::input::declaration::{Declaration, Name, Numbers};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::Formula;
use crate::problem::mentions::mentions;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::order::order;
use crate::problem::resolve::{ItemScope, Report, Resolver, Stage, Value};

impl Assembly<'_> {
    /// The syntax tree, or mistakes pointing into the text.
    pub(super) fn parsed<T>(&mut self, written: &Written, parse: impl FnOnce(&str) -> Result<T, Vec<SyntaxError>>) -> Option<T> {
        match parse(&written.text) {
            Ok(tree) => Some(tree),
            Err(mistakes) => {
                for mistake in mistakes {
                    let place = written.part(mistake.span.start, mistake.span.end);
                    self.findings.mistake(MistakeCode::Expression, place, mistake.message, mistake.help);
                }
                None
            }
        }
    }

    /// Looks names up; remarks become mistakes and warnings at their places in `written`.
    pub(super) fn resolved<T>(
        &mut self,
        written: &Written,
        scope: Option<&ItemScope>,
        stage: Stage,
        resolve: impl FnOnce(&mut Resolver) -> Option<T>,
    ) -> Option<T> {
        let mut report = Report::default();
        let found = resolve(&mut Resolver::new(self.world(stage), scope, &mut report));
        for (code, remark) in report.mistakes {
            self.findings.mistake(code, written.part(remark.span.start, remark.span.end), remark.message, remark.help);
        }
        for (code, remark) in report.warnings.into_iter().filter(|_| !self.quiet) {
            self.findings.warning(code, written.part(remark.span.start, remark.span.end), remark.message, remark.help);
        }
        self.quantities |= report.quantities;
        for column in report.used {
            if !self.used.contains(&column) {
                self.used.push(column);
            }
        }
        found
    }

    /// The formula of one number.
    pub(super) fn scalar(&mut self, written: &Written, scope: Option<&ItemScope>) -> Option<Formula> {
        let ast = self.parsed(written, parse)?;
        self.resolved(written, scope, Stage::All, |resolver| resolver.scalar(&ast))
    }

    /// The number of a constant.
    pub(super) fn constant(&mut self, scalar: &Scalar) -> Option<f64> {
        match scalar {
            Scalar::Number(value, _) => Some(*value),
            Scalar::Expression(written) => {
                let ast = self.parsed(written, parse)?;
                let formula = self.resolved(written, None, Stage::Constants, |resolver| resolver.scalar(&ast))?;
                if let Formula::Constant(value) = formula { Some(value) } else { None }
            }
        }
    }

    /// The numbers of a constant: one, or an array's.
    pub(super) fn constants(&mut self, numbers: &Numbers) -> Option<Value> {
        match numbers {
            // Stands for a mistake that was told already.
            Numbers::One(Scalar::Number(value, _)) if value.is_nan() => None,
            Numbers::One(Scalar::Number(value, _)) => Some(Value::Scalar(Formula::Constant(*value))),
            Numbers::One(Scalar::Expression(written)) => {
                let ast = self.parsed(written, parse)?;
                self.resolved(written, None, Stage::Constants, |resolver| resolver.value(&ast))
            }
            Numbers::Many(list, _) => {
                let list: Vec<Option<f64>> = list.iter().map(|scalar| self.constant(scalar)).collect();
                list.into_iter().map(|value| value.map(Formula::Constant)).collect::<Option<_>>().map(Value::Array)
            }
        }
    }

    /// `[parameters]`, in an order in which each finds what it needs.
    pub(super) fn parameters(&mut self, declared: &Declaration, overrides: &Overrides) {
        let entries = &declared.parameters;
        self.parameters = vec![None; entries.len()];
        let needs: Vec<Vec<u32>> = entries.iter().map(|(_, numbers)| self.parameters_in(numbers)).collect();
        let order = order(entries.len(), |at| needs[at as usize].clone());
        for circle in &order.circles {
            let names: Vec<&Name> = circle.iter().map(|&at| &entries[at as usize].0).collect();
            self.circle(names[0].place, names.iter().map(|name| name.text.clone()).collect());
        }
        for at in order.order {
            let (name, numbers) = &entries[at as usize];
            self.parameters[at as usize] = match overrides.parameter(&name.text) {
                Some(value) => Some(Value::Scalar(Formula::Constant(value))),
                None if order.circles.iter().any(|circle| circle.contains(&at)) => None,
                None => self.constants(numbers),
            };
        }
        let density = self.names.find(&self.problem, "density");
        self.problem.density = match density
            .and_then(|entity| if let Entity::Parameter(p) = entity { self.parameters[p as usize].as_ref() } else { None })
        {
            Some(Value::Scalar(Formula::Constant(value))) => Some(*value),
            _ => None,
        };
    }

    fn parameters_in(&self, numbers: &Numbers) -> Vec<u32> {
        let scalars = match numbers {
            Numbers::One(scalar) => std::slice::from_ref(scalar),
            Numbers::Many(list, _) => list,
        };
        let trees = scalars.iter().filter_map(|scalar| match scalar {
            Scalar::Expression(written) => parse(&written.text).ok(),
            Scalar::Number(..) => None,
        });
        trees.flat_map(|ast| self.parameters_of(&ast)).collect()
    }

    fn parameters_of(&self, ast: &Ast) -> Vec<u32> {
        let names = mentions(ast).0.into_iter().filter_map(|mention| match mention.parts {
            [name] => self.names.find(&self.problem, name),
            _ => None,
        });
        names.filter_map(|entity| if let Entity::Parameter(at) = entity { Some(at) } else { None }).collect()
    }

    /// The mistake of names that depend on one another.
    pub(super) fn circle(&mut self, place: Place, mut names: Vec<String>) {
        let first = names[0].clone();
        names.push(first.clone());
        let path: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        let message = format!("`{first}` depends on itself");
        self.findings.mistake(
            MistakeCode::Circle,
            place,
            message,
            format!("{}: one of these must not need the next", path.join(" → ")),
        );
    }
}
