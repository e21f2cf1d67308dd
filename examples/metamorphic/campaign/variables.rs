//! Transformations of variables: units, origins, order, reciprocals, fixed ones, starts.

use toml::Value;

use super::draft::{Draft, Origin, Step, Variable};
use super::random::Random;
use super::reading::resolved_start;
use super::words::{Requirement, number, replace_names};

/// Sections' own variables become entries of `[variables]` that the dimension links to.
fn lift_dimensions(draft: &mut Draft) {
    for at in 0..draft.sections.len() {
        let (section, fields) = draft.sections[at].clone();
        for key in fields.as_table().into_iter().flat_map(toml::Table::keys) {
            let dimension = format!("{section}.{key}");
            let Some(&[lower, upper, start]) = draft.ranges.get(&dimension) else { continue };
            let Some(range) = fields.get(key).and_then(Value::as_table) else { continue };
            let name = draft.fresh(&dimension);
            let start = range.contains_key("start").then_some(start);
            draft.variables.push(Variable::scalar(name.clone(), [lower, upper], start));
            draft.track(&dimension, &name, Step::Affine(1.0, 0.0));
            if let Some(dimension) = draft.sections[at].1.get_mut(key) {
                *dimension = name.into();
            }
        }
    }
}

/// Puts `steps` (one per element) of a new variable in the place of variable `at`: in every formula, or by a definition under the
/// old name.
fn substitute(draft: &mut Draft, random: &mut Random, at: usize, steps: &[Step]) {
    let old = draft.variables[at].clone();
    let name = draft.fresh(&old.name);
    let new = transformed(&old, &name, steps);
    let infinite = |values: &[f64]| values.iter().filter(|value| value.is_infinite()).count();
    if infinite(&new.lower) + infinite(&new.upper) > infinite(&old.lower) + infinite(&old.upper) {
        return; // A bound beyond the largest number would be none.
    }
    draft.variables[at] = new;
    let formula = formula(draft, &old, &name, steps);
    if draft.is_algebraic() && random.coin() {
        let write = |word: &str, index: &str| (word == old.name).then(|| formula(index));
        draft.rewrite_formulas(&|text| replace_names(text, &write));
    } else {
        draft.definitions.push((old.name.clone(), formula("").into()));
    }
    for (i, &step) in steps.iter().enumerate() {
        let element = |name: &str| if old.is_array { format!("{name}[{}]", i + 1) } else { name.to_string() };
        draft.track(&old.element(i), &element(&name), step);
    }
}

/// The new variable: bounds and starts taken through the inverse of each step.
fn transformed(old: &Variable, name: &str, steps: &[Step]) -> Variable {
    let start = old.start.clone().unwrap_or_else(|| (0..steps.len()).map(|i| resolved_start(old, i)).collect());
    let mut new = Variable { name: name.into(), start: Some(start.clone()), ..old.clone() };
    let mut starts = start;
    for (i, &step) in steps.iter().enumerate() {
        let inverse = |value: f64| match step {
            Step::Affine(factor, shift) => (value - shift) / factor,
            Step::Reciprocal => value.recip(),
        };
        let (a, b) = (inverse(old.lower[i]), inverse(old.upper[i]));
        (new.lower[i], new.upper[i]) = (a.min(b), a.max(b));
        starts[i] = inverse(starts[i]);
    }
    new.start = Some(starts);
    new
}

/// What stands for the old variable, given its index. An array's factors and shifts become parameters.
fn formula(draft: &mut Draft, old: &Variable, name: &str, steps: &[Step]) -> impl Fn(&str) -> String + use<> {
    let mut parameter = |what: &str, values: Vec<f64>| -> Box<dyn Fn(&str) -> String> {
        if !old.is_array {
            return Box::new(move |_| number(values[0]));
        }
        let name = draft.fresh(&format!("{}_{what}", old.name));
        draft.parameters.push((name.clone(), Value::from(values)));
        Box::new(move |index| format!("{name}{index}"))
    };
    let part = |get: fn(&Step) -> f64| steps.iter().map(get).collect::<Vec<f64>>();
    let factors = part(|step| if let Step::Affine(factor, _) = step { *factor } else { 1.0 });
    let shifts = part(|step| if let Step::Affine(_, shift) = step { *shift } else { 0.0 });
    let factor = factors.iter().any(|&factor| factor != 1.0).then(|| parameter("factor", factors));
    let shift = shifts.iter().any(|&shift| shift != 0.0).then(|| parameter("shift", shifts));
    let (name, reciprocal) = (name.to_string(), steps.contains(&Step::Reciprocal));
    move |index| {
        let scaled = factor.as_ref().map_or(String::new(), |factor| format!("{}*", factor(index)));
        let shifted = shift.as_ref().map_or(String::new(), |shift| format!(" + {}", shift(index)));
        let over = if reciprocal { "1/" } else { "" };
        format!("({over}{scaled}{name}{index}{shifted})")
    }
}

