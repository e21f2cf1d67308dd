//! Pictures of a study, by what it varies.

use super::{Row, Study, Table, lower_bound, tangents};
use crate::problem::Sense;
use crate::report::pictures::studies::{Answer, Course, Front, HeatMap, Swing, course, front, heat_map, parallel, tornado};

/// Points along a front's bound.
const FINE: usize = 400;

/// Cells of a map at the most, each with a place of its own.
const MOST_CELLS: usize = 40_000;

/// Names and SVG texts: what there is to see in the rows by now.
pub fn pictures(study: &Study, table: &Table) -> Vec<(String, String)> {
    let mut list = Vec::new();
    let mut add = |name: &str, picture: Option<String>| list.extend(picture.map(|text| (format!("{name}.svg"), text)));
    if let Some(objectives) = study.objectives() {
        add("front", of_front(study, objectives, table));
        return list;
    }
    let axes: Vec<(usize, Vec<f64>)> =
        (0..study.names().len()).map(|at| (at, values(table, at))).filter(|(_, values)| values.len() > 1).collect();
    match axes.as_slice() {
        [] => {}
        _ if study.is_centered() => add("tornado", of_swings(study, table)),
        [(axis, _)] => add("course", Some(of_courses(study, table, *axis))),
        [one, two] if study.is_grid() => {
            let longest = if two.1.len() > one.1.len() { two.0 } else { one.0 };
            add("course", Some(of_courses(study, table, longest)));
            add("map", of_map(study, table, [one, two]));
        }
        _ => add("parallel", Some(of_lines(study, table))),
    }
    list
}

/// The values of a varied name in the table, each once, in their order.
fn values(table: &Table, axis: usize) -> Vec<f64> {
    let mut list: Vec<f64> = table.rows.iter().filter_map(|row| row.varied.get(axis).copied().flatten()).collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

fn answer(row: &Row) -> Answer {
    match (row.exit, row.objective) {
        (Some(0), Some(value)) => Answer::Certified(value),
        (_, Some(value)) => Answer::Open(value),
        (Some(3 | 4), None) => Answer::None,
        _ => Answer::Unknown,
    }
}

fn of_front(study: &Study, [first, second]: &[String; 2], table: &Table) -> Option<String> {
    let known = tangents(&table.rows);
    let (low, high) = (known.first()?.at[0], known.last()?.at[0]);
    let at = |step: usize| low + (high - low) * step as f64 / FINE as f64;
    let bound = (0..=FINE).filter_map(|step| Some([at(step), lower_bound(&known, study.class, at(step))?])).collect();
    let points = known.iter().map(|tangent| (tangent.at, tangent.slope)).collect();
    Some(front(&study.title, &Front { names: [second.clone(), first.clone()], points, bound }))
}

fn of_swings(study: &Study, table: &Table) -> Option<String> {
    let base = table.rows.first().filter(|row| row.varied.iter().all(Option::is_none))?.objective?;
    let swing = |(axis, name): (usize, &&str)| {
        let reached = table.rows.iter().filter_map(|row| Some((row.varied[axis]?, row.objective?)));
        let mut reached: Vec<(f64, f64)> = reached.collect();
        reached.sort_by(|a, b| a.1.total_cmp(&b.1));
        Some(Swing { name: (*name).to_owned(), ends: [*reached.first()?, *reached.last()?] })
    };
    let swings: Vec<Swing> = study.names().iter().enumerate().filter_map(swing).collect();
    Some(tornado(&study.title, "objective", base, &swings))
}

/// Lines along an axis, one for every combination of the others.
fn of_courses(study: &Study, table: &Table, axis: usize) -> String {
    let names = study.names();
    let mut courses: Vec<(Vec<Option<u64>>, Course)> = Vec::new();
    for row in &table.rows {
        let Some(value) = row.varied[axis] else { continue };
        let others = || (0..names.len()).filter(|&at| at != axis);
        let key: Vec<Option<u64>> = others().map(|at| row.varied[at].map(f64::to_bits)).collect();
        let number = courses.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
            let words: Vec<String> = others()
                .map(|at| format!("{} = {}", names[at], row.varied[at].map_or("-".into(), |value| value.to_string())))
                .collect();
            courses.push((key, Course { name: words.join(", "), points: Vec::new() }));
            courses.len() - 1
        });
        let proved = row.objective.filter(|_| row.is_certified());
        courses[number].1.points.push((value, proved, row.governs.first().cloned().unwrap_or_default()));
    }
    let mut courses: Vec<Course> = courses.into_iter().map(|(_, course)| course).collect();
    courses.iter_mut().for_each(|course| course.points.sort_by(|a, b| a.0.total_cmp(&b.0)));
    course(&study.title, [names[axis], "objective"], &courses)
}

fn of_map(study: &Study, table: &Table, [one, two]: [&(usize, Vec<f64>); 2]) -> Option<String> {
    if one.1.len() * two.1.len() > MOST_CELLS {
        return None;
    }
    let mut cells = vec![vec![Answer::Unknown; one.1.len()]; two.1.len()];
    for row in &table.rows {
        let place = |(axis, values): &(usize, Vec<f64>)| values.iter().position(|value| Some(*value) == row.varied[*axis]);
        if let (Some(column), Some(line)) = (place(one), place(two)) {
            cells[line][column] = answer(row);
        }
    }
    let names = [one, two].map(|(axis, _)| study.names()[*axis].to_owned());
    Some(heat_map(&study.title, "objective", &HeatMap { names, values: [one.1.clone(), two.1.clone()], cells }))
}

fn of_lines(study: &Study, table: &Table) -> String {
    let mut names = study.names();
    names.push("objective");
    let line = |row: &Row| (row.varied.iter().map(|value| value.unwrap_or(f64::NAN)).collect(), answer(row));
    let points: Vec<(Vec<f64>, Answer)> = table.rows.iter().map(line).collect();
    parallel(&study.title, &names, &points, study.sense == Sense::Maximize)
}
