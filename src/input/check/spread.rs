//! Constraints on responses that leave out the case, the station or the point: one row each.

use super::Assembly;
use crate::expression::ast::{Collection, Requirement};
use crate::expression::parse::parse_requirement;
use crate::input::declaration::ConstraintEntry;
use crate::input::source::Written;
use crate::problem::glob::matches;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::resolve::outer::names_outer;
use crate::problem::resolve::{Chosen, ItemScope, Open, Report, Resolver, Stage};
use crate::problem::structure::{Plane, Structure};
use crate::sections;

/// Rows beyond this number are warned of.
const MANY_ROWS: usize = 1_000_000;

/// One case, station and point.
#[derive(Default, Clone)]
pub(super) struct Choice {
    case: Option<u32>,
    station: Option<f64>,
    point: Option<String>,
    sign: f64,
    /// The item, where each is resolved by itself.
    item: Option<(Collection, u32)>,
    /// How rows are told apart: `ULS, 0.5, top-left`.
    pub(super) detail: Box<str>,
}

impl Choice {
    /// The station of properties that name none.
    pub(super) fn at(station: Option<f64>) -> Choice {
        Choice { station, ..Choice::default() }
    }

    pub(super) fn chosen(&self) -> Chosen<'_> {
        Chosen {
            case: self.case,
            station: self.station,
            point: self.point.as_deref(),
            sign: self.sign,
            item: self.item,
            index: None,
        }
    }
}

