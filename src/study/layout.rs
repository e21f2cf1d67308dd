//! Which points a study has, and which of them are solved one after the other.

use std::collections::HashMap;
use std::path::Path;

use toml::Spanned;

use super::axis::Axis;
use super::declaration::{Declaration, Method, Pareto};
use super::mistakes::Mistakes;
use super::problem::{beside, computed};
use super::{MOST_POINTS, Point, Quantity, designs, points_file};
use crate::run::RunError;

/// Points of a chain at the most: what begins cold once may go on warm this often, and no worker holds more.
const LONGEST_CHAIN: usize = 16;

/// Points, or a front to be found.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Layout {
    Points(Points),
    Front(Front),
}

/// Points that are known beforehand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Points {
    pub axes: Vec<Axis>,
    pub points: Vec<Point>,
    /// Numbers of points, each once.
    pub chains: Vec<Vec<usize>>,
    /// Whether a point of a chain starts at the answer before it.
    pub warm: bool,
    /// Whether points are all combinations of the axes' values.
    pub is_grid: bool,
    /// Whether every point but the first moves one name alone.
    pub is_centered: bool,
}

/// Two objectives against one another.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Front {
    pub objectives: [String; 2],
    pub points: usize,
}

/// The varied name of a front's points: the limit on the second objective.
pub(super) const LIMIT: &str = "limit";

/// What the front's objectives are called among the problem's definitions.
const OBJECTIVES: [&str; 2] = ["pareto_first", "pareto_second"];

/// The columns of their values.
const COLUMNS: [&str; 2] = ["first", "second"];

impl Default for Layout {
    fn default() -> Self {
        let (axes, points, chains) = (Vec::new(), Vec::new(), Vec::new());
        Layout::Points(Points { axes, points, chains, warm: false, is_grid: false, is_centered: false })
    }
}

impl Layout {
    /// The varied names.
    pub fn names(&self) -> Vec<&str> {
        match self {
            Layout::Points(points) => points.axes.iter().map(|axis| axis.name.as_str()).collect(),
            Layout::Front(_) => vec![LIMIT],
        }
    }

    /// Whether points may be chained along this name.
    pub fn may_chain(&self, name: &str) -> bool {
        name == NONE || matches!(self, Layout::Points(_)) && self.names().contains(&name)
    }

    /// The point by which the problem is looked at.
    pub fn first(&self) -> Point {
        match self {
            Layout::Points(points) => points.points.first().cloned().unwrap_or_default(),
            Layout::Front(_) => Point { values: vec![None], ..Point::default() },
        }
    }

    /// What is asked for at every point by itself.
    pub fn quantities(&self) -> Vec<Quantity> {
        match self {
            Layout::Points(_) => Vec::new(),
            Layout::Front(front) => {
                let both = OBJECTIVES.iter().zip(COLUMNS).zip(&front.objectives);
                both.map(|((name, column), text)| Quantity { column: column.into(), name: (*name).into(), text: text.clone() })
                    .collect()
            }
        }
    }
}

const NONE: &str = "none";

/// The points of a grid, pairs, single moves or a drawn design.
pub(super) fn laid_out(axes: Vec<Axis>, declared: &Declaration, mistakes: &mut Mistakes<'_>) -> Option<Layout> {
    let design = &declared.design;
    let counts: Vec<usize> = axes.iter().map(|axis| axis.values.len()).collect();
    let span = design.samples.as_ref().map_or_else(|| declared.problem.span(), Spanned::span);
    let valued = |at: Vec<usize>| -> Vec<Option<f64>> { at.iter().zip(&axes).map(|(&at, axis)| Some(axis.values[at])).collect() };
    let values: Vec<Vec<Option<f64>>> = match design.method {
        method if method.draws() => drawn(&axes, declared, mistakes)?,
        Method::Zip => {
            if counts.iter().any(|&count| count != counts[0]) {
                mistakes.tell(span, format!("names taken together need equally many values; here {counts:?}"), None);
                return None;
            }
            (0..counts[0]).map(|at| valued(vec![at; axes.len()])).collect()
        }
        Method::Centered => designs::centered(&counts)
            .into_iter()
            .map(|point| point.iter().zip(&axes).map(|(at, axis)| at.map(|at| axis.values[at])).collect())
            .collect(),
        _ => {
            let total = counts.iter().fold(1u64, |product, &count| product.saturating_mul(count as u64));
            if total > u64::from(MOST_POINTS) {
                let message = format!("the grid has {total} points; a study has at most {MOST_POINTS}");
                mistakes.tell(span, message, Some("draw some of them: [design] method = \"sobol\", samples = 1000"));
                return None;
            }
            designs::grid(&counts).into_iter().map(valued).collect()
        }
    };
    Some(chained(axes, values, declared))
}

