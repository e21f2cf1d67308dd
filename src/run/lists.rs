//! Sizes from lists: after the optimum with all sizes free, the best choice of rows, and what is proved of it.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use super::Subject;
use super::bounded::below_every_design;
use super::remaining::Remaining;
use crate::certificate::{Extent, Tolerances, certify};
use crate::crosscheck::{Outcome, Status};
use crate::discrete::convex::{Convex, FacetRow};
use crate::discrete::hull::{Facet, facets};
use crate::discrete::{Found, List, Rest, exchange, search};
use crate::expression::operators::Binary;
use crate::model::{Budget, Class, Formulation, Stop, Substitution, formulate};
use crate::problem::{Constraint, Formula, Limit, Listed, Problem, Scope, Settings};
use crate::report::number::{percent, significant};

/// A design no further above the bound than this, relative, is the best: what backends may differ by and still agree.
const AGREEMENT: f64 = 1e-6;

/// A row's limit is a facet's own number, up to the rounding of a way into logarithms and back.
const SAME: f64 = 1e-9;

/// Share of the time left that the search may take: the rest is for the run with the sizes chosen.
const SHARE: f64 = 0.9;

/// What a choice came to.
pub(super) struct Chosen {
    pub outcome: Outcome,
    /// The problem with these sizes; `None` where no choice was found.
    pub subject: Option<Subject>,
    /// Section and row, of catalogues.
    pub rows: Vec<(String, String)>,
}

/// Chooses rows, and has the problem with these sizes solved by `again`; `None` where there are no lists, or no point to begin at.
pub(super) fn choose(
    subject: &Subject,
    settings: &Settings,
    free: &Outcome,
    again: impl FnOnce(&Subject, &[f64]) -> Option<Outcome>,
    remaining: &Remaining,
    interrupt: Option<&AtomicBool>,
) -> Option<Chosen> {
    let listed = &subject.problem().listed;
    let begins = matches!(free.status, Status::Certified | Status::Uncertified | Status::LimitReached);
    if listed.is_empty() || !begins || free.objective.is_none() {
        return None;
    }
    let lists: Vec<List> = listed.iter().map(list).collect();
    let Some(left) = remaining.settings(settings).map(|settings| settings.max_seconds) else { return Some(no_time(free)) };
    // A year is as good as no limit.
    let deadline = Instant::now() + Duration::from_secs_f64((SHARE * left).min(3e7));
    let budget = Budget { deadline: Some(deadline), interrupt, ..Budget::default() };
    let mut found = find(subject, settings, &lists, &free.x, budget);
    if found.bound == f64::NEG_INFINITY {
        found.bound = below_every_design(subject, remaining, interrupt).unwrap_or(f64::NEG_INFINITY);
    }
    let Some(best) = &found.best else { return Some(none(free, &found)) };
    let mut problem = subject.problem().clone();
    for (list, &row) in lists.iter().zip(&best.rows) {
        for (&j, &value) in list.variables.iter().zip(&list.rows[row]) {
            let variables = &mut problem.variables;
            (variables.lower[j], variables.upper[j], variables.start[j]) = (value, value, value);
        }
    }
    let chosen = subject.with_problem(problem).ok()?;
    let own = chosen.shown().meta().variables();
    let x = &best.x[..own.min(best.x.len())];
    let mut outcome = again(&chosen, x).unwrap_or_else(|| as_found(&chosen, x, free));
    judge(subject, &mut outcome, free, &found, &budget);
    let named = listed.iter().zip(lists.iter().zip(&best.rows));
    let named =
        named.filter_map(|(listed, (list, &row))| Some((listed.name.clone(), listed.names.get(list.places[row])?.clone())));
    Some(Chosen { rows: named.collect(), outcome, subject: Some(chosen) })
}

fn list(listed: &Listed) -> List {
    List::new(listed.variables.iter().map(|&j| j as usize).collect(), listed.rows.clone())
}

