//! Many short texts in one piece of memory: the names of millions of ribs.

use std::ops::Index;

/// A list of texts that only grows.
///
/// ```
/// use ribopt::problem::texts::Texts;
/// let mut names = Texts::default();
/// names.push("support");
/// names.push("midspan");
/// assert_eq!((names.len(), &names[1]), (2, "midspan"));
/// assert_eq!(names.iter().collect::<Vec<_>>(), ["support", "midspan"]);
/// assert_eq!(names.get(2), None);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Texts {
    joined: String,
    ends: Vec<usize>,
}

impl Texts {
    /// No text.
    pub const NONE: &'static Texts = &Texts { joined: String::new(), ends: Vec::new() };

    /// Adds a text at the end.
    pub fn push(&mut self, text: &str) {
        self.joined.push_str(text);
        self.ends.push(self.joined.len());
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The text at a place.
    pub fn get(&self, at: usize) -> Option<&str> {
        let end = *self.ends.get(at)?;
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.joined.get(start..end)
    }

    /// All of them, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> {
        // Every place below the length has a text.
        (0..self.len()).map(|at| self.get(at).unwrap_or_default())
    }
}

impl Index<usize> for Texts {
    type Output = str;

    /// # Panics
    /// Beyond the end, as slices do.
    fn index(&self, at: usize) -> &str {
        match self.get(at) {
            Some(text) => text,
            None => panic!("text {at} of {}", self.len()),
        }
    }
}

impl<'a> FromIterator<&'a str> for Texts {
    fn from_iter<I: IntoIterator<Item = &'a str>>(texts: I) -> Self {
        let mut list = Texts::default();
        texts.into_iter().for_each(|text| list.push(text));
        list
    }
}
