//! Responses of the structure: `disp(CASE, NODE, x)`, `stress(CASE, RIB, s, POINT)`, ….
//!
//! What is left out belongs to the row: the item of its scope, and a station, a point and a case of those that a constraint is spread
//! over ([`Chosen`]); elsewhere it has to be said.

use std::sync::Arc;

use super::{Resolver, Stage, Value};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::problem::formula::{Members, Response, Subject, What};
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::{DIRECTIONS, Structure};
use crate::problem::{Formula, Problem, Property};
use crate::sections::{self, Points};
use crate::structure::beam::Force;

/// The case, station and point of the row a constraint is being spread over.
#[derive(Debug, Clone, Copy, Default)]
pub struct Chosen<'a> {
    /// The case or combination that the word `case` stands for.
    pub case: Option<u32>,
    /// The station of responses that name none.
    pub station: Option<f64>,
    /// The point of stresses that name none.
    pub point: Option<&'a str>,
    /// The sign of torsion's share in shear stresses.
    pub sign: f64,
    /// The row's item, where each is resolved by itself.
    pub item: Option<(Collection, u32)>,
}

/// What responses left open while a formula was resolved: the row has to be spread over it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Open {
    /// Some response names no station.
    pub station: bool,
    /// Some normal stress names no point.
    pub stress: bool,
    /// Some equivalent stress names no point.
    pub shear: bool,
    /// Sags occur: rows are those of the ribs of each line.
    pub sag: bool,
    /// Shear stresses occur, so that torsion may count either way.
    pub sign: bool,
    /// Cases and combinations that occur.
    pub sets: Vec<u32>,
    /// Forms of the sections whose points are left open.
    pub forms: Vec<u16>,
}

/// One argument, read as a word where it may be one.
struct Argument<'a> {
    ast: &'a Ast,
    word: Option<&'a str>,
}

impl<'a> Argument<'a> {
    fn of(ast: &'a Ast) -> Self {
        let word = match &ast.kind {
            AstKind::Text(text) => Some(text.as_str()),
            AstKind::Name(parts) if parts.len() == 1 => Some(parts[0].as_str()),
            _ => None,
        };
        Argument { ast, word }
    }
}

/// The arguments not yet looked at.
struct Arguments<'a> {
    list: std::collections::VecDeque<Argument<'a>>,
    span: Span,
}

impl<'a> Arguments<'a> {
    /// The next argument, if it is a word that passes.
    fn word<T>(&mut self, passes: impl Fn(&str) -> Option<T>) -> Option<T> {
        let found = passes(self.list.front()?.word?)?;
        self.list.pop_front();
        Some(found)
    }
}

