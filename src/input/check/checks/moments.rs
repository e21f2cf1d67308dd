//! What a check has to be given of moments: lateral-torsional buckling and the factors of Annex B.

use super::super::Assembly;
use crate::input::codes::{Bending, CURVES, Ltb};
use crate::input::declaration::checks::{CheckEntry, CmEntry, LtbData, LtbEntry};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::resolve::ItemScope;

impl Assembly<'_> {
    /// What is checked of moments; the outer `None` after a mistake.
    pub(super) fn bending(&mut self, entry: &CheckEntry, what: &str, scope: &ItemScope, class: u8) -> Option<Option<Bending>> {
        let ltb = match (&entry.ltb, &entry.cm) {
            (None, None) => return Some(None),
            (None, Some(cm)) => {
                let message = format!("{what}: `Cm` without `ltb`");
                let help = "add ltb = { length = …, C1 = …, curve = … }, or ltb = \"held\" where the compressed flange is held, \
                            or the section is hollow";
                self.findings.mistake(MistakeCode::Check, cm.place, message, help);
                return None;
            }
            (Some(LtbEntry::Wrong), _) => return None,
            (Some(LtbEntry::Held(_)), _) => Some(Ltb::Held),
            (Some(LtbEntry::Given(data)), _) => self.ltb(data, what, scope),
        };
        let cm = match &entry.cm {
            Some(given) => Some(self.moment_factors(given, what)?),
            None => None,
        };
        Some(Some(Bending { class, ltb: ltb?, cm }))
    }

    fn moment_factors(&mut self, given: &CmEntry, what: &str) -> Option<[f64; 3]> {
        let mut factors = Vec::new();
        for (key, scalar) in [("y", &given.y), ("z", &given.z), ("LT", &given.lt)] {
            let Some(scalar) = scalar else {
                let help = format!("add {key} = …: the equivalent uniform moment factor of Table B.3, 1 for a uniform moment");
                self.findings.mistake(MistakeCode::MissingKey, given.place, format!("{what}: `Cm` lacks `{key}`"), help);
                continue;
            };
            let value = self.constant(scalar)?;
            if !(0.4..=1.0).contains(&value) {
                self.findings.mistake(
                    MistakeCode::OutOfRange,
                    scalar.place(),
                    format!("Cm cannot be {value}"),
                    "Table B.3 gives 0.4 to 1",
                );
                continue;
            }
            factors.push(value);
        }
        factors.try_into().ok()
    }

    fn ltb(&mut self, data: &LtbData, what: &str, scope: &ItemScope) -> Option<Ltb> {
        let of = format!("`ltb` of {what}");
        let length = self.needed(data.length.as_ref(), "length", data.place, &of);
        let length = length.and_then(|length| self.expression(length, "length", scope));
        let c1 = self.factor(data.c1.as_ref(), "C1", data.place, &of);
        let curve = self.needed(data.curve.as_ref(), "curve", data.place, &of);
        let alpha = curve.and_then(|curve| self.word(curve, "curve", &CURVES[1..]));
        let clauses = [("6.3.2.2", false), ("6.3.2.3", true)];
        let rolled = match &data.clause {
            None => Some(false),
            Some(written) => self.word(written, "clause", &clauses),
        };
        let plateau = match rolled {
            Some(true) => {
                let least = self.factor(data.lambda0.as_ref(), "lambda_LT0", data.place, &of);
                let beta = self.factor(data.beta.as_ref(), "beta", data.place, &of);
                [least?, beta?]
            }
            _ => {
                for (key, given) in [("lambda_LT0", &data.lambda0), ("beta", &data.beta)] {
                    if let Some(scalar) = given {
                        let help = "add clause = \"6.3.2.3\" for rolled sections and their like, or leave it out";
                        self.findings.mistake(MistakeCode::UnknownKey, scalar.place(), format!("6.3.2.2 has no `{key}`"), help);
                    }
                }
                [0.2, 1.0]
            }
        };
        Some(Ltb::Given { length: length?, c1: c1?, alpha: alpha?, plateau, rolled: rolled? })
    }
}
