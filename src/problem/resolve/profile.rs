//! `profile(depth, 0.25)`: a B-spline's value as a sum over its control variables.

use super::{Resolver, Stage};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind};
use crate::problem::cells::uses;
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::formula::Formula;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;

impl Resolver<'_, '_> {
    /// The profile's value; its parameter is constant, or follows from the items' data.
    pub(super) fn profile(&mut self, arguments: &[Ast], span: Span) -> Option<Formula> {
        let example = || Some("as in profile(depth, 0.25)".to_owned());
        let [which, at] = arguments else {
            let message = format!("`profile` takes 2 arguments, not {}", arguments.len());
            return self.mistake(MistakeCode::Profile, span, message, example());
        };
        if self.world.stage == Stage::Constants {
            let help = "numbers and parameters may occur here";
            return self.mistake(
                MistakeCode::NotConstant,
                span,
                "a profile varies, but this must be constant",
                Some(help.into()),
            );
        }
        let AstKind::Name(parts) = &which.kind else {
            return self.mistake(MistakeCode::Profile, which.span, "this is no name of a profile", example());
        };
        // Both arguments are looked at, so that mistakes in either are found.
        let (number, parameter) = (self.profile_named(&parts.join("."), which.span), self.scalar(at));
        let (number, parameter) = (number?, parameter?);
        self.parameter_inside(&parameter, at.span)?;
        match parameter {
            Formula::Constant(s) => self.world.problem.profiles.get(number as usize)?.at(s),
            other => Some(Formula::Profile(number, Box::new(other))),
        }
    }

    fn profile_named(&mut self, name: &str, span: Span) -> Option<u32> {
        let profiles = &self.world.problem.profiles;
        if let Some(at) = profiles.iter().position(|profile| profile.name == name) {
            return Some(at as u32);
        }
        let message = match self.world.names.find(self.world.problem, name) {
            Some(entity) => format!("`{name}` is a {}, not a profile", entity.word()),
            None => format!("there is no profile `{name}`"),
        };
        let help = did_you_mean(name, profiles.iter().map(|profile| profile.name.as_str()));
        self.mistake(
            MistakeCode::UnknownItem,
            span,
            message,
            Some(help.unwrap_or_else(|| format!("declare it: [profiles.{name}]"))),
        )
    }

    /// The parameter of every item concerned is a number from 0 to 1.
    fn parameter_inside(&mut self, parameter: &Formula, span: Span) -> Option<()> {
        let problem = self.world.problem;
        let items: Vec<Item> = match self.scope {
            Some(scope) => scope.members.iter().map(|&index| Item::of(scope.collection, index)).collect(),
            None => vec![Item::None],
        };
        for item in items {
            match Evaluation::constants(problem).value(parameter, item) {
                Some(s) if (0.0..=1.0).contains(&s) => {}
                Some(s) => {
                    let of = self.words_for(item);
                    let help = "it runs from 0, the line's beginning, to 1, its end";
                    return self.mistake(
                        MistakeCode::Profile,
                        span,
                        format!("the profile's parameter is {s}{of}"),
                        Some(help.into()),
                    );
                }
                // An empty cell is told of where the formula is used.
                None if uses(problem, parameter, self.scope).iter().any(|used| !used.empty.is_empty()) => {}
                None => {
                    let help = "give a number, or an expression in parameters and data";
                    return self.mistake(
                        MistakeCode::NotConstant,
                        span,
                        "the profile's parameter is not constant",
                        Some(help.into()),
                    );
                }
            }
        }
        Some(())
    }

    fn words_for(&self, item: Item) -> String {
        use crate::expression::ast::Collection::{Nodes, Ribs, Sections};
        match item {
            Item::None => String::new(),
            Item::Section(s) => format!(" for section `{}`", self.world.problem.item_name(Sections, s)),
            Item::Rib(r) => format!(" for rib `{}`", self.world.problem.item_name(Ribs, r)),
            Item::Node(n) => format!(" for node `{}`", self.world.problem.item_name(Nodes, n)),
        }
    }
}