/// The best choice: proved where the class is one whose minima are global, else the best that exchanges find.
fn find(subject: &Subject, settings: &Settings, lists: &[List], x: &[f64], budget: Budget<'_>) -> Found {
    let start = subject.completed(x.to_vec());
    // States beside the design are no variables of lists.
    let plain = |other: &&dyn Substitution| other.model().meta().states.is_none();
    let substitution = subject.substitution().filter(plain);
    let rest = Rest { model: subject.model(), substitution, class: subject.class(), settings, lists, budget };
    let first = exchange::best(&rest, &start);
    let relaxed = if subject.class().is_global() { relaxed(subject) } else { None };
    match &relaxed {
        Some(relaxed) => {
            let model = relaxed.model.judge();
            let facets = facet_rows(subject, relaxed, lists);
            let substitution = relaxed.substitution.as_deref().map(|other| other as &dyn Substitution);
            search(&Convex { rest, relaxed: model, substitution, facets }, lists, first, &start, &budget)
        }
        None => {
            let nothing = f64::NEG_INFINITY;
            Found { best: first, bound: nothing, proved: false, root: nothing, relaxations: 0 }
        }
    }
}

/// The problem with the facets of its catalogues as rows; `None` where it is of no class whose minima are global then.
fn relaxed(subject: &Subject) -> Option<Formulation> {
    let mut problem = subject.problem().clone();
    let geometric = subject.class() == Class::GeometricProgram;
    for listed in subject.problem().listed.iter().filter(|listed| listed.variables.len() > 1) {
        add_facets(&mut problem, listed, geometric);
    }
    formulate(problem).ok().filter(|relaxed| relaxed.class.is_global())
}

/// The numbers in which a catalogue's rows have facets: of geometric programs their logarithms, where facets are monomials.
fn points(rows: &[Vec<f64>], geometric: bool) -> Vec<Vec<f64>> {
    let number = |value: &f64| if geometric { value.ln() } else { *value };
    rows.iter().map(|row| row.iter().map(number).collect()).collect()
}

/// What the row of a facet is called.
fn facet_name(listed: &Listed, at: usize) -> String {
    format!("hull of {} #{at}", listed.name)
}

/// The rows of the convex model that are facets, each by its name; those whose limits are in other numbers stay as they are.
fn facet_rows(subject: &Subject, relaxed: &Formulation, lists: &[List]) -> Vec<FacetRow> {
    let geometric = subject.class() == Class::GeometricProgram;
    let own = relaxed.model.judge();
    let model = relaxed.substitution.as_deref().map_or(own, |other| other.model());
    let numbers: HashMap<String, usize> = (0..own.meta().rows()).map(|i| (own.row_name(i), i)).collect();
    let mut found = Vec::new();
    for (list, (listed, sorted)) in subject.problem().listed.iter().zip(lists).enumerate() {
        if listed.variables.len() < 2 {
            continue;
        }
        let facets = facets(&points(&listed.rows, geometric));
        let points = Arc::new(points(&sorted.rows, geometric));
        for (at, facet) in facets.into_iter().enumerate() {
            let Some(&row) = numbers.get(&facet_name(listed, at)) else { continue };
            let limit = model.meta().row_upper[row];
            if (limit - facet.c).abs() <= SAME * (1.0 + facet.c.abs()) {
                found.push(FacetRow { list, row, facet, points: Arc::clone(&points) });
            }
        }
    }
    found
}

/// Adds the facets of a catalogue.
fn add_facets(problem: &mut Problem, listed: &Listed, geometric: bool) {
    for (at, facet) in facets(&points(&listed.rows, geometric)).into_iter().enumerate() {
        let Facet { first, second, a, b, c } = facet;
        let [u, v] = [first, second].map(|k| Box::new(Formula::Variable(listed.variables[k])));
        let times = |op, left: Box<Formula>, number| Box::new(Formula::Binary(op, left, Box::new(Formula::Constant(number))));
        let (left, limit) = match geometric {
            // A last digit more for the way out of logarithms.
            true => (
                Formula::Binary(Binary::Multiply, times(Binary::Power, u, a), times(Binary::Power, v, b)),
                c.exp() * (1.0 + 4.0 * f64::EPSILON * (1.0 + c.abs())),
            ),
            false => (Formula::Binary(Binary::Add, times(Binary::Multiply, u, a), times(Binary::Multiply, v, b)), c),
        };
        let right = Limit::AtMost(Formula::Constant(limit));
        problem.constraints.push(Constraint { right, ..Constraint::unlimited(facet_name(listed, at), Scope::Once, left) });
    }
}