/// Every variable in other units.
pub fn scale_all(draft: &mut Draft, random: &mut Random) -> bool {
    lift_dimensions(draft);
    (0..draft.variables.len()).for_each(|at| scale(draft, random, at));
    !draft.variables.is_empty()
}

/// One variable in other units.
pub fn scale_one(draft: &mut Draft, random: &mut Random) -> bool {
    lift_dimensions(draft);
    if draft.variables.is_empty() {
        return false;
    }
    let at = random.below(draft.variables.len());
    scale(draft, random, at);
    true
}

fn scale(draft: &mut Draft, random: &mut Random, at: usize) {
    let steps: Vec<Step> = draft.variables[at].lower.iter().map(|_| Step::Affine(random.factor(), 0.0)).collect();
    substitute(draft, random, at, &steps);
}

/// A bound as far away as this says «none» and not how large the variable is.
pub const NO_SIZE: f64 = 1e12;

/// Variables counted from elsewhere, by up to ten times their size. Powers of two: most bounds are moved without rounding. Where neither
/// start nor bound tells it, the file's own answer does: counted from a million sizes away, a variable has lost the digits it is asked for.
pub fn translate(draft: &mut Draft, random: &mut Random) -> bool {
    lift_dimensions(draft);
    for at in (0..draft.variables.len()).filter(|&at| !draft.variables[at].is_slack).collect::<Vec<usize>>() {
        let variable = &draft.variables[at];
        let shift = |i: usize| {
            let of_answer = || size_of_answer(&draft.origins, variable, i);
            let size = variable.size(i).filter(|&size| size < NO_SIZE).unwrap_or_else(of_answer);
            let by = random.of_magnitude(-1.0, 1.0) * size;
            Step::Affine(1.0, by.signum() * by.abs().log2().round().exp2())
        };
        let steps: Vec<Step> = (0..variable.lower.len()).map(shift).collect();
        substitute(draft, random, at, &steps);
    }
    !draft.variables.is_empty()
}

/// How large the file's own answer makes element i, in the draft's units.
fn size_of_answer(origins: &[Origin], variable: &Variable, i: usize) -> f64 {
    origins.iter().find(|origin| origin.now == variable.element(i)).map_or(1.0, Origin::size_in_draft)
}

/// x = 1/y where both bounds are positive.
pub fn reciprocal(draft: &mut Draft, random: &mut Random) -> bool {
    lift_dimensions(draft);
    let is_positive = |variable: &Variable| {
        variable.lower.iter().all(|&lower| lower > 0.0) && variable.upper.iter().all(|upper| upper.is_finite())
    };
    let positive: Vec<usize> = (0..draft.variables.len()).filter(|&at| is_positive(&draft.variables[at])).collect();
    let every = random.coin();
    let chosen = if every || positive.is_empty() { positive } else { vec![positive[random.below(positive.len())]] };
    for &at in &chosen {
        let steps = vec![Step::Reciprocal; draft.variables[at].lower.len()];
        substitute(draft, random, at, &steps);
    }
    !chosen.is_empty()
}

/// Variables and sections in another order.
pub fn permute(draft: &mut Draft, random: &mut Random) -> bool {
    random.shuffle(&mut draft.variables);
    random.shuffle(&mut draft.sections);
    draft.variables.len() + draft.sections.len() > 1
}

/// Variables whose bounds are equal, as terms that add exactly 0. In rows they are fixed at 0, so that the size of a row's terms,
/// which its tolerance is relative to, stays.
pub fn add_fixed(draft: &mut Draft, random: &mut Random) -> bool {
    let value = random.of_magnitude(-3.0, 3.0);
    let name = insert_fixed(draft, random, value);
    let nothing = format!("{}*({name} - {})", number(random.of_magnitude(-2.0, 0.0)), number(value));
    draft.objective = format!("({}) + {nothing}", draft.objective);
    for _ in 0..random.below(3) {
        let name = insert_fixed(draft, random, 0.0);
        let nothing = format!("{}*{name}", number(random.of_magnitude(-3.0, 3.0)));
        change_side(draft, random, |left| format!("{left} + {nothing}"));
    }
    true
}

