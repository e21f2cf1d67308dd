//! One TOML table: its keys in the file's order, taken one by one; whatever is left in the end is unknown.

use std::collections::BTreeMap;

use crate::problem::mistake_code::MistakeCode;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::findings::Findings;
use super::source::{Place, Source, Written};
use crate::problem::nearest::did_you_mean;
use crate::units::{Dimension, System};

/// A key and its value.
#[derive(Clone)]
pub(super) struct Field<'a> {
    pub key: &'a str,
    pub key_place: Place,
    pub value: &'a DeValue<'a>,
    pub place: Place,
    range: std::ops::Range<usize>,
}

/// A number, or an expression that stands for one.
#[derive(Debug, Clone)]
pub(super) enum Scalar {
    Number(f64, Place),
    Expression(Written),
}

/// What a table's keys are read with.
pub(super) struct Reader<'a> {
    /// Set while bounds are read: there, and nowhere else, `inf` has a meaning.
    pub bounds: bool,
    /// What the file's numbers are in, once that is read.
    pub units: System,
    /// Dimensions of data given with units, by the places of their keys.
    pub measured: BTreeMap<Place, Dimension>,
    pub source: &'a Source,
    pub findings: &'a mut Findings,
}

impl<'a> Reader<'a> {
    /// For the text of a file; nothing is known of its units.
    pub fn new(source: &'a Source, findings: &'a mut Findings) -> Reader<'a> {
        Reader { bounds: false, units: System::default(), measured: BTreeMap::new(), source, findings }
    }
}

/// The fields of a table not yet taken.
pub(super) struct Fields<'a> {
    fields: Vec<Field<'a>>,
    /// Every key the table knows, for help.
    known: Vec<&'static str>,
    /// Where the table stands.
    pub place: Place,
}

impl<'a> Fields<'a> {
    /// The fields of a table.
    pub fn of(table: &'a DeTable<'a>, place: Place) -> Fields<'a> {
        let mut fields: Vec<Field> = table.iter().map(|(key, value)| Field::of(key, value)).collect();
        fields.sort_by_key(|field| field.key_place);
        Fields { fields, known: Vec::new(), place }
    }

    /// Whether there is a field of this key.
    pub fn has(&self, key: &str) -> bool {
        self.fields.iter().any(|field| field.key == key)
    }

    /// A field by its key.
    pub fn take(&mut self, key: &'static str) -> Option<Field<'a>> {
        self.known.push(key);
        let at = self.fields.iter().position(|field| field.key == key)?;
        Some(self.fields.remove(at))
    }

    /// A field the table cannot do without.
    pub fn require(&mut self, key: &'static str, what: &str, reader: &mut Reader) -> Option<Field<'a>> {
        let field = self.take(key);
        if field.is_none() {
            reader.findings.mistake(
                MistakeCode::MissingKey,
                self.place,
                format!("{what} needs `{key}`"),
                format!("add `{key} = …`"),
            );
        }
        field
    }

    /// The rest, where keys are names of the user's choice.
    pub fn rest(&mut self) -> Vec<Field<'a>> {
        std::mem::take(&mut self.fields)
    }

    /// Every field left is a mistake.
    pub fn finish(self, reader: &mut Reader) {
        for field in &self.fields {
            let help = did_you_mean(field.key, self.known.iter().copied());
            let help = help.unwrap_or_else(|| format!("known here: {}", self.known.join(", ")));
            reader.findings.mistake(MistakeCode::UnknownKey, field.key_place, format!("unknown key `{}`", field.key), help);
        }
    }
}

