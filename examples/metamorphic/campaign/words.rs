//! Expressions as text: names replaced, comparisons taken apart.

/// The text with names replaced. `new` gets each name that stands without dots and its index with brackets (`[2]`, or empty) and
/// returns what to write for both, or nothing to leave them.
pub fn replace_names(text: &str, new: &dyn Fn(&str, &str) -> Option<String>) -> String {
    let mut written = String::with_capacity(2 * text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = word_length(rest);
        let (word, behind) = rest.split_at(length);
        let index = index_behind(behind);
        match (is_letter(first) && !word.contains('.')).then(|| new(word, index)).flatten() {
            Some(replacement) => {
                written.push_str(&replacement);
                rest = &behind[index.len()..];
            }
            None => {
                written.push_str(word);
                rest = behind;
            }
        }
    }
    written
}

/// A name with its dots, a number, a quotation or one other character.
fn word_length(text: &str) -> usize {
    let end = |from: usize, part: fn(char) -> bool| text[from..].find(|c| !part(c)).map_or(text.len(), |length| from + length);
    match text.chars().next() {
        Some(quote @ ('"' | '\'')) => text[1..].find(quote).map_or(text.len(), |length| length + 2),
        Some(c) if is_letter(c) => end(0, |c| is_letter(c) || c.is_ascii_digit() || c == '.'),
        Some(c) if c.is_ascii_digit() => {
            let digits = end(0, |c| c.is_ascii_digit() || c == '.');
            let sign = text[digits..].strip_prefix(['e', 'E']).map(|power| usize::from(power.starts_with(['+', '-'])));
            sign.map_or(digits, |sign| end(digits + 1 + sign, |c| c.is_ascii_digit()))
        }
        other => other.map_or(0, char::len_utf8),
    }
}

fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

/// `[…]` where the text begins with it.
fn index_behind(text: &str) -> &str {
    if !text.starts_with('[') {
        return "";
    }
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        depth += i32::from(c == '[') - i32::from(c == ']');
        if depth == 0 {
            return &text[..=at];
        }
    }
    ""
}

/// What a `require` states, its sides as text.
#[derive(Debug, Clone, PartialEq)]
pub enum Requirement {
    AtMost(String, String),
    AtLeast(String, String),
    Equal(String, String),
    /// lower ≤ middle ≤ upper
    Range(String, String, String),
}

impl Requirement {
    /// `None` for what the language does not know.
    pub fn parse(text: &str) -> Option<Requirement> {
        let (sides, signs) = compared(text);
        let own = |at: usize| sides.get(at).map(|side| side.trim().to_string());
        match signs.as_slice() {
            ["<="] => Some(Requirement::AtMost(own(0)?, own(1)?)),
            [">="] => Some(Requirement::AtLeast(own(0)?, own(1)?)),
            ["=="] => Some(Requirement::Equal(own(0)?, own(1)?)),
            ["<=", "<="] => Some(Requirement::Range(own(0)?, own(1)?, own(2)?)),
            [">=", ">="] => Some(Requirement::Range(own(2)?, own(1)?, own(0)?)),
            _ => None,
        }
    }

    pub fn text(&self) -> String {
        match self {
            Requirement::AtMost(left, right) => format!("{left} <= {right}"),
            Requirement::AtLeast(left, right) => format!("{left} >= {right}"),
            Requirement::Equal(left, right) => format!("{left} == {right}"),
            Requirement::Range(lower, middle, upper) => format!("{lower} <= {middle} <= {upper}"),
        }
    }

    /// The same with every side rewritten.
    pub fn map(self, side: impl Fn(String) -> String) -> Requirement {
        match self {
            Requirement::AtMost(left, right) => Requirement::AtMost(side(left), side(right)),
            Requirement::AtLeast(left, right) => Requirement::AtLeast(side(left), side(right)),
            Requirement::Equal(left, right) => Requirement::Equal(side(left), side(right)),
            Requirement::Range(lower, middle, upper) => Requirement::Range(side(lower), side(middle), side(upper)),
        }
    }
}

/// The sides of a comparison and the signs between them; comparisons inside parentheses are conditions.
fn compared(text: &str) -> (Vec<&str>, Vec<&str>) {
    let (mut sides, mut signs, mut begin, mut at, mut depth) = (Vec::new(), Vec::new(), 0, 0, 0);
    while at < text.len() {
        let rest = &text[at..];
        let sign = rest.get(..2).filter(|sign| depth == 0 && ["<=", ">=", "=="].contains(sign));
        if let Some(sign) = sign {
            sides.push(&text[begin..at]);
            signs.push(sign);
            at += 2;
            begin = at;
        } else {
            depth += i32::from(rest.starts_with(['(', '['])) - i32::from(rest.starts_with([')', ']']));
            at += word_length(rest).max(1);
        }
    }
    sides.push(&text[begin..]);
    (sides, signs)
}

/// A number as the language reads it, in parentheses where it is negative.
pub fn number(value: f64) -> String {
    if value < 0.0 { format!("({value:?})") } else { format!("{value:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_replaced_where_they_stand_for_a_variable() {
        let new = |word: &str, index: &str| (word == "x").then(|| format!("(2*y{index})"));
        let text = "x*exp(x[2 + n]) - a.x + xx + 1e5x + sum(ribs where line == \"x\": x)";
        let expected = "(2*y)*exp((2*y[2 + n])) - a.x + xx + 1e5(2*y) + sum(ribs where line == \"x\": (2*y))";
        assert_eq!(replace_names(text, &new), expected);
        assert_eq!(replace_names("2.5e-3*x^.5", &new), "2.5e-3*(2*y)^.5");
    }

    #[test]
    fn requirements_are_taken_apart_at_their_own_signs() {
        let own = |text: &str| Requirement::parse(text).map(|requirement| requirement.map(|side| format!("k*({side})")).text());
        assert_eq!(own("a + b <= c").as_deref(), Some("k*(a + b) <= k*(c)"));
        assert_eq!(own("2 >= x[1] >= 1").as_deref(), Some("k*(1) <= k*(x[1]) <= k*(2)"));
        assert_eq!(own("sum(ribs where c >= 2: x) == 1").as_deref(), Some("k*(sum(ribs where c >= 2: x)) == k*(1)"));
        assert_eq!(own("a"), None);
    }
}