/// Points by numbers drawn between the ends of the axes.
fn drawn(axes: &[Axis], declared: &Declaration, mistakes: &mut Mistakes<'_>) -> Option<Vec<Vec<Option<f64>>>> {
    let design = &declared.design;
    let Some(samples) = &design.samples else {
        mistakes.tell(declared.problem.span(), "points that are drawn need [design] samples", Some("as in samples = 256"));
        return None;
    };
    let (count, limit) = (*samples.get_ref(), designs::MOST_SOBOL);
    let most = if design.method == Method::Sobol { limit.0 as u32 } else { MOST_POINTS };
    if count == 0 || count > most || (design.method == Method::Sobol && axes.len() > limit.1) {
        let names = if design.method == Method::Sobol { format!(" of at most {} names", limit.1) } else { String::new() };
        mistakes.tell(samples.span(), format!("from 1 to {most} points{names} can be drawn"), None);
        return None;
    }
    let shares = match design.method {
        Method::LatinHypercube => designs::latin_hypercube(count as usize, axes.len(), design.seed),
        Method::Sobol => designs::sobol(count as usize, axes.len(), design.seed),
        _ => designs::random(count as usize, axes.len(), design.seed),
    };
    Some(shares.iter().map(|point| point.iter().zip(axes).map(|(&share, axis)| Some(axis.at(share))).collect()).collect())
}

/// The points of a table, whose columns are the varied names.
pub(super) fn listed(
    file: &Path,
    problem: &Path,
    declared: &Declaration,
    mistakes: &mut Mistakes<'_>,
) -> Result<Option<Layout>, RunError> {
    let Some(table) = &declared.design.table else {
        mistakes.tell(declared.problem.span(), "a list needs [design] table", Some("as in table = \"points.csv\""));
        return Ok(None);
    };
    if let Some(name) = declared.vary.keys().next() {
        let help = "leave [vary] out: the table's columns are the varied names";
        mistakes.tell(name.span(), "points of a list are in its table", Some(help));
    }
    let list = match points_file::read(&beside(file, table.get_ref())) {
        Ok(list) => list,
        Err(message) => {
            mistakes.tell(table.span(), message, None);
            return Ok(None);
        }
    };
    let numbers = computed(problem, list.texts)?;
    let values: Vec<Vec<Option<f64>>> =
        list.cells.iter().map(|row| row.iter().map(|cell| cell.number(&numbers)).collect()).collect();
    let column = |at: usize| values.iter().filter_map(|row: &Vec<Option<f64>>| row[at]).collect();
    let axes = list.names.iter().enumerate().map(|(at, name)| Axis::of(name, column(at))).collect();
    Ok(Some(chained(axes, values, declared)))
}

/// A front between two objectives.
pub(super) fn front(pareto: &Spanned<Pareto>, declared: &Declaration, mistakes: &mut Mistakes<'_>) -> Option<Layout> {
    let asked = pareto.get_ref();
    if let Some(name) = declared.vary.keys().next() {
        let help = "make one study for each: the front of this one varies the limit on the second objective";
        mistakes.tell(name.span(), "a study has either [vary] or [pareto]", Some(help));
    }
    let objectives: Vec<String> = asked.minimize.get_ref().iter().map(|text| text.get_ref().clone()).collect();
    let points = *asked.points.get_ref();
    if !(3..=1000).contains(&points) {
        mistakes.tell(asked.points.span(), "a front has from 3 to 1000 points", None);
    }
    let Ok(objectives) = <[String; 2]>::try_from(objectives) else {
        mistakes.tell(asked.minimize.span(), "a front is between two objectives", Some("as in minimize = [\"volume\", \"sag\"]"));
        return None;
    };
    Some(Layout::Front(Front { objectives, points: points as usize }))
}

/// Points with their chains.
fn chained(axes: Vec<Axis>, values: Vec<Vec<Option<f64>>>, declared: &Declaration) -> Layout {
    let method = declared.design.method;
    let asked = declared.run.chain.as_ref().map(|chain| chain.get_ref().as_str());
    let named = asked.and_then(|name| axes.iter().position(|axis| axis.name == name));
    // The longest axis of a grid has the most to gain; of other points none lie on a line by themselves.
    let longest = || (0..axes.len()).rev().max_by_key(|&at| axes[at].values.len());
    let along = if asked.is_none() && method == Method::Grid { longest() } else { named };
    let points: Vec<Point> = values.into_iter().enumerate().map(|(number, values)| Point { number, values }).collect();
    let lines = match along {
        None => vec![(0..points.len()).collect()],
        Some(axis) if method == Method::Grid => lines(&points, axis),
        Some(axis) => vec![along_axis(&points, (0..points.len()).collect(), axis)],
    };
    let chains = lines.iter().flat_map(|line| line.chunks(LONGEST_CHAIN).map(<[usize]>::to_vec)).collect();
    let (is_grid, is_centered) = (method == Method::Grid, method == Method::Centered);
    Layout::Points(Points { axes, points, chains, warm: along.is_some(), is_grid, is_centered })
}

/// The points that differ along this axis alone, line by line.
fn lines(points: &[Point], axis: usize) -> Vec<Vec<usize>> {
    let mut found: Vec<Vec<usize>> = Vec::new();
    let mut known: HashMap<Vec<Option<u64>>, usize> = HashMap::new();
    for point in points {
        let others = point.values.iter().enumerate().filter(|(at, _)| *at != axis);
        let key: Vec<Option<u64>> = others.map(|(_, value)| value.map(f64::to_bits)).collect();
        let line = *known.entry(key).or_insert_with(|| {
            found.push(Vec::new());
            found.len() - 1
        });
        found[line].push(point.number);
    }
    found.into_iter().map(|line| along_axis(points, line, axis)).collect()
}

fn along_axis(points: &[Point], mut line: Vec<usize>, axis: usize) -> Vec<usize> {
    let value = |number: usize| points[number].values[axis].unwrap_or(f64::NEG_INFINITY);
    line.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
    line
}
