//! Units as people write them: `mm`, `kN/m`, `kN·m`, `N/mm²`, `kg/(m·s^2)`.

use super::dimension::Dimension;
use super::ratio::Ratio;

/// A unit: how many SI units (m, N, s, K) it is, as a fraction of two numbers that are exact where they can be, and of what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    over: f64,
    under: f64,
    dimension: Dimension,
}

/// What is wrong with a unit: which bytes of the text, and the remedy.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct UnitError {
    /// Bytes of the text.
    pub start: usize,
    /// One past the last.
    pub end: usize,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: String,
}

/// Symbol, SI units as a fraction, exponents of length, force, time and temperature. The inch is 25.4 mm, the pound 0.45359237 kg,
/// standard gravity 9.80665 m/s² (BIPM, The International System of Units, 9th edition; NIST SP 811, Appendix B). Hours and minutes are
/// left out: `h` is a height and `min` a function.
const SYMBOLS: &[(&str, f64, f64, [i64; 4])] = &[
    ("m", 1.0, 1.0, [1, 0, 0, 0]),
    ("mm", 1.0, 1e3, [1, 0, 0, 0]),
    ("cm", 1.0, 1e2, [1, 0, 0, 0]),
    ("dm", 1.0, 10.0, [1, 0, 0, 0]),
    ("km", 1e3, 1.0, [1, 0, 0, 0]),
    ("in", 254.0, 1e4, [1, 0, 0, 0]),
    ("ft", 3048.0, 1e4, [1, 0, 0, 0]),
    ("N", 1.0, 1.0, [0, 1, 0, 0]),
    ("kN", 1e3, 1.0, [0, 1, 0, 0]),
    ("MN", 1e6, 1.0, [0, 1, 0, 0]),
    ("kgf", 980_665.0, 1e5, [0, 1, 0, 0]),
    ("lbf", 44_482_216_152_605.0, 1e13, [0, 1, 0, 0]),
    ("kip", 44_482_216_152_605.0, 1e10, [0, 1, 0, 0]),
    ("Pa", 1.0, 1.0, [-2, 1, 0, 0]),
    ("kPa", 1e3, 1.0, [-2, 1, 0, 0]),
    ("MPa", 1e6, 1.0, [-2, 1, 0, 0]),
    ("GPa", 1e9, 1.0, [-2, 1, 0, 0]),
    ("bar", 1e5, 1.0, [-2, 1, 0, 0]),
    // lbf/in²: 4.4482216152605 N over (0.0254 m)².
    ("psi", 44_482_216_152_605.0, 6_451_600_000.0, [-2, 1, 0, 0]),
    ("ksi", 44_482_216_152_605.0, 6_451_600.0, [-2, 1, 0, 0]),
    ("kg", 1.0, 1.0, [-1, 1, 2, 0]),
    ("g", 1.0, 1e3, [-1, 1, 2, 0]),
    ("t", 1e3, 1.0, [-1, 1, 2, 0]),
    ("lb", 45_359_237.0, 1e8, [-1, 1, 2, 0]),
    ("s", 1.0, 1.0, [0, 0, 1, 0]),
    ("ms", 1.0, 1e3, [0, 0, 1, 0]),
    ("Hz", 1.0, 1.0, [0, 0, -1, 0]),
    ("K", 1.0, 1.0, [0, 0, 0, 1]),
];

impl Unit {
    /// The unit of plain numbers.
    pub(super) const NONE: Unit = Unit { over: 1.0, under: 1.0, dimension: Dimension::NONE };

    /// What it measures.
    pub fn dimension(self) -> Dimension {
        self.dimension
    }