impl<'a> Resolver<'a, '_> {
    /// The formula of a response.
    pub(super) fn response(&mut self, name: &str, arguments: &[Ast], span: Span) -> Option<Value> {
        let Some(structure) = self.world.problem.structure.as_deref() else {
            let help = "declare [nodes], [supports] and ribs with `start` and `end`";
            return self.mistake(span, format!("`{name}` needs a structure, and there is none"), Some(help.into()));
        };
        if self.world.stage == Stage::Constants {
            let help = "numbers and parameters may occur here";
            return self.mistake(span, format!("`{name}` depends on the design, but this must be constant"), Some(help.into()));
        }
        let mut arguments = Arguments { list: arguments.iter().map(Argument::of).collect(), span };
        let formula = match name {
            "buckling" | "frequency" => {
                let help = "buckling and frequencies are not computed by this version";
                return self.mistake(span, format!("`{name}` is not available"), Some(help.into()));
            }
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
            return self.mistake(surplus.ast.span, format!("this is no argument of `{name}`"), Some(help));
        }
        Some(Value::Scalar(formula))
    }

    fn of_case(&mut self, structure: &Structure, name: &str, set: u32, arguments: &mut Arguments) -> Option<Formula> {
        let one = |subject, what| Formula::Response(Arc::new(Response { set, subject, what }));
        match name {
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
            _ => {
                let rib = self.response_rib(structure, name, arguments)?;
                let forms = self.forms(structure, rib);
                let known: Vec<Points> = forms.iter().map(|&form| sections::kind_of(form).points(sections::form(form))).collect();
                let point = |word: &str| known.iter().any(|points| names_point(points, word)).then(|| Arc::<str>::from(word));
                let unknown = arguments
                    .list
                    .front()
                    .and_then(|next| next.word)
                    .filter(|word| point(word).is_none() && self.world.names.find(self.world.problem, word).is_none());
                if let (Some(word), Some(next)) = (unknown, arguments.list.front()) {
                    let names: Vec<&str> = known.iter().flat_map(all_points).collect();
                    let help =
                        did_you_mean(word, names.iter().copied()).unwrap_or_else(|| format!("its points: {}", names.join(", ")));
                    return self.mistake(next.ast.span, format!("`{word}` is no point of the section"), Some(help));
                }
                let is_point = arguments.list.front().and_then(|next| next.word).is_some_and(|word| point(word).is_some());
                let station = if is_point { self.open_station(arguments.span)? } else { self.station(arguments)? };
                let point = match arguments.word(point) {
                    Some(point) => point,
                    None if arguments.list.is_empty() => self.open_point(name, &forms, arguments.span)?,
                    None => {
                        let names: Vec<&str> = known.iter().flat_map(all_points).collect();
                        let next = arguments.list.pop_front()?;
                        let help = next.word.and_then(|word| did_you_mean(word, names.iter().copied()));
                        let help = help.unwrap_or_else(|| format!("its points: {}", names.join(", ")));
                        return self.mistake(next.ast.span, "this is no point of the section", Some(help));
                    }
                };
                let stress = one(rib, What::Stress(station, Arc::clone(&point)));
                if name == "stress" {
                    return Some(stress);
                }
                if let Some(&without) =
                    forms.iter().find(|&&form| sections::kind_of(form).points(sections::form(form)).shear.is_empty())
                {
                    let kind = sections::kind_of(without).name();
                    let message = format!("sections of kind {kind} know no shear stresses, and `vonmises` needs them");
                    return self.mistake(arguments.span, message, Some("limit stress(…) instead, or choose another kind".into()));
                }
                self.report.open.sign = true;
                let sign = if self.world.chosen.sign == 0.0 { 1.0 } else { self.world.chosen.sign };
                let shear = one(rib, What::Shear(station, point, sign));
                Some(Formula::Unary(Unary::Sqrt, Box::new(equivalent_square(stress, shear))))
            }
        }
    }

    fn case(&mut self, structure: &Structure, arguments: &mut Arguments) -> Option<u32> {
        let Some(first) = arguments.list.pop_front() else {
            return self.mistake(arguments.span, "no case is named", Some("give a load case or a combination first".into()));
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
        self.mistake(first.ast.span, message, Some(help))
    }

    fn node(&mut self, structure: &Structure, name: &str, arguments: &mut Arguments) -> Option<Subject> {
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
            return self.mistake(arguments.span, format!("`{name}` names no node"), Some(shape(name).into()));
        };
        let known = structure.nodes.names.iter().take(10_000);
        let help = next.word.and_then(|word| did_you_mean(word, known));
        let message = next.word.map_or("this is no node".into(), |word| format!("there is no node `{word}`"));
        self.mistake(next.ast.span, message, Some(help.unwrap_or_else(|| shape(name).into())))
    }

    fn direction(&mut self, structure: &Structure, name: &str, arguments: &mut Arguments) -> Option<u8> {
        let has = structure.plane.directions();
        let known: Vec<&str> = DIRECTIONS.iter().zip(has).filter(|(_, has)| *has).map(|(name, _)| *name).collect();
        let find = |word: &str| DIRECTIONS.iter().position(|known| *known == word).filter(|&at| has[at]).map(|at| at as u8);
        self.needed(name, arguments, &format!("a direction: {}", known.join(", ")), find)
    }

    /// A rib of the structure: named, or the row's own.
    fn response_rib(&mut self, structure: &Structure, name: &str, arguments: &mut Arguments) -> Option<Subject> {
        let problem = self.world.problem;
        let find = |word: &str| self.world.names.ribs.find(&problem.ribs.names, word);
        if let Some(rib) = arguments.word(find) {
            if structure.member(rib).is_none() {
                let rib = &problem.ribs.names[rib as usize];
                let help = "give it `start` and `end`";
                return self.mistake(
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
                self.mistake(span, message, Some(help.unwrap_or_else(|| format!("{}, or for = \"ribs\"", shape(name)))))
            }
        }
    }

    fn needed<T>(&mut self, name: &str, arguments: &mut Arguments, what: &str, passes: impl Fn(&str) -> Option<T>) -> Option<T> {
        if let Some(found) = arguments.word(passes) {
            return Some(found);
        }
        let span = arguments.list.front().map_or(arguments.span, |next| next.ast.span);
        self.mistake(span, format!("`{name}` needs {what}"), Some(format!("as in {}", shape(name))))
    }

    /// A fraction of the length; that of the row where it is left out.
    fn station(&mut self, arguments: &mut Arguments) -> Option<f64> {
        let Some(next) = arguments.list.pop_front() else { return self.open_station(arguments.span) };
        let Formula::Constant(at) = self.scalar(next.ast)? else {
            return self.mistake(next.ast.span, "this station is not constant", Some("a fraction of the rib's length".into()));
        };
        if !(0.0..=1.0).contains(&at) {
            let help = "0 is the rib's start, 1 its end";
            return self.mistake(next.ast.span, format!("station {at} lies outside the rib"), Some(help.into()));
        }
        Some(at)
    }

    fn open_station(&mut self, span: Span) -> Option<f64> {
        self.report.open.station = true;
        match self.world.chosen.station {
            Some(station) => Some(station),
            None => self.mistake(
                span,
                "no station is named",
                Some("only a constraint is spread over all stations: give a fraction of the rib's length".into()),
            ),
        }
    }

    fn open_point(&mut self, name: &str, forms: &[u16], span: Span) -> Option<Arc<str>> {
        match name {
            "stress" => self.report.open.stress = true,
            _ => self.report.open.shear = true,
        }
        self.report.open.forms.extend(forms);
        match self.world.chosen.point {
            Some(point) => Some(Arc::from(point)),
            None => self.mistake(
                span,
                "no point of the section is named",
                Some("only a constraint is spread over all points: name one, as top".into()),
            ),
        }
    }

    /// The forms of the sections concerned.
    fn forms(&self, structure: &Structure, rib: Subject) -> Vec<u16> {
        let ribs = match (rib, self.scope) {
            (Subject::Rib(rib), _) => vec![rib],
            (_, Some(scope)) => scope.members.clone(),
            _ => Vec::new(),
        };
        let mut forms: Vec<u16> =
            ribs.iter().filter(|&&rib| structure.member(rib).is_some()).map(|&rib| form(self.world.problem, rib)).collect();
        forms.sort_unstable();
        forms.dedup();
        forms
    }

    /// The displacement from the chord of a line of ribs, along an axis of the rib at hand: by groups of ribs along a line.
    fn sag(&mut self, structure: &Structure, set: u32, arguments: &mut Arguments) -> Option<Formula> {
        let rib = self.response_rib(structure, "sag", arguments)?;
        let vertical = self.needed("sag", arguments, "an axis of the ribs: y or z", axis)?;
        let station = self.station(arguments)?;
        if self.group != Some(Collection::Ribs) {
            let help = "use it with for = \"ribs\" and by = \"line\", a datum that tells which ribs make up a line";
            return self.mistake(arguments.span, "`sag` is taken from the chord of a line of ribs", Some(help.into()));
        }
        self.report.open.sag = true;
        Some(Formula::Response(Arc::new(Response { set, subject: rib, what: What::Sag(vertical, station, [0, 0]) })))
    }

    /// `at.h`: a dimension or property at the row's station.
    pub(super) fn at_station(&mut self, name: &str, span: Span) -> Option<Formula> {
        let offered = self.scope.is_some_and(|scope| scope.offers(name));
        if !offered {
            let help = "a dimension or property of the sections at both ends, as at.h or at.A";
            return self.mistake(span, format!("the sections here have no `{name}`"), Some(help.into()));
        }
        let station = self.open_station(span)?;
        Some(Formula::AtProperty(station, Property(Arc::from(name))))
    }

    /// `mass` and `weight`: of all ribs with nodes, or of the rib whose row it is.
    pub(super) fn mass(&mut self, name: &str, span: Span) -> Option<Formula> {
        let structure = self.world.problem.structure.as_deref()?;
        let own = self.scope.is_some_and(|scope| scope.collection == Collection::Ribs);
        let undefined = structure.members.iter().find(|member| structure.materials[member.material as usize].density.is_none());
        if let Some(member) = undefined {
            let material = &structure.materials[member.material as usize].name;
            let help = format!("give it: density, in material `{material}`");
            return self.mistake(span, format!("`{name}` needs the density of `{material}`"), Some(help));
        }
        let one = Formula::Response(Arc::new(Response { set: 0, subject: Subject::Own, what: What::Mass }));
        let mass = match own {
            true => one,
            false => Formula::Over {
                fold: Fold::Sum,
                collection: Collection::Ribs,
                members: Members::Listed(Arc::new({
                    let mut ribs: Vec<u32> = structure.members.iter().map(|member| member.rib).collect();
                    ribs.sort_unstable();
                    ribs
                })),
                body: Arc::new(one),
            },
        };
        let gravity = structure.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        Some(match name {
            "weight" => Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(gravity)), Box::new(mass)),
            _ => mass,
        })
    }

    /// `material.fy` in a rib's scope, or of a material by name.
    pub(super) fn material(&mut self, word: &str, name: &str, span: Span) -> Option<Option<Formula>> {
        let structure = self.world.problem.structure.as_deref()?;
        let in_ribs = self.scope.is_some_and(|scope| scope.collection == Collection::Ribs);
        if !(word == "material" && in_ribs) {
            return None;
        }
        let known = |material: u32| structure.material_number(material, name);
        let materials = self.scope.map(|scope| scope.members.as_slice()).unwrap_or_default();
        let lacking = materials.iter().find_map(|&rib| {
            let material = structure.members[structure.member(rib)? as usize].material;
            known(material).is_none().then_some(material)
        });
        if let Some(material) = lacking {
            let material = &structure.materials[material as usize];
            let names = material.data.iter().map(|(name, _)| &**name).chain(["E", "G", "nu", "density", "alpha"]);
            let help = did_you_mean(name, names).unwrap_or_else(|| format!("add it: {name} = … in [materials]"));
            return Some(self.mistake(span, format!("material `{}` has no number `{name}`", material.name), Some(help)));
        }
        Some(Some(Formula::OwnMaterial(Arc::from(name))))
    }
}

