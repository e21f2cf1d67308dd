//! The table of loads: case, node, rib or line, and what acts there.

use super::super::super::Assembly;
use super::super::loads::Effect;
use super::super::targets::Target;
use super::{filled, find, refuse_others, require, scalar};
use crate::expression::ast::Collection;
use crate::input::fields::Scalar;
use crate::input::source::Written;
use crate::input::table::{Row, Table, Tables};
use crate::problem::Cells;
use crate::problem::glob::matches;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::{Axes, Plane};

/// Columns of the table.
struct Columns {
    case: usize,
    node: Option<usize>,
    rib: Option<usize>,
    line: Option<usize>,
    force: [Option<usize>; 3],
    moment: [Option<usize>; 3],
    axes: Option<usize>,
    at: Option<usize>,
    /// Changes of state: temperature, gradient, pretension.
    states: [Option<usize>; 3],
}

const FORCES: [&str; 3] = ["fx", "fy", "fz"];
const MOMENTS: [&str; 3] = ["mx", "my", "mz"];
const STATES: [&str; 3] = ["temperature", "gradient", "pretension"];

impl Assembly<'_> {
    pub(in crate::input::check::structure) fn load_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        let before = std::mem::replace(&mut self.without.table, true);
        let Some(mut table) = tables.open(written, &mut self.findings) else { return };
        self.columns_of(&table, None);
        let Some(columns) = self.load_columns(&table) else { return };
        while let Some(row) = table.next(&mut self.findings) {
            self.load_row(&row, &columns);
        }
        table.say_how(&mut self.findings);
        self.without.table = before || (table.ragged && self.building.structure.cases.is_empty());
    }

    fn load_columns(&mut self, table: &Table) -> Option<Columns> {
        let known = ["case", "node", "rib", "line", "axes", "at"].into_iter().chain(FORCES).chain(MOMENTS).chain(STATES);
        refuse_others(table, &known.collect::<Vec<_>>(), &mut self.findings);
        let case = require(table, "case", &mut self.findings);
        let (node, rib, line) = (find(table, "node"), find(table, "rib"), find(table, "line"));
        if node.or(rib).or(line).is_none() {
            let place = table.place(1, crate::input::source::Place::WHOLE_ROW);
            let message = "the table lacks a column `node`, `rib` or `line`";
            self.findings.mistake(MistakeCode::Table, place, message, "add one of them to the header");
            return None;
        }
        Some(Columns {
            case: case?,
            node,
            rib,
            line,
            force: FORCES.map(|name| find(table, name)),
            moment: MOMENTS.map(|name| find(table, name)),
            axes: find(table, "axes"),
            at: find(table, "at"),
            states: STATES.map(|name| find(table, name)),
        })
    }

    fn load_row(&mut self, row: &Row, columns: &Columns) {
        if row.field(columns.case).is_empty() {
            self.findings.mistake(MistakeCode::EmptyCell, row.place(columns.case), "this load has no case", "name its load case");
            return;
        }
        let case = self.case(row.field(columns.case), row.place(columns.case));
        let targets = [columns.node, columns.rib, columns.line].map(|at| filled(row, at));
        let (effect, targets) = match targets {
            [Some(node), None, None] => (self.nodal_cells(row, columns), self.targets(Target::Nodes, &row.written(node))),
            [None, Some(rib), None] => {
                let ribs = self.targets(Target::Ribs, &row.written(rib));
                (self.spanning_cells(row, columns), self.members_of(&ribs, &[row.written(rib)]).into())
            }
            [None, None, Some(line)] => {
                let ribs = self.ribs_of_line(&row.written(line));
                (self.spanning_cells(row, columns), self.members_of(&ribs, &[row.written(line)]).into())
            }
            _ => {
                let message = "this load acts on nothing, or on two things";
                self.findings.mistake(
                    MistakeCode::BothGiven,
                    row.place(columns.case),
                    message,
                    "fill one of the cells `node`, `rib` and `line`",
                );
                return;
            }
        };
        let Some(effect) = effect else { return };
        for &target in targets.iter() {
            self.act(case, &effect, target, row.place(columns.case));
        }
    }

    fn nodal_cells(&mut self, row: &Row, columns: &Columns) -> Option<Effect> {
        for at in columns.states.into_iter().chain([columns.at, columns.axes]).filter_map(|at| filled(row, at)) {
            if row.field(at) != "global" {
                self.findings.mistake(MistakeCode::Load, row.place(at), "this belongs to a load on ribs", "leave the cell empty");
            }
        }
        let force = self.components(row, columns.force, self.building.structure.plane.axes(), "a force");
        let moment = self.components(row, columns.moment, self.about_axes(false), "a moment");
        self.something(row, columns, force?, moment?).map(|(force, moment)| Effect::Nodal { force, moment })
    }

    fn spanning_cells(&mut self, row: &Row, columns: &Columns) -> Option<Effect> {
        if let Some(effect) = self.state_cells(row, columns)? {
            return Some(effect);
        }
        let axes = match filled(row, columns.axes) {
            Some(at) => self.axes(&row.written(at))?,
            None => Axes::Global,
        };
        let plane = self.building.structure.plane;
        let local = axes == Axes::Local;
        let along = if local && plane != Plane::Space { &[0, 2] } else { plane.axes() };
        let force = self.components(row, columns.force, along, "a force");
        let moment = self.components(row, columns.moment, self.about_axes(local), "a moment");
        let (force, moment) = self.something(row, columns, force?, moment?)?;
        if let Some(at) = filled(row, columns.at) {
            let at = scalar(row, at).and_then(|at| self.fraction(&at, "at"))?;
            return Some(Effect::Point { axes, force, moment, at });
        }
        if moment != [0.0; 3] {
            let place = row.place(columns.moment.into_iter().flatten().next()?);
            self.findings.mistake(
                MistakeCode::Load,
                place,
                "a moment on a rib needs `at`",
                "add a column `at`, a fraction of the rib's length",
            );
            return None;
        }
        Some(Effect::Distributed { axes, force, force_end: force, from: 0.0, to: 1.0 })
    }

    /// `Some(None)` where no cell of these is filled, `None` after a mistake.
    fn state_cells(&mut self, row: &Row, columns: &Columns) -> Option<Option<Effect>> {
        let given = columns.states.map(|at| filled(row, at));
        let forces = columns.force.into_iter().chain(columns.moment).find_map(|at| filled(row, at));
        let count = given.iter().flatten().count() + usize::from(forces.is_some());
        let Some(at) = given.iter().flatten().copied().next() else { return Some(None) };
        if count > 1 {
            self.findings.mistake(
                MistakeCode::BothGiven,
                row.place(at),
                "a load of two kinds",
                "write a row of its own for each",
            );
            return None;
        }
        let value = scalar(row, at).and_then(|scalar| self.finite(&scalar))?;
        Some(Some(match given {
            [Some(_), ..] => Effect::Temperature(value),
            [_, Some(_), _] => Effect::Gradient(value),
            _ => Effect::Pretension(value),
        }))
    }

    /// The axes moments have: all in space, the normal in a plane.
    fn about_axes(&self, local: bool) -> &'static [usize] {
        match self.building.structure.plane {
            Plane::Space => &[0, 1, 2],
            Plane::Xy if !local => &[2],
            _ => &[1],
        }
    }

    /// Numbers of cells along the given axes; other cells are empty or 0.
    fn components(&mut self, row: &Row, columns: [Option<usize>; 3], axes: &[usize], what: &str) -> Option<[f64; 3]> {
        self.nothing_along_others(row, columns, axes, what);
        let mut parts = [0.0; 3];
        for &axis in axes {
            if let Some(scalar) = columns[axis].and_then(|at| scalar(row, at)) {
                parts[axis] = match scalar {
                    Scalar::Number(value, _) if value.is_finite() => value,
                    other => self.finite(&other)?,
                };
            }
        }
        Some(parts)
    }

    /// The mistake of a row in which no force and no moment stands.
    fn something(&mut self, row: &Row, columns: &Columns, force: [f64; 3], moment: [f64; 3]) -> Option<([f64; 3], [f64; 3])> {
        if columns.force.into_iter().chain(columns.moment).all(|at| filled(row, at).is_none()) {
            let help = "fill a cell of fx, fy, fz, mx, my, mz";
            self.findings.mistake(MistakeCode::Load, row.place(columns.case), "this load says nothing that acts", help);
            return None;
        }
        Some((force, moment))
    }

    /// The ribs whose datum `line` is this, or matches it.
    fn ribs_of_line(&mut self, written: &Written) -> Vec<u32> {
        if self.building.lines.is_none() {
            self.building.lines = Some(self.lines());
        }
        let lines = self.building.lines.as_ref().into_iter().flatten();
        if let Some(ribs) = self.building.lines.as_ref().and_then(|lines| lines.get(written.text.as_str())) {
            return ribs.clone();
        }
        let found: Vec<u32> =
            lines.filter(|(line, _)| matches(&written.text, line)).flat_map(|(_, ribs)| ribs.iter().copied()).collect();
        if found.is_empty() {
            let known = self.building.lines.iter().flatten().map(|(line, _)| &**line);
            let help = did_you_mean(&written.text, known).unwrap_or_else(|| "lines are named by the ribs' datum `line`".into());
            self.findings.mistake(MistakeCode::UnknownItem, written.place, format!("there is no line `{}`", written.text), help);
        }
        found
    }

    /// Ribs by their datum `line`.
    fn lines(&mut self) -> std::collections::BTreeMap<Box<str>, Vec<u32>> {
        let mut lines = std::collections::BTreeMap::<Box<str>, Vec<u32>>::new();
        let columns = self.problem.columns(Collection::Ribs);
        let Some(at) = columns.iter().position(|column| column.name == "line") else { return lines };
        self.used.push((Collection::Ribs, at as u32));
        for rib in 0..self.problem.ribs.names.len() as u32 {
            let label: Option<Box<str>> = match &self.problem.columns(Collection::Ribs)[at].cells {
                Cells::Labels { .. } => self.problem.label(Collection::Ribs, at as u32, rib).map(Box::from),
                Cells::Numbers(numbers) => {
                    let value = numbers.get(rib as usize).filter(|value| !value.is_nan());
                    value.map(|value| value.to_string().into())
                }
            };
            if let Some(label) = label {
                lines.entry(label).or_default().push(rib);
            }
        }
        lines
    }
}