    /// A text that is a unit and nothing else.
    ///
    /// # Errors
    /// What is no unit in it.
    ///
    /// ```
    /// use ribopt::units::{Dimension, Unit};
    /// assert_eq!(Unit::parse("N/mm^2").unwrap().dimension(), Dimension::STRESS);
    /// assert!(Unit::parse("N/mm/s").is_err());
    /// ```
    pub fn parse(text: &str) -> Result<Unit, UnitError> {
        let trimmed = text.trim_start();
        let skipped = text.len() - trimmed.len();
        let text = text.trim();
        let wrong = |at: usize| {
            let named = text[at..].split(|c: char| !c.is_alphanumeric()).find(|part| !part.is_empty()).unwrap_or(text);
            let message = format!("`{named}` is no unit known here");
            UnitError { start: skipped + at, end: skipped + text.len(), message, help: known() }
        };
        match scan(text) {
            Some(Ok((length, unit))) if length == text.len() => Ok(unit),
            Some(Ok((length, _))) => Err(wrong(length)),
            Some(Err(error)) => Err(UnitError { start: skipped + error.start, end: skipped + error.end, ..error }),
            None => Err(wrong(0)),
        }
    }

    fn named(symbol: &str) -> Option<Unit> {
        let (_, over, under, powers) = SYMBOLS.iter().find(|(known, ..)| *known == symbol)?;
        Some(Unit { over: *over, under: *under, dimension: Dimension::whole(*powers) })
    }

    /// The product of two.
    pub(super) fn times(self, other: Unit) -> Option<Unit> {
        let dimension = self.dimension.times(other.dimension)?;
        let [a, b] = lowest(self.over, other.under);
        let [c, d] = lowest(other.over, self.under);
        Some(Unit { over: a * c, under: d * b, dimension })
    }

    /// A power.
    pub(super) fn power(self, exponent: Ratio) -> Option<Unit> {
        let dimension = self.dimension.power(exponent)?;
        let raised = |value: f64| match (*exponent.numer(), *exponent.denom()) {
            (top, 1) if top.abs() <= 64 => value.powi(top.unsigned_abs() as i32),
            (top, bottom) => value.powf(top.unsigned_abs() as f64 / bottom as f64),
        };
        let (over, under) = (raised(self.over), raised(self.under));
        Some(if *exponent.numer() < 0 { Unit { over: under, under: over, dimension } } else { Unit { over, under, dimension } })
    }

    /// So many of this unit, in SI units.
    pub(super) fn of(self, value: f64) -> f64 {
        // One of the two is usually 1, so that 300 mm is 300/1000 m, rounded once.
        value * self.over / self.under
    }
}

/// Both divided by what they have in common, where they are whole.
fn lowest(mut a: f64, mut b: f64) -> [f64; 2] {
    let exact = |value: f64| value.fract() == 0.0 && value.abs() < 9e15 && value > 0.0;
    if !(exact(a) && exact(b)) {
        return [a, b];
    }
    let whole = [a, b];
    while b != 0.0 {
        (a, b) = (b, a % b);
    }
    whole.map(|value| value / a)
}

/// Help for what is no unit.
fn known() -> String {
    let symbols: Vec<&str> = SYMBOLS.iter().map(|(symbol, ..)| *symbol).collect();
    format!("known: {}; powers joined by `*` or `·`, at most one `/`", symbols.join(", "))
}

/// The unit at the front of a text and how many bytes it takes; `None` where there is none.
///
/// Parts are joined without blanks: in `5 kN/m * length` the unit ends after the m, and so does it before a name that is no unit.
///
/// # Errors
/// A unit that is written wrongly.
pub fn scan(text: &str) -> Option<Result<(usize, Unit), UnitError>> {
    let (mut at, mut unit) = factor(text, 0)?;
    loop {
        let joined = match text[at..].chars().next() {
            Some('*') => factor(text, at + 1),
            Some('·') => factor(text, at + '·'.len_utf8()),
            _ => None,
        };
        let Some((end, next)) = joined else { break };
        unit = unit.times(next)?;
        at = end;
    }
    if text[at..].starts_with('/') {
        let divisor = if text[at + 1..].starts_with('(') { bracket(text, at + 2) } else { factor(text, at + 1) };
        if let Some((end, under)) = divisor {
            unit = unit.times(under.power(Ratio::from_integer(-1))?)?;
            at = end;
            let again = text[at..].starts_with(['/', '*', '·']);
            let next = text[at..].chars().next().map_or(0, char::len_utf8);
            if let Some((end, _)) = factor(text, at + next).filter(|_| again) {
                let message = "what follows the `/` of a unit stands in brackets".to_owned();
                let help = "write kN/(m*s), or put blanks around the sign where a name follows".to_owned();
                return Some(Err(UnitError { start: at, end, message, help }));
            }
        }
    }
    Some(Ok((at, unit)))
}

