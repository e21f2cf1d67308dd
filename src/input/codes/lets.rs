//! Short names for parts of a formula.

/// Names with their texts, in which earlier names stand as `$name`.
#[derive(Clone, Default)]
pub(in crate::input) struct Lets(Vec<Let>);

#[derive(Clone)]
struct Let {
    name: String,
    short: String,
    whole: String,
}

impl Lets {
    /// A name for a text.
    pub fn name(&mut self, name: impl Into<String>, text: impl AsRef<str>) {
        let (name, text) = (name.into(), text.as_ref());
        let whole = self.whole(text);
        self.0.retain(|known| known.name != name);
        self.0.push(Let { name, short: plain(text), whole });
    }

    /// The text with every name written out.
    pub fn whole(&self, text: &str) -> String {
        let mut out = String::with_capacity(text.len());
        let mut pieces = text.split('$');
        out.push_str(pieces.next().unwrap_or_default());
        for piece in pieces {
            let end = piece.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(piece.len());
            let (name, rest) = piece.split_at(end);
            match self.0.iter().find(|known| known.name == name) {
                Some(known) => out.extend(["(", &known.whole, ")"]),
                None => out.push_str(name),
            }
            out.push_str(rest);
        }
        out
    }

    /// `name = text` of every name that a text needs, directly or not, in order.
    pub fn needed(&self, text: &str) -> Vec<String> {
        let mentions = |text: &str, name: &str| {
            let is_name = |c: char| c.is_alphanumeric() || c == '_';
            text.match_indices(name).any(|(at, _)| {
                let (before, after) = (text[..at].chars().next_back(), text[at + name.len()..].chars().next());
                !before.is_some_and(|c| is_name(c) || c == '.') && !after.is_some_and(is_name)
            })
        };
        let mut wanted: Vec<&Let> = Vec::new();
        for known in self.0.iter().rev() {
            if mentions(text, &known.name) || wanted.iter().any(|one| mentions(&one.short, &known.name)) {
                wanted.push(known);
            }
        }
        wanted.iter().rev().map(|one| format!("{} = {}", one.name, one.short)).collect()
    }
}

/// The text as it is shown.
pub(super) fn plain(text: &str) -> String {
    text.replace('$', "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_written_out_and_only_the_needed_ones_told() {
        let mut lets = Lets::default();
        lets.name("a", "x + 1");
        lets.name("other", "7");
        lets.name("b", "2*$a");
        assert_eq!(lets.whole("$b^2 <= $a/$a"), "(2*(x + 1))^2 <= (x + 1)/(x + 1)");
        assert_eq!(lets.needed("b^2 <= 3"), ["a = x + 1", "b = 2*a"]);
        lets.name("a", "y");
        assert_eq!(lets.whole("$a"), "(y)");
    }
}
