//! Numbers by name, by the million, in the order of the file they come from.

use std::cell::OnceCell;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};

use crate::problem::names::NameIndex;
use crate::problem::texts::Texts;

/// Names and their numbers. Most often they are asked for in their own order: an index is made at the first question that is not.
#[derive(Debug, Default)]
pub(super) struct NamedNumbers {
    names: Texts,
    values: Vec<f64>,
    index: OnceCell<NameIndex>,
}

impl NamedNumbers {
    /// Adds a number.
    pub fn push(&mut self, name: &str, value: f64) {
        self.names.push(name);
        self.values.push(value);
        self.index = OnceCell::new();
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The number of this name, which probably stands at this place.
    pub fn get(&self, place: usize, name: &str) -> Option<f64> {
        if self.names.get(place) == Some(name) {
            return self.values.get(place).copied();
        }
        let number = self.index.get_or_init(|| self.indexed()).find(&self.names, name)?;
        self.values.get(number as usize).copied()
    }

    /// Names and numbers in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.names.iter().zip(self.values.iter().copied())
    }

    fn indexed(&self) -> NameIndex {
        let mut index = NameIndex::default();
        for number in 0..self.names.len() as u32 {
            let _ = index.enter(&self.names, number); // the first of two counts
        }
        index
    }
}

/// From an object; `null` is NaN.
impl<'de> Deserialize<'de> for NamedNumbers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = NamedNumbers;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("an object of numbers")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<NamedNumbers, A::Error> {
                let mut numbers = NamedNumbers::default();
                while let Some((name, value)) = map.next_entry::<String, Option<f64>>()? {
                    numbers.push(&name, value.unwrap_or(f64::NAN));
                }
                Ok(numbers)
            }
        }
        deserializer.deserialize_map(Entries)
    }
}

/// The multipliers of a list of `{"name": …, "multiplier": …}`; rows without one are left out.
pub(super) fn multipliers<'de, D: Deserializer<'de>>(deserializer: D) -> Result<NamedNumbers, D::Error> {
    #[derive(Deserialize)]
    struct Row {
        name: String,
        multiplier: Option<f64>,
    }
    struct Rows;
    impl<'de> Visitor<'de> for Rows {
        type Value = NamedNumbers;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("a list of constraints")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<NamedNumbers, A::Error> {
            let mut numbers = NamedNumbers::default();
            while let Some(Row { name, multiplier }) = list.next_element()? {
                if let Some(multiplier) = multiplier {
                    numbers.push(&name, multiplier);
                }
            }
            Ok(numbers)
        }
    }
    deserializer.deserialize_seq(Rows)
}