/// `m*s^2)`
fn bracket(text: &str, from: usize) -> Option<(usize, Unit)> {
    let (mut at, mut unit) = factor(text, from)?;
    loop {
        let next = text[at..].chars().next()?;
        if next == ')' {
            return Some((at + 1, unit));
        }
        let (end, other) = if matches!(next, '*' | '·') { factor(text, at + next.len_utf8())? } else { return None };
        unit = unit.times(other)?;
        at = end;
    }
}

/// A symbol and its power.
fn factor(text: &str, from: usize) -> Option<(usize, Unit)> {
    let rest = text.get(from..)?;
    let length = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    let unit = Unit::named(&rest[..length])?;
    if rest[length..].starts_with(['.', '(', '[']) {
        return None; // a section, a function or an array of this name
    }
    let (taken, exponent) = exponent(&rest[length..]);
    Some((from + length + taken, unit.power(exponent)?))
}

/// `^2`, `^-1`, `²`, `³`; 1 where nothing is said.
fn exponent(text: &str) -> (usize, Ratio) {
    for (sign, power) in [("²", 2), ("³", 3), ("⁴", 4)] {
        if text.starts_with(sign) {
            return (sign.len(), Ratio::from_integer(power));
        }
    }
    let Some(rest) = text.strip_prefix('^') else { return (0, Ratio::ONE) };
    let sign = usize::from(rest.starts_with('-'));
    let digits = rest[sign..].bytes().take_while(u8::is_ascii_digit).count();
    match rest[..sign + digits].parse::<i64>() {
        Ok(power) if digits > 0 && power.abs() <= 12 => (1 + sign + digits, Ratio::from_integer(power)),
        _ => (0, Ratio::ONE),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(text: &str) -> &str {
        &text[..scan(text).unwrap().unwrap().0]
    }

    #[test]
    fn units_end_where_names_begin() {
        assert_eq!(taken("kN/m * length^2/8"), "kN/m");
        assert_eq!(taken("kN/m*length"), "kN/m");
        assert_eq!(taken("kN / t"), "kN");
        assert_eq!(taken("mm^2)"), "mm^2");
        assert_eq!(taken("kg/(m*s^2) + 1"), "kg/(m*s^2)");
        assert_eq!(taken("kN/(m + b)"), "kN");
        assert_eq!(taken("kN·m"), "kN·m");
        assert!(scan("m.b").is_none());
        assert!(scan("length").is_none() && scan("").is_none());
        assert!(scan("kN/m/s").unwrap().is_err());
    }

    #[test]
    fn conversions_are_rounded_once() {
        assert_eq!(Unit::parse("mm").unwrap().of(300.0), 0.3);
        assert_eq!(Unit::parse("N/mm²").unwrap().of(235.0), 235e6);
        assert_eq!(Unit::parse("in").unwrap().of(1.0), 0.0254);
        let psi = Unit::parse("lbf/in^2").unwrap().of(1.0);
        assert!((psi - 6894.757293168361).abs() < 1e-9 && psi == Unit::parse("psi").unwrap().of(1.0));
    }

    #[test]
    fn what_is_no_unit_is_told() {
        assert_eq!(Unit::parse(" °C").unwrap_err().message, "`C` is no unit known here");
        assert_eq!(Unit::parse("kN/foo").unwrap_err().message, "`foo` is no unit known here");
    }
}
