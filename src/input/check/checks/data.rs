//! What a check has to be given: nothing is filled in silently.

use super::super::Assembly;
use crate::expression::parse::parse;
use crate::input::codes::{Aisc, Axis, Bending, CURVES, En, Euler, Made, Web};
use crate::input::declaration::checks::{AxisEntry, CheckEntry, LengthEntry, LtbEntry};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::resolve::{ItemScope, Stage};

/// A check's data by its code.
pub(super) enum Code {
    Euler(Euler),
    En { en: En, bending: Option<Bending>, class: u8, web: Option<Web>, fy: Scalar, unit: f64 },
    Aisc { aisc: Aisc, made: Made, fy: Scalar },
}

/// The codes, as files name them, with what reports call them.
pub(super) const CODES: [(&str, &str); 3] =
    [("Euler", "Euler's critical force"), ("EN 1993-1-1", "EN 1993-1-1:2005"), ("AISC 360-22", "AISC 360-22")];

/// What a missing key is, for help.
const MEANINGS: [(&str, &str); 13] = [
    ("fy", "the yield strength, such as fy = \"material.fy\""),
    ("gamma_M1", "the partial factor of 6.1: the code recommends 1.0, national annexes may differ"),
    ("class", "1, 2 or 3 of Table 5.2: its c/t limits become rows, and 1 and 2 count plastic moduli"),
    ("stress_unit", "the MPa in one unit of the file's stresses: 1e-3 in kN and m, 1 in N and mm"),
    ("buckling", "buckling = { y = { length = …, curve = \"b\" }, z = { length = …, curve = \"c\" } }"),
    ("safety", "what N is multiplied with: 1 for the bare critical force"),
    ("phi", "the resistance factor of E1: 0.9 (LRFD), or 1/1.67 (ASD)"),
    ("made", "made = \"rolled\" or \"built-up\": Table B4.1a tells them apart"),
    ("length", "the buckling length, such as length = \"0.7*length\""),
    ("curve", "the buckling curve a0, a, b, c or d: Table 6.2 tells which"),
    ("C1", "the factor of the moments' course in M_cr: 1.0 for a uniform moment"),
    ("lambda_LT0", "the plateau of 6.3.2.3: 0.4 is recommended"),
    ("beta", "the factor of 6.3.2.3: 0.75 is recommended"),
];

