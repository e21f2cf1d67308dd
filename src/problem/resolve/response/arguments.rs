//! The arguments of a response, taken one by one: case, node, rib, direction.

use super::super::Resolver;
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection};
use crate::problem::formula::Subject;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::{DIRECTIONS, Structure};

/// One argument, read as a word where it may be one.
pub(super) struct Argument<'a> {
    pub(super) ast: &'a Ast,
    pub(super) word: Option<&'a str>,
}

/// The arguments not yet looked at.
pub(super) struct Arguments<'a> {
    pub(super) list: std::collections::VecDeque<Argument<'a>>,
    pub(super) span: Span,
}

impl<'a> Argument<'a> {
    pub(super) fn of(ast: &'a Ast) -> Self {
        let word = match &ast.kind {
            AstKind::Text(text) => Some(text.as_str()),
            AstKind::Name(parts) if parts.len() == 1 => Some(parts[0].as_str()),
            _ => None,
        };
        Argument { ast, word }
    }
}

impl<'a> Arguments<'a> {
    /// The next argument, if it is a word that passes.
    pub(super) fn word<T>(&mut self, passes: impl Fn(&str) -> Option<T>) -> Option<T> {
        let found = passes(self.list.front()?.word?)?;
        self.list.pop_front();
        Some(found)
    }
}

impl<'a> Resolver<'a, '_> {
    pub(super) fn case(&mut self, structure: &Structure, arguments: &mut Arguments) -> Option<u32> {
        let Some(first) = arguments.list.pop_front() else {
            return self.mistake(
                MistakeCode::Response,
                arguments.span,
                "no case is named",
                Some("give a load case or a combination first".into()),
            );
        };
        if let Some(word) = first.word {
            if let (Some(case), "case") = (self.world.chosen.case, word) {
                return Some(case);
            }
            if let Some(set) = structure.load_set(word) {
                return Some(set);
            }
        }
        let names: Vec<&str> = (0..structure.load_sets() as u32).map(|set| structure.load_set_name(set)).collect();
        let help = first.word.and_then(|word| did_you_mean(word, names.iter().copied()));
        let help = help.unwrap_or_else(|| match names.is_empty() {
            true => "declare a case: [[loads]] with `case = \"…\"`".into(),
            false => format!("cases and combinations: {}", names.join(", ")),
        });
        let message = match first.word {
            Some(word) => format!("there is no case or combination `{word}`"),
            None => "this is no case".into(),
        };
        self.mistake(MistakeCode::UnknownItem, first.ast.span, message, Some(help))
    }

    pub(super) fn node(&mut self, structure: &Structure, name: &str, arguments: &mut Arguments) -> Option<Subject> {
        let own = self.scope.is_some_and(|scope| scope.collection == Collection::Nodes);
        let find =
            |word: &str| (0..structure.nodes.names.len() as u32).find(|&node| &structure.nodes.names[node as usize] == word);
        if own && arguments.list.len() == 1 {
            return Some(Subject::Own);
        }
        if let Some(node) = arguments.word(find) {
            return Some(Subject::Node(node));
        }
        let Some(next) = arguments.list.front() else {
            return self.mistake(
                MistakeCode::Response,
                arguments.span,
                format!("`{name}` names no node"),
                Some(shape(name).into()),
            );
        };
        let known = structure.nodes.names.iter().take(10_000);
        let help = next.word.and_then(|word| did_you_mean(word, known));
        let message = next.word.map_or("this is no node".into(), |word| format!("there is no node `{word}`"));
        self.mistake(MistakeCode::UnknownItem, next.ast.span, message, Some(help.unwrap_or_else(|| shape(name).into())))
    }

    pub(super) fn direction(&mut self, structure: &Structure, name: &str, arguments: &mut Arguments) -> Option<u8> {
        let has = structure.plane.directions();
        let known: Vec<&str> = DIRECTIONS.iter().zip(has).filter(|(_, has)| *has).map(|(name, _)| *name).collect();
        let find = |word: &str| DIRECTIONS.iter().position(|known| *known == word).filter(|&at| has[at]).map(|at| at as u8);
        self.needed(name, arguments, &format!("a direction: {}", known.join(", ")), find)
    }

    /// A rib of the structure: named, or the row's own.
    pub(super) fn response_rib(&mut self, structure: &Structure, name: &str, arguments: &mut Arguments) -> Option<Subject> {
        let problem = self.world.problem;
        let find = |word: &str| self.world.names.ribs.find(&problem.ribs.names, word);
        if let Some(rib) = arguments.word(find) {
            if structure.member(rib).is_none() {
                let rib = &problem.ribs.names[rib as usize];
                let help = "give it `start` and `end`";
                return self.mistake(
                    MistakeCode::NoStructure,
                    arguments.span,
                    format!("rib `{rib}` has no nodes, so it is no part of the structure"),
                    Some(help.into()),
                );
            }
            return Some(Subject::Rib(rib));
        }
        match self.scope {
            Some(scope) if scope.collection == Collection::Ribs => {
                let without = scope.members.iter().find(|&&rib| structure.member(rib).is_none());
                match without {
                    None => Some(Subject::Own),
                    Some(&rib) => {
                        let rib = &problem.ribs.names[rib as usize];
                        let help = "choose others by `only` or `where`, or give it `start` and `end`";
                        self.mistake(
                            MistakeCode::NoStructure,
                            arguments.span,
                            format!("rib `{rib}` has no nodes, so `{name}` has no value there"),
                            Some(help.into()),
                        )
                    }
                }
            }
            _ => {
                let (span, message, help) = match arguments.list.front() {
                    Some(next) => {
                        let near = next.word.and_then(|word| did_you_mean(word, problem.ribs.names.iter().take(10_000)));
                        let message = next.word.map_or("this is no rib".into(), |word| format!("there is no rib `{word}`"));
                        (next.ast.span, message, near)
                    }
                    None => (arguments.span, format!("`{name}` names no rib"), None),
                };
                self.mistake(
                    MistakeCode::UnknownItem,
                    span,
                    message,
                    Some(help.unwrap_or_else(|| format!("{}, or for = \"ribs\"", shape(name)))),
                )
            }
        }
    }

    pub(super) fn needed<T>(
        &mut self,
        name: &str,
        arguments: &mut Arguments,
        what: &str,
        passes: impl Fn(&str) -> Option<T>,
    ) -> Option<T> {
        if let Some(found) = arguments.word(passes) {
            return Some(found);
        }
        let span = arguments.list.front().map_or(arguments.span, |next| next.ast.span);
        self.mistake(MistakeCode::Response, span, format!("`{name}` needs {what}"), Some(format!("as in {}", shape(name))))
    }
}

pub(super) fn axis(word: &str) -> Option<bool> {
    match word {
        "z" => Some(true),
        "y" => Some(false),
        _ => None,
    }
}

/// What a response takes, for help.
pub(super) fn shape(name: &str) -> &'static str {
    match name {
        "disp" => "disp(CASE, NODE, DIRECTION)",
        "reaction" => "reaction(CASE, NODE, DIRECTION)",
        "deflection" => "deflection(CASE, RIB, y or z, station)",
        "sag" => "sag(CASE, y or z)",
        "force" => "force(CASE, RIB, N | Vy | Vz | T | My | Mz, station)",
        "stress" => "stress(CASE, RIB, station, POINT)",
        "buckling" => "buckling(CASE) or buckling(CASE, k)",
        "frequency" => "frequency(k)",
        "vonmises" => "vonmises(CASE, RIB, station, POINT)",
        _ => "compliance(CASE)",
    }
}