impl<'a> Field<'a> {
    fn of(key: &'a Spanned<std::borrow::Cow<'a, str>>, value: &'a Spanned<DeValue<'a>>) -> Field<'a> {
        let (key_place, place) = (Place::file(key.span()), Place::file(value.span()));
        Field { key: key.get_ref(), key_place, value: value.get_ref(), place, range: value.span() }
    }

    /// An item of an array, under the array's key.
    fn item(&self, value: &'a Spanned<DeValue<'a>>) -> Field<'a> {
        let place = Place::file(value.span());
        Field { key: self.key, key_place: self.key_place, value: value.get_ref(), place, range: value.span() }
    }

    /// The number, if the value is one.
    pub fn as_number(&self) -> Option<f64> {
        match self.value {
            DeValue::Integer(integer) => match integer.radix() {
                10 => integer.as_str().parse().ok(),
                radix => i128::from_str_radix(integer.as_str(), radix).ok().map(|value| value as f64),
            },
            DeValue::Float(float) => float.as_str().parse().ok(),
            _ => None,
        }
    }

    /// Whether the file says `inf`, rather than a number that is too large for one.
    fn says_infinity(&self) -> bool {
        matches!(self.value, DeValue::Float(float) if float.as_str().trim_start_matches(['+', '-']) == "inf")
    }

    /// A text.
    pub fn text(&self, reader: &mut Reader) -> Option<Written> {
        match self.value {
            DeValue::String(text) => Some(Written::of(&reader.source.text, self.range.clone(), text)),
            _ => self.expected("text in quotes", reader),
        }
    }

    /// True or false.
    pub fn flag(&self, reader: &mut Reader) -> Option<bool> {
        match self.value {
            DeValue::Boolean(value) => Some(*value),
            _ => self.expected("true or false", reader),
        }
    }

    /// A number that is one: no NaN.
    pub fn number(&self, reader: &mut Reader) -> Option<f64> {
        match self.as_number() {
            Some(number) if number.is_nan() => {
                reader.findings.mistake(
                    MistakeCode::NoNumber,
                    self.place,
                    format!("`{}` is no number", self.key),
                    "give a number",
                );
                None
            }
            Some(number) if number.is_infinite() && !(reader.bounds && self.says_infinity()) => {
                let (what, help) = match self.says_infinity() {
                    true => ("cannot be infinite", "only bounds may be inf; leave an open bound out, or give a number"),
                    false => (
                        "is too large for a number",
                        "numbers reach to about 1.8e308; change the units, or leave an open bound out",
                    ),
                };
                reader.findings.mistake(MistakeCode::NoNumber, self.place, format!("`{}` {what}", self.key), help);
                None
            }
            Some(number) => Some(number),
            None => self.expected("a number", reader),
        }
    }

    /// A number or an expression.
    pub fn scalar(&self, reader: &mut Reader) -> Option<Scalar> {
        match self.value {
            DeValue::String(_) => self.text(reader).map(Scalar::Expression),
            DeValue::Integer(_) | DeValue::Float(_) => self.number(reader).map(|value| Scalar::Number(value, self.place)),
            _ => self.expected("a number or an expression in quotes", reader),
        }
    }

    /// The items of an array.
    pub fn items(&self) -> Option<Vec<Field<'a>>> {
        match self.value {
            DeValue::Array(array) => Some(array.iter().map(|value| self.item(value)).collect()),
            _ => None,
        }
    }

    /// An array of texts; a single text passes for one.
    pub fn texts(&self, reader: &mut Reader) -> Vec<Written> {
        match self.items() {
            Some(items) => items.iter().filter_map(|item| item.text(reader)).collect(),
            None => self.text(reader).into_iter().collect(),
        }
    }

    /// The number that a text such as `"12 kN"` stands for in the file's units; `None` for any other text.
    pub fn quantity(&self, reader: &mut Reader) -> Option<f64> {
        let DeValue::String(text) = self.value else { return None };
        let (own, dimension) = reader.units.quantity(text)?;
        reader.measured.insert(self.key_place, dimension);
        Some(own)
    }

    /// The fields of a table.
    pub fn table(&self, reader: &mut Reader) -> Option<Fields<'a>> {
        match self.value {
            DeValue::Table(table) => Some(Fields::of(table, self.key_place)),
            _ => self.expected("a table", reader),
        }
    }

    /// Whether it is a table.
    pub fn is_table(&self) -> bool {
        matches!(self.value, DeValue::Table(_))
    }

    /// The tables of `[[key]]`.
    pub fn tables(&self, reader: &mut Reader) -> Vec<Fields<'a>> {
        let Some(items) = self.items() else {
            let message = format!("`{}` is a list of tables", self.key);
            reader.findings.mistake(
                MistakeCode::WrongType,
                self.key_place,
                message,
                format!("write [[{}]] with two brackets", self.key),
            );
            return Vec::new();
        };
        items.iter().filter_map(|item| item.table_at(item.place, reader)).collect()
    }

    fn table_at(&self, place: Place, reader: &mut Reader) -> Option<Fields<'a>> {
        let mut fields = self.table(reader)?;
        fields.place = place;
        Some(fields)
    }

    /// The mistake of a value of another type.
    pub fn expected<T>(&self, what: &str, reader: &mut Reader) -> Option<T> {
        let found = match self.value {
            DeValue::String(_) => "text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "an array",
            DeValue::Table(_) => "a table",
        };
        reader.findings.mistake(
            MistakeCode::WrongType,
            self.place,
            format!("`{}` is {found}", self.key),
            format!("expected {what}"),
        );
        None
    }
}

impl Scalar {
    /// Where it stands.
    pub fn place(&self) -> Place {
        match self {
            Scalar::Number(_, place) => *place,
            Scalar::Expression(written) => written.place,
        }
    }
}
