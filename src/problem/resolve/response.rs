//! Responses of the structure: `disp(CASE, NODE, x)`, `stress(CASE, RIB, s, POINT)`, ….
//!
//! What is left out belongs to the row: the item of its scope, and a station, a point and a case of those that a constraint is spread
//! over ([`super::Chosen`]); elsewhere it has to be said.

mod arguments;
mod items;
mod modes;
mod stress;

use std::sync::Arc;

use super::{Resolver, Stage, Value};
use crate::expression::Span;
use crate::expression::ast::{Ast, Collection};
use crate::problem::Formula;
use crate::problem::formula::{Response, Subject, What};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::modes::Pencil;
use crate::problem::structure::Structure;
use crate::structure::beam::Force;
use arguments::{Argument, Arguments, axis, shape};

impl<'a> Resolver<'a, '_> {
    /// The formula of a response.
    pub(super) fn response(&mut self, name: &str, arguments: &[Ast], span: Span) -> Option<Value> {
        let Some(structure) = self.world.problem.structure.as_deref() else {
            let help = "declare [nodes], [supports] and ribs with `start` and `end`";
            return self.mistake(
                MistakeCode::NoStructure,
                span,
                format!("`{name}` needs a structure, and there is none"),
                Some(help.into()),
            );
        };
        if self.world.stage == Stage::Constants {
            let help = "numbers and parameters may occur here";
            return self.mistake(
                MistakeCode::NotConstant,
                span,
                format!("`{name}` depends on the design, but this must be constant"),
                Some(help.into()),
            );
        }
        let mut arguments = Arguments { list: arguments.iter().map(Argument::of).collect(), span };
        let formula = match name {
            "frequency" => self.eigenvalue(structure, Pencil::Vibration, &mut arguments)?,
            _ => {
                let set = self.case(structure, &mut arguments)?;
                if !self.report.open.sets.contains(&set) {
                    self.report.open.sets.push(set);
                }
                self.of_case(structure, name, set, &mut arguments)?
            }
        };
        if let Some(surplus) = arguments.list.front() {
            let help = format!("`{name}` takes {}", shape(name));
            return self.mistake(MistakeCode::Response, surplus.ast.span, format!("this is no argument of `{name}`"), Some(help));
        }
        Some(Value::Scalar(formula))
    }

    fn of_case(&mut self, structure: &Structure, name: &str, set: u32, arguments: &mut Arguments) -> Option<Formula> {
        let one = |subject, what| Formula::Response(Arc::new(Response { set, subject, what }));
        match name {
            "buckling" => self.eigenvalue(structure, Pencil::Buckling(set), arguments),
            "compliance" => Some(one(Subject::Whole, What::Compliance)),
            "disp" | "reaction" => {
                let node = self.node(structure, name, arguments)?;
                let direction = self.direction(structure, name, arguments)?;
                let what = if name == "disp" { What::Displacement(direction) } else { What::Reaction(direction) };
                Some(one(node, what))
            }
            "force" => {
                let rib = self.response_rib(structure, name, arguments)?;
                let named = |word: &str| Force::NAMED.iter().find(|(known, _)| *known == word).map(|(_, force)| *force);
                let force = self.needed(name, arguments, "a force: N, Vy, Vz, T, My or Mz", named)?;
                let station = self.station(arguments)?;
                Some(one(rib, What::Force(force, station)))
            }
            "deflection" => {
                let rib = self.response_rib(structure, name, arguments)?;
                let vertical = self.needed(name, arguments, "an axis of the rib: y or z", axis)?;
                let station = self.station(arguments)?;
                Some(one(rib, What::Deflection(vertical, station)))
            }
            "sag" => self.sag(structure, set, arguments),
            _ => self.stress(structure, name, set, arguments),
        }
    }

    /// The displacement from the chord of a line of ribs, along an axis of the rib at hand: by groups of ribs along a line.
    fn sag(&mut self, structure: &Structure, set: u32, arguments: &mut Arguments) -> Option<Formula> {
        let rib = self.response_rib(structure, "sag", arguments)?;
        let vertical = self.needed("sag", arguments, "an axis of the ribs: y or z", axis)?;
        let station = self.station(arguments)?;
        if self.group != Some(Collection::Ribs) {
            let help = "use it with for = \"ribs\" and by = \"line\", a datum that tells which ribs make up a line";
            return self.mistake(
                MistakeCode::Group,
                arguments.span,
                "`sag` is taken from the chord of a line of ribs",
                Some(help.into()),
            );
        }
        self.report.open.sag = true;
        Some(Formula::Response(Arc::new(Response { set, subject: rib, what: What::Sag(vertical, station, [0, 0]) })))
    }
}
