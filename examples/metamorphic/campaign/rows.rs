//! Transformations of rows and of the objective.

use super::draft::{Draft, Row, Variable};
use super::random::Random;
use super::words::{Requirement, number};

/// Every row in other units.
pub fn scale_all(draft: &mut Draft, random: &mut Random) -> bool {
    (0..draft.rows.len()).filter(|&at| scale(draft, random, at)).count() > 0
}

/// One row in other units.
pub fn scale_one(draft: &mut Draft, random: &mut Random) -> bool {
    let at = random.below(draft.rows.len());
    !draft.rows.is_empty() && scale(draft, random, at)
}

fn scale(draft: &mut Draft, random: &mut Random, at: usize) -> bool {
    let Some(requirement) = Requirement::parse(&draft.rows[at].require) else { return false };
    let factor = number(random.factor());
    draft.rows[at].require = requirement.map(|side| format!("{factor}*({side})")).text();
    true
}

/// The objective in other units.
pub fn scale_objective(draft: &mut Draft, random: &mut Random) -> bool {
    let factor = random.factor();
    draft.objective = format!("{}*({})", number(factor), draft.objective);
    draft.factor *= factor;
    true
}

/// The greatest −f instead of the least f, or the other way round.
pub fn turn_objective(draft: &mut Draft, _: &mut Random) -> bool {
    draft.objective = format!("-({})", draft.objective);
    draft.maximize = !draft.maximize;
    true
}

/// Rows in another order.
pub fn permute(draft: &mut Draft, random: &mut Random) -> bool {
    random.shuffle(&mut draft.rows);
    draft.rows.len() > 1
}

/// One to three rows a second time.
pub fn duplicate(draft: &mut Draft, random: &mut Random) -> bool {
    let own = draft.rows.len();
    for _ in 0..(1 + random.below(3)).min(own) {
        let row = draft.rows[random.below(own)].clone();
        insert(draft, random, row);
    }
    own > 0
}

/// A row under a new name, anywhere.
fn insert(draft: &mut Draft, random: &mut Random, row: Row) {
    let name = draft.fresh(&row.name);
    draft.rows.insert(random.below(draft.rows.len() + 1), Row { name, ..row });
}

/// Rows that follow from others: with room to spare, or the sum of positive multiples of two.
pub fn add_redundant(draft: &mut Draft, random: &mut Random) -> bool {
    let before = draft.rows.len();
    for _ in 0..(1 + random.below(2)).min(before) {
        let (first, second) = (random.below(before), random.below(before));
        let rows = [draft.rows[first].clone(), draft.rows[second].clone()];
        let implied = if random.coin() { combined(&rows, random) } else { relaxed(&rows[0], random) };
        if let Some(row) = implied {
            insert(draft, random, row);
        }
    }
    draft.rows.len() > before
}

fn relaxed(row: &Row, random: &mut Random) -> Option<Row> {
    let room = number(random.of_magnitude(-3.0, 3.0).abs());
    let require = match Requirement::parse(&row.require)? {
        Requirement::AtMost(left, right) => Requirement::AtMost(left, format!("{right} + {room}")),
        Requirement::AtLeast(left, right) => Requirement::AtLeast(left, format!("{right} - {room}")),
        Requirement::Range(_, middle, upper) => Requirement::AtMost(middle, format!("{upper} + {room}")),
        Requirement::Equal(left, right) => Requirement::AtMost(left, format!("{right} + {room}")),
    };
    Some(Row { require: require.text(), ..row.clone() })
}

fn combined(rows: &[Row; 2], random: &mut Random) -> Option<Row> {
    if rows.iter().any(|row| !row.scope.is_empty()) {
        return None;
    }
    let mut sum = Vec::new();
    for row in rows {
        let weight = number(random.of_magnitude(-1.0, 1.0).abs());
        // Each as something that is at most 0.
        let difference = match Requirement::parse(&row.require)? {
            Requirement::AtMost(left, right) | Requirement::Equal(left, right) => format!("({left}) - ({right})"),
            Requirement::AtLeast(left, right) => format!("({right}) - ({left})"),
            Requirement::Range(_, middle, upper) => format!("({middle}) - ({upper})"),
        };
        sum.push(format!("{weight}*({difference})"));
    }
    Some(Row { require: format!("{} <= 0", sum.join(" + ")), ..rows[0].clone() })
}

/// Two-sided rows as two.
pub fn split(draft: &mut Draft, _: &mut Random) -> bool {
    let mut any = false;
    for at in (0..draft.rows.len()).rev() {
        let Some(Requirement::Range(lower, middle, upper)) = Requirement::parse(&draft.rows[at].require) else { continue };
        let second = Row {
            name: draft.fresh(&draft.rows[at].name),
            require: Requirement::AtMost(middle.clone(), upper).text(),
            ..draft.rows[at].clone()
        };
        draft.rows[at].require = Requirement::AtLeast(middle, lower).text();
        draft.rows.insert(at + 1, second);
        any = true;
    }
    any
}

/// One inequality, or every one, as an equality with a bounded slack. A range needs numbers as its ends.
pub fn write_out_slacks(draft: &mut Draft, random: &mut Random) -> bool {
    let inequalities: Vec<usize> = (0..draft.rows.len()).filter(|&at| slack(&draft.rows[at], "").is_some()).collect();
    let every = random.coin();
    let chosen = random.below(inequalities.len());
    let chosen = if every { inequalities.as_slice() } else { inequalities.get(chosen..=chosen).unwrap_or_default() };
    for &at in chosen {
        let name = draft.fresh("slack");
        if let Some((require, bounds)) = slack(&draft.rows[at], &name) {
            draft.rows[at].require = require;
            draft.variables.push(Variable { is_slack: true, ..Variable::scalar(name, bounds, None) });
        }
    }
    !chosen.is_empty()
}

fn slack(row: &Row, name: &str) -> Option<(String, [f64; 2])> {
    if !row.scope.is_empty() {
        return None;
    }
    match Requirement::parse(&row.require)? {
        Requirement::AtMost(left, right) => Some((format!("{left} + {name} == {right}"), [0.0, f64::INFINITY])),
        Requirement::AtLeast(left, right) => Some((format!("{left} - {name} == {right}"), [0.0, f64::INFINITY])),
        Requirement::Range(lower, middle, upper) => {
            Some((format!("{middle} - {name} == 0"), [lower.parse().ok()?, upper.parse().ok()?]))
        }
        Requirement::Equal(..) => None,
    }
}
