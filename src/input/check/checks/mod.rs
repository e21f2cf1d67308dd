//! `[[checks]]`: which ribs and cases, with what data; their rows join the constraints.

mod data;
mod facts;
mod local;
mod moments;

use std::collections::HashMap;

use super::Assembly;
use super::spread::Choice;
use crate::expression::ast::Collection;
use crate::expression::parse::parse;
use crate::input::codes::{Effects, Known, Places, Row, Where};
use crate::input::declaration::checks::CheckEntry;
use crate::input::source::{Place, Written};
use crate::problem::checks::{Check, CheckRow};
use crate::problem::glob::matches;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::resolve::{ItemScope, Report, Resolver, Stage};
use crate::problem::{Constraint, Formula, Scope};
use data::{CODES, Code};
use facts::{Facts, loaded};

/// A row's name, detail, short text, text and station.
type Key = (String, String, String, String, Option<u64>);

impl Assembly<'_> {
    /// All checks, in the file's order.
    pub(super) fn checks(&mut self, entries: &[CheckEntry]) {
        for (at, entry) in entries.iter().enumerate() {
            let name = entry.name.as_ref().map_or_else(|| format!("check{}", at + 1), |name| name.text.clone());
            self.check(entry, name);
        }
    }

    fn check(&mut self, entry: &CheckEntry, name: String) {
        let what = format!("check `{name}`");
        let Some(scope) = self.ribs_checked(entry, &what) else { return };
        let (code, cases) = (self.code(entry, &what, &scope), self.cases_checked(entry, &what));
        let (Some(code), Some(cases)) = (code, cases) else { return };
        if !self.findings.clean() || !self.suits(entry, &code, &scope, &what) {
            return;
        }
        let title = entry.code.as_ref().and_then(|code| CODES.iter().find(|(known, _)| *known == code.text));
        let mut check = Check {
            name,
            code: format!("{}, {}", title.map_or("", |(_, title)| title), code.clauses()),
            assumptions: self.assumptions(entry, &scope),
            rows: Vec::new(),
        };
        for case in cases {
            self.case_rows(entry, &code, &scope, case, &mut check);
        }
        self.local_rows(entry, &code, &scope, &mut check);
        self.problem.checks.push(check);
    }

    /// The ribs chosen.
    fn ribs_checked(&mut self, entry: &CheckEntry, what: &str) -> Option<ItemScope> {
        let Some(structure) = self.problem.structure.clone() else {
            let help = "declare [nodes], [supports] and ribs with `start` and `end`";
            self.findings.mistake(
                MistakeCode::NoStructure,
                entry.place,
                format!("{what} needs a structure, and there is none"),
                help,
            );
            return None;
        };
        if entry.ribs.is_empty() {
            self.findings.mistake(
                MistakeCode::MissingKey,
                entry.place,
                format!("{what} needs `ribs`"),
                "add it: names or patterns, as ribs = [\"c*\"]",
            );
            return None;
        }
        let mut chosen: Vec<u32> = Vec::new();
        for pattern in &entry.ribs {
            let names = &self.problem.ribs.names;
            let hits: Vec<u32> = (0..names.len() as u32).filter(|&rib| matches(&pattern.text, &names[rib as usize])).collect();
            if hits.is_empty() {
                let help = did_you_mean(&pattern.text, names.iter().take(10_000));
                self.findings.mistake(
                    MistakeCode::UnknownItem,
                    pattern.place,
                    format!("no rib is called `{}`", pattern.text),
                    help,
                );
                return None;
            }
            if let Some(&rib) = hits.iter().find(|&&rib| structure.member(rib).is_none()) {
                let message = format!("rib `{}` has no nodes, so it is no part of the structure", &names[rib as usize]);
                self.findings.mistake(
                    MistakeCode::NoStructure,
                    pattern.place,
                    message,
                    "give it `start` and `end`, or choose others",
                );
                return None;
            }
            chosen.extend(hits);
        }
        chosen.sort_unstable();
        chosen.dedup();
        Some(ItemScope::of(&self.problem, Collection::Ribs, chosen))
    }

    fn cases_checked(&mut self, entry: &CheckEntry, what: &str) -> Option<Vec<u32>> {
        if entry.cases.is_empty() {
            let help = "add it: cases and combinations, as cases = [\"ULS*\"]";
            self.findings.mistake(MistakeCode::MissingKey, entry.place, format!("{what} needs `cases`"), help);
            return None;
        }
        Some(self.cases(&entry.cases)?.into_iter().flatten().collect())
    }

    /// Rows of all ribs under a case: those of ribs of which the same is known are the same.
    fn case_rows(&mut self, entry: &CheckEntry, code: &Code, scope: &ItemScope, case: u32, check: &mut Check) {
        let mut groups: Vec<(Facts, Vec<u32>)> = Vec::new();
        let on_spans = self.problem.structure.as_deref().map(|structure| loaded(structure, case)).unwrap_or_default();
        for &rib in &scope.members {
            let facts = self.facts(code, rib, case, &on_spans);
            match groups.iter_mut().find(|(known, _)| *known == facts) {
                Some((_, ribs)) => ribs.push(rib),
                None => groups.push((facts, vec![rib])),
            }
        }
        let mut list: Vec<(Key, Row, Vec<u32>)> = Vec::new();
        let mut known: HashMap<Key, usize> = HashMap::new();
        for (facts, ribs) in groups {
            if let Some(sides) = facts.sides(code) {
                let first = self.problem.item_name(Collection::Ribs, ribs[0]);
                let more = if ribs.len() > 1 { format!(" and {} more", ribs.len() - 1) } else { String::new() };
                let told = format!("{first}{more}: {sides}");
                if !check.assumptions.contains(&told) {
                    check.assumptions.push(told);
                }
            }
            for row in facts.rows(code) {
                let station = row.station.filter(|_| facts.tapered).map(f64::to_bits);
                let key = (row.clause.clone(), row.detail.clone(), row.short.clone(), row.require.clone(), station);
                match known.get(&key) {
                    Some(&at) => list[at].2.extend(&ribs),
                    None => {
                        known.insert(key.clone(), list.len());
                        list.push((key, row, ribs.clone()));
                    }
                }
            }
        }
        for (_, row, mut ribs) in list {
            ribs.sort_unstable();
            let items = ItemScope::of(&self.problem, Collection::Ribs, ribs.clone());
            self.push_row(entry, row, &items, Scope::Ribs(ribs), check);
        }
    }

    /// A row of a check becomes a constraint like any other.
    fn push_row(&mut self, entry: &CheckEntry, row: Row, items: &ItemScope, scope: Scope, check: &mut Check) {
        let written = Written { text: row.require, place: entry.place, inside: None };
        let name = format!("{} {}", check.name, row.clause);
        self.choice = Choice::at(row.station);
        self.quiet = true;
        let found = self.requirement(&written, Some(items), &scope, &name);
        self.quiet = false;
        self.choice = Choice::default();
        let names = items.members.iter().map(|&index| self.problem.item_name(items.collection, index).to_owned());
        let (names, count) = (names.collect(), items.members.len());
        for (name, left, right) in found {
            let (detail, place, text) = (row.detail.as_str().into(), self.spoken(entry.place), row.short.clone());
            self.problem.constraints.push(Constraint {
                name,
                detail,
                place,
                text,
                scope: scope.clone(),
                left,
                right,
                asked: Vec::new(),
            });
        }
        check.note(CheckRow { clause: row.clause, short: row.short, names: row.names, items: names, count });
    }

    /// The formula of a text in the ribs' names; nothing is said of mistakes.
    fn quietly(&mut self, text: &str, scope: &ItemScope) -> Option<Formula> {
        let tree = parse(text).ok()?;
        Resolver::new(self.world(Stage::All), Some(scope), &mut Report::default()).scalar(&tree)
    }

    /// What was assumed, as the file says it.
    fn assumptions(&self, entry: &CheckEntry, scope: &ItemScope) -> Vec<String> {
        let names = scope.members.iter().take(10).map(|&rib| self.problem.item_name(Collection::Ribs, rib));
        let more = if scope.members.len() > 10 { ", …" } else { "" };
        let ribs = format!("ribs: {}{more}", names.collect::<Vec<_>>().join(", "));
        let Place::File { start, .. } = entry.place else { return vec![ribs] };
        // The entry's own lines, to the next table.
        let lines = self.source.text.get(start as usize..).unwrap_or_default().lines().skip(1);
        let own = lines.take_while(|line| !line.trim_start().starts_with('['));
        let data = own.map(str::trim).filter(|line| line.contains('=') && !line.starts_with('#'));
        let told = data.filter(|line| !["name", "code", "ribs"].iter().any(|key| line.starts_with(key)));
        [ribs].into_iter().chain(told.map(str::to_owned)).collect()
    }
}