impl Assembly<'_> {
    /// What a constraint is spread over, each with the ribs it concerns where that depends on the point; `None` after a mistake.
    pub(super) fn spread(
        &mut self,
        entry: &ConstraintEntry,
        require: &Written,
        items: Option<&ItemScope>,
    ) -> Option<Vec<(Choice, Option<Vec<u32>>)>> {
        let cases = self.cases(&entry.cases)?;
        let mut list = Vec::new();
        for case in cases {
            let probe = Choice { case, station: Some(0.0), point: Some("top".into()), ..Choice::default() };
            let open = self.open(require, items, probe);
            let Some(structure) = self.problem.structure.clone().filter(|_| !open.sets.is_empty()) else {
                list.push((Choice { case, ..Choice::default() }, None));
                continue;
            };
            let several = open.station || open.stress || open.shear || case.is_some();
            let set = case.or(if open.sets.len() == 1 { open.sets.first().copied() } else { None });
            let name = set.filter(|_| several).map(|set| structure.load_set_name(set).to_owned());
            self.over_stations(&structure, &open, (case, name), items, &mut list);
        }
        self.say_many(entry, items, list.len());
        Some(self.by_item(require, items, list))
    }

    /// Where a sum names the row's item, every item is resolved by itself.
    fn by_item(
        &mut self,
        require: &Written,
        items: Option<&ItemScope>,
        list: Vec<(Choice, Option<Vec<u32>>)>,
    ) -> Vec<(Choice, Option<Vec<u32>>)> {
        let Some(items) = items.filter(|items| !items.grouped) else { return list };
        let names = |requirement: &Requirement| names_outer(requirement, &self.names, &self.problem);
        // A text that cannot be read is told where its rows are made.
        if !parse_requirement(&require.text).is_ok_and(|requirement| names(&requirement)) {
            return list;
        }
        let one = |(choice, ribs): (Choice, Option<Vec<u32>>)| {
            let own = ribs.unwrap_or_else(|| items.members.clone());
            let alone = move |index: u32| (Choice { item: Some((items.collection, index)), ..choice.clone() }, Some(vec![index]));
            own.into_iter().map(alone)
        };
        list.into_iter().flat_map(one).collect()
    }

    fn over_stations(
        &self,
        structure: &Structure,
        open: &Open,
        (case, name): (Option<u32>, Option<String>),
        items: Option<&ItemScope>,
        list: &mut Vec<(Choice, Option<Vec<u32>>)>,
    ) {
        let stations: Vec<Option<f64>> = match open.station {
            true => structure.stations.iter().map(|&station| Some(station)).collect(),
            false => vec![None],
        };
        for station in stations {
            for (point, ribs) in self.open_points(structure, open, items) {
                let signs: &[f64] = if self.twists(structure, open, point.as_deref(), items) { &[1.0, -1.0] } else { &[1.0] };
                for &sign in signs {
                    let turned = (sign < 0.0).then(|| "torsion reversed".to_owned());
                    let parts = [name.clone(), station.map(|station| station.to_string()), point.clone(), turned];
                    let detail = parts.into_iter().flatten().collect::<Vec<_>>().join(", ").into();
                    let item = None;
                    list.push((Choice { case, station, point: point.clone(), sign, item, detail }, ribs.clone()));
                }
            }
        }
    }

    /// The cases a constraint is repeated for; one `None` where it names none.
    pub(super) fn cases(&mut self, patterns: &[Written]) -> Option<Vec<Option<u32>>> {
        if patterns.is_empty() {
            return Some(vec![None]);
        }
        let structure = self.problem.structure.clone();
        let sets = structure.as_deref().map_or(0, Structure::load_sets) as u32;
        let mut found: Vec<u32> = Vec::new();
        for pattern in patterns {
            let name = |set: u32| structure.as_deref().map_or("", |structure| structure.load_set_name(set));
            let hits: Vec<u32> = (0..sets).filter(|&set| matches(&pattern.text, name(set))).collect();
            if hits.is_empty() {
                let help = crate::problem::nearest::did_you_mean(&pattern.text, (0..sets).map(name));
                let message = format!("no case or combination is called `{}`", pattern.text);
                self.findings.mistake(MistakeCode::UnknownItem, pattern.place, message, help);
                return None;
            }
            found.extend(hits);
        }
        found.sort_unstable();
        found.dedup();
        Some(found.into_iter().map(Some).collect())
    }

    /// What the responses of a text leave open. Mistakes are found when its rows are read.
    fn open(&mut self, require: &Written, items: Option<&ItemScope>, probe: Choice) -> Open {
        let Some(requirement) = self.parsed(require, parse_requirement) else { return Open::default() };
        let trees = match &requirement {
            Requirement::Two { left, right, .. } => vec![left, right],
            Requirement::Range { lower, middle, upper } => vec![lower, middle, upper],
        };
        self.choice = probe;
        let mut report = Report::default();
        for tree in trees {
            Resolver::new(self.world(Stage::All), items, &mut report).value(tree);
        }
        self.choice = Choice::default();
        report.open.forms.sort_unstable();
        report.open.forms.dedup();
        report.open
    }

    /// The points that are left open, each with the ribs whose sections have it.
    fn open_points(
        &self,
        structure: &Structure,
        open: &Open,
        items: Option<&ItemScope>,
    ) -> Vec<(Option<String>, Option<Vec<u32>>)> {
        if !open.stress && !open.shear {
            return vec![(None, None)];
        }
        let of_form = |form: u16| {
            let points = sections::kind_of(form).points(sections::form(form));
            let normal = if structure.plane == Plane::Space { points.normal } else { points.upright };
            let shear = if open.shear { points.shear } else { &[] };
            normal.iter().chain(shear.iter().filter(|point| !normal.contains(point))).copied().collect::<Vec<_>>()
        };
        let by_form: Vec<(u16, Vec<&str>)> = open.forms.iter().map(|&form| (form, of_form(form))).collect();
        let mut names: Vec<&str> = Vec::new();
        for (_, points) in &by_form {
            points.iter().for_each(|point| {
                if !names.contains(point) {
                    names.push(point);
                }
            });
        }
        let with = |point: &str| {
            let members = &items?.members;
            let has = |&&rib: &&u32| {
                let form = self.problem.sections.form[self.problem.ribs.from[rib as usize] as usize];
                by_form.iter().any(|(known, points)| *known == form && points.contains(&point))
            };
            Some(members.iter().filter(has).copied().collect::<Vec<u32>>())
        };
        names.into_iter().map(|point| (Some(point.to_owned()), with(point))).collect()
    }

    /// Whether torsion and shear forces both count at a point, so that torsion has to be taken either way.
    fn twists(&self, structure: &Structure, open: &Open, point: Option<&str>, items: Option<&ItemScope>) -> bool {
        let Some(point) = point.filter(|_| open.sign && open.shear && structure.plane == Plane::Space) else { return false };
        let _ = items;
        open.forms.iter().any(|&form| sections::twists(form, point))
    }

    fn say_many(&mut self, entry: &ConstraintEntry, items: Option<&ItemScope>, spread: usize) {
        let rows = spread * items.map_or(1, |items| items.members.len());
        if rows > MANY_ROWS {
            let stations = self.problem.structure.as_deref().map_or(1, |structure| structure.stations.len()).max(1);
            let message = format!("this constraint makes {rows} rows");
            let help = format!("`stations = 3` in [structure] would make {}", rows / stations * 3);
            self.findings.warning(MistakeCode::ManyRows, entry.place, message, help);
        }
    }
}