/// What an outcome with chosen sizes says of all choices.
fn judge(subject: &Subject, outcome: &mut Outcome, free: &Outcome, found: &Found, budget: &Budget<'_>) {
    let Some(objective) = outcome.objective.filter(|_| outcome.status == Status::Certified) else {
        outcome.message = format!("The problem with the sizes that were chosen: {}", outcome.message);
        return;
    };
    let size = objective.abs().max(f64::MIN_POSITIVE);
    let gap = ((objective - found.bound) / size).max(0.0);
    outcome.lower_bound = found.bound.is_finite().then(|| found.bound.min(objective));
    let proved = found.proved || gap <= AGREEMENT;
    outcome.scope = if proved { Extent::Global } else { Extent::Local };
    outcome.message = if proved {
        format!(
            "Proved best of the list: no other choice of sizes is better ({} ranges of choices were bounded).",
            found.relaxations
        )
    } else if found.bound.is_finite() {
        outcome.status = ended(budget);
        format!("The best choice of sizes that was found, within {} of the best of the list.", percent(gap))
    } else {
        outcome.status = ended(budget);
        "The best choice of sizes that rounding and exchanges found; nothing is proved of other choices.".to_owned()
    };
    if !proved {
        let more = "raise --max-seconds, or make the lists shorter";
        outcome.remedy =
            Some(if found.bound.is_finite() { more.into() } else { "compare it with --start from other designs".into() });
    }
    outcome.message += &price(subject, (objective, free), found);
}

/// What the lists cost against sizes between their rows.
fn price(subject: &Subject, (objective, free): (f64, &Outcome), found: &Found) -> String {
    let single = subject.problem().listed.iter().all(|listed| listed.variables.len() == 1);
    // Free numbers of a catalogue are no sections: what its rows have in common is kept.
    let before = if single { free.objective } else { Some(found.root).filter(|root| root.is_finite()) };
    let Some(before) = before else { return String::new() };
    let size = before.abs().max(f64::MIN_POSITIVE);
    let (cost, before) = (percent((objective - before).abs() / size), significant(subject.sign() * before + 0.0, 7));
    match single {
        true => format!(" With all sizes free the optimum is {before}: the lists cost {cost} of that."),
        false => format!(" With sizes between the rows it would be {before} at best: the rows cost up to {cost} of that."),
    }
}

fn ended(budget: &Budget<'_>) -> Status {
    match budget.check(0) {
        Err(Stop::Interrupted) => Status::Interrupted,
        Err(_) => Status::LimitReached,
        Ok(()) => Status::Uncertified,
    }
}

/// A design as the search found it, where no time is left for the backends to solve the problem with its sizes.
fn as_found(chosen: &Subject, x: &[f64], free: &Outcome) -> Outcome {
    let Settings { optimality_tolerance: optimality, constraint_tolerance: constraint, .. } = chosen.settings;
    let certificate = certify(chosen.shown(), chosen.class(), x, None, Tolerances { optimality, constraint }).ok();
    let certified = certificate.as_ref().is_some_and(|certificate| certificate.certified);
    Outcome {
        status: if certified { Status::Certified } else { Status::LimitReached },
        objective: certificate.as_ref().map(|certificate| certificate.objective),
        message: "Time ended before the backends could solve the problem with these sizes.".into(),
        x: x.to_vec(),
        certificate,
        best: None,
        agreement: None,
        lower_bound: None,
        ..free.clone()
    }
}

/// Sizes between rows are no answer, whatever was proved of them.
fn no_time(free: &Outcome) -> Chosen {
    let outcome = Outcome {
        status: Status::LimitReached,
        message: "Time ended before sizes were chosen from the lists. The point shown has its sizes between rows.".into(),
        remedy: Some("raise --max-seconds".into()),
        scope: Extent::Local,
        ..free.clone()
    };
    Chosen { rows: Vec::new(), outcome, subject: None }
}

/// No choice meets the limits, or none was found.
fn none(free: &Outcome, found: &Found) -> Chosen {
    let mut outcome = free.clone();
    (outcome.lower_bound, outcome.agreement) = (None, None);
    if found.proved {
        (outcome.status, outcome.scope) = (Status::Infeasible, Extent::Global);
        outcome.message =
            "No choice of sizes from the lists meets all limits: this is proved. The point shown has its sizes between rows."
                .into();
        outcome.remedy = Some("add sizes near those of the point shown, which meets all limits, to the lists".into());
    } else {
        (outcome.status, outcome.scope) = (Status::Uncertified, Extent::Local);
        outcome.message =
            "No choice of sizes that was tried meets all limits. The point shown has its sizes between rows.".into();
        outcome.remedy = Some(
            "add sizes near those of the point shown, which meets all limits, to the lists, or give more time with --max-seconds"
                .into(),
        );
    }
    Chosen { rows: Vec::new(), outcome, subject: None }
}
