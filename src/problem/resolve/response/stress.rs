//! Stresses, and the stations and points they are asked for at.

use super::super::Resolver;
use super::arguments::Arguments;
use crate::expression::Span;
use crate::expression::operators::{Binary, Unary};
use crate::problem::formula::{Response, Subject, What};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::Structure;
use crate::problem::{Formula, Problem};
use crate::sections::{self, Points};
use std::sync::Arc;

impl<'a> Resolver<'a, '_> {
    /// `stress(CASE, RIB, station, POINT)` and `vonmises(…)`.
    pub(super) fn stress(&mut self, structure: &Structure, name: &str, set: u32, arguments: &mut Arguments) -> Option<Formula> {
        let one = |subject, what| Formula::Response(Arc::new(Response { set, subject, what }));
        let rib = self.response_rib(structure, name, arguments)?;
        let forms = self.forms(structure, rib);
        let (station, point) = self.stressed_point(name, &forms, arguments)?;
        let stress = one(rib, What::Stress(station, Arc::clone(&point)));
        if name == "stress" {
            return Some(stress);
        }
        if let Some(&without) = forms.iter().find(|&&form| sections::kind_of(form).points(sections::form(form)).shear.is_empty())
        {
            let kind = sections::kind_of(without).name();
            let message = format!("sections of kind {kind} know no shear stresses, and `vonmises` needs them");
            return self.mistake(
                MistakeCode::Response,
                arguments.span,
                message,
                Some("limit stress(…) instead, or choose another kind".into()),
            );
        }
        self.report.open.sign = true;
        let sign = if self.world.chosen.sign == 0.0 { 1.0 } else { self.world.chosen.sign };
        let shear = one(rib, What::Shear(station, point, sign));
        Some(Formula::Unary(Unary::Sqrt, Box::new(equivalent_square(stress, shear))))
    }

    /// The station and the point that a stress is asked for at.
    pub(super) fn stressed_point(&mut self, name: &str, forms: &[u16], arguments: &mut Arguments) -> Option<(f64, Arc<str>)> {
        let known: Vec<Points> = forms.iter().map(|&form| sections::kind_of(form).points(sections::form(form))).collect();
        let point = |word: &str| known.iter().any(|points| names_point(points, word)).then(|| Arc::<str>::from(word));
        let help = |word: Option<&str>| {
            let names: Vec<&str> = known.iter().flat_map(all_points).collect();
            let near = word.and_then(|word| did_you_mean(word, names.iter().copied()));
            near.unwrap_or_else(|| format!("its points: {}", names.join(", ")))
        };
        let unknown = arguments
            .list
            .front()
            .and_then(|next| next.word)
            .filter(|word| point(word).is_none() && self.world.names.find(self.world.problem, word).is_none());
        if let (Some(word), Some(next)) = (unknown, arguments.list.front()) {
            return self.mistake(
                MistakeCode::Response,
                next.ast.span,
                format!("`{word}` is no point of the section"),
                Some(help(Some(word))),
            );
        }
        let is_point = arguments.list.front().and_then(|next| next.word).is_some_and(|word| point(word).is_some());
        let station = if is_point { self.open_station(arguments.span)? } else { self.station(arguments)? };
        let point = match arguments.word(point) {
            Some(point) => point,
            None if arguments.list.is_empty() => self.open_point(name, forms, arguments.span)?,
            None => {
                let next = arguments.list.pop_front()?;
                return self.mistake(
                    MistakeCode::Response,
                    next.ast.span,
                    "this is no point of the section",
                    Some(help(next.word)),
                );
            }
        };
        Some((station, point))
    }

    /// A fraction of the length; that of the row where it is left out.
    pub(super) fn station(&mut self, arguments: &mut Arguments) -> Option<f64> {
        let Some(next) = arguments.list.pop_front() else { return self.open_station(arguments.span) };
        let Formula::Constant(at) = self.scalar(next.ast)? else {
            return self.mistake(
                MistakeCode::NotConstant,
                next.ast.span,
                "this station is not constant",
                Some("a fraction of the rib's length".into()),
            );
        };
        if !(0.0..=1.0).contains(&at) {
            let help = "0 is the rib's start, 1 its end";
            return self.mistake(
                MistakeCode::Response,
                next.ast.span,
                format!("station {at} lies outside the rib"),
                Some(help.into()),
            );
        }
        Some(at)
    }

    pub(super) fn open_station(&mut self, span: Span) -> Option<f64> {
        self.report.open.station = true;
        match self.world.chosen.station {
            Some(station) => Some(station),
            None => self.mistake(
                MistakeCode::Response,
                span,
                "no station is named",
                Some("only a constraint is spread over all stations: give a fraction of the rib's length".into()),
            ),
        }
    }

    pub(super) fn open_point(&mut self, name: &str, forms: &[u16], span: Span) -> Option<Arc<str>> {
        match name {
            "stress" => self.report.open.stress = true,
            _ => self.report.open.shear = true,
        }
        self.report.open.forms.extend(forms);
        match self.world.chosen.point {
            Some(point) => Some(Arc::from(point)),
            None => self.mistake(
                MistakeCode::Response,
                span,
                "no point of the section is named",
                Some("only a constraint is spread over all points: name one, as top".into()),
            ),
        }
    }

    /// The forms of the sections concerned.
    pub(super) fn forms(&self, structure: &Structure, rib: Subject) -> Vec<u16> {
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
}

/// σ² + 3τ².
pub fn equivalent_square(stress: Formula, shear: Formula) -> Formula {
    let square = |formula| Formula::Binary(Binary::Power, Box::new(formula), Box::new(Formula::Constant(2.0)));
    let threefold = Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(3.0)), Box::new(square(shear)));
    Formula::Binary(Binary::Add, Box::new(square(stress)), Box::new(threefold))
}

/// The form of the section a rib starts with.
pub(super) fn form(problem: &Problem, rib: u32) -> u16 {
    problem.sections.form[problem.ribs.from[rib as usize] as usize]
}

pub(super) fn all_points(points: &Points) -> impl Iterator<Item = &'static str> {
    let named = ["top", "bottom", "left", "right", "top-left", "top-right", "bottom-left", "bottom-right", "centre"];
    let own = points.shear.iter().copied().filter(move |point| !named.contains(point));
    named.into_iter().chain(own)
}

pub(super) fn names_point(points: &Points, word: &str) -> bool {
    all_points(points).any(|known| known == word)
}