impl Assembly<'_> {
    /// A key that the code cannot do without.
    pub(super) fn needed<'s, T>(&mut self, value: Option<&'s T>, key: &str, place: Place, what: &str) -> Option<&'s T> {
        if value.is_none() {
            let meaning = MEANINGS.iter().find(|(known, _)| *known == key).map_or("", |(_, meaning)| meaning);
            self.findings.mistake(MistakeCode::MissingKey, place, format!("{what} needs `{key}`"), format!("add it: {meaning}"));
        }
        value
    }

    /// A positive constant that must be there.
    pub(super) fn factor(&mut self, value: Option<&Scalar>, key: &str, place: Place, what: &str) -> Option<f64> {
        let scalar = self.needed(value, key, place, what)?;
        let number = self.constant(scalar)?;
        if number > 0.0 && number.is_finite() {
            return Some(number);
        }
        self.findings.mistake(
            MistakeCode::OutOfRange,
            scalar.place(),
            format!("`{key}` cannot be {number}"),
            "expected a positive number",
        );
        None
    }

    /// The text of a quantity in the ribs' names, positive where it is constant.
    pub(super) fn expression(&mut self, scalar: &Scalar, key: &str, scope: &ItemScope) -> Option<String> {
        let text = match scalar {
            Scalar::Number(value, _) => value.to_string(),
            Scalar::Expression(written) => {
                let tree = self.parsed(written, parse)?;
                self.resolved(written, Some(scope), Stage::All, |resolver| resolver.scalar(&tree))?;
                written.text.clone()
            }
        };
        for &rib in &scope.members {
            if let Some(value) = self.value_of(scalar, scope, rib).filter(|value| *value <= 0.0 || !value.is_finite()) {
                self.findings.mistake(
                    MistakeCode::OutOfRange,
                    scalar.place(),
                    format!("`{key}` cannot be {value}"),
                    "expected a positive number",
                );
                return None;
            }
        }
        Some(text)
    }

    /// The value of a quantity for a rib, where it depends on no variable.
    pub(super) fn value_of(&mut self, scalar: &Scalar, scope: &ItemScope, rib: u32) -> Option<f64> {
        match scalar {
            Scalar::Number(value, _) => Some(*value),
            Scalar::Expression(written) => {
                let formula = self.quietly(&written.text, scope)?;
                Evaluation::constants(&self.problem).value(&formula, Item::Rib(rib))
            }
        }
    }

    /// A word of a list.
    pub(super) fn word<T: Copy>(&mut self, written: &Written, key: &str, known: &[(&str, T)]) -> Option<T> {
        if let Some((_, found)) = known.iter().find(|(word, _)| *word == written.text) {
            return Some(*found);
        }
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        let message = format!("`{key}` is \"{}\"", written.text);
        self.findings.mistake(
            MistakeCode::UnknownChoice,
            written.place,
            message,
            format!("expected one of {}", words.join(", ")),
        );
        None
    }

    /// Keys that this code does not know.
    fn foreign(&mut self, entry: &CheckEntry, code: &str, known: &[&str]) {
        let scalars = [
            ("fy", &entry.fy),
            ("gamma_M1", &entry.gamma),
            ("stress_unit", &entry.stress_unit),
            ("class", &entry.class),
            ("safety", &entry.safety),
            ("phi", &entry.phi),
        ];
        let mut given: Vec<(&str, Place)> =
            scalars.iter().filter_map(|(key, value)| Some((*key, value.as_ref()?.place()))).collect();
        given.extend(entry.web.as_ref().map(|written| ("web", written.place)));
        given.extend(entry.made.as_ref().map(|written| ("made", written.place)));
        given.extend(entry.cm.as_ref().map(|cm| ("Cm", cm.place)));
        given.extend(entry.ltb.as_ref().map(|ltb| match ltb {
            LtbEntry::Held(place) => ("ltb", *place),
            LtbEntry::Given(data) => ("ltb", data.place),
            LtbEntry::Wrong => ("ltb", entry.place),
        }));
        for (key, place) in given {
            if !known.contains(&key) {
                let help = format!("it takes ribs, cases, buckling and {}", known.join(", "));
                self.findings.mistake(MistakeCode::Check, place, format!("a check by {code} has no `{key}`"), help);
            }
        }
    }

    /// The check's data; `None` after a mistake.
    pub(super) fn code(&mut self, entry: &CheckEntry, what: &str, scope: &ItemScope) -> Option<Code> {
        let Some(written) = &entry.code else {
            let names: Vec<String> = CODES.iter().map(|(code, _)| format!("\"{code}\"")).collect();
            self.findings.mistake(
                MistakeCode::MissingKey,
                entry.place,
                format!("{what} needs `code`"),
                format!("one of {}", names.join(", ")),
            );
            return None;
        };
        match written.text.as_str() {
            "Euler" => {
                self.foreign(entry, "Euler", &["safety"]);
                let safety = self.factor(entry.safety.as_ref(), "safety", entry.place, what);
                let axes = self.buckling_axes(entry, what, scope, false, false);
                Some(Code::Euler(Euler { safety: safety?, axes: axes? }))
            }
            "EN 1993-1-1" => self.en1993(entry, what, scope),
            "AISC 360-22" => {
                self.foreign(entry, "AISC 360-22", &["fy", "phi", "made"]);
                let phi = self.factor(entry.phi.as_ref(), "phi", entry.place, what);
                let axes = self.buckling_axes(entry, what, scope, false, false);
                let made = self.needed(entry.made.as_ref(), "made", entry.place, what);
                let made =
                    made.and_then(|made| self.word(made, "made", &[("rolled", Made::Rolled), ("built-up", Made::BuiltUp)]));
                let fy = self.needed(entry.fy.as_ref(), "fy", entry.place, what).cloned();
                let text = self.expression(fy.as_ref()?, "fy", scope);
                Some(Code::Aisc { aisc: Aisc { fy: text?, phi: phi?, axes: axes? }, made: made?, fy: fy? })
            }
            other => {
                let help = did_you_mean(other, CODES.iter().map(|(code, _)| *code));
                let help = help.unwrap_or_else(|| format!("known: {}", CODES.map(|(code, _)| code).join(", ")));
                self.findings.mistake(MistakeCode::UnknownChoice, written.place, format!("unknown code `{other}`"), help);
                None
            }
        }
    }

    fn en1993(&mut self, entry: &CheckEntry, what: &str, scope: &ItemScope) -> Option<Code> {
        self.foreign(entry, "EN 1993-1-1", &["fy", "gamma_M1", "stress_unit", "class", "web", "ltb", "Cm"]);
        let gamma = self.factor(entry.gamma.as_ref(), "gamma_M1", entry.place, what);
        let axes = self.buckling_axes(entry, what, scope, true, true);
        let class = self.needed(entry.class.as_ref(), "class", entry.place, what).and_then(|scalar| self.class(scalar));
        let unit = self.factor(entry.stress_unit.as_ref(), "stress_unit", entry.place, what);
        let webs = [("bending", Web::Bending), ("compression", Web::Compression)];
        let web = entry.web.as_ref().and_then(|written| self.word(written, "web", &webs));
        let bending = self.bending(entry, what, scope, class.unwrap_or(3));
        let fy = self.needed(entry.fy.as_ref(), "fy", entry.place, what).cloned();
        let text = self.expression(fy.as_ref()?, "fy", scope);
        let en = En { fy: text?, gamma: gamma?, axes: axes? };
        Some(Code::En { en, bending: bending?, class: class?, web, fy: fy?, unit: unit? })
    }

    fn class(&mut self, scalar: &Scalar) -> Option<u8> {
        let class = self.constant(scalar)?;
        if [1.0, 2.0, 3.0].contains(&class) {
            return Some(class as u8);
        }
        let help = "1, 2 or 3: sections of class 4 lose a part of their area, which is not covered";
        self.findings.mistake(MistakeCode::OutOfRange, scalar.place(), format!("`class` cannot be {class}"), help);
        None
    }

    fn buckling_axes(
        &mut self,
        entry: &CheckEntry,
        what: &str,
        scope: &ItemScope,
        curves: bool,
        system: bool,
    ) -> Option<[Axis; 2]> {
        let buckling = self.needed(entry.buckling.as_ref(), "buckling", entry.place, what)?;
        let mut found = Vec::new();
        for (axis, given) in [("y", &buckling.y), ("z", &buckling.z)] {
            if given.is_none() {
                let message = format!("{what}: `buckling` says nothing about {axis}");
                let help =
                    format!("add {axis} = {{ length = … }}, or {axis} = \"held\" where the rib is held against it throughout");
                self.findings.mistake(MistakeCode::Check, buckling.place, message, help);
            }
            found.push(given.as_ref().and_then(|given| self.buckling_axis(given, what, scope, curves, system)));
        }
        let mut found = found.into_iter();
        Some([found.next()??, found.next()??])
    }

    fn buckling_axis(&mut self, given: &AxisEntry, what: &str, scope: &ItemScope, curves: bool, system: bool) -> Option<Axis> {
        let (place, length, curve) = match given {
            AxisEntry::Held => return Some(Axis::Held),
            AxisEntry::Wrong => return None,
            AxisEntry::Given { place, length, curve } => (*place, length, curve),
        };
        if let (false, Some(curve)) = (curves, curve) {
            self.findings.mistake(MistakeCode::Check, curve.place, "only EN 1993-1-1 has buckling curves", "leave `curve` out");
        }
        let alpha = match curves {
            true => self.needed(curve.as_ref(), "curve", place, what).and_then(|curve| self.word(curve, "curve", &CURVES)),
            false => Some(0.0),
        };
        match self.needed(length.as_ref(), "length", place, what)? {
            LengthEntry::Length(scalar) => {
                let length = self.expression(scalar, "length", scope);
                Some(Axis::Length { length: length?, alpha: alpha? })
            }
            LengthEntry::System(_) if system => Some(Axis::System { alpha: alpha? }),
            LengthEntry::System(place) => {
                let help = "give a length; the structure's own factor is used by checks by EN 1993-1-1";
                self.findings.mistake(
                    MistakeCode::Check,
                    *place,
                    "this code takes no buckling length of the whole structure",
                    help,
                );
                None
            }
        }
    }
}