/// σ² + 3τ².
pub fn equivalent_square(stress: Formula, shear: Formula) -> Formula {
    let square = |formula| Formula::Binary(Binary::Power, Box::new(formula), Box::new(Formula::Constant(2.0)));
    let threefold = Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(3.0)), Box::new(square(shear)));
    Formula::Binary(Binary::Add, Box::new(square(stress)), Box::new(threefold))
}

/// The form of the section a rib starts with.
fn form(problem: &Problem, rib: u32) -> u16 {
    problem.sections.form[problem.ribs.from[rib as usize] as usize]
}

fn axis(word: &str) -> Option<bool> {
    match word {
        "z" => Some(true),
        "y" => Some(false),
        _ => None,
    }
}

fn all_points(points: &Points) -> impl Iterator<Item = &'static str> {
    let named = ["top", "bottom", "left", "right", "top-left", "top-right", "bottom-left", "bottom-right", "centre"];
    let own = points.shear.iter().copied().filter(move |point| !named.contains(point));
    named.into_iter().chain(own)
}

fn names_point(points: &Points, word: &str) -> bool {
    all_points(points).any(|known| known == word)
}

/// What a response takes, for help.
fn shape(name: &str) -> &'static str {
    match name {
        "disp" => "disp(CASE, NODE, DIRECTION)",
        "reaction" => "reaction(CASE, NODE, DIRECTION)",
        "deflection" => "deflection(CASE, RIB, y or z, station)",
        "sag" => "sag(CASE, y or z)",
        "force" => "force(CASE, RIB, N | Vy | Vz | T | My | Mz, station)",
        "stress" => "stress(CASE, RIB, station, POINT)",
        "vonmises" => "vonmises(CASE, RIB, station, POINT)",
        _ => "compliance(CASE)",
    }
}