/// Variables whose bounds are equal, as factors that are exactly 1.
pub fn multiply_by_fixed(draft: &mut Draft, random: &mut Random) -> bool {
    if draft.variables.iter().any(leaves_numbers) {
        return false;
    }
    for _ in 0..=random.below(3) {
        let value = random.of_magnitude(-3.0, 3.0).abs();
        let one = format!("{}/{}", insert_fixed(draft, random, value), number(value));
        if random.coin() {
            draft.objective = format!("{one}*({})", draft.objective);
        } else {
            change_side(draft, random, |left| format!("{one}*({left})"));
        }
    }
    true
}

/// Whether a variable goes so far that its products with other numbers are none.
fn leaves_numbers(variable: &Variable) -> bool {
    variable.lower.iter().chain(&variable.upper).any(|bound| bound.is_finite() && bound.abs() > 1e290)
}

fn insert_fixed(draft: &mut Draft, random: &mut Random, value: f64) -> String {
    let name = draft.fresh("fixed");
    let fixed = Variable::scalar(name.clone(), [value, value], Some(value));
    draft.variables.insert(random.below(draft.variables.len() + 1), fixed);
    name
}

/// Rewrites the left side of a row, or the middle of a two-sided one.
fn change_side(draft: &mut Draft, random: &mut Random, change: impl Fn(String) -> String) {
    let at = random.below(draft.rows.len());
    let Some(row) = draft.rows.get_mut(at) else { return };
    let changed = Requirement::parse(&row.require).map(|requirement| match requirement {
        Requirement::AtMost(left, right) => Requirement::AtMost(change(left), right),
        Requirement::AtLeast(left, right) => Requirement::AtLeast(change(left), right),
        Requirement::Equal(left, right) => Requirement::Equal(change(left), right),
        Requirement::Range(lower, middle, upper) => Requirement::Range(lower, change(middle), upper),
    });
    row.require = changed.map_or(row.require.clone(), |requirement| requirement.text());
}

/// Whether a start decides what the rows are: of formulas that a code gives by ranges, the one of the start's range is stated.
fn states_rows(draft: &Draft) -> bool {
    draft.rest.iter().any(|(key, _)| key == "checks")
}

/// Starts anywhere inside the bounds; where these are open, some sizes away.
pub fn start_elsewhere(draft: &mut Draft, random: &mut Random) -> bool {
    if states_rows(draft) {
        return false;
    }
    lift_dimensions(draft);
    for variable in &mut draft.variables {
        let size = |i: usize| size_of_answer(&draft.origins, variable, i);
        let start = (0..variable.lower.len()).map(|i| inside(variable, i, size(i), random)).collect();
        variable.start = Some(start);
    }
    !draft.variables.is_empty()
}

fn inside(variable: &Variable, i: usize, size: f64, random: &mut Random) -> f64 {
    let (lower, upper) = (variable.lower[i], variable.upper[i]);
    let start = variable.start.as_ref().map_or(0.0, |start| start[i]);
    let away = random.of_magnitude(-1.0, 1.0) * start.abs().max(size);
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) if lower > 0.0 && upper > 100.0 * lower => random.between(lower.ln(), upper.ln()).exp().clamp(lower, upper),
        (true, true) => random.between(lower, upper).clamp(lower, upper),
        (true, false) => lower + away.abs(),
        (false, true) => upper - away.abs(),
        (false, false) => start + away,
    }
}

/// No starts.
pub fn leave_out_starts(draft: &mut Draft, _: &mut Random) -> bool {
    if states_rows(draft) {
        return false;
    }
    let mut any = false;
    for variable in &mut draft.variables {
        any |= variable.start.take().is_some();
    }
    for (_, section) in &mut draft.sections {
        for (_, dimension) in section.as_table_mut().into_iter().flatten().filter(|(key, _)| *key != "data") {
            any |= dimension.as_table_mut().is_some_and(|range| range.remove("start").is_some());
        }
    }
    any
}
