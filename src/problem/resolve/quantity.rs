//! Quantities: numbers with units become numbers of the file's own.

use super::{Resolver, Value, binary};
use crate::expression::Span;
use crate::expression::ast::Ast;
use crate::expression::operators::Binary;
use crate::problem::Formula;
use crate::problem::mistake_code::MistakeCode;
use crate::units::{System, Unit};

impl Resolver<'_, '_> {
    /// What the file's base units make of a unit; a mistake where one is not given.
    pub(super) fn own_units(
        &mut self,
        unit: Unit,
        span: Span,
        convert: impl Fn(&System) -> Result<f64, &'static str>,
    ) -> Option<f64> {
        self.report.quantities = true;
        match convert(self.world.units) {
            Ok(value) if value.is_finite() => Some(value),
            Ok(_) => self.mistake(
                MistakeCode::Units,
                span,
                "this is too large in the file's units",
                Some("choose other base units".into()),
            ),
            Err(key) => {
                let (message, help) = self.world.units.missing(key);
                self.mistake(MistakeCode::Units, span, message, Some(format!("{help}: this is {}", unit.dimension())))
            }
        }
    }

    /// Warns where a name of the file is read as a part of a unit: `5 kN/t` with a thickness t.
    pub(super) fn say_hidden(&mut self, unit: &str, span: Span) {
        let mut symbols = unit.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').skip(1);
        let hidden = |name: &&str| {
            let own = self.scope.is_some_and(|scope| scope.offers(name));
            own || self.world.names.find(self.world.problem, name).is_some()
        };
        if let Some(name) = symbols.find(hidden) {
            let message = format!("`{name}` is a part of the unit here, not what has this name");
            self.warning(MistakeCode::HiddenName, span, message, "put blanks around the sign before it where the name is meant");
        }
    }

    /// `value(x, "MPa")` is x over 1 MPa, `quantity(x, "MPa")` x times 1 MPa.
    pub(super) fn measured(&mut self, inner: &Ast, unit: Unit, op: Binary, span: Span) -> Option<Value> {
        let (value, one) = (self.value(inner), self.own_units(unit, span, |units| units.own(1.0, unit)));
        let one = one?;
        self.each(value?, |formula| binary(op, formula, Formula::Constant(one)), span)
    }
}
